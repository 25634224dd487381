// Laws of the interpolation between key frames.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/errors.hpp"
#include "sim/core/monotone.hpp"

namespace witherfield {
namespace {

double value(const std::vector<double>& t, const std::vector<double>& y, double at) {
  const KeyPlace p = place_among(t, at);
  constexpr double kUnused = 1e9;  // where the window has no key
  return monotone_between(p.window, p.window.before ? y[p.first - 1] : kUnused, y[p.first], y[p.first + 1],
                          p.window.after ? y[p.first + 2] : kUnused);
}

const std::vector<double> kTime{0, 0.02, 0.1, 0.3, 1};

TEST(Monotone, PassesThroughTheKeys) {
  const std::vector<double> y{1, 4, 4, 0.5, 9};
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(value(kTime, y, kTime[i]), y[i], 1e-12) << i;
}

TEST(Monotone, WhatGrowsInTheKeysGrowsInBetween) {
  const std::vector<double> y{0, 3, 3.001, 80, 81};
  double last = -1;
  for (int i = 0; i <= 5000; ++i) {
    const double v = value(kTime, y, i / 5000.0);
    EXPECT_GE(v, last - 1e-12) << i;
    last = v;
  }
}

TEST(Monotone, NeverLeavesTheRangeOfTheTwoKeysBesideIt) {
  const std::vector<double> y{5, -3, 9, 9, -8};
  for (int i = 0; i <= 5000; ++i) {
    const double at = i / 5000.0;
    const std::size_t k = place_among(kTime, at).first;
    EXPECT_GE(value(kTime, y, at), std::min(y[k], y[k + 1]));
    EXPECT_LE(value(kTime, y, at), std::max(y[k], y[k + 1]));
  }
}

TEST(Monotone, ALineIsALineAndTheSlopeHasNoSteps) {
  std::vector<double> line, bent{0, 1, 3, 7, 20};
  for (double t : kTime) line.push_back(2 + 3 * t);
  for (double at : {0.001, 0.05, 0.2, 0.77}) EXPECT_NEAR(value(kTime, line, at), 2 + 3 * at, 1e-12);
  const double h = 1e-6;
  for (std::size_t i = 1; i + 1 < kTime.size(); ++i) {
    const double left = (value(kTime, bent, kTime[i]) - value(kTime, bent, kTime[i] - h)) / h,
                 right = (value(kTime, bent, kTime[i] + h) - value(kTime, bent, kTime[i])) / h;
    EXPECT_NEAR(left, right, 1e-2 * std::abs(left)) << i;
  }
}

TEST(Monotone, TheErrorFallsWithTheThirdPowerOfTheStep) {
  const auto error = [](int keys) {
    std::vector<double> t, y;
    for (int i = 0; i <= keys; ++i) t.push_back(double(i) / keys), y.push_back(1 - std::exp(-3 * t.back()));
    double worst = 0;
    for (double at = 0.3; at < 0.7; at += 0.0003) worst = std::max(worst, std::abs(value(t, y, at) - 1 + std::exp(-3 * at)));
    return worst;
  };
  EXPECT_LT(error(20), error(10) / 6);
}

FloorField floor_of(float gloss) {
  FloorField f(3, 2, {0, 0}, 0.1);
  f.make("gloss").assign(6, gloss);
  f.make("diffuse").assign(18, 1 - gloss);
  return f;
}

TEST(FloorBetween, EndsAreTheKeysAndTheMiddleLiesBetween) {
  const FloorField a = floor_of(0.9f), b = floor_of(0.1f);
  KeyPlace p = place_among(std::vector<double>{0, 1}, 0);
  const FloorField* keys[4] = {nullptr, &a, &b, nullptr};
  EXPECT_EQ(floor_between(p.window, keys).at("gloss"), a.at("gloss"));
  p = place_among(std::vector<double>{0, 1}, 1);
  EXPECT_EQ(floor_between(p.window, keys).at("diffuse"), b.at("diffuse"));
  p = place_among(std::vector<double>{0, 1}, 0.5);
  EXPECT_NEAR(floor_between(p.window, keys).at("gloss")[4], 0.5, 1e-6);
}

TEST(FloorBetween, OtherGridsAndMissingChannelsAreErrors) {
  const FloorField a = floor_of(0.9f), other(2, 2, {0, 0}, 0.1);
  FloorField bare(3, 2, {0, 0}, 0.1);
  bare.make("gloss");
  const KeyWindow w = place_among(std::vector<double>{0, 1}, 0.5).window;
  const FloorField* grids[4] = {nullptr, &a, &other, nullptr};
  EXPECT_THROW(floor_between(w, grids), InvalidInput);
  const FloorField* channels[4] = {nullptr, &a, &bare, nullptr};
  EXPECT_THROW(floor_between(w, channels), InvalidInput);
  EXPECT_THROW(place_among(std::vector<double>{0}, 0), InvalidInput);
  EXPECT_THROW(place_among(std::vector<double>{0, 0}, 0), InvalidInput);
}

}  // namespace
}  // namespace witherfield
