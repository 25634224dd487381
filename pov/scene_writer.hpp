// Simulation data -> POV-Ray scenes. Two looks of the same simulation: "texel" (pre-lit emission + absorption
// media, one sheared box per texel) and "blades" (instanced two-sided mesh2). The left-handed y-up flip (x,
// y, z) -> (x, z, y) happens in this folder only.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/blade_ribbons.hpp"
#include "sim/core/placement.hpp"
#include "sim/core/progress.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/core/tri_mesh.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

/// One variant at one key frame: the texel at full resolution (with its margin) and its blades.
struct VariantFrame {
  const TexelGrid* lod[4] = {
      nullptr, nullptr, nullptr,
      nullptr};  ///< full, half, quarter, eighth resolution, with margin; missing ones null
  const TexelGrid* tile[4] = {nullptr, nullptr, nullptr, nullptr};  ///< the same folded to the periodic tile
  const BladeRibbons* blades = nullptr;
};

struct SceneInput {
  Still still;
  std::vector<VariantFrame> variants;
  double tile_m = 0.2;
  const Placement* placement = nullptr;  ///< null: one single texel on flat studio ground
  const TriMesh* ground = nullptr;       ///< terrain mesh; null: flat
};

/// Writes pov/<still>_<look>.pov and its includes (DF3, mesh2, images, sky) below `folder` (the run's pov/
/// folder). Everything the scene needs is inside that folder. Returns the scene files written. @throws
/// IoFailure.
std::vector<std::filesystem::path> write_scenes(const std::filesystem::path& folder, const SceneInput& input,
                                                const Progress& progress = {});

}  // namespace witherfield::pov
