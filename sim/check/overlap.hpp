// How much do the shells of a surface (kernels of an ear) run into each other?
#pragma once
#include <cstddef>
#include <vector>

#include "sim/core/surface.hpp"

namespace witherfield::check {

struct OverlapOptions {
  std::size_t lines = 2048;  ///< lines sampled per pair, 16..1e6; the error falls about as 1 / lines
};

/// Shells are numbered as MeshReport::component of check_surface; a < b.
struct Overlap {
  std::size_t a = 0, b = 0;
  double volume_m3 = 0;  ///< of the intersection
  double error_m3 = 0;   ///< standard error of volume_m3
  double fraction = 0;   ///< volume_m3 / volume of the smaller of the two
  double error = 0;      ///< standard error of fraction
};

/// All pairs of closed shells whose volumes intersect (estimate > 0), by (a, b). Shells that are not closed
/// have no inside and are left out; inside out or not makes no difference.
///
/// Within the common bounding box of two shells vertical lines are cut exactly with both; the estimate is the
/// mean length of what lies in both, times the area. The lines stand at the points of a rank-1 lattice of
/// irrational generators (deterministic), in 8 random shifts, whose spread gives the standard error. Same
/// result for any number of threads.
/// @throws InvalidInput when an option is out of range or the surface is not valid.
std::vector<Overlap> overlap_fractions(const Surface& surface, const OverlapOptions& options = {});

}  // namespace witherfield::check
