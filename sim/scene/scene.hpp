// Scene files (TOML) -> options. Every key has a unit in its name, a default and a range; unknown keys are
// errors that suggest the nearest known one; messages name file, line, key, value, range and unit.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim/core/view.hpp"
#include "sim/grass/options.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::scene {

/// What is written by a run.
struct OutputOptions {
  bool fields = true;               ///< texel/*.vti and grass.pvd
  bool optics = true;               ///< optics/*.vti
  bool points = true;               ///< points/*.vtp
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

/// `kind` of a scene file. @throws as above; InvalidInput with the known kinds when it is another.
std::string scene_kind(const std::string& path);

/// A complete commented scene with every key, its default, range and unit; loading it back gives the
/// defaults.
std::string print_defaults(const std::string& kind);

/// The resolved scene, every default spelled out, as JSON text (for run.json).
std::string resolved_json(const GrassScene& scene);

}  // namespace witherfield::scene
