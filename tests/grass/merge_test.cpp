// Laws of combining points (fig. 6b): what is conserved, who combines with whom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/points.hpp"
#include "tests/grass/point_fixtures.hpp"

namespace witherfield::grass {
namespace {

using namespace fixtures;

/// Sums that combining must keep.
struct Totals {
  double mass = 0, water = 0;
  glm::dvec3 moment{0}, momentum{0}, diffuse{0};
};

Totals totals(const PointSet& p) {
  Totals t;
  for (std::size_t i = 0; i < p.size(); ++i) {
    t.mass += p.mass_kg[i];
    t.water += p.mass_kg[i] * double(p.water[i]);
    t.moment += p.mass_kg[i] * p.position_m[i];
    t.momentum += p.mass_kg[i] * glm::dvec3(p.velocity_m_s[i]);
    t.diffuse += p.mass_kg[i] * glm::dvec3(p.diffuse[i]);
  }
  return t;
}

/// Crowded: 4,000 points in a box of 10 mm, several of each kind within 1 mm of one another.
PointSet crowd(std::size_t n = 4000) {
  return random_points(n, glm::dvec3(0), glm::dvec3(0.01));
}
constexpr double kNear = 0.0007;

/// Nearest other point of the same kind, by looking at all.
std::optional<std::size_t> nearest(const PointSet& p, std::size_t i, double distance_m) {
  std::optional<std::size_t> best;
  double best_d2 = distance_m * distance_m;
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (j == i || p.blade_id[j] != p.blade_id[i] || p.tissue[j] != p.tissue[i]) continue;
    const glm::dvec3 gap = p.position_m[i] - p.position_m[j];
    if (glm::dot(gap, gap) < best_d2) best = j, best_d2 = glm::dot(gap, gap);
  }
  return best;
}

TEST(MergePoints, KeepsMassMomentumAndCentreOfMass) {
  PointSet p = crowd();
  const Totals before = totals(p);
  const std::size_t merges = merge_points(p, kNear);
  ASSERT_GT(merges, 500u);
  EXPECT_EQ(p.size(), 4000 - merges);
  const Totals after = totals(p);
  EXPECT_NEAR(after.mass / before.mass, 1, 1e-12);
  EXPECT_LT(glm::length(after.moment - before.moment), 1e-12 * glm::length(before.moment));
  EXPECT_LT(glm::length(after.momentum - before.momentum),
            1e-6 * before.mass);  // velocities are stored as floats
  EXPECT_NEAR(after.water / before.water, 1, 1e-6);
  EXPECT_LT(glm::length(after.diffuse - before.diffuse), 1e-6 * glm::length(before.diffuse));
}

TEST(MergePoints, CombinesExactlyTheMutuallyNearest) {
  const PointSet before = crowd(600);
  PointSet after = before;
  merge_points(after, 2 * kNear);
  PointSet expected;  // positions and masses by the definition
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto j = nearest(before, i, 2 * kNear);
    const bool pair = j && nearest(before, *j, 2 * kNear) == i;
    if (pair && *j < i) continue;
    const double m = before.mass_kg[i], other = pair ? before.mass_kg[*j] : 0;
    expected.mass_kg.push_back(m + other);
    expected.position_m.push_back(pair ? (m * before.position_m[i] + other * before.position_m[*j]) /
                                             (m + other)
                                       : before.position_m[i]);
  }
  ASSERT_EQ(after.size(), expected.size());
  ASSERT_LT(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after.mass_kg[i], expected.mass_kg[i], 1e-12);
    EXPECT_LT(glm::length(after.position_m[i] - expected.position_m[i]), 1e-15);
  }
}

TEST(MergePoints, KeepsBladesAndTissuesApart) {
  PointSet p = plain_points(4);  // all at one spot
  p.blade_id = {0, 1, 0, 1};
  p.tissue = {1, 1, 2, 2};
  EXPECT_EQ(merge_points(p, 0.001), 0u);
  EXPECT_EQ(p.size(), 4u);
  p.tissue = {1, 1, 1, 2};
  EXPECT_EQ(merge_points(p, 0.001), 1u);
  EXPECT_EQ(p.size(), 3u);
  EXPECT_EQ(p.mass_kg[0], 2);
}

TEST(MergePoints, DistanceIsExclusiveAndZeroMeansNever) {
  PointSet p = plain_points(2);
  p.position_m[1] = {0.25, 0, 0};
  EXPECT_EQ(merge_points(p, 0.25), 0u);
  EXPECT_EQ(merge_points(p, 0), 0u);
  p.position_m[1] = p.position_m[0];
  EXPECT_EQ(merge_points(p, 0), 0u);
  EXPECT_EQ(merge_points(p, 0.25), 1u);
}

TEST(MergePoints, OneCombinationPerPointAndCall) {
  PointSet p = plain_points(
      4);  // a chain 1.0 - 0.9 - 1.1: the middle two combine, then they are too far from the ends
  p.position_m = {{0, 0, 0}, {0.010, 0, 0}, {0.019, 0, 0}, {0.030, 0, 0}};
  EXPECT_EQ(merge_points(p, 0.012), 1u);
  ASSERT_EQ(p.size(), 3u);
  EXPECT_NEAR(p.position_m[1].x, 0.0145, 1e-15);
  EXPECT_EQ(merge_points(p, 0.012), 0u);
}

// Tangents and normals are axial: opposite ones are the same fibre and must not cancel.
TEST(MergePoints, MeansOfDirectionsAreAxial) {
  PointSet p = plain_points(2);
  p.mass_kg = {1, 3};
  const glm::vec3 t = glm::normalize(glm::vec3(1, 2, 3));
  p.tangent = {t, -t};
  p.normal = {glm::vec3(1, 0, 0), glm::normalize(glm::vec3(-1, 0.2f, 0))};
  ASSERT_EQ(merge_points(p, 1), 1u);
  EXPECT_NEAR(std::abs(glm::dot(p.tangent[0], t)), 1, 1e-6);
  EXPECT_NEAR(glm::length(p.normal[0]), 1, 1e-6);
  EXPECT_LT(p.normal[0].x, -0.97f) << "the heavier one's sign";
  // Between the two axes, nearer to the heavier one.
  const double angle = std::atan2(double(-p.normal[0].y), double(-p.normal[0].x)), heavy = -std::atan(0.2);
  EXPECT_LT(angle, 0.5 * heavy);
  EXPECT_GT(angle, heavy);
}

TEST(MergePoints, ZeroNormalsOfAConesAxisStayZero) {
  PointSet p = plain_points(2);
  std::fill(p.normal.begin(), p.normal.end(), glm::vec3(0));
  ASSERT_EQ(merge_points(p, 1), 1u);
  EXPECT_EQ(p.normal[0], glm::vec3(0));
}

TEST(MergePoints, OrderOfThePointsDoesNotMatter) {
  PointSet a = crowd(), b = a;
  for (std::size_t i = 0; i < a.size(); ++i) {  // 4000 and 1223 have no common factor: a permutation
    const std::size_t j = i * 1223 % a.size();
    b.position_m[i] = a.position_m[j], b.mass_kg[i] = a.mass_kg[j];
    b.blade_id[i] = a.blade_id[j], b.tissue[i] = a.tissue[j];
  }
  EXPECT_EQ(merge_points(a, kNear), merge_points(b, kNear));
  const auto by_place = [](const glm::dvec3& p, const glm::dvec3& q) { return p.x < q.x; };
  std::sort(a.position_m.begin(), a.position_m.end(), by_place);
  std::sort(b.position_m.begin(), b.position_m.end(), by_place);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(glm::length(a.position_m[i] - b.position_m[i]), 1e-15);
}

TEST(MergePoints, AnyThreadCountGivesTheSameBits) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    PointSet p = random_points(20000, glm::dvec3(0), glm::dvec3(0.02), 40);
    EXPECT_GT(merge_points(p, 2 * kNear), 1000u);
    return p;
  };
  EXPECT_TRUE(same_bits(run(1), run(2)));
}

TEST(MergePoints, EndsWithNoPairNearerThanTheDistance) {
  PointSet p = crowd(1000);
  for (int call = 0; call < 40 && merge_points(p, kNear) > 0;) ++call;
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_FALSE(nearest(p, i, kNear));
}

TEST(MergePoints, RefusesNonsense) {
  PointSet p = crowd(10);
  EXPECT_THROW(merge_points(p, -1), InvalidInput);
  EXPECT_THROW(merge_points(p, std::nan("")), InvalidInput);
  p = plain_points(2);
  p.position_m[1].y = std::nan("");
  EXPECT_THROW(merge_points(p, 1), SolverFailure);
}

}  // namespace
}  // namespace witherfield::grass
