// Blades: what is drawn at random about each, and the centre lines of all of them at a moment.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/core/blade_ribbons.hpp"
#include "sim/grass/options.hpp"

namespace witherfield::grass {

/// One blade as drawn: everything that does not change with time. Angles in radians, lengths in metres.
struct Blade {
  glm::dvec3 root_m{0.0};     ///< on the ground, z = 0, within the tile
  double length_m = 0, width_m = 0, thickness_m = 0;
  double azimuth_rad = 0;     ///< direction it leans to, counter-clockwise from +x
  double lean_rad = 0;        ///< inclination at the foot from the vertical
  double curl_rad = 0;        ///< further inclination gained toward the tip: lean + curl * (s/L)^1.6
  double sway_rad = 0;        ///< turn of the azimuth from root to tip (the blade leaves its plane a little)
  double twist_rad = 0;       ///< turn of the side vector about the tangent, root to tip
  double fold_rad = 0;        ///< half-angle of the V fold
  double onset = 0.5;         ///< wd' at which this blade has lost half its chlorophyll
  double brightness = 1;      ///< factor on its reflectance
};

/// Blades of one sample: deterministic in (options, tile size, season's onset, colour, seed, sample number).
std::vector<Blade> make_blades(const BladeOptions& options, double tile_m, const SeasonOptions& season,
                               double brightness_sd, std::uint64_t seed, std::uint64_t sample);

/// Relative half-width of a blade at arc s in [0, 1] (1 at the widest place, 0 at the tip). Ribbon: narrow foot, slight
/// bulge, pointed tip. Cone: 1 - s.
double width_profile(BladeForm form, double s);

/// All blades of one sample at one moment. Node k of blade b is at index b * (segments + 1) + k.
struct BladeState {
  BladeForm form = BladeForm::ribbon;
  int segments = 0;
  double wd = 0;                          ///< the sample's own weathering degree
  double time_days = 0;
  double chlorophyll_fresh_ug_cm2 = 43.9;  ///< content that `chlorophyll` is a fraction of
  std::vector<glm::dvec3> node_m;         ///< centre line
  std::vector<glm::dvec3> velocity_m_day;
  std::vector<glm::dvec3> tangent, side;  ///< unit, orthogonal; normal = side x tangent... see blade_normal
  std::vector<float> half_width_m, thickness_m, fold_rad;
  std::vector<float> water;               ///< relative water content 0..1
  std::vector<float> chlorophyll;         ///< fraction of the fresh content 0..1
  std::vector<float> stress_vein_MPa, stress_mesophyll_MPa;   ///< > 0 tension
  std::vector<float> strain_vein, strain_mesophyll;           ///< volumetric, <= 0
  std::vector<glm::vec3> diffuse;         ///< linear sRGB
  std::vector<float> specular;
  int nodes_per_blade() const { return segments + 1; }
  int blade_count() const { return segments ? int(node_m.size()) / (segments + 1) : 0; }
};

/// Face normal of the blade: tangent x side... unit; with side to the right and the tangent up it points to the viewer.
inline glm::dvec3 blade_normal(const glm::dvec3& tangent, const glm::dvec3& side) { return glm::dvec3(side.y * tangent.z - side.z * tangent.y, side.z * tangent.x - side.x * tangent.z, side.x * tangent.y - side.y * tangent.x); }

/// Render geometry of the given states, one after another (blade ids follow on).
BladeRibbons to_ribbons(const std::vector<const BladeState*>& states);

}  // namespace witherfield::grass
