// Writes each key frame of a run as VTK files, as it comes from the simulation, and the series at the end.
#pragma once
#include <vector>

#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"
#include "sim/grass/simulate.hpp"
#include "sim/scene/scene.hpp"
#include "vis/writers.hpp"

namespace witherfield::cli {

class FrameWriter {
 public:
  /// @param whole frames of an earlier attempt: they are not written again.
  FrameWriter(const RunFolder& folder, const scene::GrassScene& scene, std::vector<FrameRecord> whole);

  /// Makes sure that the frame's files exist and records it. @throws IoFailure; SolverFailure when grass
  /// leaves the box.
  void write(const grass::GrassFrame& frame);
  /// grass.pvd and the other series.
  void write_series() const;
  const std::vector<FrameRecord>& frames() const { return frames_; }

 private:
  bool reuse(const grass::GrassFrame& frame);
  std::string path_of(const char* series, const grass::GrassFrame& frame, const char* extension) const;
  void write_series(const char* name, const char* series) const;

  const RunFolder& folder_;
  const scene::OutputOptions output_;
  const int variants_;
  vis::VoxelBox box_;
  std::vector<FrameRecord> whole_, frames_;
};

/// The part of the grid that a run's grass can reach: all of it sideways; upward to the longest blade
/// standing upright (blades only shrink and droop), plus the reach of the kernel that spreads points over
/// voxels.
vis::VoxelBox reachable_box(const grass::GrassOptions& options, const GridShape& shape);

}  // namespace witherfield::cli
