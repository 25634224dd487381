// The hot loop of add_stamps. Private to it.
#pragma once
#include "sim/floor/stamp.hpp"

namespace witherfield::floor {

/// A placement made ready: whole cells; weights of a cell's row and the one below, and of the cell and its left neighbour.
struct ReadyStamp {
  int column, row;  // of the stamp's middle
  float upper, lower, right, left;
};
ReadyStamp ready(const Placement& placement);

/// Part of the plane that is worked on at once, with room for a strip to the left and right.
struct StampTile {
  int x0, y0, width, height, stride;
  float* plane[3];  ///< cell (x0, y0) lies at [StampSet::kWidth]
};

/// Adds the placements order[0 .. n) of `all` to the tile.
void add_to_tile(std::span<const Placement> all, const std::uint32_t* order, std::size_t n, const StampPass& pass,
                 const StampTile& tile);

}  // namespace witherfield::floor
