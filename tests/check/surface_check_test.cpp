#include "sim/check/surface_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "tests/check/shapes.hpp"

namespace witherfield::check {
namespace {

using Ids = std::vector<int>;
using Edges = std::vector<std::array<int, 2>>;

Surface soup(std::vector<glm::dvec3> positions, std::vector<std::array<int, 3>> triangles) {
  Surface s;
  s.position_m = std::move(positions);
  s.triangles = std::move(triangles);
  return s;
}

TEST(SurfaceCheck, CubeAwayFromTheOrigin) {
  const MeshReport r = check_surface(shapes::cube({100, -50, 20}, 2));
  EXPECT_EQ(r.vertices, 8u);
  EXPECT_EQ(r.edges, 18u);
  EXPECT_EQ(r.faces, 12u);
  EXPECT_TRUE(r.closed && r.manifold && r.oriented_outward && r.sound());
  EXPECT_NEAR(r.volume_m3, 8, 1e-12);
  EXPECT_NEAR(r.area_m2, 24, 1e-12);
  EXPECT_EQ(r.faces_down, 2u);
  ASSERT_EQ(r.component.size(), 1u);
  EXPECT_EQ(r.component[0].faces, 12u);
}

// A mesh that both can hold must give the same report, whichever way it is checked.
TEST(SurfaceCheck, AgreesWithTheCheckOfOpenMeshMeshes) {
  std::size_t crossings = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Random random(5, Stream::test, std::uint64_t(trial));
    Surface s = trial % 2 ? shapes::ball(7) : shapes::sheet(9);
    append(s, shapes::ball(5, {0.7, 0.2, 0.3}, 0.8));
    if (trial % 3 == 0) s.triangles.erase(s.triangles.begin() + 20);  // a hole
    for (glm::dvec3& p : s.position_m)
      for (int c = 0; c < 3; ++c) p[c] += 0.04 * trial * (random.uniform() - 0.5);  // crumpled more and more
    const MeshCheckOptions all{true, 100000};
    const MeshReport a = check_surface(s, all), b = check_mesh(to_tri_mesh(s), all);
    EXPECT_EQ(a.edges, b.edges);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.border_loops, b.border_loops) << trial;
    EXPECT_EQ(a.isolated_vertices, b.isolated_vertices);
    EXPECT_EQ(a.non_manifold_vertices, b.non_manifold_vertices);
    EXPECT_EQ(a.closed, b.closed);
    EXPECT_EQ(a.manifold, b.manifold);
    EXPECT_EQ(a.faces_down, b.faces_down);
    EXPECT_EQ(a.oriented_outward, b.oriented_outward);
    EXPECT_NEAR(a.area_m2, b.area_m2, 1e-9);
    EXPECT_NEAR(a.volume_m3, b.volume_m3, 1e-9);
    EXPECT_EQ(a.degenerate_ids, b.degenerate_ids);
    auto pairs = a.self_intersection_ids;
    pairs.insert(pairs.end(), a.shell_intersection_ids.begin(), a.shell_intersection_ids.end());
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(pairs, b.self_intersection_ids) << trial;
    crossings += a.self_intersections + a.shell_intersections;
  }
  EXPECT_GT(crossings, 100u);  // there was something to agree about
}

TEST(SurfaceCheck, ThreeFacesAtAnEdge) {
  const MeshReport r = check_surface(soup({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}},
                                          {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(r.non_manifold_edges, 1u);
  EXPECT_EQ(r.non_manifold_edge_ids, (Edges{{0, 1}}));
  EXPECT_EQ(r.components, 1u);
  EXPECT_FALSE(r.manifold);
  EXPECT_FALSE(r.sound());
  EXPECT_EQ(r.self_intersections, 0u);  // they meet in their edge only
}

TEST(SurfaceCheck, TwoCubesGluedAtAnEdge) {
  Surface s = shapes::cube();
  Surface other = shapes::cube({1, 1, 0});
  // vertices 0 and 4 of the second are 2 and 6 of the first
  for (auto t : other.triangles) {
    for (int& v : t) v = v == 0 ? 2 : v == 4 ? 6 : v + 8;
    s.triangles.push_back(t);
  }
  s.position_m.insert(s.position_m.end(), other.position_m.begin(), other.position_m.end());
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.non_manifold_edge_ids, (Edges{{2, 6}}));
  EXPECT_EQ(r.isolated_ids, (Ids{8, 12}));
  EXPECT_FALSE(r.closed);
  EXPECT_EQ(r.border_loops, 0u);
  EXPECT_EQ(r.self_intersections, 0u);
}

TEST(SurfaceCheck, OneFaceOfACubeTurnedRound) {
  Surface s = shapes::cube();
  std::swap(s.triangles[5][0], s.triangles[5][1]);
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.clashing_edges, 3u);
  EXPECT_EQ(r.clashing_edge_ids, (Edges{{0, 4}, {0, 5}, {4, 5}}));
  EXPECT_EQ(r.non_manifold_edges, 0u);
  EXPECT_FALSE(r.closed);
  EXPECT_FALSE(r.sound());
  EXPECT_FALSE(check_surface(s, {false, 0}).sound());
}

TEST(SurfaceCheck, TwoConesTipToTip) {
  Surface s = shapes::ball(4);
  Surface up = shapes::ball(4, {0, 0, 2});
  const int tip = int(s.position_m.size()) - 1,
            base = tip;  // the second ball's vertex 0 is the first one's last
  s.position_m.insert(s.position_m.end(), up.position_m.begin() + 1, up.position_m.end());
  for (auto t : up.triangles) {
    for (int& v : t) v += base;
    s.triangles.push_back(t);
  }
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.non_manifold_vertex_ids, Ids{tip});
  EXPECT_EQ(r.components, 2u);
  EXPECT_TRUE(r.closed);
  EXPECT_FALSE(r.manifold);
  EXPECT_EQ(r.self_intersections, 0u);
}

TEST(SurfaceCheck, FacesThereTwiceAreNamedOnce) {
  Surface s = shapes::cube();
  s.triangles.push_back({2, 1, 0});  // face 0, turned in its corners
  s.triangles.push_back({1, 2, 0});  // and seen from behind
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.duplicate_ids, (Ids{12, 13}));
  EXPECT_EQ(r.non_manifold_edges, 3u);
  EXPECT_EQ(r.self_intersections, 0u);
  EXPECT_FALSE(r.sound());
}

TEST(SurfaceCheck, ACubeInPlaceOfAnotherIsAllDuplicates) {
  Surface s = shapes::cube();
  append(s, shapes::cube());
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.components, 2u);
  EXPECT_EQ(r.duplicate_faces, 12u);
  EXPECT_EQ(r.duplicate_ids.front(), 12);
}

TEST(SurfaceCheck, VerticesDoubledAtASeamAreNoIntersection) {
  Surface s = shapes::sheet(4), other = shapes::sheet(4);
  for (glm::dvec3& p : other.position_m) p += glm::dvec3(4, 0, 0.4);
  for (std::size_t v = 0; v < 5; ++v) other.position_m[5 * v] = s.position_m[5 * v + 4];
  append(s, other);
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.self_intersections, 0u);
  EXPECT_EQ(r.components, 2u);
  EXPECT_EQ(r.border_loops, 2u);
}

TEST(SurfaceCheck, FoldedFlatIsAnIntersection) {
  // the second face lies within the first, across their common edge
  const MeshReport r =
      check_surface(soup({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_EQ(r.self_intersection_ids, (std::vector<std::pair<int, int>>{{0, 1}}));
  const MeshReport beside =
      check_surface(soup({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, -0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_EQ(beside.self_intersections, 0u);
}

TEST(SurfaceCheck, FacesThatShareACornerMayStillCross) {
  const auto pair = [](double z) {
    return soup({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {2, 0, z}, {2, 0.5, 1}}, {{0, 1, 2}, {0, 3, 4}});
  };
  EXPECT_EQ(check_surface(pair(-1)).shell_intersections, 1u);
  EXPECT_EQ(check_surface(pair(0.5)).shell_intersections, 0u);
}

TEST(SurfaceCheck, FaceThatNamesAVertexTwice) {
  Surface s = shapes::cube();
  s.triangles.push_back({3, 3, 7});
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.repeated_corners, 1u);
  EXPECT_EQ(r.degenerate_ids, Ids{12});
  EXPECT_FALSE(r.closed);
  EXPECT_FALSE(r.sound());
}

TEST(SurfaceCheck, NonFiniteVerticesAreNamed) {
  Surface s = shapes::cube();
  s.position_m[3].y = std::numeric_limits<double>::quiet_NaN();
  s.position_m[6].x = std::numeric_limits<double>::infinity();
  const MeshReport r = check_surface(s);
  EXPECT_EQ(r.non_finite_ids, (Ids{3, 6}));
  EXPECT_FALSE(r.geometry_checked);
  EXPECT_FALSE(r.sound());
}

TEST(SurfaceCheck, IndicesOutOfRangeAreRefused) {
  Surface s = shapes::cube();
  for (const int v : {-1, 8}) {
    s.triangles[2][1] = v;
    EXPECT_THROW(check_surface(s), InvalidInput);
  }
  EXPECT_FALSE(check_surface(Surface{}).sound());
}

TEST(SurfaceCheck, EveryShellHasItsOwnReport) {
  Surface s = shapes::cube({0, 0, 0}, 1);
  Surface hollow = shapes::cube({5, 0, 0}, 2);
  shapes::turn_inside_out(hollow);
  append(s, hollow);
  append(s, shapes::sheet(3));
  for (std::size_t v = 16; v < s.position_m.size(); ++v) s.position_m[v].z += 9;
  const MeshReport r = check_surface(s);
  ASSERT_EQ(r.component.size(), 3u);
  EXPECT_NEAR(r.component[0].volume_m3, 1, 1e-12);
  EXPECT_NEAR(r.component[1].volume_m3, -8, 1e-12);
  EXPECT_EQ(r.component[1].first_face, 12);
  EXPECT_NEAR(r.component[1].area_m2, 24, 1e-12);
  EXPECT_FALSE(r.component[2].closed);
  EXPECT_EQ(r.component[2].border_edges, 12u);
  EXPECT_EQ(r.component[2].volume_m3, 0);
  EXPECT_FALSE(r.closed);
  EXPECT_FALSE(r.oriented_outward);
}

TEST(SurfaceCheck, SameForAnyOrderOfFacesAndAnyNumberOfThreads) {
  Surface s = shapes::ball(12);
  append(s, shapes::ball(12, {0.9, 0.1, 0.2}));
  const MeshCheckOptions all{true, 100000};
  const MeshReport r = check_surface(s, all);
  EXPECT_EQ(r.self_intersections, 0u);
  EXPECT_GT(r.shell_intersections, 20u);
  {
    const ThreadLimit one(1);
    EXPECT_EQ(check_surface(s, all).shell_intersection_ids, r.shell_intersection_ids);
  }
  const int last = int(s.triangles.size()) - 1;
  std::reverse(s.triangles.begin(), s.triangles.end());
  auto mirrored = check_surface(s, all).shell_intersection_ids;
  for (auto& p : mirrored) p = {last - p.second, last - p.first};
  std::sort(mirrored.begin(), mirrored.end());
  EXPECT_EQ(mirrored, r.shell_intersection_ids);
}

TEST(SurfaceCheck, CuttingItselfIsToldFromCuttingAnotherShell) {
  Surface s = shapes::cube();
  s.position_m[6] = {0.5, 0.5, -0.5};  // a corner of the top, pushed through the bottom
  const MeshReport alone = check_surface(s);
  EXPECT_GT(alone.self_intersections, 0u);
  EXPECT_EQ(alone.shell_intersections, 0u);
  EXPECT_FALSE(alone.sound());
  Surface pair = shapes::cube();
  append(pair, shapes::cube({0.5, 0.25, 0.3}));
  const MeshReport two = check_surface(pair);
  EXPECT_EQ(two.self_intersections, 0u);
  EXPECT_GT(two.shell_intersections, 0u);
  EXPECT_TRUE(two.sound());
  for (const auto& [f, g] : two.shell_intersection_ids) EXPECT_TRUE(f < 12 && g >= 12);
}

TEST(SurfaceCheck, ListsAreShortCountsAreComplete) {
  Surface s = shapes::sheet(8);
  append(s, shapes::sheet(8, -0.1));
  for (std::size_t v = 81; v < 162; ++v) s.position_m[v].z += 0.413;
  const MeshReport few = check_surface(s, {true, 3}), all = check_surface(s, {true, 100000});
  EXPECT_EQ(few.shell_intersections, all.shell_intersection_ids.size());
  ASSERT_EQ(few.shell_intersection_ids.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(few.shell_intersection_ids[k], all.shell_intersection_ids[k]);
}

}  // namespace
}  // namespace witherfield::check
