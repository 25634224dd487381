#include "sim/grass/options.hpp"

#include <cmath>
#include <sstream>

#include "sim/core/curve.hpp"
#include "sim/core/errors.hpp"
#include "sim/grass/season.hpp"

namespace witherfield::grass {
namespace {

[[noreturn]] void out_of_range(const std::string& name, double value, double lo, double hi, const char* unit) {
  std::ostringstream s;
  s << name << " = " << value << " is outside " << lo << ".." << hi;
  if (*unit) s << ' ' << unit;
  throw InvalidInput(s.str());
}

void require(const std::string& name, double value, double lo, double hi, const char* unit = "") {
  if (!(value >= lo && value <= hi)) out_of_range(name, value, lo, hi, unit);  // NaN fails too
}

void require(const std::string& name, Range r, double lo, double hi, const char* unit) {
  require(name + "[0]", r.lo, lo, hi, unit);
  require(name + "[1]", r.hi, lo, hi, unit);
  if (r.lo > r.hi)
    throw InvalidInput(name + ": the lower bound " + std::to_string(r.lo) + " is above the upper " + std::to_string(r.hi));
}

void validate(const BladeOptions& b, const std::string& at) {
  require(at + "count", b.count, 1, 100000, "blades");
  require(at + "length_m", b.length_m, 0.005, 2, "m");
  require(at + "width_m", b.width_m, 1e-4, 0.1, "m");
  require(at + "thickness_m", b.thickness_m, 2e-5, 0.005, "m");
  require(at + "lean_mean_deg", b.lean_mean_deg, 0, 60, "deg");
  require(at + "lean_sd_deg", b.lean_sd_deg, 0, 60, "deg");
  require(at + "curl_deg", b.curl_deg, -180, 180, "deg");
  require(at + "twist_sd_deg", b.twist_sd_deg, 0, 360, "deg");
  require(at + "fold_deg", b.fold_deg, 0, 80, "deg");
  require(at + "twin", b.twin, -1, 1023);
  for (const auto& [x, y] : b.tufts_at) {
    require(at + "tufts_at x", x, 0, 1, "of the tile");
    require(at + "tufts_at y", y, 0, 1, "of the tile");
  }
  require(at + "clumping", b.clumping, 0, 1);
  require(at + "tuft_radius_m", b.tuft_radius_m, 0, 0.2, "m");
  require(at + "blades_per_tuft", b.blades_per_tuft, 1, 1000, "blades");
  require(at + "segments", b.segments, 4, 128);
}

void validate(const SeasonOptions& s, const std::string& at) {
  require(at + "length_days", s.length_days, 1, 1000, "days");
  require(at + "steps_per_day", s.steps_per_day, 0.1, 1000, "1/day");
  require(at + "onset_mean", s.onset_mean, 0.1, 0.9);
  require(at + "onset_sd", s.onset_sd, 0, 0.3);
  require(at + "tip_advance", s.tip_advance, 0, 0.3);
  SeasonCurves checked(s);
}

void validate(const TissueOptions& t) {
  const std::string at = "model.";
  require(at + "vein_fraction", t.vein_fraction, 0.02, 0.9);
  for (const auto& [name, value] : {std::pair{"modulus_vein_fresh_MPa", t.modulus_vein_fresh_MPa},
                                    {"modulus_vein_dry_MPa", t.modulus_vein_dry_MPa},
                                    {"modulus_mesophyll_fresh_MPa", t.modulus_mesophyll_fresh_MPa},
                                    {"modulus_mesophyll_dry_MPa", t.modulus_mesophyll_dry_MPa},
                                    {"bending_fresh_MPa", t.bending_fresh_MPa},
                                    {"bending_limp_MPa", t.bending_limp_MPa},
                                    {"bending_dry_MPa", t.bending_dry_MPa}})
    require(at + name, value, 0.01, 1e5, "MPa");
  if (t.modulus_vein_dry_MPa <= t.modulus_vein_fresh_MPa || t.modulus_mesophyll_dry_MPa <= t.modulus_mesophyll_fresh_MPa)
    throw InvalidInput("model: the moduli must grow as the blade dries (modulus_*_dry_MPa > modulus_*_fresh_MPa)");
  require(at + "base_to_tip_stiffness", t.base_to_tip_stiffness, 1, 100);
  require(at + "osmotic_potential_MPa", t.osmotic_potential_MPa, -5, -0.1, "MPa");
  require(at + "wall_elasticity_MPa", t.wall_elasticity_MPa, 1, 50, "MPa");
  require(at + "density_kg_m3", t.density_kg_m3, 100, 1500, "kg/m3");
  require(at + "dry_mass_fraction", t.dry_mass_fraction, 0.05, 0.9);
  require(at + "volume_strain_vein", t.volume_strain_vein, -0.9, 0);
  require(at + "volume_strain_mesophyll", t.volume_strain_mesophyll, -0.9, 0);
  if (t.volume_strain_vein < t.volume_strain_mesophyll)
    throw InvalidInput("model: the vein must shrink less than the mesophyll (volume_strain_vein > volume_strain_mesophyll)");
  require(at + "shrink_thickness", t.shrink_thickness, -0.9, 0);
  require(at + "shrink_width", t.shrink_width, -0.9, 0);
  require(at + "shrink_length", t.shrink_length, -0.5, 0);
  require(at + "creep_days", t.creep_days, 0.1, 1000, "days");
  require(at + "response_days", t.response_days, 0.02, 100, "days");
  require(at + "droop_rate_per_day", t.droop_rate_per_day, 0, 10, "rad/day");
}

void validate_frames(const std::vector<double>& frames, const std::string& name, bool may_be_empty) {
  if (frames.empty() && !may_be_empty) throw InvalidInput(name + ": at least one key frame is needed");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    require(name + "[" + std::to_string(i) + "]", frames[i], 0, 1);
    if (i > 0 && frames[i] <= frames[i - 1]) throw InvalidInput(name + ": key frames must ascend");
  }
}

}  // namespace

BladeOptions species_preset(const std::string& name) {
  // Typical turf dimensions (estimates): blade width and thickness, posture by growth habit.
  BladeOptions b;
  if (name == "perennial_ryegrass") return b;
  if (name == "kentucky_bluegrass") {
    b.length_m = {0.05, 0.12}; b.width_m = {0.002, 0.004}; b.thickness_m = {0.00015, 0.00025};
    b.fold_deg = {20, 45};  // boat-shaped blades
    return b;
  }
  if (name == "tall_fescue") {
    b.length_m = {0.09, 0.20}; b.width_m = {0.004, 0.008}; b.thickness_m = {0.00025, 0.00035};
    b.fold_deg = {5, 20}; b.blades_per_tuft = 20;
    return b;
  }
  if (name == "fine_fescue") {
    b.length_m = {0.06, 0.16}; b.width_m = {0.0005, 0.0015}; b.thickness_m = {0.0003, 0.0005};
    b.fold_deg = {55, 78};  // rolled
    b.blades_per_tuft = 30; b.clumping = 0.8;
    return b;
  }
  if (name == "creeping_bentgrass") {
    b.length_m = {0.03, 0.08}; b.width_m = {0.0007, 0.002}; b.thickness_m = {0.0001, 0.0002};
    b.lean_sd_deg = 22; b.clumping = 0.2;
    return b;
  }
  if (name == "zoysia") {
    b.length_m = {0.04, 0.10}; b.width_m = {0.002, 0.004}; b.thickness_m = {0.0002, 0.0003};
    b.lean_sd_deg = 9; b.curl_deg = {0, 25}; b.clumping = 0.3;
    return b;
  }
  std::string known;
  for (const std::string& n : species_names()) known += (known.empty() ? "" : ", ") + n;
  throw InvalidInput("unknown species '" + name + "'; known: " + known);
}

std::vector<std::string> species_names() {
  return {"kentucky_bluegrass", "perennial_ryegrass", "tall_fescue", "fine_fescue", "creeping_bentgrass", "zoysia"};
}

void validate(const GrassOptions& o) {
  require("texel.size_m", o.texel.size_m, 0.01, 10, "m");
  require("texel.resolution", o.texel.resolution, 32, 512, "voxels");
  if (o.texel.resolution % 32 != 0)
    throw InvalidInput("texel.resolution = " + std::to_string(o.texel.resolution) + " is not a multiple of 32 voxels");
  require("texel.margin_sixteenths", o.texel.margin_sixteenths, 0, 6, "sixteenths");
  require("texel.variants", o.variants, 1, 16);
  require("texel.variant_spread", o.variant_spread, 0, 2);
  validate(o.season, "season.");
  validate(o.tissue);
  require("model.chlorophyll_fresh_ug_cm2", o.colour.chlorophyll_fresh_ug_cm2, 1, 120, "ug/cm2");
  require("model.brightness_sd", o.colour.brightness_sd, 0, 0.5);
  require("model.specular", o.colour.specular, 0, 1);
  if (!(o.points.proportion > 0) || !std::isfinite(o.points.proportion))
    throw InvalidInput("model.proportion = " + std::to_string(o.points.proportion) + " must be > 0 points per unit of density");
  require("model.proportion", o.points.proportion, 1e-6, 1000);
  require("model.kernel_sigma_voxels", o.points.kernel_sigma_voxels, 0.3, 4, "voxels");
  require("model.merge_distance_voxels", o.points.merge_distance_voxels, 0, 2, "voxels");
  if (o.samples.empty()) throw InvalidInput("GrassOptions: at least one sample of blades is needed");
  for (std::size_t i = 0; i < o.samples.size(); ++i) {
    const SampleOptions& s = o.samples[i];
    const std::string at = o.samples.size() == 1 ? "" : "mingle[" + std::to_string(i) + "].";
    validate(s.blades, at + "blades.");
    validate(s.season, at + "season.");
    if (s.season.length_days != o.season.length_days || s.season.steps_per_day != o.season.steps_per_day)
      throw InvalidInput(at + "season: length_days and steps_per_day are the scene's, not a sample's");
    if (!s.ageing.empty()) {
      const Curve mg(s.ageing, (at + "ageing").c_str());
      if (!mg.non_decreasing()) throw InvalidInput(at + "ageing: Mg must not fall in time");
      for (const auto& [x, y] : mg.keys()) {
        require(at + "ageing wd", x, 0, 1);
        require(at + "ageing value", y, 0, 1);
      }
    }
  }
  validate_frames(o.wd_frames, "season.wd_frames", false);
  validate_frames(o.wd_frames_other_variants, "season.wd_frames_other_variants", true);
}

}  // namespace witherfield::grass
