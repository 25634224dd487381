#include "cli/frame_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pov/blade_mesh.hpp"
#include "sim/core/errors.hpp"
#include "sim/grass/points.hpp"
#include "sim/grass/voxelize.hpp"
#include "vis/atomic_file.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {

vis::VoxelBox reachable_box(const grass::GrassOptions& options, const GridShape& shape) {
  double top_m = 0;
  for (const grass::SampleOptions& s : options.samples)
    top_m = std::max(top_m, s.blades.length_m.hi + s.blades.width_m.hi + s.blades.thickness_m.hi);
  const double kernel_voxels = grass::splat_reach(options.points.kernel_sigma_voxels) + 1.0;
  const double layers = std::ceil((top_m - shape.origin_m.z) / shape.spacing_m + kernel_voxels);
  return {{0, 0, 0}, {shape.nx, shape.ny, int(std::clamp(layers, 1.0, double(shape.nz)))}};
}

FrameWriter::FrameWriter(const RunFolder& folder, const scene::GrassScene& scene,
                         std::vector<FrameRecord> whole)
    : folder_(folder),
      output_(scene.output),
      variants_(scene.grass.variants),
      box_(reachable_box(scene.grass, grass::texel_shape(scene.grass.texel))),
      whole_(std::move(whole)) {
  std::error_code error;
  for (const auto& [wanted, name] :
       {std::pair{output_.fields, "texel"}, {output_.optics, "optics"}, {output_.points, "points"},
        {output_.blades, "blades"}}) {
    if (!wanted) continue;
    std::filesystem::create_directories(folder_.path() / name, error);
    if (error)
      throw IoFailure("cannot make the folder '" + (folder_.path() / name).string() +
                      "': " + error.message());
  }
}

std::string FrameWriter::path_of(const char* series, const grass::GrassFrame& frame,
                                 const char* extension) const {
  const std::string variant = frame.variant > 0 ? fmt::format("v{}_", frame.variant) : "";
  return fmt::format("{0}/{0}_{1}{2:04}.{3}", series, variant, frame.index, extension);
}

bool FrameWriter::reuse(const grass::GrassFrame& frame) {
  const auto found = std::find_if(whole_.begin(), whole_.end(), [&](const FrameRecord& f) {
    return f.variant == frame.variant && f.index == frame.index;
  });
  if (found == whole_.end()) return false;
  for (const auto& [series, file] : found->files)
    if (!std::filesystem::exists(folder_.path() / file)) return false;
  frames_.push_back(*found);
  return true;
}

void FrameWriter::write(const grass::GrassFrame& frame) {
  const TexelGrid::Box occupied = frame.texel->occupied_box();
  for (int axis = 0; axis < 3; ++axis)
    if (occupied.hi[axis] > box_.hi[axis])
      throw SolverFailure(
          fmt::format("grass at wd {} reaches voxel layer {} of axis {}, above the longest blade standing "
                      "upright ({} layers)",
                      frame.wd, occupied.hi[axis], axis, box_.hi[axis]));
  if (reuse(frame)) return;
  const vis::Stamp stamp{frame.time_days, frame.wd};
  const vis::Compression compression =
      output_.compression == "zlib" ? vis::Compression::zlib : vis::Compression::lz4;
  FrameRecord r;
  r.variant = frame.variant;
  r.index = frame.index;
  r.wd = frame.wd;
  r.time_days = frame.time_days;
  r.numbers = {{"occupied_voxels", double(frame.texel->occupied_voxels())},
               {"points", double(frame.points->size())},
               {"total_density", frame.texel->total_density()}};
  const auto add = [&](const char* series, const char* extension) {
    r.files.emplace_back(series, path_of(series, frame, extension));
    return folder_.path() / r.files.back().second;
  };
  const bool all = frame.variant == 0 || output_.other_variants == "all";
  const auto merge = [&](const vis::ValueRanges& ranges) { vis::merge_ranges(r.ranges, ranges); };
  const bool fields = output_.fields && (all || output_.other_variants == "fields"), optics = output_.optics && all;
  if (fields || optics) {
    const vis::TexelPlan plan(*frame.texel, box_);
    if (fields) merge(vis::write_texel_vti(add("texel", "vti"), plan, false, stamp, compression));
    if (optics) merge(vis::write_texel_vti(add("optics", "vti"), plan, true, stamp, compression));
  }
  if (output_.points && all) merge(vis::write_points_vtp(add("points", "vtp"), *frame.points, stamp, compression));
  if (output_.blades && all)
    merge(vis::write_surface_vtp(add("blades", "vtp"), pov::blade_surface(*frame.blades, {}), stamp, "mm", compression));
  frames_.push_back(r);
  vis::write_whole_file(folder_.partial_file(), partial_json(frames_));
}

void FrameWriter::write_series(const char* name, const char* series) const {
  for (int variant = 0; variant < variants_; ++variant) {
    std::vector<std::pair<double, std::string>> entries;
    for (const FrameRecord& f : frames_)
      if (f.variant == variant && !f.file(series).empty()) entries.emplace_back(f.time_days, f.file(series));
    if (entries.empty()) continue;
    const std::string suffix = variant > 0 ? fmt::format("_variant{}", variant) : "";
    vis::write_pvd(folder_.path() / fmt::format("{}{}.pvd", name, suffix), entries);
  }
}

void FrameWriter::write_series() const {
  write_series("grass", "texel");
  write_series("grass_optics", "optics");
  write_series("grass_points", "points");
  write_series("grass_blades", "blades");
}

}  // namespace witherfield::cli
