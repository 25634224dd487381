// Interpolation in time between key frames, value by value: monotone cubic with slopes that depend on the neighbouring
// keys only, so a film needs four key frames in memory and no more. Between two keys the value never leaves their range:
// what only grows in the keys only grows in between.
//
// Slopes: weighted harmonic mean of the neighbouring secants, F. N. Fritsch and J. Butland, "A method for constructing
// local monotone piecewise cubic interpolants", SIAM J. Sci. Stat. Comput. 5 (1984), as in PCHIP.
#pragma once
#include <span>
#include <vector>

#include "sim/core/floor_field.hpp"

namespace witherfield {

/// Where a moment lies among four neighbouring keys: between keys 1 and 2. Keys 0 and 3 may be missing at the ends.
struct KeyWindow {
  double time[4] = {0, 0, 1, 1};
  bool before = false, after = false;  ///< key 0, key 3 are there
  double at = 0;                       ///< the moment, time[1]..time[2]
};

/// The window of `moment` among ascending `times` (at least 2), clamped to their range, and the number of key 1.
struct KeyPlace {
  KeyWindow window;
  std::size_t first = 0;  ///< number of key 1
};
/// @throws InvalidInput unless the times are at least two and ascending.
KeyPlace place_among(std::span<const double> times, double moment);

/// Value at window.at of the curve through the keys' values y0..y3 (y0, y3 are ignored where they are missing).
double monotone_between(const KeyWindow& window, double y0, double y1, double y2, double y3);

/// The floor at a moment between key floors: every channel of every cell by itself. @param keys as in the window; the
/// outer two may be null where the window lacks them. @throws InvalidInput when grids or channels differ.
FloorField floor_between(const KeyWindow& window, const FloorField* const (&keys)[4]);

}  // namespace witherfield
