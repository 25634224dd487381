// Imported tracks.
#include "sim/floor/tracks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/errors.hpp"
#include "tests/floor/floor_rooms.hpp"

namespace witherfield::floor {
namespace {

std::string refusal(std::string_view text, TrackFormat format = TrackFormat::guess) {
  try {
    parse_tracks(text, format, "file.txt");
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(Tracks, CsvIsReadSortedByPersonAndTime) {
  const auto t = parse_tracks("person,time_s,x_m,y_m\n7,1.0,2.5,3\n3,0,0,0\n7,0.5,2,3\r\n3,1,1,0\n");
  ASSERT_EQ(t.size(), 2u);
  EXPECT_EQ(t[0].person, 3);
  EXPECT_EQ(t[1].points[0].time_s, 0.5);
  EXPECT_EQ(t[1].points[1].at_m, glm::dvec2(2.5, 3));
}

TEST(Tracks, JupedsimCountsFrames) {
  const auto t = parse_tracks("# description: x\n# framerate: 8.00\n# ID FR X Y Z\n1\t0\t1.5\t2\t0\n1\t16\t3.5\t2\t0\n");
  ASSERT_EQ(t.size(), 1u);
  EXPECT_EQ(t[0].points[1].time_s, 2);
  EXPECT_EQ(t[0].points[1].at_m.x, 3.5);
  EXPECT_NE(refusal("# nothing\n1 0 1.5 2 0\n").find("file.txt:2: no '# framerate"), std::string::npos);
}

TEST(Tracks, VadereOldAndNew) {
  const auto steps = parse_tracks("pedestrianId simTime endTime startX-PID1 startY-PID1 endX-PID1 endY-PID1 targetId-PID2\n"
                                  "4 0.0 0.5 1.0 1.0 1.6 1.0 2\n4 0.5 1.0 1.6 1.0 2.2 1.0 2\n");
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].points.back().at_m.x, 2.2);
  EXPECT_EQ(steps[0].points.back().time_s, 1.0);
  const auto samples = parse_tracks("timeStep pedestrianId x-PID1 y-PID1 targetId-PID2\n1 9 0.5 0.25 1\n2 9 1.0 0.25 1\n");
  EXPECT_EQ(samples[0].person, 9);
  EXPECT_EQ(samples[0].points[1].at_m.x, 1.0);
}

TEST(Tracks, FaultsAreNamedWithTheirLine) {
  EXPECT_NE(refusal("1,0,0,0\n1,1,zero,0\n").find("file.txt:2: x_m 'zero' is not a number"), std::string::npos) << refusal("1,0,0,0\n1,1,zero,0\n");
  EXPECT_NE(refusal("1,0,0\n").find("file.txt:1: y_m is missing (column 4)"), std::string::npos) << refusal("1,0,0\n");
  EXPECT_NE(refusal("").find("no positions"), std::string::npos);
  EXPECT_NE(refusal("simTime startX-PID1\n0 1\n").find("pedestrianId"), std::string::npos);
}

TEST(Tracks, FeetAreSetAlongTheTrack) {
  FloorOptions o = office_round_trips();
  Track straight{1, {}};
  for (int n = 0; n <= 100; ++n) straight.points.push_back({0.1 * n, {1 + 0.13 * n, 3}});  // 1.3 m/s along x
  std::vector<Footprint> prints;
  footprints_of({straight}, o, [&](std::span<const Footprint> p) { prints.assign(p.begin(), p.end()); }, 42);
  const double length = o.gait.step_base_m + o.gait.step_per_speed_s * 1.3;
  EXPECT_NEAR(double(prints.size()), 13 / length, 2);
  for (std::size_t n = 0; n < prints.size(); ++n) {
    const Footprint& f = prints[n];
    EXPECT_EQ(f.person, 42u);
    EXPECT_NEAR(f.y_m, 3, 0.09);
    EXPECT_EQ(f.y_m > 3, f.foot() == Foot::left);
    EXPECT_LT(std::abs(f.heading_rad()), 0.35);
    if (n > 0) {
      EXPECT_NE(f.foot(), prints[n - 1].foot());
      EXPECT_NEAR(f.x_m - prints[n - 1].x_m, length, 0.16);
      EXPECT_NEAR(f.time_s - prints[n - 1].time_s, (f.x_m - prints[n - 1].x_m) / 1.3, 0.15);
    }
  }
}

TEST(Tracks, WhoStandsStandsOnBothFeet) {
  const Track t{1, {{0, {0, 0}}, {2, {2.6, 0}}, {12, {2.6, 0.01}}, {14, {5.2, 0}}}};
  std::vector<Footprint> prints;
  footprints_of({t}, office_round_trips(), [&](std::span<const Footprint> p) { prints.assign(p.begin(), p.end()); });
  int standing = 0;
  for (const Footprint& f : prints)
    if (f.phase() == Phase::stand) {
      ++standing;
      EXPECT_NEAR(f.contact_s(), 10, 0.5);
    }
  EXPECT_EQ(standing, 2);
}

}  // namespace
}  // namespace witherfield::floor
