#include "sim/leaf/wilt_options.hpp"

#include <cmath>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/leaf/wilt_body.hpp"

namespace witherfield::leaf {
namespace {

struct Bound {
  const char* name;
  double value, lo, hi;
  const char* unit;
};

std::string text(double v) {
  std::string s = std::to_string(v);
  if (v != 0 && std::abs(v) < 1e-3) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", v);
    s = buffer;
  }
  return s;
}

template <std::size_t N>
void require(const Bound (&bounds)[N]) {
  for (const Bound& b : bounds)
    if (!(b.value >= b.lo && b.value <= b.hi))
      throw InvalidInput(std::string("wilt.") + b.name + " = " + text(b.value) + " is not in " + text(b.lo) + ".." + text(b.hi) +
                         (*b.unit ? std::string(" ") + b.unit : ""));
}

void validate_water(const WiltWaterOptions& w, double length_hours) {
  require({{"blade_water_kg_m2", w.blade_water_kg_m2, 0.01, 5, "kg/m2"},
           {"petiole_water_kg_m3", w.petiole_water_kg_m3, 50, 1000, "kg/m3"},
           {"transpiration_kg_m2_s", w.transpiration_kg_m2_s, 0, 1e-3, "kg/(m2 s)"},
           {"cuticular_share", w.cuticular_share, 0, 1, ""},
           {"margin_gain", w.margin_gain, 0, 5, ""},
           {"margin_width_m", w.margin_width_m, 1e-4, 1, "m"},
           {"diffusivity_blade_m2_s", w.diffusivity_blade_m2_s, 1e-12, 1e-3, "m2/s"},
           {"vein_conductivity_kg_m_s", w.vein_conductivity_kg_m_s, 0, 1e3, "kg/(m s)"},
           {"conductance_loss", w.conductance_loss, 0, 0.999, ""},
           {"petiole_conductance_kg_s", w.petiole_conductance_kg_s, 1e-12, 1, "kg/s"},
           {"steps_per_hour", w.steps_per_hour, 0.01, 1e5, "1/h"}});
  for (std::size_t i = 0; i < w.supply_curve.size(); ++i) {
    const auto& [hour, open] = w.supply_curve[i];
    const std::string at = "wilt.supply_curve[" + std::to_string(i) + "]";
    if (!(hour >= 0) || !(hour <= 1e6)) throw InvalidInput(at + ": hour = " + text(hour) + " is not in 0..1000000 h");
    if (!(open >= 0 && open <= 1)) throw InvalidInput(at + ": openness = " + text(open) + " is not in 0..1");
    if (i > 0 && hour <= w.supply_curve[i - 1].first) throw InvalidInput(at + ": hours must ascend");
  }
  if (w.supply_curve.size() == 1) throw InvalidInput("wilt.supply_curve: give at least two (hour, openness) pairs, or none");
  if (w.steps_per_hour * length_hours > 1e7)
    throw InvalidInput("wilt.steps_per_hour: more than 10000000 steps in length_hours = " + text(length_hours) + " h");
}

void validate_tissue(const WiltTissueOptions& t) {
  require({{"osmotic_potential_MPa", t.osmotic_potential_MPa, -5, -0.1, "MPa"},
           {"wall_elasticity_MPa", t.wall_elasticity_MPa, 0.2, 50, "MPa"},
           {"turgor_exponent", t.turgor_exponent, 0.1, 3, ""},
           {"blade_bending_turgid_MPa", t.blade_bending_turgid_MPa, 1e-3, 1e5, "MPa"},
           {"blade_bending_limp_MPa", t.blade_bending_limp_MPa, 1e-4, 1e5, "MPa"},
           {"blade_membrane_turgid_MPa", t.blade_membrane_turgid_MPa, 1e-2, 1e5, "MPa"},
           {"blade_membrane_limp_MPa", t.blade_membrane_limp_MPa, 1e-2, 1e5, "MPa"},
           {"compression_share", t.compression_share, 1e-3, 1, ""},
           {"vein_turgid_MPa", t.vein_turgid_MPa, 1e-2, 1e5, "MPa"},
           {"vein_limp_MPa", t.vein_limp_MPa, 1e-2, 1e5, "MPa"},
           {"petiole_turgid_MPa", t.petiole_turgid_MPa, 1e-2, 1e5, "MPa"},
           {"petiole_limp_MPa", t.petiole_limp_MPa, 1e-2, 1e5, "MPa"},
           {"softening_exponent", t.softening_exponent, 0, 4, ""},
           {"poisson", t.poisson, 0, 0.49, ""},
           {"thickness_m", t.thickness_m, 2e-5, 0.005, "m"},
           {"dry_mass_kg_m2", t.dry_mass_kg_m2, 0, 2, "kg/m2"},
           {"shrink_thickness", t.shrink_thickness, -0.95, 0, ""},
           {"shrink_blade", t.shrink_blade, -0.5, 0, ""},
           {"shrink_vein", t.shrink_vein, -0.5, 0, ""},
           {"curl_1_m", t.curl_1_m, -500, 500, "1/m"},
           {"chlorophyll_fresh_ug_cm2", t.chlorophyll_fresh_ug_cm2, 1, 120, "ug/cm2"},
           {"chlorophyll_loss_hours", t.chlorophyll_loss_hours, 0.1, 1e5, "h"}});
  if (t.shrink_vein < t.shrink_blade)
    throw InvalidInput("wilt: veins must shrink less than the blade (shrink_vein >= shrink_blade)");
  if (t.blade_bending_limp_MPa > t.blade_bending_turgid_MPa || t.blade_membrane_limp_MPa > t.blade_membrane_turgid_MPa || t.vein_limp_MPa > t.vein_turgid_MPa ||
      t.petiole_limp_MPa > t.petiole_turgid_MPa)
    throw InvalidInput("wilt: a limp modulus must not be above the turgid one (blade_bending, blade_membrane, vein, petiole)");
}

}  // namespace

void validate(const WiltOptions& o) {
  require({{"length_hours", o.length_hours, 0.01, 1e4, "h"}, {"frames", double(o.frames), 2, 10000, ""}});
  for (std::size_t i = 0; i < o.frame_hours.size(); ++i) {
    const std::string at = "wilt.frame_hours[" + std::to_string(i) + "]";
    if (!(o.frame_hours[i] >= 0 && o.frame_hours[i] <= o.length_hours))
      throw InvalidInput(at + " = " + text(o.frame_hours[i]) + " is not in 0.." + text(o.length_hours) + " h");
    if (i > 0 && o.frame_hours[i] <= o.frame_hours[i - 1]) throw InvalidInput(at + ": key frames must ascend");
  }
  validate_water(o.water, o.length_hours);
  validate_tissue(o.tissue);
  const WiltSolverOptions& s = o.solver;
  require({{"gravity_m_s2", s.gravity_m_s2, 0, 100, "m/s2"},
           {"max_iterations", double(s.max_iterations), 1, 10000, ""},
           {"tolerance", s.tolerance, 1e-20, 0.1, ""},
           {"contact_gap", s.contact_gap, 0, 3, ""},
           {"moments_per_frame", double(s.moments_per_frame), 1, 100, ""}});
}

std::vector<double> frame_times_hours(const WiltOptions& o) {
  if (!o.frame_hours.empty()) return o.frame_hours;
  std::vector<double> hours(std::size_t(o.frames));
  for (int i = 0; i < o.frames; ++i) hours[std::size_t(i)] = o.length_hours * i / (o.frames - 1);
  return hours;
}

void validate(const WiltBody& b) {
  b.rest.validate();
  const std::size_t n = b.rest.position_m.size();
  if (b.rest.triangles.empty()) throw InvalidInput("WiltBody: the blade has no triangle");
  if (!b.vein.empty() && b.vein.size() != n)
    throw InvalidInput("WiltBody: vein has " + std::to_string(b.vein.size()) + " values for " + std::to_string(n) + " vertices");
  if (!b.vein_frame_m.empty() && b.vein_frame_m.size() != n)
    throw InvalidInput("WiltBody: vein_frame_m has " + std::to_string(b.vein_frame_m.size()) + " positions for " +
                       std::to_string(n) + " vertices");
  for (const int v : b.clamp)
    if (v < 0 || v >= int(n)) throw InvalidInput("WiltBody: clamp names vertex " + std::to_string(v) + " of " + std::to_string(n));
  for (const int v : b.inlet)
    if (v < 0 || v >= int(n)) throw InvalidInput("WiltBody: inlet names vertex " + std::to_string(v) + " of " + std::to_string(n));
  if (b.clamp.size() < 3)
    throw InvalidInput("WiltBody: at least 3 vertices of the blade must be held (clamp), not " + std::to_string(b.clamp.size()));
  for (std::size_t i = 0; i < b.veins.size(); ++i) {
    const VeinCurve& v = b.veins[i];
    const std::string at = "WiltBody: vein " + std::to_string(i);
    if (v.points_m.size() < 2) throw InvalidInput(at + " has fewer than 2 points");
    if (!(v.radius_base_m >= 0 && v.radius_base_m < 0.1 && v.radius_tip_m >= 0 && v.radius_tip_m < 0.1))
      throw InvalidInput(at + ": radii must be in 0..0.1 m");
    for (const glm::dvec3& p : v.points_m)
      if (!std::isfinite(p.x + p.y + p.z)) throw InvalidInput(at + " has a point that is not finite");
  }
  if (b.petiole_m.empty()) return;
  if (b.petiole_m.size() < 2) throw InvalidInput("WiltBody: the petiole needs at least 2 points");
  if (!(b.petiole_radius_stem_m >= 1e-5 && b.petiole_radius_stem_m < 0.1 && b.petiole_radius_blade_m >= 1e-5 &&
        b.petiole_radius_blade_m < 0.1))
    throw InvalidInput("WiltBody: the petiole's radii must be in 0.00001..0.1 m");
  for (std::size_t i = 0; i < b.petiole_m.size(); ++i) {
    const glm::dvec3& p = b.petiole_m[i];
    if (!std::isfinite(p.x + p.y + p.z)) throw InvalidInput("WiltBody: the petiole has a point that is not finite");
    if (i > 0 && p == b.petiole_m[i - 1]) throw InvalidInput("WiltBody: two points of the petiole coincide");
  }
}

}  // namespace witherfield::leaf
