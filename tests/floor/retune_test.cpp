// Changing something and walking only those it concerns gives what walking everyone gives.
#include <gtest/gtest.h>

#include "sim/core/errors.hpp"
#include "tests/floor/floor_rooms.hpp"
#include "tests/floor/footprint_lists.hpp"

namespace witherfield::floor {
namespace {

FloorOptions office() {
  FloorOptions o = office_round_trips();
  o.crowd.visits = 2000;
  o.crowd.days = 200;
  return o;
}

struct Retuned {
  std::vector<Footprint> prints;
  RetuneReport report;
};
Retuned retuned(const FloorOptions& before, const FloorOptions& after) {
  Retuned r;
  r.report = retune(before, source_of(walked(before), 777), after,
                    [&](std::span<const Footprint> p) { r.prints.insert(r.prints.end(), p.begin(), p.end()); });
  return r;
}

TEST(Retune, NothingChangedNothingWalked) {
  const Retuned r = retuned(office(), office());
  EXPECT_EQ(r.prints, walked(office()));
  EXPECT_EQ(r.report.kept, 2000);
  EXPECT_EQ(r.report.walked, 0);
}

TEST(Retune, PeopleAreDropped) {
  FloorOptions after = office();
  after.crowd.absent = {{100, 350}};
  const Retuned r = retuned(office(), after);
  EXPECT_EQ(r.prints, walked(after));
  EXPECT_EQ(r.report.dropped, 250);
  EXPECT_EQ(r.report.walked, 0);
  EXPECT_EQ(r.report.kept, 1750);
}

TEST(Retune, AShareIsChanged) {
  FloorOptions before = office(), after = office();
  before.crowd.patrol_share = 0.2;
  before.crowd.round_trip_share = 0.8;
  after.crowd.patrol_share = 0.3;
  after.crowd.round_trip_share = 0.7;
  const Retuned r = retuned(before, after);
  EXPECT_EQ(r.prints, walked(after));
  EXPECT_NEAR(double(r.report.walked), 200, 60) << "only the tenth that changes its mind";
}

TEST(Retune, ADeskIsMovedForAWhile) {
  FloorOptions after = office();
  after.room.obstacles[4].until_day = 50;  // the table in the middle is away for 30 days
  Obstacle back = after.room.obstacles[4];
  back.from_day = 80;
  back.until_day = kForever;
  after.room.obstacles.push_back(back);
  const Retuned r = retuned(office(), after);
  EXPECT_EQ(r.prints, walked(after));
  EXPECT_NEAR(double(r.report.walked), 300, 3);
  EXPECT_EQ(r.report.kept + r.report.walked, 2000);
}

TEST(Retune, OtherRulesMeanWalkingAll) {
  FloorOptions after = office();
  after.gait.heading_sd_deg = 5;
  const Retuned r = retuned(office(), after);
  EXPECT_EQ(r.report.walked, 2000);
  EXPECT_EQ(r.prints, walked(after));
}

TEST(Retune, FootprintsOutOfOrderAreRefused) {
  std::vector<Footprint> prints = walked(office(), {0, 50});
  std::reverse(prints.begin(), prints.end());
  EXPECT_THROW(retune(office(), source_of(prints), office(), [](std::span<const Footprint>) {}), InvalidInput);
}

}  // namespace
}  // namespace witherfield::floor
