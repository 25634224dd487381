#include "sim/check/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "sim/check/surface_check.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "tests/check/shapes.hpp"

namespace witherfield::check {
namespace {

Surface both(Surface a, const Surface& b) {
  append(a, b);
  return a;
}

TEST(Overlap, CubesAlongTheAxesAreExact) {
  const auto o = overlap_fractions(both(shapes::cube({0, 0, 0}, 2), shapes::cube({1.5, 0.5, 1}, 1)));
  ASSERT_EQ(o.size(), 1u);
  EXPECT_EQ(o[0].a, 0u);
  EXPECT_EQ(o[0].b, 1u);
  EXPECT_NEAR(o[0].volume_m3, 0.5, 1e-12);
  EXPECT_NEAR(o[0].fraction, 0.5, 1e-12);  // of the smaller
  EXPECT_LT(o[0].error, 1e-12);
}

TEST(Overlap, OneWithinTheOtherIsWhole) {
  const auto o = overlap_fractions(both(shapes::cube({0, 0, 0}, 4), shapes::ball(8, {2, 2, 2})));
  ASSERT_EQ(o.size(), 1u);
  EXPECT_NEAR(o[0].fraction, 1, 5 * o[0].error);
  EXPECT_LT(o[0].error, 0.004);
}

TEST(Overlap, BallsFollowTheFormulaOfTheLens) {
  for (const double distance : {0.4, 1.0, 1.6, 1.9}) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 1.5));
    OverlapOptions options;
    options.lines = 20000;
    const auto o = overlap_fractions(both(shapes::ball(60), shapes::ball(60, axis * distance)), options);
    ASSERT_EQ(o.size(), 1u) << distance;
    const double lens = std::numbers::pi * (4 + distance) * (2 - distance) * (2 - distance) / 12;
    EXPECT_NEAR(o[0].volume_m3, lens, 0.012 * lens + 0.001) << distance;  // the balls have facets
  }
}

// The error that is stated must be the error that is made.
TEST(Overlap, StandardErrorIsHonestAndFallsWithTheLines) {
  const Surface ball = shapes::ball(24);
  const auto estimate = [&](double distance, std::size_t lines) {
    OverlapOptions options;
    options.lines = lines;
    return overlap_fractions(both(ball, shapes::ball(24, {distance, 0.3 * distance, 0.2})), options).at(0);
  };
  double few = 0, many = 0, worst = 0, squares = 0;
  for (int k = 0; k < 40; ++k) {
    const double distance = 0.5 + 0.03 * k;
    const Overlap rough = estimate(distance, 256), fine = estimate(distance, 16384);
    few += rough.error;
    many += fine.error;
    const double off = std::abs(rough.volume_m3 - fine.volume_m3) / rough.error_m3;
    worst = std::max(worst, off);
    squares += off * off / 40;
  }
  EXPECT_LT(std::sqrt(squares), 1.6);
  EXPECT_GT(std::sqrt(squares), 0.5);
  EXPECT_LT(worst, 6);
  EXPECT_LT(many, few / 16);  // like 1 / lines^(3/4) at least; random points: 1 / 8
}

TEST(Overlap, LinesThroughEdgesAndCornersCountOnce) {
  // The common box is all of the small cube; its walls have diagonals, the large one's pass through its
  // middle.
  Surface large = shapes::cube({-1, -1, -1}, 4), small = shapes::cube({0, 0, 0}, 2);
  OverlapOptions options;
  options.lines = 100000;
  const auto o = overlap_fractions(both(large, small), options);
  ASSERT_EQ(o.size(), 1u);
  EXPECT_NEAR(o[0].fraction, 1, 1e-12);
}

TEST(Overlap, TouchingAndApartIsNone) {
  EXPECT_TRUE(overlap_fractions(both(shapes::cube(), shapes::cube({1, 0, 0}))).empty());
  EXPECT_TRUE(overlap_fractions(both(shapes::cube(), shapes::cube({3, 0, 0}))).empty());
  // boxes that overlap, balls that do not
  EXPECT_TRUE(overlap_fractions(both(shapes::ball(16), shapes::ball(16, {1.3, 1.3, 1.3}))).empty());
}

TEST(Overlap, TurningInsideOutOrRoundChangesNothing) {
  Surface a = shapes::ball(16), b = shapes::ball(16, {0.8, 0.3, 0.5});
  const Overlap straight = overlap_fractions(both(a, b)).at(0);
  shapes::turn_inside_out(b);
  EXPECT_EQ(overlap_fractions(both(a, b)).at(0).volume_m3, straight.volume_m3);
  EXPECT_NEAR(overlap_fractions(both(b, a)).at(0).volume_m3, straight.volume_m3, 1e-12);
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(1, 2, 3)));
  shapes::turn_inside_out(b);
  Surface turned = both(a, b);
  for (glm::dvec3& p : turned.position_m) p = turn * p;
  const Overlap other = overlap_fractions(turned).at(0);
  EXPECT_NEAR(other.fraction, straight.fraction, 4 * std::hypot(other.error, straight.error));
}

TEST(Overlap, OpenShellsHaveNoInsideAndNumbersAreThoseOfTheReport) {
  Surface s = shapes::sheet(3);
  append(s, shapes::cube({0, 0, -0.5}));
  append(s, shapes::cube({0.5, 0.5, -0.25}));
  const auto o = overlap_fractions(s);
  ASSERT_EQ(o.size(), 1u);
  EXPECT_EQ(o[0].a, 1u);
  EXPECT_EQ(o[0].b, 2u);
  EXPECT_NEAR(o[0].fraction, 0.5 * 0.5 * 0.75, 1e-12);
  EXPECT_FALSE(check_surface(s).component[0].closed);
}

TEST(Overlap, ManyShellsSameForAnyNumberOfThreads) {
  Surface s;
  for (int k = 0; k < 30; ++k) append(s, shapes::ball(6, {0.4 * k, 0.3 * (k % 3), 0.2 * (k % 5)}, 0.5));
  const auto all = overlap_fractions(s);
  EXPECT_GT(all.size(), 29u);
  const ThreadLimit one(1);
  const auto again = overlap_fractions(s);
  ASSERT_EQ(again.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(again[k].volume_m3, all[k].volume_m3);
    EXPECT_EQ(again[k].error_m3, all[k].error_m3);
    EXPECT_LT(all[k].a, all[k].b);
    if (k == 0) continue;
    EXPECT_LT(std::pair(all[k - 1].a, all[k - 1].b), std::pair(all[k].a, all[k].b));
  }
}

TEST(Overlap, OptionsAreChecked) {
  for (const std::size_t lines : {0u, 15u, 1000001u}) {
    OverlapOptions options;
    options.lines = lines;
    EXPECT_THROW(overlap_fractions(shapes::cube(), options), InvalidInput);
  }
}

}  // namespace
}  // namespace witherfield::check
