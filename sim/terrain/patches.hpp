// Which variant of a texel stands where.
#pragma once
#include <vector>

#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain {

/// A variant for each cell, row by row. Every variant gets the same number of cells (give or take one);
/// patchiness says how far cells of one variant lie together in patches of about options.patch_m.
std::vector<int> patchy_variants(int cells_x, int cells_y, double tile_m, const PlacementOptions& options);

}  // namespace witherfield::terrain
