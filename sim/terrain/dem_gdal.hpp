// Reads a digital elevation model through GDAL.
#pragma once
#include "sim/terrain/grid_surface.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain {

/// The samples of options.dem that options.crop needs, in true metres: geographic degrees become metres at
/// the crop's middle latitude (on the DEM's own ellipsoid), feet become metres. The whole DEM spans from the
/// centre of its first cell to that of its last.
/// @throws IoFailure, InvalidInput as load_terrain.
DemGrid load_dem(const TerrainOptions& options);

}  // namespace witherfield::terrain
