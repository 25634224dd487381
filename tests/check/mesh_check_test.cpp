#include "sim/check/mesh_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/core/errors.hpp"

namespace witherfield::check {
namespace {

using Points = std::vector<TriMesh::Point>;
using Faces = std::vector<std::array<int, 3>>;

TriMesh build(const Points& points, const Faces& faces, bool flipped = false) {
  TriMesh m;
  for (const auto& p : points) m.add_vertex(p);
  for (const auto& f : faces) {
    const TriMesh::VertexHandle a{f[0]}, b{f[flipped ? 2 : 1]}, c{f[flipped ? 1 : 2]};
    EXPECT_TRUE(m.add_face(a, b, c).is_valid());
  }
  return m;
}

const Points kCubePoints{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Faces kCubeFaces{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
const Faces kTetFaces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

TriMesh moved(TriMesh m, const TriMesh::Point& by, double scale = 1) {
  for (const auto v : m.vertices()) m.set_point(v, m.point(v) * scale + by);
  return m;
}

// An n x n sheet in the plane z = 0.1 x.
TriMesh sheet(int n, bool flipped = false) {
  Points points;
  Faces faces;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) points.push_back({double(i), double(j), 0.1 * i});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2});
      faces.push_back({a, a + n + 2, a + n + 1});
    }
  return build(points, faces, flipped);
}

TEST(MeshCheck, Cube) {
  const MeshReport r = check_mesh(moved(build(kCubePoints, kCubeFaces), {100, -50, 20}, 2));
  EXPECT_EQ(r.vertices, 8u);
  EXPECT_EQ(r.edges, 18u);
  EXPECT_EQ(r.faces, 12u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.border_loops, 0u);
  EXPECT_TRUE(r.closed);
  EXPECT_TRUE(r.manifold);
  EXPECT_TRUE(r.oriented_outward);
  EXPECT_FALSE(r.oriented_up);
  EXPECT_EQ(r.faces_down, 2u);
  EXPECT_NEAR(r.volume_m3, 8, 1e-12);
  EXPECT_NEAR(r.area_m2, 24, 1e-12);
  EXPECT_EQ(r.degenerate_faces, 0u);
  EXPECT_TRUE(r.self_intersections_checked);
  EXPECT_EQ(r.self_intersections, 0u);
  EXPECT_TRUE(r.sound());
}

TEST(MeshCheck, Tetrahedron) {
  const MeshReport r = check_mesh(build({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}}, kTetFaces));
  EXPECT_TRUE(r.closed);
  EXPECT_TRUE(r.oriented_outward);
  EXPECT_DOUBLE_EQ(r.volume_m3, 1);  // 3 * 2 * 1 / 6
  EXPECT_NEAR(r.area_m2, 3 + 1.5 + 1 + 3.5, 1e-12);
}

TEST(MeshCheck, FlippedSolidIsInsideOut) {
  const MeshReport r = check_mesh(build(kCubePoints, kCubeFaces, true));
  EXPECT_TRUE(r.closed);
  EXPECT_FALSE(r.oriented_outward);
  EXPECT_NEAR(r.volume_m3, -1, 1e-12);
}

// One of two solids inside out: the sum of volumes is positive, the orientation is wrong all the same.
TEST(MeshCheck, EveryComponentMustBeOutward) {
  Points points = kCubePoints;
  Faces faces = kCubeFaces;
  for (const auto& p : Points{{5, 0, 0}, {5.5, 0, 0}, {5, 0.5, 0}, {5, 0, 0.5}}) points.push_back(p);
  for (const auto& f : kTetFaces) faces.push_back({f[0] + 8, f[2] + 8, f[1] + 8});
  const MeshReport r = check_mesh(build(points, faces));
  EXPECT_EQ(r.components, 2u);
  EXPECT_TRUE(r.closed);
  EXPECT_GT(r.volume_m3, 0);
  EXPECT_FALSE(r.oriented_outward);
}

TEST(MeshCheck, OpenPlaneHasOneBorder) {
  const MeshReport r = check_mesh(sheet(6));
  EXPECT_EQ(r.border_loops, 1u);
  EXPECT_FALSE(r.closed);
  EXPECT_TRUE(r.manifold);
  EXPECT_TRUE(r.oriented_up);
  EXPECT_FALSE(r.oriented_outward);
  EXPECT_EQ(r.volume_m3, 0);
  EXPECT_NEAR(r.area_m2, 36 * std::sqrt(1.01), 1e-9);
  EXPECT_EQ(r.self_intersections, 0u);
  EXPECT_TRUE(r.sound());
}

TEST(MeshCheck, FlippedPlaneLooksDown) {
  const MeshReport r = check_mesh(sheet(3, true));
  EXPECT_FALSE(r.oriented_up);
  EXPECT_EQ(r.faces_down, 18u);
}

TEST(MeshCheck, HoleIsASecondBorder) {
  TriMesh m = sheet(6);
  m.delete_face(TriMesh::FaceHandle(2 * (2 * 6 + 2)), false);
  EXPECT_THROW(check_mesh(m), InvalidInput);  // deleted, not collected
  m.garbage_collection();
  EXPECT_EQ(check_mesh(m).border_loops, 2u);
}

TEST(MeshCheck, CrossingTrianglesAreNamed) {
  // Face 0 lies apart; faces 1 and 2 cross.
  const TriMesh m = build(
      {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 2, 1}},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  const MeshReport r = check_mesh(m);
  EXPECT_EQ(r.components, 3u);
  ASSERT_EQ(r.self_intersections, 1u);
  EXPECT_EQ(r.self_intersection_ids.front(), (std::pair{1, 2}));
  EXPECT_FALSE(r.sound());
  MeshCheckOptions fast;
  fast.self_intersections = false;
  EXPECT_FALSE(check_mesh(m, fast).self_intersections_checked);
  EXPECT_EQ(check_mesh(m, fast).self_intersections, 0u);
}

TEST(MeshCheck, CountsAreCompleteWhenListsAreShort) {
  // Two sheets that cross each other along a line.
  TriMesh m = sheet(8);
  const int base = int(m.n_vertices());
  const TriMesh other = sheet(8);
  for (const auto v : other.vertices()) {
    const auto p = other.point(v);
    m.add_vertex({p[0], p[1], 0.8 - p[2] + 0.013});
  }
  for (const auto f : other.faces()) {
    std::vector<TriMesh::VertexHandle> c;
    for (const auto v : f.vertices()) c.emplace_back(v.idx() + base);
    m.add_face(c);
  }
  MeshCheckOptions options;
  options.listed = 3;
  const MeshReport r = check_mesh(m, options), all = check_mesh(m, {true, 100000});
  EXPECT_GE(r.self_intersections, 16u);
  EXPECT_EQ(r.self_intersection_ids.size(), 3u);
  EXPECT_EQ(all.self_intersection_ids.size(), all.self_intersections);
  EXPECT_EQ(r.self_intersections, all.self_intersections);
  EXPECT_TRUE(std::is_sorted(all.self_intersection_ids.begin(), all.self_intersection_ids.end()));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(r.self_intersection_ids[k], all.self_intersection_ids[k]);
  for (const auto& [a, b] : all.self_intersection_ids) EXPECT_TRUE(a < 128 && b >= 128);
}

TEST(MeshCheck, DegenerateFaceIsNamed) {
  const MeshReport r = check_mesh(
      build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 3, 3}, {4, 4, 4}, {6, 6, 6}}, {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(r.degenerate_faces, 1u);
  EXPECT_EQ(r.degenerate_ids, std::vector<int>{1});
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, NearlyDegenerateIsNotDegenerate) {
  const double tiny = std::nextafter(1.0, 2.0);
  EXPECT_EQ(check_mesh(build({{0, 0, 0}, {1, 1, 0}, {2, 2 * tiny, 0}}, {{0, 1, 2}})).degenerate_faces, 0u);
}

TEST(MeshCheck, TwoFansAtOneVertexAreNotManifold) {
  const TriMesh m = build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const MeshReport r = check_mesh(m);
  EXPECT_EQ(r.non_manifold_vertices, 1u);
  EXPECT_FALSE(r.manifold);
  EXPECT_EQ(r.components, 2u);
}

TEST(MeshCheck, IsolatedVertex) {
  TriMesh m = build(kCubePoints, kCubeFaces);
  m.add_vertex({7, 7, 7});
  const MeshReport r = check_mesh(m);
  EXPECT_EQ(r.isolated_vertices, 1u);
  EXPECT_TRUE(r.closed);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, NonFiniteVerticesAreCountedAndNothingGeometricIsDone) {
  TriMesh m = build(kCubePoints, kCubeFaces);
  m.set_point(TriMesh::VertexHandle(3), {0, std::numeric_limits<double>::quiet_NaN(), 0});
  m.set_point(TriMesh::VertexHandle(5), {0, 0, std::numeric_limits<double>::infinity()});
  const MeshReport r = check_mesh(m);
  EXPECT_EQ(r.non_finite_vertices, 2u);
  EXPECT_FALSE(r.geometry_checked);
  EXPECT_FALSE(r.self_intersections_checked);
  EXPECT_TRUE(r.closed);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, EmptyMesh) {
  const MeshReport r = check_mesh(TriMesh{});
  EXPECT_EQ(r.faces, 0u);
  EXPECT_FALSE(r.closed);
  EXPECT_FALSE(r.sound());
}

}  // namespace
}  // namespace witherfield::check
