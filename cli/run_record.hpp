// What a run tells about itself: run.json, and run.partial.json while it is under way.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/view.hpp"
#include "vis/writers.hpp"

namespace witherfield::cli {

/// One key frame that has been written whole.
struct FrameRecord {
  int variant = 0, index = 0;
  double wd = 0, time_days = 0;
  std::vector<std::pair<std::string, std::string>>
      files;  ///< series ("texel", "fruit" ...) -> path relative to the run's folder
  std::vector<std::pair<std::string, double>>
      numbers;  ///< what else is told of the frame, with units in the names
  vis::ValueRanges ranges;

  /// Path of the frame's file in a series, "" = the run does not write it.
  std::string file(const std::string& series) const;
};

struct StillRecord {
  Still still;
  std::vector<std::pair<std::string, std::string>>
      scenes;  ///< look -> scene file, relative to the run's folder
};

struct StageRecord {
  std::string name;
  double seconds = 0;
  double peak_memory_MiB = 0;  ///< largest resident memory during the stage
};

/// A law that the run was checked against: name, measured value, limit, unit.
struct Check {
  std::string name;
  double value, limit;
  std::string unit;
  bool passed() const { return value <= limit; }
};

struct RunRecord {
  std::string kind;
  std::string scene_json;  ///< resolved
  std::string scene_file;
  bool preview = false;
  int threads = 0;
  std::vector<StageRecord> stages;
  std::vector<Check> checks;
  std::vector<std::pair<std::string, std::string>> details;  ///< what only this kind tells: name -> JSON text
  std::vector<FrameRecord> frames;
  std::vector<StillRecord> stills;
  std::vector<std::pair<std::string, std::uintmax_t>> files;  ///< path, bytes
};

/// Identifies what a run's files hold: program version and resolved scene, as JSON text.
std::string run_signature(const std::string& scene_json);

std::string partial_json(const std::vector<FrameRecord>& frames);
/// Frames of an unfinished run; none when there is no such file. @throws IoFailure when it cannot be
/// understood.
std::vector<FrameRecord> read_partial(const std::filesystem::path& file);

vis::ValueRanges ranges_of(const RunRecord& run);  ///< over all frames
std::string run_json(const RunRecord& run);

/// What other commands need to know of a run.
struct RunSummary {
  std::string name, kind;
  std::string version, seed_text;
  std::vector<FrameRecord> frames;
  std::vector<StillRecord> stills;  ///< name, wd, size, looks and scene files only
  double seconds = 0, peak_memory_MiB = 0;
  std::uintmax_t bytes = 0;
  std::vector<std::pair<std::string, bool>> checks;
};
/// @throws IoFailure when the folder holds no complete run or its run.json cannot be understood.
RunSummary read_run(const std::filesystem::path& folder);

/// Measures stages: wall clock and the process's largest resident memory in each.
class StageClock {
 public:
  explicit StageClock(std::vector<StageRecord>& stages) : stages_(stages) {}
  /// Ends the stage under way and starts the next; "" only ends.
  void start(const std::string& name);

 private:
  std::vector<StageRecord>& stages_;
  std::string name_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace witherfield::cli
