// Rooms: what is in, what is out, and what is refused.
#include "sim/floor/room.hpp"

#include <gtest/gtest.h>

#include "sim/core/errors.hpp"
#include "sim/floor/simulate.hpp"
#include "sim/floor/walkers.hpp"
#include "tests/floor/floor_rooms.hpp"

namespace witherfield::floor {
namespace {

/// The message of the InvalidInput that `body` throws, or "".
template <class Body>
std::string refusal(const Body& body) {
  try {
    body();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}
std::string refusal(const FloorOptions& o) {
  return refusal([&] { validate(o); make_worlds(o); });
}

TEST(Room, ExamplesAreValid) {
  for (const FloorOptions& o : {patrol_gallery(), office_round_trips(), stone_stairs()}) EXPECT_EQ(refusal(o), "");
}

TEST(Room, EitherSenseOfTheOutlineGivesTheSamePlan) {
  FloorOptions o = patrol_gallery();
  const RoomPlan a(o.room, 0);
  std::reverse(o.room.outline_m.begin(), o.room.outline_m.end());
  std::swap(o.room.doors[0].a_m, o.room.doors[0].b_m);
  const RoomPlan b(o.room, 0);
  for (const glm::dvec2 p : {glm::dvec2(1, 1), {4.5, -0.2}, {4.5, 4.5}, {10, 3}, {0.1, -0.2}}) {
    EXPECT_EQ(a.open(p), b.open(p));
    EXPECT_NEAR(a.clearance_m(p), b.clearance_m(p), 1e-12);
  }
  EXPECT_GT(a.gates()[0].depth_m({4.5, 1}), 0);
  EXPECT_GT(b.gates()[0].depth_m({4.5, 1}), 0);
}

TEST(Room, DoorsAreOpenAndObstaclesAreNot) {
  const RoomPlan plan(patrol_gallery().room, 0);
  EXPECT_TRUE(plan.open({4.5, -0.3}));
  EXPECT_FALSE(plan.open({3.0, -0.3}));
  EXPECT_FALSE(plan.open({4.5, 4.5})) << "the bench";
  EXPECT_NEAR(plan.clearance_m({4.5, 0.0}), 0.7, 1e-12) << "the nearer jamb";
  EXPECT_NEAR(plan.clearance_m({2.0, 0.5}), 0.5, 1e-12);
  EXPECT_NEAR(plan.wall_distance_m({4.5, 0.3}), 0.3, 1e-12) << "here the door counts as wall";
}

TEST(Room, CrossingOutlineIsRefused) {
  FloorOptions o = patrol_gallery();
  o.room.outline_m = {{0, 0}, {9, 9}, {9, 0}, {0, 9}};
  EXPECT_NE(refusal(o).find("crosses itself"), std::string::npos) << refusal(o);
  o.room.outline_m = {{0, 0}, {9, 0}};
  EXPECT_NE(refusal(o).find("corners"), std::string::npos);
}

TEST(Room, DoorOutsideTheWallIsRefused) {
  FloorOptions o = patrol_gallery();
  o.room.doors[0] = {"lost", {3, 2}, {4, 2}};
  EXPECT_NE(refusal(o).find("'lost'"), std::string::npos) << refusal(o);
  EXPECT_NE(refusal(o).find("outline"), std::string::npos);
  o.room.doors[0] = {"slit", {3, 0}, {3.2, 0}};
  EXPECT_NE(refusal(o).find("width"), std::string::npos) << refusal(o);
}

TEST(Room, DeskBlockingTheOnlyDoorIsRefused) {
  FloorOptions o = patrol_gallery();
  o.room.obstacles.push_back(box_obstacle("wardrobe", 3.5, 0.1, 5.5, 0.7));
  EXPECT_NE(refusal(o).find("blocks"), std::string::npos) << refusal(o);
  o.room.obstacles.back().from_day = 100;  // later, but still
  EXPECT_NE(refusal(o).find("from day"), std::string::npos) << refusal(o);
}

TEST(Room, PlaceThatNobodyCanReachIsRefused) {
  FloorOptions o = office_round_trips();
  o.room.obstacles.push_back(box_obstacle("partition", 9.0, 0, 9.2, 7));
  EXPECT_NE(refusal(o).find("cannot be reached"), std::string::npos) << refusal(o);
  o = office_round_trips();
  o.room.places[0].at_m = {4.0, 6.0};
  EXPECT_NE(refusal(o).find("inside the obstacle 'desk at the window'"), std::string::npos) << refusal(o);
  o.room.places[0].at_m = {20, 6.0};
  EXPECT_NE(refusal(o).find("outside the room"), std::string::npos);
}

TEST(Room, PlacesMayMoveWithTheirDesk) {
  FloorOptions o = office_round_trips();
  o.room.obstacles[0].until_day = 100;
  o.room.places[0].until_day = 100;
  Obstacle moved = o.room.obstacles[0];
  for (glm::dvec2& p : moved.outline_m) p.x -= 1;
  moved.from_day = 100;
  moved.until_day = kForever;
  o.room.obstacles.push_back(moved);
  Place chair = o.room.places[0];
  chair.at_m.x -= 1;
  chair.from_day = 100;
  chair.until_day = kForever;
  o.room.places.push_back(chair);
  EXPECT_EQ(refusal(o), "");
  EXPECT_EQ(changes_of_plan(o.room, o.crowd.days), (std::vector<double>{0, 100}));
  const auto worlds = make_worlds(o);
  ASSERT_EQ(worlds.size(), 2u);
  EXPECT_FALSE(world_on(worlds, 99).plan().open({4.6, 6}));
  EXPECT_TRUE(world_on(worlds, 100).plan().open({4.6, 6}));
}

TEST(Options, WrongValuesAreNamedWithRangeAndUnit) {
  const auto expect = [](const std::string& word, const auto& change) {
    FloorOptions o = patrol_gallery();
    change(o);
    const std::string why = refusal([&] { validate(o); });
    EXPECT_NE(why.find(word), std::string::npos) << word << ": " << why;
  };
  expect("crowd.visits", [](FloorOptions& o) { o.crowd.visits = 0; });
  expect("patrol_share", [](FloorOptions& o) { o.crowd.patrol_share = 0; });
  expect("pass_share", [](FloorOptions& o) { o.crowd.pass_share = 1; });
  expect("no place to go to", [](FloorOptions& o) { o.crowd.round_trip_share = 1; });
  expect("gait.clearance_m = 3 is outside 0.1..0.6 m", [](FloorOptions& o) { o.gait.clearance_m = 3; });
  expect("must be odd", [](FloorOptions& o) { o.footprints.mask_size = 100; });
  expect("must be odd", [](FloorOptions& o) { o.footprints.masks = {{"mine", 98, 250, std::vector<float>(98 * 98, 1)}}; });
  expect("multiple of 4", [](FloorOptions& o) { o.footprints.angle_steps = 90 + 1; });
  expect("ascend", [](FloorOptions& o) { o.frames = {0.5, 0.5}; });
  expect("thickness_um", [](FloorOptions& o) { o.material.layers[0].thickness_um = 0; });
  expect("million cells", [](FloorOptions& o) { o.footprints.pixels_per_m = 2000, o.room.outline_m = {{0, 0}, {50, 0}, {50, 50}, {0, 50}}; });
  EXPECT_NE(refusal([] { material_preset("cheese"); }).find("varnished_oak"), std::string::npos);
}

}  // namespace
}  // namespace witherfield::floor
