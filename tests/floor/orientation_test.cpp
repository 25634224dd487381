// Orientation fields: every line ends at the goal, in any room.
#include "sim/floor/orientation_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/floor/floor_rooms.hpp"

namespace witherfield::floor {
namespace {

/// An L with a column in each leg and a niche: nothing about it is convex.
RoomOptions awkward_room() {
  RoomOptions r;
  r.outline_m = {{0, 0}, {8, 0}, {8, 3}, {3.5, 3}, {3.5, 5}, {4.5, 5}, {4.5, 6}, {3.5, 6}, {3.5, 9}, {0, 9}};
  r.doors = {{"door", {7, 0}, {8, 0}}};
  r.obstacles = {box_obstacle("column", 4.5, 1.2, 5.1, 1.8), box_obstacle("other", 1.4, 5.5, 2.2, 6.3)};
  return r;
}

/// Follows the field from p by short steps; the number of metres walked, or -1 when it does not arrive.
double follow(const NavGrid& grid, const OrientationField& field, glm::dvec2 p, glm::dvec2 goal, double near_m) {
  for (double way = 0; way < 60; way += 0.02) {
    if (glm::distance(p, goal) < near_m) return way;
    p += 0.02 * field.at(grid.shape(), grid.shape().spot(p));
  }
  return -1;
}

TEST(OrientationField, EveryLineEndsAtTheGoal) {
  const RoomPlan plan(awkward_room(), 0);
  const NavGrid grid(plan, 0.22);
  const FieldSolver solver(grid, 0.35);
  const glm::dvec2 goal{4.1, 5.5};  // in the niche
  const OrientationField field = solver.towards({std::size_t(grid.nearest_free(goal, 0.2))});
  int tried = 0;
  for (int j = 0; j < grid.shape().ny; j += 3)
    for (int i = 0; i < grid.shape().nx; i += 3) {
      const std::size_t cell = std::size_t(j) * std::size_t(grid.shape().nx) + std::size_t(i);
      const glm::dvec2 p = grid.shape().centre_m(i, j);
      if (!grid.free(cell) || p.y < 0) continue;
      ++tried;
      const double way = follow(grid, field, p, goal, 0.1);
      ASSERT_GE(way, 0) << p.x << ' ' << p.y;
      ASSERT_LT(way, 25);
    }
  EXPECT_GT(tried, 1000);
}

TEST(OrientationField, IsUnitAndLeadsAwayFromWalls) {
  const RoomPlan plan(awkward_room(), 0);
  const NavGrid grid(plan, 0.22);
  const OrientationField field = FieldSolver(grid, 0.35).towards({std::size_t(grid.nearest_free({1, 8}, 0.2))});
  const NavShape& s = grid.shape();
  for (int j = 1; j + 1 < s.ny; ++j)
    for (int i = 1; i + 1 < s.nx; ++i) {
      const std::size_t c = std::size_t(j) * std::size_t(s.nx) + std::size_t(i);
      if (!grid.free(c)) continue;
      ASSERT_NEAR(std::hypot(field.x[c], field.y[c]), 1, 1e-5);
      const glm::dvec2 p = s.centre_m(i, j);
      if (glm::distance(p, {1, 8}) < 0.5) continue;
      // Beside a straight wall (one neighbour blocked, the opposite free) nothing leads into it.
      if (!grid.free(c - 1) && grid.free(c + 1)) { ASSERT_GT(field.x[c], 0); }
      if (!grid.free(c + 1) && grid.free(c - 1)) { ASSERT_LT(field.x[c], 0); }
    }
}

TEST(OrientationField, IsTheStraightLineWhereNothingStandsInTheWay) {
  RoomOptions r;
  r.outline_m = {{0, 0}, {10, 0}, {10, 6}, {0, 6}};
  r.doors = {{"door", {0, 2}, {0, 4}}};
  const RoomPlan plan(r, 0);
  const NavGrid grid(plan, 0.22);
  const glm::dvec2 goal = grid.shape().centre_m(int(8 / 0.05), int(3 / 0.05));
  const OrientationField field = FieldSolver(grid, 0.35).towards({std::size_t(grid.nearest_free(goal, 0.2))});
  for (const glm::dvec2 p : {glm::dvec2(3, 2), {4, 4}, {6, 2}, {5, 3}, {8, 1.5}}) {
    const glm::dvec2 e = field.at(grid.shape(), grid.shape().spot(p)), d = glm::normalize(goal - p);
    EXPECT_LT(std::abs(std::atan2(e.x * d.y - e.y * d.x, glm::dot(e, d))), 0.035) << p.x << ' ' << p.y;  // 2 degrees
  }
}

/// -lambda log(u) grows by one metre a metre (Varadhan).
TEST(OrientationField, WayLeftIsADistance) {
  RoomOptions r;
  r.outline_m = {{0, 0}, {12, 0}, {12, 8}, {0, 8}};
  r.doors = {{"door", {0, 3}, {0, 5}}};
  const RoomPlan plan(r, 0);
  const NavGrid grid(plan, 0.22);
  const OrientationField f = FieldSolver(grid, 0.2).towards({std::size_t(grid.nearest_free({2, 4}, 0.2))});
  const auto way = [&](double x) { return grid.shape().sample(f.way_m, grid.shape().spot({x, 4})); };
  EXPECT_NEAR(way(9) - way(5), 4, 0.25);
}

TEST(RoundField, TurnsOnceAboutTheMiddle) {
  for (const RoomOptions& room : {awkward_room(), patrol_gallery().room}) {
    const RoomPlan plan(room, 0);
    const NavGrid grid(plan, 0.22);
    const RoundField round = FieldSolver(grid, 0.35).round();
    // Along any loop about the middle phi gains one turn; along one that does not enclose it, none.
    const auto turns = [&](glm::dvec2 centre, double radius) {
      double sum = 0;
      for (int n = 0; n < 400; ++n) {
        const auto at = [&](int k) {
          const double a = 2 * std::numbers::pi * k / 400;
          return centre + radius * glm::dvec2(std::cos(a), std::sin(a));
        };
        const double d = round.phi(grid.shape(), at(n + 1)) - round.phi(grid.shape(), at(n));
        sum += d - std::round(d);
      }
      return sum;
    };
    EXPECT_NEAR(turns(round.middle_m, 0.8), 1, 1e-3);
    EXPECT_NEAR(turns({1, 1}, 0.5), 0, 1e-3);
  }
}

TEST(RoundField, HasTheSymmetryOfASquareRoom) {
  RoomOptions r = patrol_gallery().room;
  r.obstacles.clear();
  const RoomPlan plan(r, 0);
  const NavGrid grid(plan, 0.22);
  const RoundField round = FieldSolver(grid, 0.35).round();
  const auto at = [&](glm::dvec2 p) { return round.direction.at(grid.shape(), grid.shape().spot(p)); };
  for (const glm::dvec2 p : {glm::dvec2(1, 3), {2, 7.5}, {1.2, 6}, {3, 8}}) {
    const glm::dvec2 d = p - 4.5, quarter = glm::dvec2(4.5 - d.y, 4.5 + d.x);
    const glm::dvec2 e = at(p), f = at(quarter);
    EXPECT_NEAR(f.x, -e.y, 0.06);
    EXPECT_NEAR(f.y, e.x, 0.06);
    EXPECT_GT(d.x * e.y - d.y * e.x, 0) << "counter-clockwise";
  }
}

TEST(RoundField, DividesAroundAColumn) {
  RoomOptions r = patrol_gallery().room;
  r.obstacles = {box_obstacle("column", 1.0, 4.2, 1.6, 4.8)};
  const RoomPlan plan(r, 0);
  const NavGrid grid(plan, 0.22);
  const RoundField round = FieldSolver(grid, 0.35).round();
  const auto at = [&](glm::dvec2 p) { return round.direction.at(grid.shape(), grid.shape().spot(p)); };
  EXPECT_LT(at({0.5, 4.5}).y, -0.9) << "between column and wall";
  EXPECT_LT(at({2.1, 4.5}).y, -0.9) << "on the room's side";
  EXPECT_LT(at({1.0, 5.2}).x, 0.0) << "before it, one half turns to the wall";
  EXPECT_GT(at({1.6, 5.2}).x, 0.0) << "the other away from it";
}

}  // namespace
}  // namespace witherfield::floor
