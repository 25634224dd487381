// What the floor simulator is told. One aggregate per concern: default, unit and range on every field.
// The scene file (sim/scene) fills these; `validate` is called once, by the simulator.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/floor_pattern.hpp"

namespace witherfield::floor {

inline constexpr double kForever = std::numeric_limits<double>::infinity();

/// A normal distribution cut off at lo and hi. (Su et al. 1998, sec. 1.4, writes eta(lo, hi): see eta().)
struct Spread {
  double mean = 0, sd = 0, lo = 0, hi = 0;
  bool operator==(const Spread&) const = default;
};
/// The paper's eta(lo, hi): mean in the middle, the ends at three standard deviations.
constexpr Spread eta(double lo, double hi) { return {(lo + hi) / 2, (hi - lo) / 6, lo, hi}; }

/// Opening in the outer wall: a segment that lies on it.
struct Door {
  std::string name;
  glm::dvec2 a_m{0.0}, b_m{0.0};  ///< jambs; 0.5..10 m apart
  double share = 1;               ///< of the visits that begin here, relative to the other doors, >= 0
  bool operator==(const Door&) const = default;
};

/// Desk, column, bench: a polygon that nobody walks through while it stands there.
struct Obstacle {
  std::string name;
  std::vector<glm::dvec2> outline_m;             ///< simple polygon, either sense, at least 3 corners
  double from_day = 0, until_day = kForever;     ///< stands in [from_day, until_day)
  bool operator==(const Obstacle&) const = default;
};

/// Goal of round trips: where somebody stands or sits down.
struct Place {
  std::string name;
  glm::dvec2 at_m{0.0};
  double facing_deg = 90;                        ///< where one looks there, counter-clockwise from x
  double share = 1;                              ///< relative to the other places, >= 0
  double stay_min = 60;                          ///< 0..1e6
  double from_day = 0, until_day = kForever;
  bool operator==(const Place&) const = default;
};

/// Picture on a wall (or thing on show) that patrols may stop at.
struct Picture {
  std::string name;
  glm::dvec2 at_m{0.0};
  bool operator==(const Picture&) const = default;
};

struct RoomOptions {
  std::vector<glm::dvec2> outline_m;             ///< outer wall: simple polygon, either sense
  std::vector<Door> doors;                       ///< at least one
  std::vector<Obstacle> obstacles;
  std::vector<Place> places;
  std::vector<Picture> pictures;
  bool operator==(const RoomOptions&) const = default;
};

enum class Behaviour : std::uint8_t {
  patrol,      ///< once round the walls and out by the same door (Su et al. 1998, fig. 1)
  round_trip,  ///< to a place, stay, back by the same door (fig. 2)
  pass,        ///< in by one door, out by another
};

/// Who comes, how often and what for.
struct CrowdOptions {
  std::int64_t visits = 10000;         ///< walked one by one, 1..1e8
  double days = 3650;                  ///< over which they are spread evenly, 0.01..1e6
  double visits_each = 1;              ///< real visits that a walked one stands for, 1e-6..1e6
  double patrol_share = 1, round_trip_share = 0, pass_share = 0;  ///< relative, >= 0, not all 0
  double clockwise_share = 0.5;        ///< of the patrols, 0..1; the others go counter-clockwise
  double women_share = 0.5;            ///< 0..1
  std::vector<std::pair<std::int64_t, std::int64_t>> absent;  ///< visits [first, last) that do not take place
  Spread speed_men_m_s{1.41, 0.26, 0.6, 2.4}, speed_women_m_s{1.27, 0.26, 0.6, 2.2};  ///< free walking (Weidmann 1993; his sd of all people for each)
  double patrol_speed_factor = 0.6;    ///< people who look around are slower, 0.1..1
  Spread mass_men_kg{85.5, 14, 50, 140}, mass_women_kg{67.8, 11, 40, 120};            ///< ANSUR II
  Spread foot_men_m{0.271, 0.013, 0.235, 0.31}, foot_women_m{0.246, 0.012, 0.21, 0.28};
  double toe_slide_share = 0.15;       ///< of the steps end with a slide of the toe, 0..1
  bool operator==(const CrowdOptions&) const = default;
};

/// How they walk. Steps: Seitz & Koester 2012, eq. 6.
struct GaitOptions {
  double step_base_m = 0.4625, step_per_speed_s = 0.2345;  ///< step = base + per_speed * v + noise; 0.05..1, 0..1
  double step_sd_m = 0.036;            ///< cut off at 3 sd, 0..0.1
  Spread side_m{0.05, 0.012, 0.014, 0.086};                ///< foot centre to line of walking, d(t)
  Spread toe_out_deg{7.5, 4, -4.5, 19.5};                  ///< phi(t), outward; mean: Morton 1932, sd: estimate
  double heading_sd_deg = 8;           ///< about the orientation field, cut off at 3 sd, 0..45
  double heading_memory_m = 1.2;       ///< way after which a deviation is forgotten, 0.1..20
  double turn_radius_m = 0.45;         ///< tightest walked curve, 0.05..2
  double clearance_m = 0.22;           ///< middle of the body to wall or desk, 0.1..0.6
  double reach_m = 0.35;               ///< how early walls and desks are given way, 0.1..2
  double stance_share = 0.62;          ///< of a stride that a foot stands, 0.3..0.9
  Spread slip_m{0.010, 0.003, 0.002, 0.020};               ///< sliding of the sole in a normal step
  Spread toe_slide_m{0.045, 0.012, 0.02, 0.075};           ///< of a step with toe slide
  double pivot_m_per_rad = 0.02;       ///< sliding added by turning on the foot, 0..0.2
  Spread view_distance_m{1.35, 0.3, 0.6, 2.4};             ///< patrols: wall to line of walking
  double look_share = 0.45;            ///< of the pictures passed that are stopped at, 0..1
  Spread look_s{12, 6, 2, 40};         ///< standing before a picture
  int steps_max = 4000;                ///< after which a walker counts as stuck, 10..1e6
  bool operator==(const GaitOptions&) const = default;
};

/// A sole of the user's own: grey values, heel to the left, toe to the right (+x), seen from above, a right foot.
struct UserMask {
  std::string name;
  int size = 0;                        ///< a: cells along an edge, odd, 3..1001
  double pixels_per_m = 250;           ///< of this mask, 10..5000
  std::vector<float> grey;             ///< a * a, row j upward, 0 (no contact) .. 1
  bool operator==(const UserMask&) const = default;
};

struct FootprintOptions {
  double pixels_per_m = 250;           ///< of the floor and the masks, 20..2000
  int mask_size = 0;                   ///< a, odd; 0 = as large as the longest sole with its slide needs
  int angle_steps = 360;               ///< headings of a footprint in a full turn, a multiple of 4, 16..3600
  int sizes = 3;                       ///< sole lengths for each sex, 1..9
  std::vector<UserMask> masks;         ///< when not empty, they replace ours; drawn evenly
  bool operator==(const FootprintOptions&) const = default;
};

/// One layer of the floor. Wear goes through the layers from the top; the last has no end.
struct Layer {
  std::string name;
  double thickness_um = 0;             ///< > 0; ignored for the last
  double hardness_Pa = 1e8;            ///< H of Archard's law, 1e5..1e11
  double wear_coefficient = 1e-4;      ///< K, with grit under the sole, 0..0.1; good to a factor of five
  double gloss_new = 0.5, gloss_worn = 0.1;  ///< 0..1; stone may gain
  double gloss_hits = 3000;            ///< steps on one spot after which 63 % of that change is done, 1..1e9
  glm::dvec3 colour{0.5}, colour_worn{0.5};  ///< linear sRGB, 0..1
  double dirt_hold = 0.3;              ///< how dark dirt makes it, 0..1
  bool operator==(const Layer&) const = default;
};

struct MaterialOptions {
  std::vector<Layer> layers;           ///< top first, at least one
  FloorPattern pattern;
  double piece_hardness_sd = 0.12;     ///< between boards or slabs, relative, 0..0.5
  double piece_brightness_sd = 0.12;   ///< relative, 0..0.5
  double finish_sd = 0.2;              ///< unevenness of the upper layers' thickness, relative, 0..0.5
  double joint_depth_m = 0.0015;       ///< 0..0.1
  double piece_level_sd_m = 0.0001;    ///< how unevenly the pieces lie, 0..0.02
};

/// Names: oak, varnished_oak, pine, varnished_pine, marble, limestone, granite, concrete, porcelain, pvc, linoleum.
/// @throws InvalidInput with the known names for any other.
MaterialOptions material_preset(const std::string& name);
std::vector<std::string> material_names();

/// Dirt comes in under the soles, is left behind, rubbed off by others and mopped up.
struct SoilOptions {
  double carried = 0.02;               ///< dirt that a clean spot gains from a step at the door, 0..1
  double fades_over_steps = 9;         ///< steps after which a sole has lost 63 % of its dirt, 0.1..1e4
  double rubbed = 0.006;               ///< share of the dirt that a step takes along, 0..1
  double mopped_per_day = 0.01;        ///< share of the dirt, 0..10
  bool operator==(const SoilOptions&) const = default;
};

/// A straight flight; walkers go up and down. Replaces the room: its plan is width_m across (x) and going_m times
/// treads along (y, upward); each tread is a floor of its own.
struct StairOptions {
  int treads = 12;                     ///< 2..200
  double going_m = 0.30;               ///< depth of a tread, 0.2..0.6
  double rise_m = 0.165;               ///< 0.05..0.3
  double width_m = 1.4;                ///< 0.6..20
  double up_share = 0.5;               ///< of the visits, 0..1
  double keep_right_m = 0.12;          ///< lane's distance from the middle, to the right of the walker, 0..width / 2
  double lane_sd_m = 0.14;             ///< spread of the lanes, 0..width / 2
  double speed_m_s = 0.5;              ///< along the plan, 0.1..2
  double nosing_m = 0.03;              ///< zone behind the front edge that carries more, 0..0.2
  double nosing_factor = 2.0;          ///< wear at the very edge over that further back, 1..10
  bool operator==(const StairOptions&) const = default;
};

struct FloorOptions {
  std::uint64_t seed = 1;
  RoomOptions room;
  std::optional<StairOptions> stairs;
  CrowdOptions crowd;
  GaitOptions gait;
  FootprintOptions footprints;
  MaterialOptions material = material_preset("varnished_oak");
  SoilOptions soil;
  std::vector<double> frames{0, 0.01, 0.1, 0.4, 1};  ///< key frames: share of the visits made, ascending, 0..1
};

/// Geometry too: crossing outlines, doors off the wall, places inside desks. (Goals that a desk cuts off are found when the
/// orientation fields are made: simulate, walk and retune throw InvalidInput then.)
/// @throws InvalidInput naming the field, its value, the range and the unit.
void validate(const FloorOptions& options);

}  // namespace witherfield::floor
