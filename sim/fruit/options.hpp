// What the fruit simulator is told. One aggregate per concern: default, unit and range on every field.
// The scene file (sim/scene) fills these; `validate` is called once, by the simulator.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/fruit/subdivision.hpp"

namespace witherfield::fruit {

/// Wheat ear (Liu et al. 2007, sec. 2.1): shank, spikelets of up to five kernels ("segments"), husks, awns.
/// Kernel dimensions are those of the harvest-dry kernel, at 12 % water (wet basis).
struct WheatOptions {
  int spikelets = 20;             ///< alternately in the front and the back row, 2..60 (17..24 in the field)
  int kernels_per_spikelet = 5;   ///< in the order 0, 1, 3, 2, 4 from the middle outwards, 1..5
  double ear_length_mm = 78;      ///< of the stepped part of the shank, 20..300; 0.3..40 mm per spikelet
  double stem_length_mm = 22;     ///< of the cylinder below the ear, 1..300
  double stem_radius_mm = 1.1;    ///< 0.2..5
  double kernel_length_mm = 6.2;  ///< 2..15
  double kernel_width_mm = 3.2;   ///< 1..8
  double kernel_thickness_mm = 2.9;  ///< 1..8
  bool husks = true;                 ///< glumes and lemmas
  double gape_deg = 5;               ///< how far the ripe husks open, 0..30
  bool awns = true;
  double awn_length_mm = 60;        ///< of the longest awns, 1..200 (typically 40..100)
  double awn_root_radius_mm = 0.2;  ///< 0.02..2 (typically 0.15..0.3; the paper: 0.7)
  double awn_tip_radius_mm = 0.02;  ///< 0.002..2, not above the root's (typically 0.02; the paper: 0.07)
  double awn_start = 1;  ///< radii at wd = 0 over those at wd = 1: below 1 the awns thicken in time, 0.05..1
  double nod_deg = 14;   ///< how far the ripe ear's upper end hangs over sideways, 0..60
  double variation = 1;  ///< scale of the seeded differences between kernels, 0 (all alike)..2
};

enum class Crown { dent, flint };

/// Maize ear (sec. 2.2): the cob is a polyhedron of rows x kernels_per_row cells, and the cells' size is the
/// size of the swollen kernels on it.
struct MaizeOptions {
  int rows = 16;                   ///< even, 4..40 (14..20 in the field)
  int kernels_per_row = 40;        ///< 4..80 (40..44 in the field)
  double ear_length_mm = 195;      ///< 40..400 (180..220)
  double cob_diameter_mm = 27;     ///< bare, widest place, 8..80 (25..30)
  double kernel_length_mm = 10.2;  ///< swollen (25 % water or more), 3..25
  double ratio_upper = 1.5;   ///< length over width of the kernel's cross-section before the two planes cut
                              ///< it, 1..3: paper's UPSEEDSCALE
  double ratio_middle = 1.5;  ///< MIDSEEDSCALE
  double ratio_lower = 1.2;   ///< LOWSEEDSCALE
  Crown crown = Crown::dent;  ///< dent: the crown sinks in as the kernel dries; flint: it stays round
  bool kernels = true;        ///< false: the bare cob
  double variation = 1;       ///< scale of the seeded differences between kernels, 0 (all alike)..2
};

enum class Arrangement {
  spiral,  ///< golden-angle spiral, equal area per grain
  rows,    ///< whorls, each turned by half a grain
  cells    ///< one grain per face of the user's control mesh (needs FruitOptions::mesh)
};

/// Colour as 8-bit sRGB levels, 0..255, as a scene file states it.
struct Srgb {
  double r = 0, g = 0, b = 0;
};

/// Any fruit of many grains on a body. The default is a raspberry.
struct PlantedOptions {
  /// Outline of the body of revolution as (height, radius), from the base up; the height ascends, 2 or more
  /// points. Not used when the user gives a control mesh as the body.
  std::vector<std::pair<double, double>> body_profile_mm{{0, 6.2},  {3, 7.3},  {8, 6.9},
                                                         {13, 5.2}, {17, 2.6}, {18, 0.7}};
  Arrangement arrangement = Arrangement::spiral;
  int grains = 84;                  ///< 1..20000; the cells arrangement takes one per face instead
  double grain_length_mm = 4.6;     ///< along the normal, 0.1..100
  double grain_width_mm = 4.1;      ///< 0.1..100
  double grain_thickness_mm = 4.0;  ///< 0.1..100
  bool grain_pointed = false;       ///< sharp-vertex rule at the outer end
  double sink = 0.30;               ///< share of the grain's length below the body's surface, 0..0.95
  double lean_deg = 14;             ///< of the grains towards the fruit's upper end, -80..80
  double shrink_dry = 0;            ///< linear shrinkage of the grains at wd = 1, 0..0.5
  bool calyx = true;                ///< five sepals and a stalk at the base
  double style_length_mm = 2.6;     ///< of the dry hair on each grain, 0 = none, 0..50
  Srgb unripe{126, 150, 78}, turning{226, 150, 120}, ripe{176, 24, 38};  ///< grains at wd 0, turning point, 1
  double turning_wd = 0.5;                                               ///< 0.05..0.95
  Srgb body{216, 196, 160};
  double variation = 1;  ///< 0..2
};

/// Ripening: days, water, pigments (docs/physics.md). wd = 0 is the milk stage, wd = 1 harvest-dry.
struct RipeningOptions {
  double length_days = 36;  ///< wd = days / length_days, 1..365
  double start_day = 18;    ///< after flowering, at wd = 0; 0..200
  /// Kernel moisture, wet basis, against days after flowering, falling; empty = the crop's own.
  std::vector<std::pair<double, double>> moisture_curve;
  /// Ripeness of the pigments (0 green .. 1 ripe) against wd, rising; empty = default.
  std::vector<std::pair<double, double>> pigment_curve;
  double spread = 0.05;  ///< between kernels: standard deviation in wd, 0..0.3
  bool shrink = true;    ///< kernels change their size with their moisture
};

struct FruitOptions {
  std::string crop = "wheat";  ///< wheat, maize, planted (default: a raspberry) or mesh
  std::uint64_t seed = 1;
  Scheme scheme = Scheme::liu2007;
  int steps = 2;  ///< of subdivision, 0..4
  WheatOptions wheat;
  MaizeOptions maize;
  PlantedOptions planted;
  ControlMesh mesh;  ///< crop = mesh: the fruit; crop = planted: the body, when not empty. Metres
  std::vector<glm::dvec2> mesh_uv;   ///< of its vertices, subdivided with them; empty = by place
  double mesh_crease_angle_deg = 0;  ///< edges of `mesh` sharper than this become creases, 0 = none, 0..180
  RipeningOptions ripening;
  std::vector<double> frames{0.0, 0.35, 0.6, 1.0};  ///< wd, ascending, 0..1
};

std::vector<std::string> crop_names();
/// Defaults that suit the crop (times of ripening). @throws InvalidInput with the known names for any other.
FruitOptions crop_preset(const std::string& crop);

/// @throws InvalidInput naming the key, its value, the range and the unit.
void validate(const FruitOptions& options);

}  // namespace witherfield::fruit
