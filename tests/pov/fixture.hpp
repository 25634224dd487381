// Grass for the tests of pov/, free of the simulators: bent blades with plausible colours, and their texel by
// dense sampling.
#pragma once
#include <cstdint>

#include "sim/core/blade_ribbons.hpp"
#include "sim/core/placement.hpp"
#include "sim/core/texel_grid.hpp"

namespace witherfield::pov::fixture {

/// `dry` 0 green .. 1 straw (shorter and bent over), with a spread between blades.
BladeRibbons blades(int count, double tile_m, double dry, std::uint64_t seed);

/// Texel of resolution^3 voxels over the tile plus `margin` voxels at each side.
GridShape shape(double tile_m, int resolution, int margin);
TexelGrid texel(const BladeRibbons& blades, const GridShape& shape);

/// The same texel turned by quarter turns counter-clockwise (after mirroring x when asked). Square grids
/// only.
TexelGrid turned(const TexelGrid& grid, int quarter_turns, bool mirrored);

/// Every voxel filled evenly with `density`.
TexelGrid uniform_slab(const GridShape& shape, int layers, float density);

/// A level placement of cells x cells texels of one variant, all unturned, LOD 0.
Placement level_placement(double tile_m, int cells);

}  // namespace witherfield::pov::fixture
