// The frame of `witherfield run` that all kinds of scene share: the folder, what of an earlier attempt is
// kept, the order of the stages, what stays after a failure, the summary.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"

namespace witherfield::cli {

class Console;

struct RunRequest {
  std::string scene;
  std::string folder;  ///< "" = out/<name of the scene>
  int threads = 0;     ///< 0 = all
  bool preview = false, resume = false, force = false;
  std::string visits;                   ///< floors: stretch of visits to walk, "FROM:UNTIL"; "" = as the scene says
  std::vector<std::string> footprints;  ///< floors: footprints.bin of earlier runs, besides the scene's
};

/// The stages of one run, called in this order.
class RunStages {
 public:
  virtual ~RunStages() = default;
  /// Everything that can be wrong with the input shows here, before anything is written.
  virtual void prepare() {}
  /// Simulates and writes; frames that are `whole` from an earlier attempt need not be written again.
  virtual void simulate(std::vector<FrameRecord> whole) = 0;
  virtual void write_pictures() {}
};

/// Makes the stages for a folder and a record, both of which live longer than a failure, which must leave no
/// half-written run.
using MakeStages = std::function<std::unique_ptr<RunStages>(RunFolder&, RunRecord&)>;

/// @throws InvalidInput, IoFailure, SolverFailure, Interrupted; Error with exit code 1 when the run is whole
/// but a check failed.
void carry_out(const RunRequest& request, const std::string& kind, const std::string& name,
               const std::string& scene_json, Console& console, const MakeStages& make);

}  // namespace witherfield::cli
