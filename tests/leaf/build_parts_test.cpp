// Splines, outline files, triangulation, repair of ears, texture coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "sim/core/errors.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "sim/leaf/margin.hpp"
#include "sim/leaf/outline.hpp"
#include "sim/leaf/repair.hpp"
#include "sim/leaf/segment_grid.hpp"
#include "sim/leaf/splines.hpp"
#include "sim/leaf/texture_coordinates.hpp"
#include "sim/leaf/triangulate.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::leaf {
namespace {

std::vector<glm::dvec2> circle(int n, double radius = 1) {
  std::vector<glm::dvec2> p;
  for (int i = 0; i < n; ++i)
    p.emplace_back(radius * std::cos(2 * std::numbers::pi * i / n), radius * std::sin(2 * std::numbers::pi * i / n));
  return p;
}

std::vector<glm::dvec3> half_circle(int pieces) {
  std::vector<glm::dvec3> p;
  for (int i = 0; i <= pieces; ++i)
    p.emplace_back(std::cos(std::numbers::pi * i / pieces), std::sin(std::numbers::pi * i / pieces), 0.1 * i);
  return p;
}

TEST(CubicSpline, InterpolatesAndIsSmooth) {
  const CubicSpline s(half_circle(7));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(glm::distance(s(s.knot(i)), half_circle(7)[i]), 1e-12);
  // First and second derivative go on through the knots.
  const double h = 1e-5;
  for (std::size_t i = 1; i < 7; ++i) {
    const double t = s.knot(i);
    const glm::dvec3 before = (s(t) - s(t - h)) / h, after = (s(t + h) - s(t)) / h;
    EXPECT_LT(glm::distance(before, after), 1e-3);
    EXPECT_LT(glm::distance(s.second_derivative(t - 1e-9), s.second_derivative(t + 1e-9)), 1e-5);
  }
  EXPECT_LT(glm::length(s.second_derivative(s.begin())), 1e-12);
}

TEST(CubicSpline, ConvergesToACircleWithTheFourthPower) {
  double last = 0;
  for (const int n : {8, 16, 32}) {
    std::vector<glm::dvec3> ring;  // three turns, so that the free ends do not matter in the middle
    for (int i = 0; i <= 3 * n; ++i) ring.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), 0);
    const CubicSpline s(ring);
    double error = 0;
    for (int k = 0; k < 200; ++k)
      error = std::max(error, std::abs(glm::length(s(s.knot(std::size_t(n)) + (s.knot(std::size_t(n) + 1) - s.knot(std::size_t(n))) * k / 200)) - 1));
    if (last > 0) {
      EXPECT_GT(last / error, 13);
    }
    last = error;
  }
}

TEST(CubicSpline, SamplesAreEvenOrDenserWhereItTurns) {
  const CubicSpline s({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3.2, 0.3, 0}, {3, 0.6, 0}, {2, 0.6, 0}, {1, 0.6, 0}});
  const auto even = s.sample(0.05);
  double shortest = 1e9, longest = 0, sum = 0;
  for (std::size_t i = 0; i + 1 < even.size(); ++i) {
    const double d = glm::distance(even[i], even[i + 1]);
    shortest = std::min(shortest, d), longest = std::max(longest, d), sum += d;
  }
  EXPECT_NEAR(longest, 0.05, 0.002);
  EXPECT_NEAR(shortest, 0.05, 0.002);
  EXPECT_NEAR(sum, s.length_m(), 1e-3);
  const auto turned = s.sample(0.2, 1, 0.1);
  std::size_t at_bend = 0;
  for (const auto& p : turned) at_bend += p.x > 2.9;
  EXPECT_GT(at_bend, 12u);
  EXPECT_LT(turned.size(), 60u);
  EXPECT_THROW(CubicSpline({{0, 0, 0}}), InvalidInput);
  EXPECT_THROW(CubicSpline({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}), InvalidInput);
}

TEST(Polygons, AreaInsideCrossing) {
  EXPECT_NEAR(polygon_area(circle(2000)), std::numbers::pi, 1e-5);
  EXPECT_TRUE(inside_polygon(circle(50), {0.9, 0.1}));
  EXPECT_FALSE(inside_polygon(circle(50), {0.9, 0.6}));
  EXPECT_EQ(self_crossing(circle(50)).first, -1);
  auto p = circle(50);
  std::swap(p[10], p[11]);
  EXPECT_GE(self_crossing(p).first, 8);
  EXPECT_LE(self_crossing(p).first, 11);
}

TEST(SegmentGrid, FindsWhatALinearSearchFinds) {
  Random random(2, Stream::test, 4);
  SegmentGrid grid(0.08);
  std::vector<std::pair<glm::dvec2, glm::dvec2>> all;
  for (int k = 0; k < 300; ++k) {
    const glm::dvec2 a(random.uniform(), random.uniform()), b = a + 0.3 * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
    all.emplace_back(a, b);
    grid.add(a, b, k);
  }
  grid.build();
  for (int k = 0; k < 1000; ++k) {
    const glm::dvec2 p(random.uniform(-0.5, 1.5), random.uniform(-0.5, 1.5));
    double best = 1e300;
    for (const auto& [a, b] : all) {
      const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
      best = std::min(best, glm::distance(p, a + t * (b - a)));
    }
    const auto hit = grid.nearest(p);
    if (best <= 0.08) {
      EXPECT_DOUBLE_EQ(hit.distance_m, best);
    } else {
      EXPECT_EQ(hit.tag, -1);
    }
  }
}

TEST(Outline, CsvRoundTripAndUnits) {
  OutlinePoints p;
  for (int i = 1; i <= 4; ++i) {
    p.left_m.emplace_back(0.02 * i, 0.03, 0.001 * i);
    p.right_m.emplace_back(0.02 * i, -0.03, 0);
    p.midrib_m.emplace_back(0.025 * (i - 1), 0, 1.0 / 3);
  }
  const OutlinePoints again = parse_outline_csv(outline_csv(p), "test");
  ASSERT_EQ(again.left_m.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(glm::distance(again.left_m[i], p.left_m[i]), 1e-9);
    EXPECT_LT(glm::distance(again.midrib_m[i], p.midrib_m[i]), 1e-9);
  }
  const OutlinePoints mm = parse_outline_csv(
      "# by hand\ngroup; x; y\n\nleft;10;30\r\nleft;40;35\nright;12,-31\nright;40;-33\nmidrib;0;0\nmidrib;70;0\n", "leaf.csv", "mm");
  EXPECT_NEAR(mm.left_m[1].y, 0.035, 1e-12);
  EXPECT_NEAR(mm.right_m[0].y, -0.031, 1e-12);
}

TEST(OutlineJson, ReadsGroupsAndSaysWhatIsWrong) {
  const OutlinePoints p = parse_outline_json(R"({"unit": "cm", "left": [[1, 2], [3, 2, 1]], "right": [[1, -2], [3, -2]],
    "midrib": [[0, 0], [4, 0]]})", "leaf.json");
  ASSERT_EQ(p.left_m.size(), 2u);
  EXPECT_LT(glm::distance(p.left_m[1], glm::dvec3(0.03, 0.02, 0.01)), 1e-15);
  EXPECT_LT(glm::distance(p.right_m[0], glm::dvec3(0.01, -0.02, 0)), 1e-15);
  const auto reason = [](const char* text) -> std::string {
    try {
      parse_outline_json(text, "leaf.json");
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(reason("{\n\"left\": [[1,\n}").find("leaf.json:3"), std::string::npos);
  EXPECT_NE(reason("[]").find("object"), std::string::npos);
  EXPECT_NE(reason(R"({"left": [[1, 2], [3, 2]]})").find("right is missing"), std::string::npos);
  EXPECT_NE(reason(R"({"left": [[1, 2], [3]], "right": [], "midrib": []})").find("left[1] = [3]"), std::string::npos);
  EXPECT_NE(reason(R"({"left": [[1, "a"]], "right": [], "midrib": []})").find("left[0][1]"), std::string::npos);
  EXPECT_NE(reason(R"({"top": []})").find("'top' is unknown"), std::string::npos);
  EXPECT_NE(reason(R"({"unit": "inch", "left": []})").find("inch"), std::string::npos);
  EXPECT_NE(reason(R"({"left": [[1, 2]], "right": [[1, -2], [3, -2]], "midrib": [[0, 0], [4, 0]]})").find("at least 2"), std::string::npos);
}

TEST(Outline, MistakesAreNamedWithTheirLine) {
  const auto reason = [](const char* text, const char* unit = "m") -> std::string {
    try {
      parse_outline_csv(text, "leaf.csv", unit);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(reason("left,1,2\nleft,1,x\n").find("leaf.csv:2: 'x' is not a number"), std::string::npos);
  EXPECT_NE(reason("left,1,2\nmiddle,1,3\n").find("leaf.csv:2: group 'middle'"), std::string::npos);
  EXPECT_NE(reason("left,1\n").find("2 columns"), std::string::npos);
  EXPECT_NE(reason("left,1,2\nleft,2,2\n").find("right has 0 points"), std::string::npos);
  EXPECT_NE(reason("left,1,1\nleft,2,2\nright,3,3\nright,4,4\nmidrib,0,0\nmidrib,5,5\n").find("one line"), std::string::npos);
  EXPECT_NE(reason("left,1,1\nleft,1,1\nright,3,-3\nright,4,-4\nmidrib,0,0\nmidrib,5,5\n").find("coincide"), std::string::npos);
  EXPECT_NE(reason("left,1,1\n", "inch").find("m, cm, mm"), std::string::npos);
}

TEST(Margin, TeethKeepTheEndsAndTheAreaAndHaveTheirDepth) {
  std::vector<glm::dvec2> line;
  for (int i = 0; i <= 400; ++i) line.emplace_back(std::cos(std::numbers::pi * (1 - i / 400.0)) + 1.2, -std::sin(std::numbers::pi * i / 400.0));
  MarginOptions o{0.05, 0.012, 0.5, 0.2};
  Random random(1, Stream::test, 2);
  const auto out = toothed(line, o, 1, 0.006, random);
  EXPECT_EQ(out.front(), line.front());
  EXPECT_EQ(out.back(), line.back());
  EXPECT_NEAR(std::abs(polygon_area(out)), std::numbers::pi / 2, 0.01);
  double highest = -1, lowest = 1;
  for (const auto& p : out) {
    const double r = glm::distance(p, {1.2, 0}) - 1;
    highest = std::max(highest, r), lowest = std::min(lowest, r);
  }
  EXPECT_NEAR(highest - lowest, 0.012, 0.004);
  EXPECT_GT(out.size(), 400u);
  o.tooth_depth_m = 0;
  EXPECT_EQ(toothed(line, o, 1, 0.006, random), line);
}

PlanarDomain disc() { return {circle(40), {{{-0.5, 0}, {0.5, 0}}}}; }

Surface surface_of(const PlanarMesh& m) {
  Surface s;
  for (const auto& p : m.point) s.position_m.emplace_back(p, 0.0);
  s.triangles = m.triangles;
  return s;
}

TEST(Triangulate, FillsTheOutlineOnceAndKeepsGivenEdges) {
  const PlanarMesh m = triangulate(disc());
  EXPECT_EQ(m.point.size(), 42u);
  EXPECT_NEAR(surface_area_m2(surface_of(m)), polygon_area(circle(40)), 1e-12);
  bool found = false;
  for (const auto& t : m.triangles) {
    const auto &a = m.point[std::size_t(t[0])], &b = m.point[std::size_t(t[1])], &c = m.point[std::size_t(t[2])];
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
    for (int k = 0; k < 3; ++k)
      found = found || (m.point[std::size_t(t[std::size_t(k)])] == glm::dvec2(-0.5, 0) && m.point[std::size_t(t[std::size_t(k + 1) % 3])] == glm::dvec2(0.5, 0));
  }
  EXPECT_TRUE(found);
}

TEST(Triangulate, RefinesToTheWantedEdgesWithoutSharpAngles) {
  const auto wanted = [](const glm::dvec2& p) { return 0.05 + 0.2 * glm::length(p); };
  const PlanarMesh m = triangulate(disc(), wanted, 100000);
  EXPECT_NEAR(surface_area_m2(surface_of(m)), polygon_area(circle(40)), 1e-12);
  for (const auto& t : m.triangles) {
    glm::dvec2 middle(0.0);
    for (const int v : t) middle += m.point[std::size_t(v)] / 3.0;
    for (int k = 0; k < 3; ++k) {
      const auto &a = m.point[std::size_t(t[std::size_t(k)])], &b = m.point[std::size_t(t[std::size_t(k + 1) % 3])], &c = m.point[std::size_t(t[std::size_t(k + 2) % 3])];
      EXPECT_LE(glm::distance(a, b), wanted(middle) * (1 + 1e-9));
      EXPECT_GT(std::acos(glm::dot(b - a, c - a) / glm::distance(a, b) / glm::distance(a, c)), 19 * std::numbers::pi / 180);
    }
  }
  EXPECT_THROW(triangulate(disc(), [](const glm::dvec2&) { return 0.01; }, 1000), InvalidInput);
}

TEST(Triangulate, SaysWhyAnOutlineCannotBeFilled) {
  const auto reason = [](const std::vector<glm::dvec2>& outline) -> std::string {
    try {
      triangulate(PlanarDomain{outline, {}});
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(reason({{0, 0}, {3, 0}, {3, 2}, {1, -1}, {0, 2}}).find("crosses itself near"), std::string::npos);
  EXPECT_NE(reason({{0, 0}, {0, 1}, {1, 0}}).find("clockwise"), std::string::npos);
  EXPECT_NE(reason({{0, 0}, {0, 1}}).find("no area"), std::string::npos);
}

std::set<std::pair<int, int>> border_edges(const Surface& s) {
  std::set<std::pair<int, int>> directed, border;
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) directed.insert({t[k], t[(k + 1) % 3]});
  for (const auto& [a, b] : directed)
    if (!directed.count({b, a})) border.insert({a, b});
  return border;
}

int triangles_with_two_border_edges(const Surface& s) {
  const auto border = border_edges(s);
  int count = 0;
  for (const auto& t : s.triangles) {
    int edges = 0;
    for (std::size_t k = 0; k < 3; ++k) edges += int(border.count({t[k], t[(k + 1) % 3]}));
    count += edges >= 2;
  }
  return count;
}

TEST(Repair, NoTriangleKeepsTwoBorderEdges) {
  Surface star = surface_of(triangulate({circle(12), {}}));  // a fan of ears
  for (auto& p : star.position_m) p.z = p.x * p.y;
  star.uv.resize(star.position_m.size(), {0.25, 0.5});
  auto& vein = star.make_field("vein").values;
  for (std::size_t i = 0; i < vein.size(); ++i) vein[i] = float(i);
  star.make_field("strain_area", true).values.assign(star.triangles.size(), 0.5f);
  const double area = surface_area_m2(star);
  const int before = triangles_with_two_border_edges(star), edges = int(border_edges(star).size());
  ASSERT_GT(before, 2);
  const auto splits = split_ears(star);
  EXPECT_EQ(triangles_with_two_border_edges(star), 0);
  EXPECT_TRUE(ear_vertices(star).empty());
  EXPECT_EQ(int(splits.size()), before);
  EXPECT_EQ(int(border_edges(star).size()), edges);  // the outline itself is untouched
  EXPECT_NEAR(surface_area_m2(star), area, 1e-12);
  EXPECT_NO_THROW(star.validate());
  for (const EdgeSplit& e : splits) {
    EXPECT_EQ(star.position_m[std::size_t(e.middle)], 0.5 * (star.position_m[std::size_t(e.a)] + star.position_m[std::size_t(e.b)]));
    EXPECT_FLOAT_EQ(star.field("vein").values[std::size_t(e.middle)],
                    0.5f * (star.field("vein").values[std::size_t(e.a)] + star.field("vein").values[std::size_t(e.b)]));
  }
  EXPECT_EQ(star.field("strain_area").values.size(), star.triangles.size());
  EXPECT_TRUE(split_ears(star).empty());
}

TEST(Repair, TwoEarsThatLeanOnEachOther) {
  Surface s;
  s.position_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(split_ears(s).size(), 1u);
  EXPECT_EQ(triangles_with_two_border_edges(s), 0);
  EXPECT_EQ(s.triangles.size(), 4u);
  Surface one;
  one.position_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  one.triangles = {{0, 1, 2}};
  EXPECT_THROW(split_ears(one), InvalidInput);
}

TEST(Repair, BorderLoopsRunWithTheInsideOnTheLeft) {
  const Surface s = test::sheet(4, 0);
  const auto loops = border_loops(s.triangles);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 12u);
  EXPECT_EQ(loops[0].front(), 0);
  EXPECT_EQ(loops[0][1], 1);
}

TEST(TextureCoordinates, FollowTheLeafWhateverItsPlace) {
  Random random(3, Stream::test, 6);
  std::vector<glm::dvec3> flat, turned;
  const glm::dvec3 x = glm::normalize(glm::dvec3(1, 2, 3)), z = glm::normalize(glm::cross(x, glm::dvec3(0, 1, 0))), y = glm::cross(z, x);
  for (int i = 0; i < 500; ++i) {
    flat.emplace_back(random.uniform(0, 2), random.uniform(-0.5, 0.5), 0.01 * random.uniform());
    turned.push_back(glm::dvec3(4, 5, 6) + flat.back().x * x + flat.back().y * y + flat.back().z * z);
  }
  for (const double sign : {1.0, -1.0}) {  // base to tip fixes the sign
    const auto a = plane_uv(flat, principal_plane(flat, {sign, 0, 0}, {0, 0, 1}));
    const auto b = plane_uv(turned, principal_plane(turned, sign * x, z));
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_LT(glm::distance(a[i], b[i]), 1e-9);
      ASSERT_TRUE(a[i].x >= 0 && a[i].x <= 1 && a[i].y >= 0 && a[i].y <= 1);
    }
    // The same scale in u and v; u grows towards the tip.
    const double length = glm::distance(glm::dvec2(flat[3]), glm::dvec2(flat[4])), ratio = glm::distance(a[3], a[4]) / length;
    EXPECT_NEAR(glm::distance(a[7], a[90]) / glm::distance(glm::dvec2(flat[7]), glm::dvec2(flat[90])), ratio, 2e-3 * ratio);
    EXPECT_GT(sign * (a[3].x - a[4].x) * (flat[3].x - flat[4].x), 0);
  }
  EXPECT_THROW(principal_plane(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {1, 0, 0}, {0, 0, 1}), InvalidInput);
}

TEST(LeafArea, SliversLoseNoDigits) {
  // Heron's formula as printed has no correct digit here: sides 1e5, 1e5 and 1e-5 m.
  Surface s;
  s.position_m = {{0, 0, 0}, {1e5, 0, 0}, {1e5, 1e-5, 0}};
  s.triangles = {{0, 1, 2}};
  EXPECT_NEAR(surface_area_m2(s), 0.5, 1e-12);
  EXPECT_NEAR(area_error(1.1, 1.0), 0.1, 1e-12);
  EXPECT_THROW(area_error(1, 0), InvalidInput);
}

}  // namespace
}  // namespace witherfield::leaf
