#include "sim/check/mesh_check.hpp"

// CGAL's graph traits of OpenMesh must come before its algorithms.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
// (the algorithms, which look the traits up)
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <unordered_set>

#include "sim/core/errors.hpp"

namespace witherfield::check {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Face = boost::graph_traits<TriMesh>::face_descriptor;
using Halfedge = boost::graph_traits<TriMesh>::halfedge_descriptor;

// A property of faces, kept outside the mesh: which component each belongs to.
struct FaceLabels {
  using key_type = Face;
  using value_type = std::size_t;
  using reference = std::size_t;
  using category = boost::read_write_property_map_tag;
  std::vector<std::size_t>* label;
  friend std::size_t get(const FaceLabels& m, Face f) { return (*m.label)[std::size_t(f.idx())]; }
  friend void put(const FaceLabels& m, Face f, std::size_t value) {
    (*m.label)[std::size_t(f.idx())] = value;
  }
};

template <class Id>
void sort_and_shorten(std::vector<Id>& ids, std::size_t listed) {
  std::sort(ids.begin(), ids.end());
  if (ids.size() > listed) ids.resize(listed);
}

void require_no_deleted(const TriMesh& mesh) {
  // By index: the mesh's own ranges step over what is marked as deleted.
  bool deleted = false;
  for (int k = 0; k < int(mesh.n_vertices()); ++k)
    deleted = deleted || mesh.status(TriMesh::VertexHandle(k)).deleted();
  for (int k = 0; k < int(mesh.n_faces()); ++k)
    deleted = deleted || mesh.status(TriMesh::FaceHandle(k)).deleted();
  if (deleted) throw InvalidInput("check_mesh: the mesh holds deleted elements; collect the garbage first");
}

std::vector<std::size_t> check_topology(const TriMesh& mesh, MeshReport& r) {
  r.vertices = mesh.n_vertices();
  r.edges = mesh.n_edges();
  r.faces = mesh.n_faces();
  std::vector<std::size_t> component(r.faces, 0);
  if (r.faces) r.components = pmp::connected_components(mesh, FaceLabels{&component});

  std::vector<Halfedge> loops;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(loops));
  r.border_loops = loops.size();
  r.closed = r.faces > 0 && r.border_loops == 0;

  std::unordered_set<int> bad;
  std::vector<Halfedge>
      fans;  // one for each fan at a vertex where several meet; names the vertex that it points to
  pmp::non_manifold_vertices(mesh, std::back_inserter(fans));
  for (const Halfedge h : fans) bad.insert(mesh.to_vertex_handle(h).idx());
  for (const auto v : mesh.vertices()) {
    if (!v.halfedge().is_valid()) ++r.isolated_vertices;
    if (mesh.status(v).fixed_nonmanifold()) bad.insert(v.idx());
    const auto& p = mesh.point(v);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) ++r.non_finite_vertices;
  }
  r.non_manifold_vertices = bad.size();
  r.manifold = bad.empty();
  return component;
}

// Areas, volumes (divergence theorem over tetrahedra to one vertex of the mesh, which keeps rounding small)
// and orientation.
void measure(const TriMesh& mesh, const std::vector<std::size_t>& component, MeshReport& r) {
  std::vector<double> volume(r.components, 0.0);
  const auto origin = mesh.point(TriMesh::VertexHandle(0));
  for (const auto f : mesh.faces()) {
    TriMesh::Point p[3];
    int k = 0;
    for (const auto v : f.vertices()) p[k++] = mesh.point(v) - origin;
    const auto normal = (p[1] - p[0]) % (p[2] - p[0]);
    r.area_m2 += normal.norm() / 2;
    if (normal[2] < 0) ++r.faces_down;
    volume[component[std::size_t(f.idx())]] += (p[0] | (p[1] % p[2])) / 6;
  }
  r.oriented_up = r.faces > 0 && r.faces_down == 0;
  if (!r.closed) return;
  for (const double v : volume) r.volume_m3 += v;
  r.oriented_outward = std::all_of(volume.begin(), volume.end(), [](double v) { return v > 0; });
}

void find_degenerate(const TriMesh& mesh, std::size_t listed, MeshReport& r) {
  for (const Face f : faces(mesh))
    if (pmp::is_degenerate_triangle_face(f, mesh)) r.degenerate_ids.push_back(f.idx());
  r.degenerate_faces = r.degenerate_ids.size();
  sort_and_shorten(r.degenerate_ids, listed);
}

// CGAL leaves out nothing here but wants faces with area: a degenerate face has no plane to intersect.
void find_self_intersections(const TriMesh& mesh, std::size_t listed, MeshReport& r) {
  std::vector<Face> sane;
  for (const Face f : faces(mesh))
    if (!pmp::is_degenerate_triangle_face(f, mesh)) sane.push_back(f);
  pmp::self_intersections(sane, mesh,
                          boost::make_function_output_iterator([&](const std::pair<Face, Face>& p) {
                            r.self_intersection_ids.push_back(std::minmax(p.first.idx(), p.second.idx()));
                          }));
  r.self_intersections = r.self_intersection_ids.size();
  sort_and_shorten(r.self_intersection_ids, listed);
  r.self_intersections_checked = true;
}

}  // namespace

MeshReport check_mesh(const TriMesh& mesh, const MeshCheckOptions& options) {
  require_no_deleted(mesh);
  MeshReport report;
  const std::vector<std::size_t> component = check_topology(mesh, report);
  if (report.faces == 0 || report.non_finite_vertices > 0) return report;
  report.geometry_checked = true;
  measure(mesh, component, report);
  find_degenerate(mesh, options.listed, report);
  if (options.self_intersections) find_self_intersections(mesh, options.listed, report);
  return report;
}

}  // namespace witherfield::check
