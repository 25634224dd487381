// The grass simulator: options in, frames out, one after another; nothing is kept that a frame does not need.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sim/core/blade_ribbons.hpp"
#include "sim/core/point_set.hpp"
#include "sim/core/progress.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/grass/options.hpp"

namespace witherfield::grass {

/// One key frame of one variant: all samples mingled.
struct GrassFrame {
  int variant = 0;
  int index = 0;               ///< number of the key frame, in ascending wd
  double wd = 0, time_days = 0;
  const TexelGrid* texel = nullptr;
  const PointSet* points = nullptr;       ///< all samples' points, blade ids as in the texel
  const BladeRibbons* blades = nullptr;
};
/// Called once per frame in order (variant, index); pointers are valid during the call only.
using FrameSink = std::function<void(const GrassFrame&)>;

/// What was measured on the way (for run.json and the tests of laws).
struct GrassReport {
  int blades = 0;
  std::size_t points_first = 0, points_last = 0, merges = 0;
  double density_error_max = 0;      ///< max over frames of |sum density - expected| / expected; expected = sum of point weights / proportion
  double root_shift_max_m = 0;       ///< how far any root moved
  bool all_finite = true;
  struct Stage { std::string name; double seconds; };
  std::vector<Stage> stages;         ///< wall clock per stage, summed
};

/// Runs the pipeline of Jiao et al. 2010: blades -> texel -> points -> (dynamics -> texel)*, per sample; then mingling.
/// wd = 0 gives the voxelised texel itself. @throws InvalidInput, SolverFailure.
GrassReport simulate_grass(const GrassOptions& options, const FrameSink& sink, const Progress& progress = {});

}  // namespace witherfield::grass
