// Walkers: statistics of their steps, and that they walk where one can walk.
#include "sim/floor/walkers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>

#include "sim/core/parallel.hpp"
#include "sim/floor/gait.hpp"
#include "sim/floor/simulate.hpp"
#include "tests/floor/floor_rooms.hpp"
#include "tests/floor/statistics.hpp"

namespace witherfield::floor {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

/// Calls use(visit, walk) for the first n visits.
template <class Use>
void for_walks(const FloorOptions& o, std::int64_t n, const Use& use) {
  const auto worlds = make_worlds(o);
  Walk walk;
  for (std::int64_t k = 0; k < n; ++k) {
    const Visit visit = plan_visit(o, k);
    if (o.stairs) walk_stairs(o, visit, walk);
    else walk_visit(o, world_on(worlds, visit.day), visit, walk);
    use(visit, walk);
  }
}

TEST(Statistics, TheTestItselfTellsRightFromWrong) {
  Random r(3, Stream::test, 1);
  const Spread s{1.34, 0.26, 0.6, 2.2};
  std::vector<double> right, shifted, wide;
  for (int n = 0; n < 10000; ++n) {
    right.push_back(draw(r, s));
    shifted.push_back(draw(r, {1.36, 0.26, 0.6, 2.2}));
    wide.push_back(draw(r, {1.34, 0.29, 0.6, 2.2}));
  }
  EXPECT_LT(kolmogorov(right, s), kKolmogorov1Percent);
  EXPECT_GT(kolmogorov(shifted, s), kKolmogorov1Percent);
  EXPECT_GT(kolmogorov(wide, s), kKolmogorov1Percent);
  EXPECT_EQ(eta(0, std::numbers::pi / 18).mean, std::numbers::pi / 36);
}

TEST(Visits, PeopleHaveTheMeasuredSpreadOfSpeedMassAndFoot) {
  FloorOptions o = office_round_trips();
  std::vector<double> speed[2], mass[2], foot[2];
  for (std::int64_t n = 0; n < 20000; ++n) {
    const Visit v = plan_visit(o, n);
    speed[v.woman].push_back(v.speed_m_s);
    mass[v.woman].push_back(v.mass_kg);
    foot[v.woman].push_back(v.foot_length_m);
  }
  const CrowdOptions& c = o.crowd;
  EXPECT_LT(kolmogorov(speed[0], c.speed_men_m_s), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(speed[1], c.speed_women_m_s), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(mass[0], c.mass_men_kg), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(mass[1], c.mass_women_kg), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(foot[0], c.foot_men_m), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(foot[1], c.foot_women_m), kKolmogorov1Percent);
}

TEST(Visits, SharesAreKept) {
  FloorOptions o = office_round_trips();
  o.room.doors.push_back({"back door", {12, 5.5}, {12, 6.5}, 0.5});
  o.crowd.patrol_share = 0.3;
  o.crowd.round_trip_share = 0.5;
  o.crowd.pass_share = 0.2;
  o.crowd.women_share = 0.4;
  std::vector<double> behaviour(3), sex(2), door(2), place(7), sense(2);
  double passes_back = 0;
  for (std::int64_t n = 0; n < 20000; ++n) {
    const Visit v = plan_visit(o, n);
    ++behaviour[std::size_t(v.behaviour)];
    ++sex[v.woman];
    ++door[std::size_t(v.gate_in)];
    if (v.behaviour == Behaviour::round_trip) ++place[std::size_t(v.place)];
    if (v.behaviour == Behaviour::patrol) ++sense[v.clockwise];
    passes_back += v.behaviour == Behaviour::pass && v.gate_in == v.gate_out;
    ASSERT_TRUE(v.behaviour == Behaviour::pass || v.gate_in == v.gate_out);
  }
  EXPECT_LT(chi_square(behaviour, {0.3, 0.5, 0.2}), kChiSquare1Percent[2]);
  EXPECT_LT(chi_square(sex, {0.6, 0.4}), kChiSquare1Percent[1]);
  EXPECT_LT(chi_square(door, {1, 0.5}), kChiSquare1Percent[1]);
  EXPECT_LT(chi_square(place, {1, 1, 1, 1, 1, 1, 1.5}), kChiSquare1Percent[6]);
  EXPECT_LT(chi_square(sense, {1, 1}), kChiSquare1Percent[1]);
  EXPECT_EQ(passes_back, 0);
}

TEST(Steps, LengthWidthAngleAndSlipFollowTheirDistributions) {
  const FloorOptions o = office_round_trips();
  std::vector<double> length, side, toe_out, slip, deviation;
  for_walks(o, 3000, [&](const Visit& v, const Walk& w) {
    for (const Step& s : w.steps) {
      if (s.phase == Phase::stand) continue;
      side.push_back(s.side_m);
      toe_out.push_back(s.toe_out_rad / kDeg);
      if (s.length_m > 0) length.push_back(s.length_m - o.gait.step_base_m - o.gait.step_per_speed_s * v.speed_m_s);
    }
  });
  ASSERT_GT(length.size(), 30000u);
  EXPECT_LT(kolmogorov(length, {0, 0.036, -0.108, 0.108}), kKolmogorov1Percent) << "Seitz & Koester 2012, eq. 6";
  EXPECT_LT(kolmogorov(side, o.gait.side_m), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(toe_out, o.gait.toe_out_deg), kKolmogorov1Percent);
}

TEST(Steps, HeadingsAreNormalAboutTheFieldAndRemembered) {
  const FloorOptions o = office_round_trips();
  const double sd = o.gait.heading_sd_deg * kDeg;
  std::vector<double> late, first;
  double product = 0, square = 0;
  for (std::int64_t n = 0; n < 5000; ++n) {
    Gait gait(o, plan_visit(o, n));
    double a = draw(gait.random(), {0, sd, -3 * sd, 3 * sd});
    first.push_back(a);
    for (int k = 0; k < 12; ++k) {
      const double before = a;
      gait.deviate(a, 0.75);
      product += a * before;
      square += before * before;
    }
    late.push_back(a);
  }
  EXPECT_LT(kolmogorov(first, {0, sd, -3 * sd, 3 * sd}), kKolmogorov1Percent);
  EXPECT_LT(kolmogorov(late, {0, sd, -3 * sd, 3 * sd}), kKolmogorov1Percent) << "the spread stays what it is";
  EXPECT_NEAR(product / square, std::exp(-0.75 / o.gait.heading_memory_m), 0.02);
}

TEST(Steps, FeetAlternateAcrossTheLineOfWalking) {
  for_walks(office_round_trips(), 200, [](const Visit&, const Walk& w) {
    for (std::size_t k = 0; k < w.steps.size(); ++k) {
      const Step& s = w.steps[k];
      const glm::dvec2 d = s.foot_m - s.body_m, ahead{std::cos(s.heading_rad), std::sin(s.heading_rad)};
      ASSERT_NEAR(glm::dot(d, ahead), 0, 1e-12) << "across, not along";
      const double left = ahead.x * d.y - ahead.y * d.x;
      ASSERT_NEAR(left, s.foot == Foot::left ? s.side_m : -s.side_m, 1e-12);
      const double out = s.foot_heading_rad - s.heading_rad;
      ASSERT_NEAR(out, s.foot == Foot::left ? s.toe_out_rad : -s.toe_out_rad, 1e-12) << "toes turn outward";
      if (k > 0) { ASSERT_NE(s.foot, w.steps[k - 1].foot); }
    }
  });
}

TEST(Steps, TimesAndPlacesAgreeWithTheSpeed) {
  for_walks(office_round_trips(), 300, [](const Visit& v, const Walk& w) {
    for (std::size_t k = 1; k < w.steps.size(); ++k) {
      const Step &a = w.steps[k - 1], &b = w.steps[k];
      ASSERT_GE(b.time_s, a.time_s);
      if (a.phase == Phase::stand || b.phase == Phase::stand) continue;
      ASSERT_NEAR(b.time_s - a.time_s, b.length_m / v.speed_m_s, 1e-4);
      ASSERT_LE(glm::distance(a.body_m, b.body_m), b.length_m + 1e-9) << "nobody jumps";
    }
  });
}

/// 10,000 walkers in each example room: none in an obstacle or wall, all out.
class Rooms : public ::testing::TestWithParam<int> {};

TEST_P(Rooms, NobodyWalksThroughAnythingAndAllLeave) {
  FloorOptions o = GetParam() == 0 ? patrol_gallery() : GetParam() == 1 ? office_round_trips() : stone_stairs();
  o.crowd.visits = 10000;
  const auto worlds = make_worlds(o);
  std::vector<int> faults(4);
  std::mutex guard;
  parallel_for(10000, 100, [&](std::size_t begin, std::size_t end) {
    Walk walk;
    std::vector<int> mine(4);
    for (std::size_t n = begin; n < end; ++n) {
      const Visit visit = plan_visit(o, std::int64_t(n));
      if (o.stairs) {
        walk_stairs(o, visit, walk);
        mine[0] += !walk.out;
        mine[3] += int(walk.steps.size()) != o.stairs->treads;
        for (const Step& s : walk.steps)
          mine[1] += s.body_m.x < o.gait.clearance_m - 1e-9 || s.body_m.x > o.stairs->width_m - o.gait.clearance_m + 1e-9;
        continue;
      }
      const RoomPlan& plan = world_on(worlds, visit.day).plan();
      walk_visit(o, world_on(worlds, visit.day), visit, walk);
      mine[0] += !walk.out;
      mine[3] += !(plan.gates()[std::size_t(visit.gate_out)].depth_m(walk.end_m) < 0);
      for (const Step& s : walk.steps) {
        mine[1] += !plan.open(s.body_m) || plan.clearance_m(s.body_m) < o.gait.clearance_m - 0.03;
        mine[2] += !plan.open(s.foot_m);
      }
    }
    const std::lock_guard<std::mutex> lock(guard);
    for (std::size_t k = 0; k < 4; ++k) faults[k] += mine[k];
  });
  EXPECT_EQ(faults[0], 0) << "stuck";
  EXPECT_EQ(faults[1], 0) << "bodies in walls";
  EXPECT_EQ(faults[2], 0) << "feet in walls";
  EXPECT_EQ(faults[3], 0) << "not at the door at the end";
}
INSTANTIATE_TEST_SUITE_P(Examples, Rooms, ::testing::Values(0, 1, 2));

TEST(Patrol, GoesOnceRoundEitherWay) {
  FloorOptions o = patrol_gallery();
  for (const double clockwise : {0.0, 1.0}) {
    o.crowd.clockwise_share = clockwise;
    for_walks(o, 100, [&](const Visit&, const Walk& w) {
      double turned = 0;  // about the room's middle
      for (std::size_t k = 1; k < w.steps.size(); ++k) {
        const glm::dvec2 a = w.steps[k - 1].body_m - 4.5, b = w.steps[k].body_m - 4.5;
        turned += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
      }
      ASSERT_NEAR(turned / (2 * std::numbers::pi), clockwise > 0 ? -1 : 1, 0.12);
    });
  }
}

TEST(RoundTrip, ComesToItsPlaceAndBack) {
  const FloorOptions o = office_round_trips();
  for_walks(o, 300, [&](const Visit& v, const Walk& w) {
    const Place& place = o.room.places[std::size_t(v.place)];
    int stood = 0;
    for (const Step& s : w.steps) {
      if (s.phase != Phase::stand) continue;
      ++stood;
      ASSERT_LT(glm::distance(s.body_m, place.at_m), 1.0);
    }
    ASSERT_GE(stood, 2);
    ASSERT_EQ(w.steps.front().phase, Phase::out);
    ASSERT_EQ(w.steps.back().phase, Phase::back);
    ASSERT_LT(w.steps.back().body_m.x, 1.5) << "at the door";
  });
}

TEST(Pass, LeavesByAnotherDoor) {
  FloorOptions o = office_round_trips();
  o.room.doors.push_back({"back door", {12, 5.5}, {12, 6.5}});
  o.crowd.round_trip_share = 0;
  o.crowd.pass_share = 1;
  for_walks(o, 200, [&](const Visit& v, const Walk& w) {
    ASSERT_TRUE(w.out);
    ASSERT_GT(std::abs(w.end_m.x - (v.gate_in == 0 ? 0 : 12)), 11.5);
  });
}

TEST(Stuck, IsDetectedAndReported) {
  FloorOptions o = patrol_gallery();
  o.crowd.visits = 300;
  o.gait.steps_max = 12;  // nobody gets round in twelve steps
  const WalkReport report = walk(o, [](std::span<const Footprint>) {});
  EXPECT_EQ(report.stuck, 300);
  EXPECT_EQ(report.stuck_first.size(), 20u);
  EXPECT_EQ(report.stuck_first[5].visit, 5);
  EXPECT_LE(report.footprints, 300 * 20);
  o.gait.steps_max = 4000;
  EXPECT_EQ(walk(o, [](std::span<const Footprint>) {}).stuck, 0);
}

TEST(Footprint, PackingKeepsWhatMatters) {
  Step s;
  s.foot_m = {3.25, 7.125};
  s.foot_heading_rad = -2.5;
  s.time_s = 1.5e9 + 0.25;
  s.contact_s = 0.72;
  s.slip_m = 0.0105;
  s.number = 70000;
  s.foot = Foot::right;
  s.phase = Phase::back;
  const Footprint f = pack(s, 4000000000u, 712.3, 0.2713, 5, Behaviour::round_trip);
  EXPECT_EQ(f.x_m, 3.25f);
  EXPECT_EQ(f.y_m, 7.125f);
  EXPECT_NEAR(f.heading_rad(), -2.5, 5e-5);
  EXPECT_EQ(f.time_s, s.time_s);
  EXPECT_NEAR(f.contact_s(), 0.72, 0.005);
  EXPECT_NEAR(f.slip_m(), 0.0105, 2.5e-4);
  EXPECT_NEAR(f.weight_N(), 712.3, 0.05);
  EXPECT_NEAR(f.foot_length_m(), 0.2713, 5e-5);
  EXPECT_EQ(f.number, 65535);
  EXPECT_EQ(f.person, 4000000000u);
  EXPECT_EQ(f.foot(), Foot::right);
  EXPECT_EQ(f.sole(), 5);
  EXPECT_EQ(f.behaviour(), Behaviour::round_trip);
  EXPECT_EQ(f.phase(), Phase::back);
}

}  // namespace
}  // namespace witherfield::floor
