#include "cli/object_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/errors.hpp"
#include "vis/atomic_file.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {

ObjectWriter::ObjectWriter(const RunFolder& folder, std::string kind, const scene::ObjectOutput& output,
                           std::vector<FrameRecord> whole)
    : folder_(folder), kind_(std::move(kind)), output_(output), whole_(std::move(whole)) {
  if (!output_.fields && !output_.obj && !output_.ply) return;
  std::error_code error;
  std::filesystem::create_directories(folder_.path() / kind_, error);
  if (error)
    throw IoFailure("cannot make the folder '" + (folder_.path() / kind_).string() + "': " + error.message());
}

void ObjectWriter::write(FrameRecord frame, const Surface& surface, bool last) {
  const auto found = std::find_if(whole_.begin(), whole_.end(),
                                  [&](const FrameRecord& f) { return f.index == frame.index; });
  if (found != whole_.end() && std::all_of(found->files.begin(), found->files.end(), [&](const auto& file) {
        return std::filesystem::exists(folder_.path() / file.second);
      })) {
    frames_.push_back(*found);
    return;
  }
  const auto add = [&](const char* series, const char* extension) {
    frame.files.emplace_back(series, fmt::format("{0}/{0}_{1:04}.{2}", kind_, frame.index, extension));
    return folder_.path() / frame.files.back().second;
  };
  if (output_.fields)
    frame.ranges = vis::write_surface_vtp(
        add(kind_.c_str(), "vtp"), surface, {frame.time_days, frame.wd}, "mm",
        output_.compression == "zlib" ? vis::Compression::zlib : vis::Compression::lz4);
  const bool meshes = last || output_.every_frame;
  if (output_.obj && meshes) vis::write_obj(add("obj", "obj"), surface);
  if (output_.ply && meshes) vis::write_ply(add("ply", "ply"), surface);
  frames_.push_back(std::move(frame));
  vis::write_whole_file(folder_.partial_file(), partial_json(frames_));
}

void ObjectWriter::write_series() const {
  std::vector<std::pair<double, std::string>> entries;
  for (const FrameRecord& f : frames_)
    if (!f.file(kind_).empty()) entries.emplace_back(f.time_days, f.file(kind_));
  if (!entries.empty()) vis::write_pvd(folder_.path() / (kind_ + ".pvd"), entries);
}

}  // namespace witherfield::cli
