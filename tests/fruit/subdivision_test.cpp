// Refined values: the masks, what they conserve, order, tags, threads.
#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>
#include <numeric>

#include "sim/core/parallel.hpp"
#include "tests/fruit/loop_reference.hpp"
#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::fruit {
namespace {

using namespace fixtures;

constexpr Scheme kBoth[] = {Scheme::liu2007, Scheme::hoppe1994};
/// No rule weighs one of these above 1, so doubles agree to a few units in the last place.
constexpr double kExact = 1e-12;

/// Meshes with every kind of neighbourhood, tags included.
std::vector<ControlMesh> zoo() {
  std::vector<ControlMesh> all;
  for (const std::size_t every : {2u, 5u, 12u}) {
    ControlMesh closed = torus(8, 6, 20), open = sheet(5);
    jiggle(closed, 0.1);
    jiggle(open, 0.1);
    open.triangles.erase(open.triangles.begin() + 20, open.triangles.begin() + 24);  // a hole
    tag(closed, every);
    tag(open, every);
    all.push_back(closed);
    all.push_back(open);
  }
  all.push_back(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  all.push_back(
      mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {5, 5, 5}}, {{0, 1, 2}, {0, 2, 3}}));  // a stray
  return all;
}

TEST(Subdivision, FollowsTheMasksOfBothSchemes) {
  for (const Scheme scheme : kBoth)
    for (ControlMesh mesh : zoo()) {
      if (scheme == Scheme::liu2007) {  // needs valence 3: the corners of open meshes have 2
        std::map<int, std::set<int>> around;
        for (const auto& t : mesh.triangles)
          for (const int v : t) around[v].insert(t.begin(), t.end());
        std::erase_if(mesh.sharp_vertices, [&](int v) { return around[v].size() < 4; });
      }
      LoopReference reference(mesh, scheme);
      for (int steps = 0; steps <= 4; ++steps) {
        const Refinement r(mesh, scheme, steps);
        if (steps > 0) {
          ASSERT_NO_FATAL_FAILURE(reference.refine(r.triangles(), r.vertices()));
        }
        EXPECT_LT(furthest(evaluated(r, mesh.position_m), reference.points()), kExact) << "steps " << steps;
      }
    }
}

TEST(Subdivision, TheZooHasEveryRuleAndValence) {
  std::set<int> valences;
  for (const ControlMesh& mesh : zoo()) {
    std::map<int, std::set<int>> around;
    for (const auto& t : mesh.triangles)
      for (const int v : t) around[v].insert(t.begin(), t.end());
    for (const auto& [v, near] : around) valences.insert(int(near.size()) - 1);
  }
  for (int n = 2; n <= 8; ++n) EXPECT_TRUE(valences.contains(n)) << n;
  std::set<VertexRule> rules;
  for (const ControlMesh& mesh : zoo()) {
    const Refinement r(mesh, Scheme::hoppe1994, 0);
    rules.insert(r.rules().begin(), r.rules().end());
  }
  EXPECT_EQ(rules.size(), 4u);
}

/// Loop's vertex mask, by moving one vertex at a time.
TEST(Subdivision, WeightsOfAVertexByValence) {
  const std::map<int, double> centre = {{3, .4375},       {4, .515625},     {5, .5795339054}, {6, .625},
                                        {7, .6568255587}, {8, .6794575215}, {12, .7248797632}};
  const std::map<int, double> sharp = {{3, .25},     {4, .5},    {5, .6875},      {6, .8125},
                                       {7, .890625}, {8, .9375}, {12, .994140625}};
  for (const auto& [n, weight] : centre) {
    ControlMesh m = bipyramid(n);
    for (const bool tagged : {false, true}) {
      if (tagged) m.sharp_vertices = {0};
      const Refinement r(m, Scheme::liu2007, 1);
      for (int moved = 0; moved < n + 2; ++moved) {
        Points control(m.position_m.size(), glm::dvec3(0));
        control[std::size_t(moved)] = {1, 1, 1};
        const double own = tagged ? sharp.at(n) : weight;
        EXPECT_NEAR(evaluated(r, control)[0].x,
                    moved == 0   ? own
                    : moved == 1 ? 0
                                 : (1 - own) / n,
                    1e-10)
            << n;
      }
    }
  }
}

TEST(Subdivision, LiuCreaseIsSevenEighths) {
  ControlMesh m = sheet(4);
  m.crease_edges = {{11, 12}, {12, 13}};
  const Refinement r(m, Scheme::liu2007, 1);
  const auto weight = [&](int control, std::size_t refined) {
    Points p(m.position_m.size(), glm::dvec3(0));
    p[std::size_t(control)].x = 1;
    return evaluated(r, p)[refined].x;
  };
  EXPECT_EQ(weight(12, 12), 7.0 / 8);
  EXPECT_EQ(weight(11, 12), 1.0 / 16);
  EXPECT_EQ(weight(13, 12), 1.0 / 16);
  EXPECT_EQ(weight(17, 12), 0);  // beside the crease
}

/// Every row of the implied weights: sum 1, none negative, and nothing from afar.
TEST(Subdivision, WeightsAreAPartitionOfOne) {
  for (const Scheme scheme : kBoth) {
    ControlMesh m = torus(8, 6, 20);
    tag(m, 5);
    const Refinement r(m, scheme, 3);
    std::vector<double> sum(r.vertices(), 0);
    std::vector<int> used(r.vertices(), 0);
    for (std::size_t c = 0; c < m.position_m.size(); c += 3) {
      Points control(m.position_m.size(), glm::dvec3(0));
      for (std::size_t a = 0; a < 3 && c + a < control.size(); ++a) control[c + a][int(a)] = 1;
      const Points row = evaluated(r, control);
      for (std::size_t v = 0; v < row.size(); ++v)
        for (int a = 0; a < 3; ++a) {
          EXPECT_GE(row[v][a], 0);
          sum[v] += row[v][a];
          used[v] += row[v][a] > 0;
        }
    }
    for (const double s : sum) EXPECT_NEAR(s, 1, 1e-14);
    EXPECT_LE(*std::max_element(used.begin(), used.end()), 24);
  }
}

TEST(Subdivision, CommutesWithAffineMaps) {
  const glm::dmat3 turn(glm::dvec3(0.3, -1.2, 0.4), glm::dvec3(2, 0.1, 0.7), glm::dvec3(-0.5, 0.9, 1.5));
  const glm::dvec3 shift(3, -2, 10);
  for (const Scheme scheme : kBoth) {
    ControlMesh m = torus(8, 6, 20);
    tag(m, 5);
    const Refinement r(m, scheme, 3);
    Points mapped = m.position_m, fine = evaluated(r, m.position_m);
    for (auto& p : mapped) p = turn * p + shift;
    for (auto& p : fine) p = turn * p + shift;
    EXPECT_LT(furthest(evaluated(r, mapped), fine), kExact);
  }
}

/// A border on a straight line stays there, whatever the inside does; the interior mask would make it zigzag.
TEST(Subdivision, StraightBorderStaysStraight) {
  for (const Scheme scheme : kBoth) {
    ControlMesh m = sheet(4);
    for (std::size_t v = 0; v < m.position_m.size(); ++v)
      if (m.position_m[v].y > 0)
        m.position_m[v] += glm::dvec3(0, draw(1, std::uint32_t(v)), draw(2, std::uint32_t(v)));
    const Refinement r(m, scheme, 4);
    const Points p = evaluated(r, m.position_m);
    // The vertices of the line: those whose every weight comes from it.
    Points inside = m.position_m;
    for (std::size_t v = 0; v < inside.size(); ++v) inside[v] = glm::dvec3(v >= 5 ? 1 : 0);
    const Points weight = evaluated(r, inside);
    std::vector<double> x;
    for (std::size_t v = 0; v < p.size(); ++v)
      if (weight[v].x == 0) {
        EXPECT_EQ(p[v].y, 0);
        EXPECT_EQ(p[v].z, 0);
        x.push_back(p[v].x);
      }
    // The cubic B-spline: the sides of the sheet reach one of the four cells in from each end.
    EXPECT_GE(x.size(), 33u);
    std::sort(x.begin(), x.end());
    EXPECT_EQ(std::adjacent_find(x.begin(), x.end()), x.end()) << "vertices of the border fall together";
  }
}

/// A crease is a curve of its own: what lies beside it does not move it.
TEST(Subdivision, CreaseDoesNotFeelItsSides) {
  for (const Scheme scheme : kBoth) {
    ControlMesh m = torus(8, 6, 0);
    for (int x = 0; x < 8; ++x) m.crease_edges.push_back({x, (x + 1) % 8});
    const Refinement r(m, scheme, 3);
    const Points before = evaluated(r, m.position_m);
    for (std::size_t v = 8; v < m.position_m.size(); ++v)
      m.position_m[v] += glm::dvec3(draw(1, std::uint32_t(v)));
    const Points after = evaluated(r, m.position_m);
    std::size_t creased = 0;
    for (std::size_t v = 0; v < after.size(); ++v)
      if (r.rules()[v] == VertexRule::crease) {
        EXPECT_EQ(before[v], after[v]);
        ++creased;
      } else {
        EXPECT_NE(before[v], after[v]);
      }
    EXPECT_EQ(creased, 64u);
  }
}

TEST(Subdivision, HoppeCornerAndStrayVertexStay) {
  ControlMesh m = octahedron();
  m.sharp_vertices = {4};
  m.position_m.emplace_back(7, 8, 9);
  for (int steps = 0; steps <= 3; ++steps) {
    const Refinement r(m, Scheme::hoppe1994, steps);
    const Points p = evaluated(r, m.position_m);
    EXPECT_EQ(p[4], m.position_m[4]);
    EXPECT_EQ(p[6], m.position_m[6]);
  }
}

TEST(Subdivision, OrderIsStableAndFacesKeepTheirSense) {
  ControlMesh m = torus(8, 6, 20);
  const Refinement coarse(m, Scheme::hoppe1994, 2), fine(m, Scheme::hoppe1994, 3);
  ASSERT_EQ(fine.faces(), 4 * coarse.faces());
  for (std::size_t f = 0; f < coarse.faces(); ++f) {
    const auto parent = coarse.triangles()[f];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(fine.triangles()[4 * f + i][0], parent[i]);
  }
  // With values that grow linearly over one control face, its children tile it with the same orientation.
  const ControlMesh one = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Refinement r(one, Scheme::hoppe1994, 4);
  const Points p = evaluated(r, one.position_m);
  for (const auto& t : r.triangles()) {
    const glm::dvec3 n =
        glm::cross(p[std::size_t(t[1])] - p[std::size_t(t[0])], p[std::size_t(t[2])] - p[std::size_t(t[0])]);
    EXPECT_GT(n.z, 0);
  }
}

TEST(Subdivision, CountsFollowEuler) {
  const std::size_t vertices[] = {6, 18, 66, 258}, faces[] = {8, 32, 128, 512};
  for (int steps = 0; steps <= 3; ++steps) {
    const Refinement r(octahedron(), Scheme::hoppe1994, steps);
    EXPECT_EQ(r.vertices(), vertices[steps]);
    EXPECT_EQ(r.faces(), faces[steps]);
    std::set<std::pair<int, int>> directed;
    for (const auto& t : r.triangles())
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(directed.insert({t[i], t[(i + 1) % 3]}).second);
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a})) << "closed";
  }
}

TEST(Subdivision, SameBitsForAnyThreadsCopiesAndMemory) {
  ControlMesh m = torus(16, 16, 60);
  tag(m, 12);
  const auto all = [&](const Refinement& r) {
    Points p = evaluated(r, m.position_m), position(r.vertices()), normal(r.vertices());
    r.evaluate_limit(m.position_m, position, normal);
    p.insert(p.end(), position.begin(), position.end());
    p.insert(p.end(), normal.begin(), normal.end());
    return p;
  };
  Triangles triangles;
  const Points one = [&] {
    const ThreadLimit limit(1);
    const Refinement r(m, Scheme::hoppe1994, 4);
    triangles.assign(r.triangles().begin(), r.triangles().end());
    return all(r);
  }();
  const ThreadLimit limit(4);
  Refinement r(m, Scheme::hoppe1994, 4);
  EXPECT_EQ(all(r), one);
  Refinement other(torus(20, 20, 10), Scheme::liu2007, 4);  // larger, then smaller, in the same memory
  other = Refinement(torus(18, 18, 10), Scheme::liu2007, 4, std::move(other));
  Refinement again(m, Scheme::hoppe1994, 4, std::move(other));
  EXPECT_EQ(all(again), one);
  EXPECT_TRUE(
      std::equal(again.triangles().begin(), again.triangles().end(), triangles.begin(), triangles.end()));
  const Refinement copy = again;
  const Refinement third(torus(16, 16, 10), Scheme::liu2007, 4,
                         std::move(again));  // must leave the copy alone
  EXPECT_EQ(all(copy), one);
  EXPECT_TRUE(
      std::equal(copy.triangles().begin(), copy.triangles().end(), triangles.begin(), triangles.end()));
}

TEST(Subdivision, ChannelsAndFloatsAreTheSameValues) {
  ControlMesh m = torus(8, 6, 20);
  tag(m, 5);
  const Refinement r(m, Scheme::hoppe1994, 3);
  const Points fine = evaluated(r, m.position_m);
  for (int channels = 1; channels <= 9; ++channels) {
    std::vector<float> control, refined(r.vertices() * std::size_t(channels));
    for (const auto& p : m.position_m)
      for (int c = 0; c < channels; ++c) control.push_back(float(p[c % 3] + c));
    r.evaluate(control, refined, channels);
    double worst = 0;
    for (std::size_t v = 0; v < fine.size(); ++v)
      for (int c = 0; c < channels; ++c)
        worst = std::max(worst, std::abs(double(refined[v * std::size_t(channels) + std::size_t(c)]) -
                                         fine[v][c % 3] - c));
    EXPECT_LT(worst, 1e-5) << channels;
  }
  std::vector<glm::vec3> control(m.position_m.begin(), m.position_m.end()), refined(r.vertices());
  r.evaluate(control, refined);
  for (std::size_t v = 0; v < fine.size(); ++v)
    EXPECT_LT(glm::length(glm::dvec3(refined[v]) - fine[v]), 1e-6);
}

TEST(Subdivision, NothingIsWrittenBeyondTheLastChannel) {
  const Refinement r(octahedron(), Scheme::hoppe1994, 2);
  for (int channels = 1; channels <= 5; ++channels) {
    std::vector<float> control(6 * std::size_t(channels), 1),
        refined(r.vertices() * std::size_t(channels) + 8, -5);
    r.evaluate(control, std::span(refined).first(r.vertices() * std::size_t(channels)), channels);
    for (std::size_t i = 0; i < refined.size(); ++i) EXPECT_EQ(refined[i], i + 8 < refined.size() ? 1 : -5);
  }
}

TEST(Subdivision, CreasesByAngle) {
  ControlMesh cube;  // edges at 90 degrees, diagonals at 0
  for (int i = 0; i < 8; ++i) cube.position_m.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    cube.triangles.push_back({a, b, c});
    cube.triangles.push_back({a, c, d});
  }
  ControlMesh m = cube;
  m.crease_edges = {{1, 0}};
  add_creases_by_angle(m, 89);
  EXPECT_EQ(m.crease_edges.size(), 12u);  // the one that was there is not doubled
  m = cube;
  add_creases_by_angle(m, 91);
  EXPECT_TRUE(m.crease_edges.empty());
  add_creases_by_angle(m, 0.1);
  EXPECT_EQ(m.crease_edges.size(), 12u);
  // Three creases meet in every corner, so the cube stays a cube.
  const Refinement r(m, Scheme::hoppe1994, 3);
  double volume = 0;
  const Points p = evaluated(r, m.position_m);
  for (const auto& t : r.triangles())
    volume += glm::dot(p[std::size_t(t[0])], glm::cross(p[std::size_t(t[1])], p[std::size_t(t[2])])) / 6;
  EXPECT_NEAR(volume, 1, 1e-12);
}

TEST(Subdivision, SurfaceCarriesItsAttributes) {
  const ControlMesh m = octahedron();
  Surface control;
  control.position_m = m.position_m;
  control.triangles = m.triangles;
  for (const auto& p : m.position_m) control.uv.emplace_back(p.x, p.y);
  auto& colour = control.make_field("diffuse");
  for (std::size_t v = 0; v < 6; ++v)
    for (std::size_t c = 0; c < 3; ++c) colour.values[3 * v + c] = float(0.5 + 0.5 * m.position_m[v][int(c)]);
  auto& organ = control.make_field("organ_id", true);
  for (std::size_t f = 0; f < 8; ++f) organ.values[f] = float(f);
  auto& kernel = control.make_field("kernel_id");
  for (std::size_t v = 0; v < 6; ++v) kernel.values[v] = float(10 * v);
  control.make_field("sharpness");
  ControlMesh tagged = m;
  tagged.sharp_vertices = {4};
  const Refinement r(tagged, Scheme::hoppe1994, 2);
  const Surface fine = refine(r, control);
  fine.validate();
  for (std::size_t v = 0; v < fine.position_m.size(); ++v) {
    EXPECT_NEAR(fine.uv[v].x, fine.position_m[v].x, 1e-14);
    EXPECT_NEAR(fine.uv[v].y, fine.position_m[v].y, 1e-14);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(fine.field("diffuse").values[3 * v + c], 0.5 + 0.5 * fine.position_m[v][int(c)], 1e-6);
    EXPECT_EQ(std::fmod(fine.field("kernel_id").values[v], 10.f), 0.f) << "numbers are not mixed";
  }
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(fine.field("kernel_id").values[v], float(10 * v));
  EXPECT_EQ(fine.field("kernel_id").values[6], 0.f);  // the first edge is 0-2
  for (std::size_t f = 0; f < fine.triangles.size(); ++f)
    EXPECT_EQ(fine.field("organ_id").values[f], float(f / 16));
  EXPECT_EQ(fine.field("sharpness").values[4], 3.f);
  EXPECT_EQ(
      std::accumulate(fine.field("sharpness").values.begin(), fine.field("sharpness").values.end(), 0.f),
      3.f);
  const Surface limit = refine(r, control, true);
  limit.validate();
  EXPECT_EQ(limit.position_m[4], m.position_m[4]);
  EXPECT_EQ(limit.normal.size(), limit.position_m.size());
}

}  // namespace
}  // namespace witherfield::fruit
