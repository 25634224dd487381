#include "sim/floor/options.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/core/errors.hpp"
#include "sim/floor/masks.hpp"
#include "sim/floor/room.hpp"

namespace witherfield::floor {
namespace {

void require(const std::string& name, double value, double lo, double hi, const char* unit = "") {
  if (value >= lo && value <= hi) return;  // NaN fails too
  std::ostringstream s;
  s << name << " = " << value << " is outside " << lo << ".." << hi;
  if (*unit) s << ' ' << unit;
  throw InvalidInput(s.str());
}

void require(const std::string& name, const Spread& s, double lo, double hi, const char* unit) {
  require(name + ".lo", s.lo, lo, hi, unit);
  require(name + ".hi", s.hi, s.lo, hi, unit);
  require(name + ".mean", s.mean, s.lo, s.hi, unit);
  require(name + ".sd", s.sd, 0, hi - lo, unit);
}

void validate(const CrowdOptions& c) {
  require("crowd.visits", double(c.visits), 1, 1e8, "visits");
  require("crowd.days", c.days, 0.01, 1e6, "days");
  require("crowd.visits_each", c.visits_each, 1e-6, 1e6);
  for (const auto& [name, share] : {std::pair{"crowd.patrol_share", c.patrol_share},
                                    {"crowd.round_trip_share", c.round_trip_share},
                                    {"crowd.pass_share", c.pass_share}})
    require(name, share, 0, 1e6);
  if (!(c.patrol_share + c.round_trip_share + c.pass_share > 0))
    throw InvalidInput("crowd.patrol_share: patrol_share, round_trip_share and pass_share are all 0");
  require("crowd.clockwise_share", c.clockwise_share, 0, 1);
  require("crowd.women_share", c.women_share, 0, 1);
  require("crowd.speed_men_m_s", c.speed_men_m_s, 0.1, 5, "m/s");
  require("crowd.speed_women_m_s", c.speed_women_m_s, 0.1, 5, "m/s");
  require("crowd.patrol_speed_factor", c.patrol_speed_factor, 0.1, 1);
  require("crowd.mass_men_kg", c.mass_men_kg, 10, 300, "kg");
  require("crowd.mass_women_kg", c.mass_women_kg, 10, 300, "kg");
  require("crowd.foot_men_m", c.foot_men_m, 0.15, 0.4, "m");
  require("crowd.foot_women_m", c.foot_women_m, 0.15, 0.4, "m");
  require("crowd.toe_slide_share", c.toe_slide_share, 0, 1);
  for (const auto& [first, last] : c.absent)
    if (first < 0 || last < first)
      throw InvalidInput("crowd.absent: visits " + std::to_string(first) + " to " + std::to_string(last) +
                         ": needs 0 <= first <= last");
}

void validate(const GaitOptions& g) {
  require("gait.step_base_m", g.step_base_m, 0.05, 1, "m");
  require("gait.step_per_speed_s", g.step_per_speed_s, 0, 1, "s");
  require("gait.step_sd_m", g.step_sd_m, 0, 0.1, "m");
  require("gait.side_m", g.side_m, 0, 0.3, "m");
  require("gait.toe_out_deg", g.toe_out_deg, -45, 45, "deg");
  require("gait.heading_sd_deg", g.heading_sd_deg, 0, 45, "deg");
  require("gait.heading_memory_m", g.heading_memory_m, 0.1, 20, "m");
  require("gait.turn_radius_m", g.turn_radius_m, 0.05, 2, "m");
  require("gait.clearance_m", g.clearance_m, 0.1, 0.6, "m");
  require("gait.reach_m", g.reach_m, 0.1, 2, "m");
  require("gait.stance_share", g.stance_share, 0.3, 0.9);
  require("gait.slip_m", g.slip_m, 0, 0.1, "m");
  require("gait.toe_slide_m", g.toe_slide_m, 0, 0.1, "m");
  require("gait.pivot_m_per_rad", g.pivot_m_per_rad, 0, 0.2, "m/rad");
  require("gait.view_distance_m", g.view_distance_m, 0.2, 20, "m");
  require("gait.look_share", g.look_share, 0, 1);
  require("gait.look_s", g.look_s, 0, 600, "s");
  require("gait.steps_max", g.steps_max, 10, 1e6, "steps");
}

void validate(const MaterialOptions& m) {
  if (m.layers.empty()) throw InvalidInput("material.layer: at least one layer is needed");
  for (std::size_t n = 0; n < m.layers.size(); ++n) {
    const Layer& l = m.layers[n];
    const std::string at = "material.layer[" + std::to_string(n) + "] '" + l.name + "'.";
    if (n + 1 < m.layers.size()) require(at + "thickness_um", l.thickness_um, 0.01, 1e6, "um");
    require(at + "hardness_Pa", l.hardness_Pa, 1e5, 1e11, "Pa");
    require(at + "wear_coefficient", l.wear_coefficient, 0, 0.1);
    require(at + "gloss_new", l.gloss_new, 0, 1);
    require(at + "gloss_worn", l.gloss_worn, 0, 1);
    require(at + "gloss_hits", l.gloss_hits, 1, 1e9);
    require(at + "dirt_hold", l.dirt_hold, 0, 1);
    for (int a = 0; a < 3; ++a) {
      require(at + "colour", l.colour[a], 0, 1);
      require(at + "colour_worn", l.colour_worn[a], 0, 1);
    }
  }
  require("material.piece_hardness_sd", m.piece_hardness_sd, 0, 0.5);
  require("material.piece_brightness_sd", m.piece_brightness_sd, 0, 0.5);
  require("material.finish_sd", m.finish_sd, 0, 0.5);
  require("material.joint_depth_m", m.joint_depth_m, 0, 0.1, "m");
  require("material.piece_level_sd_m", m.piece_level_sd_m, 0, 0.02, "m");
  require("material.piece_length_m", m.pattern.length_m, 0.02, 20, "m");
  require("material.piece_width_m", m.pattern.width_m, 0.02, 20, "m");
  require("material.joint_m", m.pattern.joint_m, 0, 0.1, "m");
  require("material.turn_deg", m.pattern.turn_deg, -360, 360, "deg");
}

void validate(const StairOptions& s, const GaitOptions& gait) {
  require("stairs.treads", s.treads, 2, 200);
  require("stairs.going_m", s.going_m, 0.2, 0.6, "m");
  require("stairs.rise_m", s.rise_m, 0.05, 0.3, "m");
  require("stairs.width_m", s.width_m, std::max(0.6, 2 * gait.clearance_m + 0.05), 20, "m");
  require("stairs.up_share", s.up_share, 0, 1);
  require("stairs.keep_right_m", s.keep_right_m, 0, s.width_m / 2, "m");
  require("stairs.lane_sd_m", s.lane_sd_m, 0, s.width_m / 2, "m");
  require("stairs.speed_m_s", s.speed_m_s, 0.1, 2, "m/s");
  require("stairs.nosing_m", s.nosing_m, 0, 0.2, "m");
  require("stairs.nosing_factor", s.nosing_factor, 1, 10);
}

void validate(const FootprintOptions& f) {
  require("footprints.pixels_per_m", f.pixels_per_m, 20, 2000, "1/m");
  require("footprints.angle_steps", f.angle_steps, 16, 3600);
  if (f.angle_steps % 4 != 0)
    throw InvalidInput("footprints.angle_steps = " + std::to_string(f.angle_steps) + " is not a multiple of 4");
  require("footprints.sizes", f.sizes, 1, 9);
  if (f.mask_size != 0 && (f.mask_size % 2 == 0 || f.mask_size < 3 || f.mask_size > 1001))
    throw InvalidInput("footprints.mask_size = " + std::to_string(f.mask_size) + " must be odd and within 3..1001 cells");
  if (f.masks.size() > 8)
    throw InvalidInput("footprints.masks: " + std::to_string(f.masks.size()) + " masks; at most 8");
  for (const UserMask& m : f.masks) validate(m);
}

/// Somebody must be able to do what the shares ask for, on every day.
void validate_behaviours(const FloorOptions& o) {
  const auto open_doors = std::count_if(o.room.doors.begin(), o.room.doors.end(), [](const Door& d) { return d.share > 0; });
  if (o.crowd.pass_share > 0 && (open_doors < 2 || o.room.doors.size() < 2))
    throw InvalidInput("crowd.pass_share = " + std::to_string(o.crowd.pass_share) +
                       ": people who pass through need two doors with a share above 0");
  if (o.crowd.round_trip_share > 0)
    for (const double day : changes_of_plan(o.room, o.crowd.days)) {
      const bool any = std::any_of(o.room.places.begin(), o.room.places.end(), [&](const Place& p) {
        return day >= p.from_day && day < p.until_day && p.share > 0;
      });
      if (!any)
        throw InvalidInput("crowd.round_trip_share = " + std::to_string(o.crowd.round_trip_share) +
                           ": no place to go to from day " + std::to_string(day) + " on");
    }
}

}  // namespace

void validate(const FloorOptions& o) {
  validate(o.crowd);
  validate(o.gait);
  validate(o.footprints);
  validate(o.material);
  require("soil.carried", o.soil.carried, 0, 1);
  require("soil.fades_over_steps", o.soil.fades_over_steps, 0.1, 1e4, "steps");
  require("soil.rubbed", o.soil.rubbed, 0, 1);
  require("soil.mopped_per_day", o.soil.mopped_per_day, 0, 10, "1/day");
  glm::dvec2 extent_m;
  if (o.stairs) {
    validate(*o.stairs, o.gait);
    extent_m = {o.stairs->width_m, o.stairs->going_m * o.stairs->treads};
  } else {
    validate_room(o.room, o.gait, o.crowd.days);
    validate_behaviours(o);
    const Box box = RoomPlan(o.room, 0).bounds();
    extent_m = box.hi - box.lo;
  }
  if (const double cells = extent_m.x * extent_m.y * o.footprints.pixels_per_m * o.footprints.pixels_per_m; cells > 4e8)
    throw InvalidInput("footprints.pixels_per_m = " + std::to_string(o.footprints.pixels_per_m) + ": the floor would have " +
                       std::to_string(cells / 1e6) + " million cells; at most 400");
  if (o.frames.empty()) throw InvalidInput("wear.frames: at least one key frame is needed");
  for (std::size_t n = 0; n < o.frames.size(); ++n) {
    require("wear.frames[" + std::to_string(n) + "]", o.frames[n], 0, 1);
    if (n > 0 && o.frames[n] <= o.frames[n - 1]) throw InvalidInput("wear.frames: key frames must ascend");
  }
}

}  // namespace witherfield::floor
