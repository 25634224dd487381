// Texel -> points and points -> texel (Jiao et al. 2010, sec. 2.3), and the combining of points (Algorithm
// 1).
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/core/point_set.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/grass/blades.hpp"

namespace witherfield::grass {

/// Num(x,y,z) = floor(proportion * density + u), u uniform in [0,1): unbiased in each voxel (erratum E0.2).
/// The u of the voxels are tied together so that the total is proportion * total density, rounded up or down
/// (unbiased, too): total density is kept to one point. Each point is placed uniformly in its voxel and
/// inherits the voxel's frame, material, tissue, blade and arc. Random numbers are keyed by (seed, voxel
/// index): any thread count, same points, in ascending order of (brick, voxel). `point_mass_kg` of every
/// point. @throws InvalidInput when proportion or the mass <= 0, or a density is negative or not finite.
PointSet sample_points(const TexelGrid& grid, double proportion, double point_mass_kg, std::uint64_t seed);

/// Finds, for every point, the arc and the offset in the frame of its blade (searching near the inherited
/// arc): the nearest spot of the centre line of blade (blade_id - first_blade_id) of `state`; keeps the
/// normal in that frame too.
/// @param tile_m edge of the tile: a point that the voxeliser wrapped around is first moved back by whole
/// tiles to its blade (it may then lie outside the grid; splat_points wraps it again). 0 = no wrapping.
/// @throws InvalidInput when a blade_id is not in `state`.
void attach_to_blades(PointSet& points, const BladeState& state, int first_blade_id = 0, double tile_m = 0);

/// Moves and updates points that ride on blades: position = centre(arc) + frame(arc) * offset, with the
/// offset scaled by the blade's shrinkage since `initial` (side: half_width ratio, normal: thickness ratio);
/// material interpolated along the blade; velocity by the blade's. Tangent along the blade, normal carried by
/// the same rotation of the frame. z >= 0. This is the update of N, T, M in Algorithm 1.
void ride_on_blades(PointSet& points, const BladeState& initial, const BladeState& now,
                    int first_blade_id = 0);

/// Combines points of the same blade and tissue that are nearer than distance_m: masses add; position,
/// velocity, frame and material are mass-weighted means (tangents and normals as axial data), renormalised
/// (fig. 6b; erratum E0.7). Each point takes part in at most one combination per call; partner = nearest,
/// ties by index. Order-independent, any thread count. Returns the number of combinations.
std::size_t merge_points(PointSet& points, double distance_m);

/// Voxels on each side of a point's own that its splat reaches: ceil(2 sigma). The weights are divided by their own sum, so
/// nothing is lost by cutting there; farther out the tails hold little and would fill empty voxels around every blade.
inline int splat_reach(double sigma_voxels) { return std::max(1, int(std::ceil(2 * sigma_voxels))); }

/// Gaussian splat. For point i and voxel c: w = prod over axes of exp(-d^2 / (2 sigma^2)) (d in voxels, from
/// the point to the voxel's centre) over the cube of voxels within splat_reach(sigma) of the point's own,
/// divided by its sum over the voxels in the grid, times mass_i / point_mass_kg: so the sum of w over
/// the voxels = weight of the point, and density = sum_i w_i / proportion conserves (Jiao et al. 2010,
/// sec. 2.3; errata E0.4, E0.5). Attributes are w-weighted means; tangent and normal are the principal axes
/// of sum w t t^T and sum w n n^T (axial data; the tangent's z >= 0, the normal on the side of the heaviest
/// point's); blade_id, arc, tissue of the heaviest point. Points outside the grid in x, y wrap by whole
/// tiles; in z they are clamped to the first / last layer. Voxel-centric: each brick gathers its points and
/// is written once; no dense pass. Reuses `out`'s memory. Any thread count and any instruction set, same
/// bits. @throws InvalidInput (sigma, proportion, masses), SolverFailure (a position or mass that is not
/// finite).
void splat_points(const PointSet& points, const GridShape& shape, double sigma_voxels, TexelGrid& out);

}  // namespace witherfield::grass
