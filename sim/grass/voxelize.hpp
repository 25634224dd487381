// Blades -> texel, with exact partial coverage (Jiao et al. 2010, sec. 2.1 and 2.2).
#pragma once
#include <vector>

#include "sim/core/texel_grid.hpp"
#include "sim/grass/blades.hpp"

namespace witherfield::grass {

/// The grid for a tile: resolution^3 voxels, margin on each side, origin so that the tile is [0, size] x [0,
/// size], z from 0. @throws InvalidInput for a resolution, margin or size out of range.
GridShape texel_shape(const TexelOptions& options);

/// Voxelises blades. A ribbon is its two folded half strips: along cos(fold) * (+-side) + sin(fold) * normal
/// from the centre line, half_width wide whatever the fold. A cone is four flat silhouettes through its axis
/// at 45 degrees, each with a quarter of the area (so that the voxels' mass does not depend on the view).
/// Each segment of a half strip is two triangles, split where |u| = vein_fraction * half width (inside: vein,
/// tissue 1; outside: mesophyll, 2). Every piece is clipped against the voxels it meets: the area in each
/// voxel is exact, so
///   sum(density) * spacing^2 = total blade area   (to 1e-6 relative: float storage).
/// Geometry outside the grid wraps around by whole tiles in x and y (a blade that leaves a tile belongs to
/// its neighbour's copy); below z = 0 and above the top it is kept in the first / last layer. Voxel
/// attributes are area-weighted means of what the blade's nodes hold, taken at the pieces' centroids along
/// the arc; strain_shrink is that of the piece's tissue. tangent (the blade's) and normal are means of axial
/// data, on the side of the largest piece. The normal is the face's, toward side x tangent (ribbon); or
/// points from the axis to the piece (cone), zero where all is vein. blade_id, arc and tissue are those of
/// the blade (tissue) with the largest area. Deterministic for any thread count.
/// @param first_blade_id added to the blade index.
/// @throws InvalidInput for arrays of unequal length, values that are not finite, vein_fraction outside 0..1.
TexelGrid voxelize(const BladeState& state, const GridShape& shape, double vein_fraction,
                   int first_blade_id = 0);

/// One-sided area of all blades of the state, m^2 (what voxelize distributes).
double total_blade_area_m2(const BladeState& state);

}  // namespace witherfield::grass
