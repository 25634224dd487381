// Stairs: the same walkers, up and down.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/floor/walkers.hpp"
#include "tests/floor/floor_rooms.hpp"
#include "tests/floor/footprint_lists.hpp"

namespace witherfield::floor {
namespace {

FloorOptions stairs(std::int64_t visits = 4000) {
  FloorOptions o = stone_stairs();
  o.crowd.visits_each *= double(o.crowd.visits) / double(visits);
  o.crowd.visits = visits;
  o.footprints.pixels_per_m = 100;
  o.frames = {0, 1};
  return o;
}

TEST(Stairs, OneFootOnEveryTreadUpAndDown) {
  const FloorOptions o = stairs();
  Walk w;
  int up = 0;
  for (std::int64_t n = 0; n < 1000; ++n) {
    const Visit v = plan_visit(o, n);
    up += v.clockwise;
    walk_stairs(o, v, w);
    ASSERT_EQ(int(w.steps.size()), o.stairs->treads);
    for (int k = 0; k < o.stairs->treads; ++k) {
      const Step& s = w.steps[std::size_t(k)];
      const int tread = v.clockwise ? k : o.stairs->treads - 1 - k;
      ASSERT_EQ(int(std::floor(s.foot_m.y / o.stairs->going_m)), tread);
      ASSERT_GT(std::sin(s.heading_rad) * (v.clockwise ? 1 : -1), 0.8);
      if (k > 0) {
        ASSERT_NE(s.foot, w.steps[std::size_t(k) - 1].foot);
        ASSERT_GT(s.time_s, w.steps[std::size_t(k) - 1].time_s);
      }
    }
  }
  EXPECT_NEAR(up, 500, 60);
}

TEST(Stairs, PeopleKeepToTheRight) {
  FloorOptions o = stairs();
  o.stairs->keep_right_m = 0.3;
  double x[2] = {0, 0};
  int n[2] = {0, 0};
  for (const Footprint& f : walked(o)) {
    const bool up = f.heading_rad() > 0;
    x[up] += f.x_m;
    ++n[up];
  }
  EXPECT_NEAR(x[1] / n[1], o.stairs->width_m / 2 + 0.3, 0.03) << "up: right is +x";
  EXPECT_NEAR(x[0] / n[0], o.stairs->width_m / 2 - 0.3, 0.03);
}

TEST(Stairs, EveryTreadIsAFloorOfItsOwn) {
  const FloorOptions o = stairs();
  std::vector<std::vector<FloorField>> frames;
  const FloorReport report = simulate(o, [&](const FloorFrame& f) { frames.emplace_back(f.floors.begin(), f.floors.end()); });
  EXPECT_TRUE(report.monotone);
  ASSERT_EQ(frames[1].size(), 14u);
  const auto total = [](const FloorField& f) {
    const std::vector<float>& v = f.at("footfalls");
    return std::accumulate(v.begin(), v.end(), 0.0);
  };
  for (int t = 0; t < 14; ++t) {
    const FloorField& f = frames[1][std::size_t(t)];
    EXPECT_EQ(f.ny, 30);
    EXPECT_NEAR(f.origin_m.y, 0.3 * t, 1e-12);
    EXPECT_NEAR(total(f) / total(frames[1][0]), 1, 0.05) << "all carry the same";
    EXPECT_NEAR(frames[0][std::size_t(t)].at("height_m")[0], 0.165 * (t + 1), 0.003);
  }
}

TEST(Stairs, AreWornMostAtTheNosingAndInTheMiddle) {
  const FloorOptions o = stairs();
  FloorField f;
  simulate(o, [&](const FloorFrame& frame) { f = frame.floors[6]; });
  const auto depth = [&](int i0, int i1, int j0, int j1) {
    double sum = 0;
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) sum += f.at("wear_depth_um")[std::size_t(j * f.nx + i)];
    return sum / ((i1 - i0) * (j1 - j0));
  };
  EXPECT_GT(depth(40, 100, 0, 6), 1.5 * depth(40, 100, 24, 30)) << "nosing against riser";
  EXPECT_GT(depth(50, 90, 0, 30), 5 * depth(0, 20, 0, 30)) << "middle against edge";
  EXPECT_GT(depth(50, 90, 0, 6), 5000) << "after five hundred years one sees it";
  EXPECT_LT(depth(50, 90, 0, 6), 80000);
}

}  // namespace
}  // namespace witherfield::floor
