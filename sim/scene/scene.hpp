// Scene files (TOML) -> options. Every key has a unit in its name, a default and a range; unknown keys are
// errors that suggest the nearest known one; messages name file, line, key, value, range and unit.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/core/view.hpp"
#include "sim/floor/options.hpp"
#include "sim/fruit/options.hpp"
#include "sim/grass/options.hpp"
#include "sim/leaf/options.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::scene {

/// What is written by a run.
struct OutputOptions {
  bool fields = true;               ///< texel/*.vti and grass.pvd
  bool optics = true;               ///< optics/*.vti
  bool points = true;               ///< points/*.vtp
  bool blades = false;              ///< blades/*.vtp
  std::string other_variants = "fields";  ///< of the texel's variants but the first: "all" of the above, "fields", "none"
  bool pov = true;                  ///< pov/ scenes
  std::string compression = "lz4";  ///< "lz4" (fast) or "zlib" (small, for archives and the web)
};

struct GrassScene {
  std::string kind = "grass";
  std::string name;  ///< default: the scene file's stem
  grass::GrassOptions grass;
  std::optional<terrain::TerrainOptions> terrain;
  terrain::PlacementOptions placement;
  std::vector<Still> stills;
  OutputOptions output;
};

/// @param preview shrinks the run so that it ends in seconds: resolution at most 64, few blades' segments, at
/// most 3 key frames, at most 12 x 12 texels, stills of at most 240 x 135. @throws IoFailure (cannot read),
/// InvalidInput. Relative paths in the scene are relative to the scene file's folder.
GrassScene load_grass_scene(const std::string& path, bool preview = false);

/// What a run of an object (fruit, leaf) writes.
struct ObjectOutput {
  bool fields = true;  ///< <kind>/*.vtp and <kind>.pvd
  bool obj = true;     ///< <kind>/*.obj
  bool ply = true;     ///< <kind>/*.ply
  bool every_frame = false;  ///< .obj and .ply of every key frame, not of the last one only: they are large
  bool pov = true;     ///< pov/ scenes
  std::string compression = "lz4";
};

struct FruitScene {
  std::string name;
  fruit::FruitOptions fruit;  ///< without the user's mesh, which the caller reads from mesh_file
  std::string mesh_file;      ///< OBJ, PLY, OFF, STL or VTP; "" = none
  double mesh_unit_mm = 1;    ///< length of the mesh file's unit
  std::vector<std::pair<int, int>> mesh_creases;  ///< vertex pairs of the mesh, from 0
  std::vector<int> mesh_sharp;                    ///< vertices
  std::vector<ObjectStill> stills;
  ObjectOutput output;
};

/// @param preview at most 1 step of subdivision, stills of 240 pixels; smaller ears.
FruitScene load_fruit_scene(const std::string& path, bool preview = false);
std::string resolved_json(const FruitScene& scene);

/// A window of a room, for pictures.
struct RoomWindow {
  glm::dvec2 a_m{0.0}, b_m{0.0};  ///< ends, on the outer wall
  double sill_m = 0.9, height_m = 1.4;
};

/// A picture of a floor in its room.
struct RoomStill {
  Still still;              ///< name, size, camera, sun, exposure
  double visits_share = 1;  ///< key frame shown
  double haze = 0;          ///< 0..1
  double relief_scale = 1;  ///< 0..1000
};

struct FloorOutput {
  bool fields = true, footprints = false, pov = true;
  int shown_visits = 100;  ///< in walks.vtp, footprints.vtp and footprints.csv
  std::string compression = "lz4";
};

/// Where footprints come from, if not from walkers of this run's own.
struct WalkSources {
  std::vector<std::string> footprint_files;  ///< footprints.bin of earlier runs
  std::vector<std::string> track_files;      ///< positions of people over time
  std::string track_format = "guess";
  std::optional<std::pair<int, int>> stretch;  ///< visits [first, last) that this run walks; none = all
};

struct FloorScene {
  std::string name;
  floor::FloorOptions floor;  ///< without the user's masks, which the caller reads from mask_files
  std::vector<std::string> mask_files;
  double mask_pixels_per_m = 250;
  double wall_height_m = 2.7;
  std::vector<double> obstacle_height_m;  ///< one per obstacle
  std::vector<RoomWindow> windows;
  WalkSources walk;
  std::vector<RoomStill> stills;
  FloorOutput output;
};

/// @param preview few visitors, each of whom stands for many (all of them where earlier footprints are taken), on a coarse
/// floor; stills of 240 pixels. @param footprints files besides those that the scene names.
FloorScene load_floor_scene(const std::string& path, bool preview = false,
                            const std::vector<std::string>& footprints = {});
std::string resolved_json(const FloorScene& scene);
/// The resolved scene as TOML, and back: what footprints.bin carries. `source` names it in messages.
std::string resolved_toml(const FloorScene& scene);
FloorScene floor_scene_from_text(const std::string& toml, const std::string& source);
/// "file:line: message" for a message of the floor simulator that begins with a key, such as "room.door[0] 'main': ..."; the
/// message as it is when the file does not state that key. @throws IoFailure.
std::string with_line(const std::string& path, const std::string& message);

struct LeafScene {
  std::string name;
  leaf::LeafOptions leaf;  ///< its points and mesh are read by the caller
  std::string points_unit = "m";
  double mesh_unit_mm = 1;
  std::vector<ObjectStill> stills;  ///< wd: the nearest key frame is shown
  ObjectOutput output;
};

/// @param preview a coarse mesh, 3 key frames, stills of 240 pixels.
LeafScene load_leaf_scene(const std::string& path, bool preview = false);
std::string resolved_json(const LeafScene& scene);

/// `kind` of a scene file. @throws as above; InvalidInput with the known kinds when it is another.
std::string scene_kind(const std::string& path);

/// A complete commented scene with every key, its default, range and unit; loading it back gives the
/// defaults.
std::string print_defaults(const std::string& kind);

/// The resolved scene, every default spelled out, as JSON text (for run.json).
std::string resolved_json(const GrassScene& scene);

}  // namespace witherfield::scene
