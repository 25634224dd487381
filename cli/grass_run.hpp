// The pipeline of `witherfield run` for grass: scene -> terrain and placement -> simulation, each key frame
// written as it comes -> series, POV-Ray scenes, run.json.
#pragma once
#include <string>

namespace witherfield::cli {

class Console;

struct RunRequest {
  std::string scene;
  std::string folder;  ///< "" = out/<name of the scene>
  int threads = 0;     ///< 0 = all
  bool preview = false, resume = false, force = false;
};

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted.
void run_grass(const RunRequest& request, Console& console);

}  // namespace witherfield::cli
