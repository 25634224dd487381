// What the leaf simulator is told: how the leaf is built and how it is deformed by hand.
// One aggregate per concern: default, unit and range on every field. Angles from the midrib, to either side.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf {

/// Where the outline comes from (Miao et al., sec. 1).
enum class LeafSource {
  veins,   ///< statistics of the veins: only the length of the main vein is entered
  points,  ///< measured or hand-set points: left outline, right outline, midrib
  mesh     ///< any triangle mesh
};

/// Teeth of the margin; added to the outline along its outward normal.
struct MarginOptions {
  double tooth_spacing_m = 0.0055;  ///< along the outline, 0.001..0.1
  double tooth_depth_m = 0.0012;    ///< from sinus to tip, 0 (entire margin)..0.02
  double tooth_lean = 0.55;         ///< 0 symmetric .. 1 sawtooth that points to the tip of its lobe
  double irregularity = 0.35;       ///< relative spread of spacing and depth, 0..0.9
};

struct MeshOptions {
  double outline_spacing_m = 0.0011;  ///< distance of the samples of the splines, 1e-4..0.05
  double edge_m = 0.0018;             ///< longest edge wanted inside the blade, 2e-4..0.05
  double vein_edge_m = 0.0012;        ///< longest edge wanted near main and side veins, 1e-4..0.05; grows to edge_m
  double growth = 0.35;               ///< how fast edges may grow away from what is fine (m per m), 0.05..2
  int max_vertices = 200000;          ///< 100..2000000; more is an error that says which sizes to raise
};

/// The pose of a living leaf, from the flat one. Lengths along the veins are kept where the blade only bends.
/// Measured leaves (source = points or mesh) have their own pose: only the relief is added.
struct PoseOptions {
  bool apply = true;               ///< false: neither pose nor relief
  double midrib_rise_deg = 12;     ///< slope of the midrib where the petiole ends, -80..80
  double midrib_bend_deg = 58;     ///< by how much the midrib turns downward from base to tip, -180..180
  double fold_deg = 8;             ///< by how much each half rises from the midrib, -80..80
  double droop_deg = 40;           ///< by how much each half bends down from midrib to margin, -180..180
  double waviness = 0.035;         ///< height of the waves of the margin over the main vein's length, 0..0.3
  int waves = 7;                   ///< around the margin, 0..40
  double pucker_m = 0.0018;        ///< bulge of the blade between side veins, 0..0.02
  double fine_pucker_m = 0.00035;  ///< bulge between the veins of the net, 0..0.01
  double vein_groove_m = 0.0004;   ///< depth of the main vein's groove on the upper side (side veins: less), 0..0.005
};

struct VeinOptions {
  double main_width_m = 0.0021;     ///< of the main vein at its base, 1e-4..0.02
  double side_spacing = 0.12;       ///< of side veins along a main vein, over the main vein's length, 0.03..0.5
  double side_angle_deg = 48;       ///< between a side vein and its main vein, 15..85
  double net_spacing_m = 0.0068;    ///< size of the cells of the net of fine veins, 0 (no net) or 0.001..0.05
};

/// One place of the leaf that is held or dragged.
struct HandleOptions {
  std::string name;
  bool by_uv = true;             ///< picked by texture coordinates, else by the nearest vertex to `point_m`
  glm::dvec2 uv{0.5, 0.5};       ///< 0..1
  glm::dvec3 point_m{0, 0, 0};   ///< in the natural pose
  double radius_m = 0;           ///< vertices of the leaf within this distance move with it, 0..1; 0 = one vertex
  double weight = 10;            ///< k_i, 0.01..1e6
};

/// Where the handles are at one key frame: displacement from the natural pose, one per handle.
struct EditKey {
  std::string name;
  std::vector<glm::dvec3> move_m;
};

enum class EditMode { linear, rotation_aware };  ///< the paper's; or with rotations (smoothed as-rigid-as-possible)

struct EditOptions {
  EditMode mode = EditMode::rotation_aware;
  double smoothness = 0.02;      ///< alpha of the rotation-aware mode: resistance against bending over a length like the leaf's, 0..10
  int max_iterations = 200;      ///< of the rotation-aware mode for each key, 1..100000
  double tolerance = 1e-5;       ///< it ends when no vertex moves further in an iteration than this share of the leaf's size, 1e-14..0.1
  std::vector<HandleOptions> handles;
  std::vector<EditKey> keys;
};

struct LeafOptions {
  std::uint64_t seed = 1;
  LeafSource source = LeafSource::veins;
  std::string species = "cucumber";  ///< cucumber, watermelon: proportions of the veins and habit of the margin
  double main_vein_m = 0.15;         ///< length of the main vein, 0.01..1
  double variation = 0.5;            ///< share of the reconstructed intervals of ratios and angles that is drawn from, 0..1
  double asymmetry = 0.5;            ///< 0: both halves alike, 1: drawn apart
  std::string points_file;           ///< source = points: CSV or JSON, read by the caller; source = veins: see LeafInput
  std::string mesh_file;             ///< source = mesh: OBJ or PLY, read by the caller
  double reference_area_m2 = 0;      ///< to report the error against; 0 = none
  MarginOptions margin;
  MeshOptions mesh;
  VeinOptions veins;
  PoseOptions pose;
  double petiole_m = 0.09;           ///< length, 0 (none)..1
  double petiole_radius_m = 0.0018;  ///< 1e-4..0.05
  double petiole_angle_deg = 55;     ///< below the blade's base direction, -90..170
  double chlorophyll_fresh_ug_cm2 = 42;  ///< 1..120; colours of the fresh leaf
  EditOptions edit;
  bool wilts = false;  ///< run the wilting simulation on the (edited) leaf
  WiltOptions wilt;
};

/// Proportions, margin, mesh and pose of a species at a length of the main vein: what a scene starts from.
/// @throws InvalidInput with the known names for any other.
LeafOptions species_preset(const std::string& name, double main_vein_m = 0);
std::vector<std::string> species_names();

/// @throws InvalidInput naming the field, its value, the range and the unit.
void validate(const LeafOptions& options);

}  // namespace witherfield::leaf
