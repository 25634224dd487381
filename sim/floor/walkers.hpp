// One visit: who comes, where to, and the Markov sequence (place, heading, phase) of the steps.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/floor/footprint.hpp"
#include "sim/floor/nav_grid.hpp"
#include "sim/floor/orientation_field.hpp"

namespace witherfield::floor {

/// The room while its plan stays the same, with a field for every goal.
class World {
 public:
  /// @throws InvalidInput when a goal cannot be reached from a door.
  World(const FloorOptions& options, double from_day, double until_day);

  double from_day() const { return from_day_; }
  double until_day() const { return until_day_; }
  const RoomPlan& plan() const { return plan_; }
  const NavGrid& grid() const { return grid_; }
  const OrientationField& to_gate(int gate) const { return to_gate_[std::size_t(gate)]; }
  /// @pre the place is there during this time.
  const OrientationField& to_place(int place) const { return to_place_[std::size_t(place)]; }
  const RoundField& round() const { return round_; }
  const std::vector<glm::dvec2>& pictures() const { return pictures_; }

 private:
  double from_day_, until_day_;
  RoomPlan plan_;
  NavGrid grid_;
  std::vector<OrientationField> to_gate_, to_place_;
  RoundField round_;
  std::vector<glm::dvec2> pictures_;
};

/// All plans of the room over the days. Stairs have none.
std::vector<std::unique_ptr<World>> make_worlds(const FloorOptions& options);
const World& world_on(const std::vector<std::unique_ptr<World>>& worlds, double day);

/// What is settled at the door, drawn from (seed, visit) alone.
struct Visit {
  std::int64_t number = 0;
  double day = 0;
  bool absent = false;
  Behaviour behaviour = Behaviour::patrol;
  int gate_in = 0, gate_out = 0, place = -1;
  bool clockwise = false;      ///< on stairs: upward
  bool woman = false;
  double mass_kg = 0, foot_length_m = 0, speed_m_s = 0;
  double weight_N() const { return 9.81 * mass_kg; }
};
Visit plan_visit(const FloorOptions& options, std::int64_t number);
/// The person alone: sex, mass, foot, speed.
Visit plan_person(const FloorOptions& options, std::int64_t number);

struct Walk {
  bool out = false;              ///< found the exit; else stuck
  glm::dvec2 end_m{0.0};
  double way_m = 0;
  std::vector<Step> steps;
};
/// Walks; `walk` is reused. Steps that fall on the sill outside the room are among them.
void walk_visit(const FloorOptions& options, const World& world, const Visit& visit, Walk& walk);
void walk_stairs(const FloorOptions& options, const Visit& visit, Walk& walk);

/// Number of the sole that a step shows: of ours, or of the user's masks.
int sole_of(const FloorOptions& options, const Visit& visit, const Step& step);

/// One foot: offset to the side of the line of walking, turned outward. Su et al. 1998, sec. 2.1, print the offset along
/// the line (cos for x, sin for y); it is across it: x' = x -+ d sin(theta), y' = y +- d cos(theta).
void place_foot(Step& step);

}  // namespace witherfield::floor
