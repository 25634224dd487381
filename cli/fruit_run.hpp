// The pipeline of `witherfield run` for fruit.
#pragma once
#include "cli/run_stages.hpp"

namespace witherfield::cli {

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted.
void run_fruit(const RunRequest& request, Console& console);

}  // namespace witherfield::cli
