// Keys of the simulation: [season], [texel], [model], [blades], [[mingle]].
#include "sim/scene/scene_keys.hpp"

namespace witherfield::scene {
namespace {

using namespace grass;

constexpr Named<Climate> kClimates[] = {
    {"standard", Climate::standard}, {"water_rich", Climate::water_rich}, {"cold", Climate::cold}};
constexpr Named<BladeForm> kForms[] = {{"ribbon", BladeForm::ribbon}, {"cone", BladeForm::cone}};
constexpr Named<Motion> kMotions[] = {{"rod", Motion::rod}, {"paper", Motion::paper}};
constexpr Named<PigmentModel> kPigmentModels[] = {{"kubelka_munk", PigmentModel::kubelka_munk},
                                                  {"paper", PigmentModel::paper}};

void range(KeyVisitor& v, const Key& key, Range& r, const Limits& limits) {
  double pair[2] = {r.lo, r.hi};
  v.numbers(key, pair, limits, Order::not_falling);
  r = {pair[0], pair[1]};
}

/// What a sample may have of its own: the course of withering, but not the length of the season.
void describe_course(KeyVisitor& v, SeasonOptions& s) {
  choice(
      v,
      {"climate",
       "Course of the water content: normal, well watered, which dries later, or cold, which dries earlier"},
      s.climate, kClimates);
  if (v.given("climate")) s.water_curve.clear();  // a stated climate replaces an inherited curve
  v.curve(
      {"water_curve", "Own course of the relative water content, [[wd, water], ...]; empty = the climate's"},
      s.water_curve, {0, 1}, Shape::falling);
  v.curve({"chlorophyll_curve",
           "Own course of the chlorophyll, [[wd, share of the fresh content], ...]; empty = default"},
          s.chlorophyll_curve, {0, 1}, Shape::falling);
  v.number({"onset_mean", "wd at which the median blade has lost half its chlorophyll"}, s.onset_mean,
           {0.1, 0.9});
  v.number({"onset_sd", "Spread of onset_mean between blades, a standard deviation"}, s.onset_sd, {0, 0.3});
  v.number({"tip_advance", "wd by which a blade's tip is ahead of its root"}, s.tip_advance, {0, 0.3});
}

void describe_tissue(KeyVisitor& v, TissueOptions& t) {
  v.number({"vein_fraction", "Share of the half-width around the midrib that is vein"}, t.vein_fraction,
           {0.02, 0.9});
  const Limits modulus{0.01, 1e5, "MPa"};
  v.number({"modulus_vein_fresh_MPa", "Young's modulus of the vein, fresh"}, t.modulus_vein_fresh_MPa,
           modulus);
  v.number({"modulus_vein_dry_MPa", "Young's modulus of the vein, dry: larger than fresh"},
           t.modulus_vein_dry_MPa, modulus);
  v.number({"modulus_mesophyll_fresh_MPa", "Young's modulus of the mesophyll, fresh"},
           t.modulus_mesophyll_fresh_MPa, modulus);
  v.number({"modulus_mesophyll_dry_MPa", "Young's modulus of the mesophyll, dry: larger than fresh"},
           t.modulus_mesophyll_dry_MPa, modulus);
  v.number({"bending_fresh_MPa", "Bending modulus of the whole blade, turgid"}, t.bending_fresh_MPa, modulus);
  v.number({"bending_limp_MPa", "Bending modulus without turgor"}, t.bending_limp_MPa, modulus);
  v.number({"bending_dry_MPa", "Bending modulus dried out"}, t.bending_dry_MPa, modulus);
  v.number({"base_to_tip_stiffness", "Bending modulus at a blade's foot over that at its tip"},
           t.base_to_tip_stiffness, {1, 100});
  v.check("modulus_vein_dry_MPa", t.modulus_vein_dry_MPa > t.modulus_vein_fresh_MPa,
          [] { return "tissue stiffens as it dries: must be greater than modulus_vein_fresh_MPa"; });
  v.check("modulus_mesophyll_dry_MPa", t.modulus_mesophyll_dry_MPa > t.modulus_mesophyll_fresh_MPa,
          [] { return "tissue stiffens as it dries: must be greater than modulus_mesophyll_fresh_MPa"; });
  v.number({"osmotic_potential_MPa", "Osmotic potential at full turgor"}, t.osmotic_potential_MPa,
           {-5, -0.1, "MPa"});
  v.number({"wall_elasticity_MPa", "Volumetric elasticity of the cell walls"}, t.wall_elasticity_MPa,
           {1, 50, "MPa"});
  v.number({"density_kg_m3", "Density of fresh tissue, air spaces included"}, t.density_kg_m3,
           {100, 1500, "kg/m3"});
  v.number({"dry_mass_fraction", "Dry mass over fresh mass"}, t.dry_mass_fraction, {0.05, 0.9});
  v.number({"volume_strain_vein", "Change of the vein's volume when all water is gone"}, t.volume_strain_vein,
           {-0.9, 0});
  v.number({"volume_strain_mesophyll",
            "Change of the mesophyll's volume when all water is gone: more than the vein's"},
           t.volume_strain_mesophyll, {-0.9, 0});
  v.check("volume_strain_vein", t.volume_strain_vein >= t.volume_strain_mesophyll,
          [] { return "the vein must not shrink more than the mesophyll (volume_strain_mesophyll)"; });
  v.number({"shrink_thickness", "Change of the blade's thickness, fresh to dry"}, t.shrink_thickness,
           {-0.9, 0});
  v.number({"shrink_width", "Change of the blade's width, fresh to dry"}, t.shrink_width, {-0.9, 0});
  v.number({"shrink_length", "Change of the blade's length, fresh to dry"}, t.shrink_length, {-0.5, 0});
  v.number({"creep_days", "Time in which a limp blade takes on its bent shape"}, t.creep_days,
           {0.1, 1000, "days"});
  v.number({"response_days", "Kelvin-Voigt time of bending"}, t.response_days, {0.02, 100, "days"});
  v.number({"droop_rate_per_day", "Turning rate of a limp blade's tip, for motion = \"paper\""},
           t.droop_rate_per_day, {0, 10, "rad/day"});
}

}  // namespace

void describe_season(KeyVisitor& v, GrassOptions& o) {
  SeasonOptions& s = o.season;
  v.number({"length_days", "Length of the season; weathering degree wd = time / length"}, s.length_days,
           {1, 1000, "days"});
  v.number({"steps_per_day", "Integration steps"}, s.steps_per_day, {0.1, 1000, "1/day"});
  v.list({"wd_frames", "Key frames that are written, as weathering degrees, ascending"}, o.wd_frames, {0, 1},
         Order::ascending);
  v.check("wd_frames", !o.wd_frames.empty(), [] { return "at least one key frame is needed"; });
  v.list({"wd_frames_other_variants", "Key frames of the texel variants after the first; empty = wd_frames"},
         o.wd_frames_other_variants, {0, 1}, Order::ascending);
  describe_course(v, s);
}

void describe_texel(KeyVisitor& v, GrassOptions& o) {
  v.number({"size_m", "Edge of the square tile of ground that a texel covers"}, o.texel.size_m,
           {0.01, 10, "m"});
  v.whole({"resolution", "Voxels along x, y and z; a multiple of 32"}, o.texel.resolution,
          {32, 512, "voxels"});
  v.check("resolution", o.texel.resolution % 32 == 0, [] { return "must be a multiple of 32 voxels"; });
  v.whole({"margin_sixteenths", "Part of the grid on each side outside the tile, into which blades may lean"},
          o.texel.margin_sixteenths, {0, 6, "sixteenths of the resolution"});
  v.whole({"variants", "Different texels of the same make, so that a terrain does not repeat"}, o.variants,
          {1, 16});
  v.number(
      {"variant_spread", "How differently the variants age: variant v ages by wd^(2^(spread x)), x in -1..1"},
      o.variant_spread, {0, 2});
}

void describe_model(KeyVisitor& v, SceneTables& s) {
  GrassOptions& o = s.grass;
  v.preset(
      {"name", "\"paper\" = the model of Jiao et al. 2010 as printed: motion, pigment_model and cone blades"},
      {"witherfield", "paper"}, "witherfield", [&](const std::string& name) {
        const bool paper = name == "paper";
        o.tissue.motion = paper ? Motion::paper : Motion::rod;
        o.colour.model = paper ? PigmentModel::paper : PigmentModel::kubelka_munk;
        s.blades.form = paper ? BladeForm::cone : BladeForm::ribbon;
      });
  choice(v, {"motion", "How blades droop: a bending rod, or the paper's turning about the root"},
         o.tissue.motion, kMotions);
  choice(v, {"pigment_model", "From pigments to a spectrum: Kubelka-Munk mixing, or the paper's subtraction"},
         o.colour.model, kPigmentModels);
  describe_tissue(v, o.tissue);
  v.number({"chlorophyll_fresh_ug_cm2", "Chlorophyll a + b of a fresh blade"},
           o.colour.chlorophyll_fresh_ug_cm2, {1, 120, "ug/cm2"});
  v.number({"brightness_sd", "Spread of the blades' reflectance, relative"}, o.colour.brightness_sd,
           {0, 0.5});
  v.number({"specular", "Specular reflectance of the cuticle, fresh"}, o.colour.specular, {0, 1});
  v.number({"proportion", "Points per unit of density"}, o.points.proportion,
           {0, 1000, "points per unit of density", true});
  v.number({"kernel_sigma_voxels", "Width of the Gaussian that turns points back into voxels"},
           o.points.kernel_sigma_voxels, {0.3, 4, "voxels"});
  v.number({"merge_distance_voxels", "Points of one blade nearer than this are combined; 0 = never"},
           o.points.merge_distance_voxels, {0, 2, "voxels"});
}

void describe_blades(KeyVisitor& v, BladeOptions& b) {
  v.preset({"species", "A turf grass whose dimensions and posture the keys below then adjust"},
           species_names(), "", [&](const std::string& name) {
             const BladeOptions before = b;
             b = species_preset(name);
             b.form = before.form;  // how many blades, and how they are modelled, is not the species' affair
             b.count = before.count;
             b.segments = before.segments;
             b.tufts_at = before.tufts_at;
             b.twin = before.twin;
           });
  choice(v, {"form", "A folded two-sided strip, or a cone"}, b.form, kForms);
  v.whole({"count", "Blades on the tile"}, b.count, {1, 100000, "blades"});
  range(v, {"length_m", "Shortest and longest blade"}, b.length_m, {0.005, 2, "m"});
  range(v, {"width_m", "Width at the widest place"}, b.width_m, {1e-4, 0.1, "m"});
  range(v, {"thickness_m", "Thickness"}, b.thickness_m, {2e-5, 0.005, "m"});
  v.number({"lean_mean_deg", "Least inclination of a blade's foot from the vertical"}, b.lean_mean_deg,
           {0, 60, "deg"});
  v.number({"lean_sd_deg", "Spread of the inclination above that"}, b.lean_sd_deg, {0, 60, "deg"});
  range(v, {"curl_deg", "Natural bend: change of inclination from root to tip"}, b.curl_deg,
        {-180, 180, "deg"});
  v.number({"twist_sd_deg", "Turn about the blade's own axis, root to tip, a standard deviation"},
           b.twist_sd_deg, {0, 360, "deg"});
  range(v, {"fold_deg", "Half-angle of the V fold, 0 = flat"}, b.fold_deg, {0, 80, "deg"});
  v.number({"clumping", "Share of the blades that stand in tufts"}, b.clumping, {0, 1});
  v.number({"tuft_radius_m", "Radius of a tuft, a standard deviation"}, b.tuft_radius_m, {0, 0.2, "m"});
  v.whole({"blades_per_tuft", "Blades in a tuft"}, b.blades_per_tuft, {1, 1000, "blades"});
  v.pairs({"tufts_at", "Where the tufts stand, [[x, y], ...] in shares of the tile; empty = at random"}, b.tufts_at,
          {0, 1, "of the tile"}, {0, 1, "of the tile"});
  v.whole({"twin", "Samples with the same number have the same blades, to compare climates; -1 = blades of its own"},
          b.twin, {-1, 1023});
  v.whole({"segments", "Pieces of a blade's centre line"}, b.segments, {4, 128});
}

void describe_sample(KeyVisitor& v, SampleOptions& s) {
  describe_blades(v, s.blades);
  describe_course(v, s.season);
  v.curve({"ageing",
           "Mg: the sample's own weathering degree over the scene's, [[wd, own wd], ...]; empty = the same"},
          s.ageing, {0, 1}, Shape::rising);
}

}  // namespace witherfield::scene
