// The pipeline of `witherfield run` for leaves: built, then edited by key frames, then wilting.
#pragma once
#include "cli/run_stages.hpp"

namespace witherfield::cli {

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted.
void run_leaf(const RunRequest& request, Console& console);

}  // namespace witherfield::cli
