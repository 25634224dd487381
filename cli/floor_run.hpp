// The pipeline of `witherfield run` for floors: people walk, footprints wear, each key frame is written.
#pragma once
#include "cli/run_stages.hpp"

namespace witherfield::cli {

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted.
void run_floor(const RunRequest& request, Console& console);

}  // namespace witherfield::cli
