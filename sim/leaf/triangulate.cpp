#include "sim/leaf/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <string>
#include <unordered_map>

#include "sim/core/errors.hpp"
#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Tds = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Tds, CGAL::Exact_predicates_tag>;
using EdgeLength = std::function<double(const glm::dvec2&)>;

/// CGAL's criteria with a size that varies in the plane.
class SizedCriteria : public CGAL::Delaunay_mesh_size_criteria_2<Cdt> {
  using Base = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;

 public:
  explicit SizedCriteria(const EdgeLength& edge_m) : Base(0.117, 0), edge_m_(&edge_m) {}  // sin^2(20 deg)

  class Is_bad : public Base::Is_bad {
   public:
    Is_bad(const typename Base::Is_bad& base, const EdgeLength& edge_m) : Base::Is_bad(base), edge_m_(&edge_m) {}
    CGAL::Mesh_2::Face_badness operator()(const Quality q) const { return Base::Is_bad::operator()(q); }
    CGAL::Mesh_2::Face_badness operator()(const Cdt::Face_handle& face, Quality& q) const {
      const auto &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
      const double longest = std::max({CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)});
      const double bound = (*edge_m_)({(a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3});
      const CGAL::Mesh_2::Face_badness shape = Base::Is_bad::operator()(face, q);  // sets the sine
      q.second = longest / (bound * bound);
      return q.second > 1 ? CGAL::Mesh_2::IMPERATIVELY_BAD : shape;
    }

   private:
    const EdgeLength* edge_m_;
  };
  Is_bad is_bad_object() const { return Is_bad(Base::is_bad_object(), *edge_m_); }

 private:
  const EdgeLength* edge_m_;
};

Cdt constrained(const PlanarDomain& domain) {
  const auto& o = domain.outline;
  if (o.size() < 3 || !(polygon_area(o) > 0))
    throw InvalidInput("leaf outline: it encloses no area, or runs clockwise (left and right swapped?)");
  const auto [i, j] = self_crossing(o);
  if (i >= 0)
    throw InvalidInput("leaf outline: it crosses itself near (" + std::to_string(o[std::size_t(i)].x) + ", " +
                       std::to_string(o[std::size_t(i)].y) + ") m and (" + std::to_string(o[std::size_t(j)].x) + ", " +
                       std::to_string(o[std::size_t(j)].y) + ") m; points are in a wrong order or too far apart there");
  Cdt cdt;
  const auto add = [&](const std::vector<glm::dvec2>& line, bool closed) {
    std::vector<Cdt::Vertex_handle> vertices;
    for (const glm::dvec2& p : line) vertices.push_back(cdt.insert(Kernel::Point_2(p.x, p.y)));
    for (std::size_t k = 0; k + (closed ? 0 : 1) < vertices.size(); ++k) {
      const auto a = vertices[k], b = vertices[(k + 1) % vertices.size()];
      if (a != b) cdt.insert_constraint(a, b);
    }
  };
  add(o, true);
  for (const auto& line : domain.lines) add(line, false);
  return cdt;
}

/// The faces inside, with vertices numbered as they come in the triangulation.
PlanarMesh inside_of(const Cdt& cdt) {
  PlanarMesh mesh;
  std::unordered_map<const void*, int> number;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    if (!f->is_in_domain()) continue;
    std::array<int, 3> t{};
    for (int k = 0; k < 3; ++k) {
      const auto v = f->vertex(k);
      const auto [at, fresh] = number.try_emplace(&*v, int(mesh.point.size()));
      if (fresh) mesh.point.emplace_back(v->point().x(), v->point().y());
      t[std::size_t(k)] = at->second;
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Marks what lies inside the outline: an even number of crossings of border lines does not do, as veins are lines, too.
void mark_inside(Cdt& cdt, const std::vector<glm::dvec2>& outline) {
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) {
    if (cdt.is_infinite(f)) {
      f->set_in_domain(false);
      continue;
    }
    const auto c = CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    f->set_in_domain(inside_polygon(outline, {c.x(), c.y()}));
  }
}

}  // namespace

PlanarMesh triangulate(const PlanarDomain& domain) {
  Cdt cdt = constrained(domain);
  mark_inside(cdt, domain.outline);
  return inside_of(cdt);
}

PlanarMesh triangulate(const PlanarDomain& domain, const EdgeLength& edge_m, int max_vertices) {
  Cdt cdt = constrained(domain);
  mark_inside(cdt, domain.outline);
  CGAL::Delaunay_mesher_2<Cdt, SizedCriteria> mesher(cdt, SizedCriteria(edge_m));
  mesher.init(true);
  for (long step = 0; !mesher.is_refinement_done(); ++step) {
    mesher.step_by_step_refine_mesh();
    if (cdt.number_of_vertices() > std::size_t(max_vertices))
      throw InvalidInput("leaf mesh: more than max_vertices = " + std::to_string(max_vertices) +
                         " are needed; raise mesh.edge_m, mesh.vein_edge_m or mesh.outline_spacing_m");
  }
  return inside_of(cdt);
}

}  // namespace witherfield::leaf
