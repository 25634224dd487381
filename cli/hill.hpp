// The terrain of a run with everything that stands on it: cameras at their heights, a placement of texels for
// each still.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/run_folder.hpp"
#include "sim/check/mesh_check.hpp"
#include "sim/core/placement.hpp"
#include "sim/core/tri_mesh.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

struct Hill {
  terrain::Terrain terrain;
  TriMesh mesh;
  check::MeshReport report;
  std::vector<Placement>
      placements;  ///< one for each still, LOD by its camera; one by the default camera if there are none
};

/// Loads the terrain, sets the heights of the stills' cameras and places the texels.
/// @throws IoFailure, InvalidInput (also when tiles and texels differ in size, or a camera is under ground).
Hill make_hill(scene::GrassScene& scene);

/// terrain.vtp, with the texels as the first still sees them.
void write_hill(const RunFolder& folder, const Hill& hill);

}  // namespace witherfield::cli
