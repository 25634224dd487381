// What the grass simulator is told. One aggregate per concern: default, unit and range on every field.
// The scene file (sim/scene) fills these; `validate` is called once, by the simulator.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace witherfield::grass {

/// Closed range of a per-blade quantity; blades draw from it (uniformly unless said otherwise).
struct Range { double lo = 0, hi = 0; };

enum class BladeForm { ribbon, cone };      ///< folded two-sided strip; or the paper's cone (Jiao et al. 2010, sec. 2.1)
enum class Motion { rod, paper };           ///< bending rod that keeps its length; or the paper's turning about the root (sec. 3.1)
enum class PigmentModel { kubelka_munk, paper };
enum class Climate { standard, water_rich, cold };

/// Geometry of the blades of one sample. Defaults: perennial ryegrass (docs/physics.md).
struct BladeOptions {
  BladeForm form = BladeForm::ribbon;
  int count = 400;                       ///< blades on the tile, 1..100000
  Range length_m{0.07, 0.15};            ///< 0.005..2
  Range width_m{0.0025, 0.0045};         ///< widest place, 1e-4..0.1
  Range thickness_m{0.0002, 0.0003};     ///< 2e-5..0.005
  double lean_mean_deg = 3;              ///< inclination of the blade's foot from the vertical, half-normal: |N(0, sd)| + mean
  double lean_sd_deg = 12;               ///< 0..60
  Range curl_deg{10, 65};                ///< natural bend: change of inclination from root to tip, drawn ~ u^2; -180..180
  double twist_sd_deg = 35;              ///< turn of the blade about its own axis, root to tip, 0..360
  Range fold_deg{12, 32};                ///< half-angle of the V fold; 0 flat .. 80
  double clumping = 0.6;                 ///< share of blades that stand in tufts, 0..1
  double tuft_radius_m = 0.006;          ///< sd of a tuft, 0..0.2
  int blades_per_tuft = 14;              ///< 1..1000
  std::vector<std::pair<double, double>> tufts_at{};  ///< where the tufts stand, in shares of the tile, 0..1; empty = at random
  int twin = -1;                         ///< samples of equal number >= 0 draw the same blades; -1 = blades of its own; ..1023
  int segments = 24;                     ///< of the centre line, 4..128
};

/// Names of the species presets: kentucky_bluegrass, perennial_ryegrass, tall_fescue, fine_fescue, creeping_bentgrass,
/// zoysia. @throws InvalidInput with the known names for any other.
BladeOptions species_preset(const std::string& name);
std::vector<std::string> species_names();

/// The grid that a texel is voxelised into.
struct TexelOptions {
  double size_m = 0.2;          ///< edge of the tile, 0.01..10
  int resolution = 256;         ///< voxels along x, y and z; a multiple of 32, 32..512
  int margin_sixteenths = 3;    ///< of the resolution, on each side outside the tile, 0..6; blades may lean into it
};

/// Time, water, chlorophyll. Real time: the season has a length in days and wd = t / length.
struct SeasonOptions {
  double length_days = 60;               ///< 1..1000
  double steps_per_day = 4;              ///< integration steps, 0.1..1000; the result depends on it only by its O(dt^2) error
  Climate climate = Climate::standard;
  std::vector<std::pair<double, double>> water_curve;        ///< user key frames (wd, relative water 0..1); empty = climate's
  std::vector<std::pair<double, double>> chlorophyll_curve;  ///< user key frames (wd, fraction 0..1); empty = default
  double onset_mean = 0.5;               ///< wd at which the median blade has lost half its chlorophyll, 0.1..0.9
  double onset_sd = 0.12;                ///< spread of the onset between blades, 0..0.3 (Mattila et al. 2018: yellowing is a spread of onsets)
  double tip_advance = 0.08;             ///< wd by which the tip is ahead of the root, 0..0.3
};

/// Mechanics and tissue (sources: docs/physics.md). Moduli in MPa.
struct TissueOptions {
  Motion motion = Motion::rod;
  double vein_fraction = 0.18;           ///< share of the half-width (or the cone's radius) around the midrib that is vein, 0.02..0.9
  double modulus_vein_fresh_MPa = 500, modulus_vein_dry_MPa = 900;        ///< E_v > E_m (the paper prints the opposite: docs/physics.md)
  double modulus_mesophyll_fresh_MPa = 10, modulus_mesophyll_dry_MPa = 60;
  double bending_fresh_MPa = 300, bending_limp_MPa = 40, bending_dry_MPa = 600;  ///< whole blade, axial
  double base_to_tip_stiffness = 12;     ///< modulus at the foot over that at the tip, falling exponentially, 1..100 (Balsamo et al. 2006: falls from base to tip)
  double osmotic_potential_MPa = -1.2;   ///< pi_0 at full turgor, -5..-0.1
  double wall_elasticity_MPa = 8;        ///< epsilon, 1..50
  double density_kg_m3 = 850;            ///< fresh tissue, 100..1500
  double dry_mass_fraction = 0.24;       ///< of fresh mass, 0.05..0.9
  double volume_strain_vein = -0.14;     ///< Delta V / V0 when all water is gone, k_v; -0.9..0
  double volume_strain_mesophyll = -0.68;///< k_m; |k_v| < |k_m|
  double shrink_thickness = -0.55, shrink_width = -0.25, shrink_length = -0.05;  ///< fresh -> dry
  double creep_days = 6;                 ///< relaxation time of a limp blade's shape, 0.1..1000
  double response_days = 1.0;            ///< Kelvin-Voigt time of bending, 0.02..100
  double droop_rate_per_day = 0.09;      ///< the paper's omega (rad/day at the tip of a limp blade), 0..10
};

struct ColourOptions {
  PigmentModel model = PigmentModel::kubelka_munk;
  double chlorophyll_fresh_ug_cm2 = 43.9;  ///< lawn grass, fitted by PROSPECT, 1..120
  double brightness_sd = 0.10;             ///< blade to blade, relative, 0..0.5
  double specular = 0.04;                  ///< Fresnel-like reflectance of the cuticle, 0..1 (dry: half of it)
};

/// Texel <-> points (Jiao et al. 2010, sec. 2.3).
struct PointOptions {
  double proportion = 6;                 ///< points per unit of density, > 0 (the paper's best: 6)
  double kernel_sigma_voxels = 0.5;      ///< Gaussian weight w_i, 0.3..4
  double merge_distance_voxels = 0.2;    ///< points of one blade and tissue nearer than this are combined; 0 = never; 0..2
};

/// One sample of the mingling (Algorithm 2): its blades, climate and ageing-rate function Mg.
struct SampleOptions {
  BladeOptions blades;
  SeasonOptions season;                                   ///< length_days and steps_per_day must equal those of the scene
  std::vector<std::pair<double, double>> ageing;          ///< Mg_i: key frames (wd, wd_i), non-decreasing, within 0..1; empty = identity
};

struct GrassOptions {
  std::uint64_t seed = 1;
  TexelOptions texel;
  SeasonOptions season;
  TissueOptions tissue;
  ColourOptions colour;
  PointOptions points;
  std::vector<SampleOptions> samples;                     ///< at least one
  int variants = 1;                                       ///< different texels of the same make, 1..16
  double variant_spread = 0.0;                            ///< variant v ages by wd^(2^(spread * x_v)), x_v in [-1, 1] evenly; 0..2
  std::vector<double> wd_frames{0.0, 0.30, 0.917};        ///< key frames, ascending, 0..1
  std::vector<double> wd_frames_other_variants;           ///< key frames of variants 1..; empty = wd_frames
};

/// @throws InvalidInput naming the field, its value, the range and the unit.
void validate(const GrassOptions& options);

}  // namespace witherfield::grass
