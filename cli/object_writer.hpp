// Writes each key frame of a run of an object (fruit, leaf): .vtp with all fields, .obj, .ply, and the
// series.
#pragma once
#include <string>
#include <vector>

#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"
#include "sim/core/surface.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

class ObjectWriter {
 public:
  /// @param kind "fruit", "leaf": names of folder, files and series.
  ObjectWriter(const RunFolder& folder, std::string kind, const scene::ObjectOutput& output,
               std::vector<FrameRecord> whole);

  /// Makes sure that the frame's files exist and records it; `frame` brings index, wd, time and numbers.
  /// @param last the run's last frame.
  /// @throws IoFailure.
  void write(FrameRecord frame, const Surface& surface, bool last);
  void write_series() const;
  const std::vector<FrameRecord>& frames() const { return frames_; }

 private:
  const RunFolder& folder_;
  const std::string kind_;
  const scene::ObjectOutput output_;
  std::vector<FrameRecord> whole_, frames_;
};

}  // namespace witherfield::cli
