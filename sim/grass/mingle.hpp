// Mingling of samples and the level-of-detail chain (Jiao et al. 2010, sec. 4.1 algorithm 2, and sec. 4.2).
#pragma once
#include <vector>

#include "sim/core/texel_grid.hpp"

namespace witherfield::grass {

/// rho = sum_i rho_i; scalar and colour attributes are rho-weighted means; tangent and normal the principal axes of the rho-weighted sums of
/// t t^T and n n^T; blade_id, arc, tissue of the densest sample in the voxel. All grids must have one shape. One
/// grid gives that grid back, bit for bit. @throws InvalidInput when empty or shapes differ.
TexelGrid mingle(const std::vector<const TexelGrid*>& samples);

/// Halves the resolution: density of a coarse voxel = sum of its 8 children's blade area over the coarse face area, i.e. sum / 4;
/// so sum(density) * spacing^2 is conserved. Attributes as in mingle. @throws InvalidInput when a side is not a multiple of 8
/// or the margin is odd.
TexelGrid half_resolution(const TexelGrid& grid);

/// Folds the margin back onto the opposite side of the tile, so that the result tiles periodically with margin 0.
/// sum(density) is conserved; attributes as in mingle. Needs a tile that is a multiple of 4 voxels.
TexelGrid fold_to_tile(const TexelGrid& grid);

}  // namespace witherfield::grass
