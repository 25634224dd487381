// The pipeline of `witherfield run` for grass: scene -> terrain and placement -> simulation, each key frame
// written as it comes -> series, POV-Ray scenes, run.json.
#pragma once
#include "cli/run_stages.hpp"

namespace witherfield::cli {

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted.
void run_grass(const RunRequest& request, Console& console);

}  // namespace witherfield::cli
