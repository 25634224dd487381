// Near texels: each cell gets a block of its own that holds all grass inside its footprint, also the blades
// that lean in from its eight neighbours, voxel for voxel (turns and mirrors map the grids onto each other).
// So no blade is cut at a cell's border and no two boxes overlap.
#pragma once
#include <map>
#include <utility>

#include "pov/media.hpp"

namespace witherfield::pov {

/// A neighbour (or the cell itself) with its light.
struct CellPart {
  const TexelInstance* at;
  const TexelGrid* grid;
  const TexelPrelight* light;
  const std::vector<glm::vec3>* radiance;
};

/// @param cell the cell; its box is upright on the cell's plane, unturned, unit height scale.
/// @param parts the cell itself and those around it, all at one resolution.
/// @param slope per part, factor on the radiance.
struct NearCell {
  MediaBlock block;
  MediaSamples samples;
};
NearCell merge_cell(const TexelInstance& cell, double tile_m, const std::vector<CellPart>& parts,
                    const std::vector<glm::dvec3>& factor);

}  // namespace witherfield::pov
