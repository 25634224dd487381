#include "sim/fruit/options.hpp"

#include <algorithm>
#include <sstream>

#include "sim/core/curve.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::fruit {
namespace {

using Keys = std::vector<std::pair<double, double>>;

void require(const std::string& name, double value, double lo, double hi, const char* unit = "") {
  if (value >= lo && value <= hi) return;  // NaN fails too
  std::ostringstream s;
  s << name << " = " << value << " is outside " << lo << ".." << hi;
  if (*unit) s << ' ' << unit;
  throw InvalidInput(s.str());
}

void require(const std::string& name, const Srgb& c) {
  for (const double level : {c.r, c.g, c.b}) require(name, level, 0, 255, "sRGB levels");
}

void require_even(const std::string& name, int value) {
  if (value % 2 != 0)
    throw InvalidInput(name + " = " + std::to_string(value) + " must be even: rows stand in pairs");
}

void validate(const WheatOptions& w) {
  const std::string at = "wheat.";
  require(at + "spikelets", w.spikelets, 2, 60);
  require(at + "kernels_per_spikelet", w.kernels_per_spikelet, 1, 5);
  require(at + "ear_length_mm", w.ear_length_mm, 20, 300, "mm");
  require(at + "ear_length_mm / spikelets", w.ear_length_mm / w.spikelets, 0.3, 40, "mm between spikelets");
  require(at + "stem_length_mm", w.stem_length_mm, 1, 300, "mm");
  require(at + "stem_radius_mm", w.stem_radius_mm, 0.2, 5, "mm");
  require(at + "kernel_length_mm", w.kernel_length_mm, 2, 15, "mm");
  require(at + "kernel_width_mm", w.kernel_width_mm, 1, 8, "mm");
  require(at + "kernel_thickness_mm", w.kernel_thickness_mm, 1, 8, "mm");
  require(at + "gape_deg", w.gape_deg, 0, 30, "deg");
  require(at + "awn_length_mm", w.awn_length_mm, 1, 200, "mm");
  require(at + "awn_root_radius_mm", w.awn_root_radius_mm, 0.02, 2, "mm");
  require(at + "awn_tip_radius_mm", w.awn_tip_radius_mm, 0.002, 2, "mm");
  if (w.awn_tip_radius_mm > w.awn_root_radius_mm)
    throw InvalidInput("wheat.awn_tip_radius_mm = " + std::to_string(w.awn_tip_radius_mm) +
                       " mm is above wheat.awn_root_radius_mm: awns taper towards the tip");
  if (w.awn_length_mm < 5 * w.awn_root_radius_mm)
    throw InvalidInput("wheat.awn_length_mm = " + std::to_string(w.awn_length_mm) +
                       " mm is less than 5 wheat.awn_root_radius_mm: no awn any more");
  require(at + "awn_start", w.awn_start, 0.05, 1);
  require(at + "nod_deg", w.nod_deg, 0, 60, "deg");
  require(at + "variation", w.variation, 0, 2);
}

void validate(const MaizeOptions& m) {
  const std::string at = "maize.";
  require(at + "rows", m.rows, 4, 40);
  require_even(at + "rows", m.rows);
  require(at + "kernels_per_row", m.kernels_per_row, 4, 80);
  require(at + "ear_length_mm", m.ear_length_mm, 40, 400, "mm");
  require(at + "cob_diameter_mm", m.cob_diameter_mm, 8, 80, "mm");
  if (m.cob_diameter_mm > 0.6 * m.ear_length_mm)
    throw InvalidInput("maize.cob_diameter_mm = " + std::to_string(m.cob_diameter_mm) +
                       " mm is more than 0.6 of maize.ear_length_mm");
  require(at + "kernel_length_mm", m.kernel_length_mm, 3, 25, "mm");
  require(at + "ratio_upper", m.ratio_upper, 1, 3);
  require(at + "ratio_middle", m.ratio_middle, 1, 3);
  require(at + "ratio_lower", m.ratio_lower, 1, 3);
  require(at + "variation", m.variation, 0, 2);
}

void validate_profile(const Keys& profile) {
  const std::string at = "planted.body_profile_mm";
  if (profile.size() < 2)
    throw InvalidInput(at + " has " + std::to_string(profile.size()) + " points, needs at least 2");
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::string point = at + "[" + std::to_string(i) + "]";
    require(point + " height", profile[i].first, -1000, 1000, "mm");
    require(point + " radius", profile[i].second, 0.05, 1000, "mm");
    if (i > 0 && profile[i].first <= profile[i - 1].first)
      throw InvalidInput(point + ": heights must ascend, " + std::to_string(profile[i].first) +
                         " mm is not above " + std::to_string(profile[i - 1].first) + " mm");
  }
}

void validate(const PlantedOptions& p, bool has_mesh) {
  const std::string at = "planted.";
  if (!has_mesh) validate_profile(p.body_profile_mm);
  if (has_mesh != (p.arrangement == Arrangement::cells))
    throw InvalidInput(has_mesh ? "planted.arrangement must be \"cells\" when a control mesh is the body"
                                : "planted.arrangement = \"cells\" needs a control mesh as the body");
  require(at + "grains", p.grains, 1, 20000);
  require(at + "grain_length_mm", p.grain_length_mm, 0.1, 100, "mm");
  require(at + "grain_width_mm", p.grain_width_mm, 0.1, 100, "mm");
  require(at + "grain_thickness_mm", p.grain_thickness_mm, 0.1, 100, "mm");
  require(at + "sink", p.sink, 0, 0.95);
  require(at + "lean_deg", p.lean_deg, -80, 80, "deg");
  require(at + "shrink_dry", p.shrink_dry, 0, 0.5);
  require(at + "style_length_mm", p.style_length_mm, 0, 50, "mm");
  require(at + "unripe", p.unripe);
  require(at + "turning", p.turning);
  require(at + "ripe", p.ripe);
  require(at + "body", p.body);
  require(at + "turning_wd", p.turning_wd, 0.05, 0.95);
  require(at + "variation", p.variation, 0, 2);
}

void validate_curve(const Keys& keys, const char* name, double y_hi, bool falling) {
  if (keys.empty()) return;
  const Curve curve(keys, name);
  for (const auto& [x, y] : keys) require(name, y, 0, y_hi);
  if (falling ? !curve.non_increasing() : !curve.non_decreasing())
    throw InvalidInput(std::string(name) + " must " + (falling ? "fall" : "rise") +
                       " or stay level from key to key");
}

void validate(const RipeningOptions& r) {
  require("ripening.length_days", r.length_days, 1, 365, "days");
  require("ripening.start_day", r.start_day, 0, 200, "days");
  require("ripening.spread", r.spread, 0, 0.3);
  validate_curve(r.moisture_curve, "ripening.moisture_curve", 0.95, true);
  validate_curve(r.pigment_curve, "ripening.pigment_curve", 1, false);
}

}  // namespace

std::vector<std::string> crop_names() {
  return {"wheat", "maize", "planted", "mesh"};
}

FruitOptions crop_preset(const std::string& crop) {
  FruitOptions o;
  o.crop = crop;
  if (crop == "wheat") return o;  // milk stage 18 days after flowering to dry 54 days after it
  if (crop == "maize") {
    o.ripening.start_day = 19;  // milk stage R3
    o.ripening.length_days = 78;
    return o;
  }
  if (crop == "planted" || crop == "mesh") {
    o.ripening.start_day = 15;
    o.ripening.length_days = 20;
    o.ripening.spread = 0.05;
    return o;
  }
  std::string known;
  for (const std::string& n : crop_names()) known += (known.empty() ? "" : ", ") + n;
  throw InvalidInput("unknown crop '" + crop + "'; known: " + known);
}

void validate(const FruitOptions& o) {
  crop_preset(o.crop);
  require("steps", o.steps, 0, 4, "steps of subdivision");
  const bool has_mesh = !o.mesh.triangles.empty();
  if (o.crop == "wheat") validate(o.wheat);
  if (o.crop == "maize") validate(o.maize);
  if (o.crop == "planted" || o.crop == "mesh") {
    PlantedOptions p = o.planted;
    if (o.crop == "mesh") p.arrangement = has_mesh ? Arrangement::cells : Arrangement::spiral;
    validate(p, has_mesh);
  }
  if (o.crop == "mesh" && !has_mesh)
    throw InvalidInput("crop = \"mesh\" needs a control mesh with at least one triangle");
  if (!o.mesh_uv.empty() && o.mesh_uv.size() != o.mesh.position_m.size())
    throw InvalidInput("mesh_uv has " + std::to_string(o.mesh_uv.size()) + " values for " +
                       std::to_string(o.mesh.position_m.size()) + " vertices of the control mesh");
  require("mesh_crease_angle_deg", o.mesh_crease_angle_deg, 0, 180, "deg");
  validate(o.ripening);
  if (o.frames.empty()) throw InvalidInput("frames: at least one key frame is needed");
  for (std::size_t i = 0; i < o.frames.size(); ++i) {
    require("frames[" + std::to_string(i) + "]", o.frames[i], 0, 1);
    if (i > 0 && o.frames[i] <= o.frames[i - 1]) throw InvalidInput("frames: key frames must ascend");
  }
}

}  // namespace witherfield::fruit
