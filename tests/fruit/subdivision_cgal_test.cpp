// Loop's scheme on closed smooth meshes as CGAL computes it.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <gtest/gtest.h>

#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::fruit {
namespace {

using namespace fixtures;
using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

Points by_cgal(const ControlMesh& m, int steps) {
  CgalMesh mesh;
  for (const auto& p : m.position_m) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& t : m.triangles)
    mesh.add_face(CgalMesh::Vertex_index(std::uint32_t(t[0])), CgalMesh::Vertex_index(std::uint32_t(t[1])),
                  CgalMesh::Vertex_index(std::uint32_t(t[2])));
  CGAL::Subdivision_method_3::Loop_subdivision(mesh,
                                               CGAL::parameters::number_of_iterations(std::size_t(steps)));
  Points out;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    out.emplace_back(p.x(), p.y(), p.z());
  }
  return out;
}

/// Largest distance from a point of one to the nearest of the other, by sorting along x.
double furthest_from_nearest(const Points& from, Points to) {
  const auto left = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; };
  std::sort(to.begin(), to.end(), left);
  constexpr double reach = 1e-6;
  double worst = 0;
  for (const auto& p : from) {
    double nearest = reach;
    for (auto q = std::lower_bound(to.begin(), to.end(), p - glm::dvec3(reach), left);
         q != to.end() && q->x < p.x + reach; ++q)
      nearest = std::min(nearest, glm::length(*q - p));
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(SubdivisionAgainstCgal, ClosedSmoothMeshes) {
  ControlMesh bumpy = torus(12, 8, 60);
  jiggle(bumpy, 0.1);
  for (const ControlMesh& m :
       {tetrahedron(), octahedron(), icosahedron(), bipyramid(3), bipyramid(7), bipyramid(8), bumpy})
    for (const Scheme scheme : {Scheme::liu2007, Scheme::hoppe1994})
      for (int steps = 1; steps <= 3; ++steps) {
        const Points ours = evaluated(Refinement(m, scheme, steps), m.position_m), theirs = by_cgal(m, steps);
        ASSERT_EQ(ours.size(), theirs.size());
        EXPECT_LT(furthest_from_nearest(ours, theirs), 1e-12);
        EXPECT_LT(furthest_from_nearest(theirs, ours), 1e-12);
      }
}

}  // namespace
}  // namespace witherfield::fruit
