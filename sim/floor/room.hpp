// A room's plan on one day: outline with doors, and what stands in it then.
#pragma once
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "sim/floor/options.hpp"

namespace witherfield::floor {

using Polygon = std::vector<glm::dvec2>;

double signed_area_m2(const Polygon& polygon);
bool contains(const Polygon& polygon, glm::dvec2 p);
double distance_m(const Polygon& polygon, glm::dvec2 p);  ///< to its border
/// @throws InvalidInput naming `what` and the corners when it has fewer than 3, is not finite, crosses itself or has
/// no area.
void check_simple(const Polygon& polygon, const std::string& what);

struct Segment { glm::dvec2 a, b; };
double distance_m(const Segment& segment, glm::dvec2 p);

/// A door with the directions that walkers need.
struct Gate {
  glm::dvec2 a, b;
  glm::dvec2 inward;   ///< unit normal, into the room
  glm::dvec2 along;    ///< unit, a to b
  double width_m = 0;
  glm::dvec2 middle() const { return 0.5 * (a + b); }
  double depth_m(glm::dvec2 p) const;   ///< > 0 inside the room
  double offset_m(glm::dvec2 p) const;  ///< along the door, from its middle
};

/// How far beyond a door the walkers' ground goes on.
inline constexpr double kVestibule_m = 0.6;

struct Box { glm::dvec2 lo, hi; };

class RoomPlan {
 public:
  /// The plan on `day`. @pre validate_room(room) passed.
  RoomPlan(const RoomOptions& room, double day);

  const Polygon& outline() const { return outline_; }  ///< counter-clockwise
  const std::vector<Polygon>& obstacles() const { return obstacles_; }
  const std::vector<Gate>& gates() const { return gates_; }
  /// In the room or on the sill of a door, and not in an obstacle.
  bool open(glm::dvec2 p) const;
  /// To the nearest wall (doors are open) or obstacle, from either side.
  double clearance_m(glm::dvec2 p) const;
  double wall_distance_m(glm::dvec2 p) const { return distance_m(outline_, p); }  ///< doors count as wall
  Box bounds() const;  ///< of the outline

 private:
  Polygon outline_;
  std::vector<Polygon> obstacles_;
  std::vector<Segment> walls_;  // outline without the doors, with the jambs
  std::vector<Gate> gates_;
};

/// The first days on which something is moved, ascending, beginning with 0: between two of them the plan is the same.
std::vector<double> changes_of_plan(const RoomOptions& room, double days);

/// What does not need a grid: outlines simple, doors on the wall and wide enough, obstacles and places in the room,
/// places free. @throws InvalidInput.
void validate_room(const RoomOptions& room, const GaitOptions& gait, double days);

}  // namespace witherfield::floor
