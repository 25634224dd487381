// Blades -> texel, with exact partial coverage (Jiao et al. 2010, sec. 2.1 and 2.2).
#pragma once
#include <vector>

#include "sim/core/texel_grid.hpp"
#include "sim/grass/blades.hpp"

namespace witherfield::grass {

/// The grid for a tile: resolution^3 voxels, margin on each side, origin so that the tile is [0, size] x [0, size], z from 0.
GridShape texel_shape(const TexelOptions& options);

/// Voxelises blades. A ribbon is its two folded half strips (each segment two quads split into triangles), a cone is four
/// flat silhouettes through its axis at 45 degrees, each with a quarter of the area (so that the voxels' mass does
/// not depend on the view). Every triangle is clipped against the voxels it meets: the area in each voxel is exact, so
///   sum(density) * spacing^2 = total blade area   (to 1e-6 relative: float storage).
/// Geometry outside the grid wraps around by whole tiles in x and y (a blade that leaves a tile belongs to its
/// neighbour's copy); below z = 0 and above the top it is kept in the first / last layer.
/// Voxel attributes are area-weighted means; tangent is the blade's, normal is the face normal (ribbon) or points from
/// the axis to the piece's centroid (cone; zero within vein_fraction of the radius). blade_id, arc and tissue are those of the blade (tissue) with
/// the largest area. Deterministic for any thread count.
/// @param first_blade_id added to the blade index.
TexelGrid voxelize(const BladeState& state, const GridShape& shape, double vein_fraction, int first_blade_id = 0);

/// One-sided area of all blades of the state, m^2 (what voxelize distributes).
double total_blade_area_m2(const BladeState& state);

}  // namespace witherfield::grass
