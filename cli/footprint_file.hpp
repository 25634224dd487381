// footprints.bin: who stepped where, and the scene he walked by. Written once, used again: docs/formats.md.
#pragma once
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "sim/floor/simulate.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::cli {

class FootprintWriter {
 public:
  /// @param scene_toml the resolved scene. @param visits that the file will hold. @throws IoFailure.
  FootprintWriter(const std::filesystem::path& file, const std::string& scene_toml, const floor::Stretch& visits);
  void write(std::span<const floor::Footprint> prints) { file_.write(prints.data(), prints.size_bytes()); }
  void commit() { file_.commit(); }

 private:
  vis::AtomicFile file_;
};

class FootprintReader {
 public:
  /// @throws IoFailure when the file cannot be read or is not one of ours, or not whole.
  explicit FootprintReader(const std::filesystem::path& file);

  const std::string& scene_toml() const { return scene_toml_; }
  const floor::Stretch& visits() const { return visits_; }
  std::uint64_t count() const { return count_; }
  /// From the first footprint on. The reader must live longer than the source; one source at a time.
  floor::FootprintSource source();

 private:
  std::filesystem::path path_;
  std::ifstream in_;
  std::string scene_toml_;
  floor::Stretch visits_;
  std::uint64_t start_ = 0, count_ = 0, read_ = 0;
  std::vector<floor::Footprint> portion_;
};

}  // namespace witherfield::cli
