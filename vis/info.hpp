// What is in a file: arrays, components, ranges, geometry, time. For `witherfield info`.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace witherfield::vis {

struct ArrayInfo {
  std::string name, unit;
  int components = 1;
  double lo = 0, hi = 0;
};
struct FileInfo {
  std::string type;  ///< "image", "points", "mesh", "series"
  std::string length_unit;
  int dimensions[3] = {0, 0, 0};
  double spacing[3] = {0, 0, 0};
  std::int64_t points = 0, cells = 0;
  double bounds[6] = {0, 0, 0, 0, 0, 0};
  double time_days = 0, wd = 0;
  bool has_time = false;
  std::vector<ArrayInfo> arrays;
  std::vector<std::pair<double, std::string>> series;  ///< for .pvd
};
/// .vti, .vtp, .pvd. @throws IoFailure.
FileInfo file_info(const std::filesystem::path& file);

}  // namespace witherfield::vis
