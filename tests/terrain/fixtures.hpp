// Small terrains made in code, written to a folder of their own that goes away with the test.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain::test {

/// Height of the sample (column from the west, row from the south).
using Height = std::function<double(int, int)>;

struct Tiff {
  int nx = 4, ny = 3;
  Height height = [](int, int) { return 0.0; };
  double west = 0, south = 0, dx = 1, dy = 1;  ///< of the outer edge; units of the coordinate system
  int epsg = 0;                                ///< 0: none
  std::string unit;                            ///< of elevation
  bool has_nodata = false;
  double nodata = 0;
  bool georeferenced = true;
};

class TerrainTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write_text(const std::string& name, const std::string& text) const;
  /// ESRI ASCII grid, cells of cell_m.
  std::string write_asc(int nx, int ny, double cell_m, const Height& height,
                        const std::string& name = "dem.asc") const;
  std::string write_tiff(const Tiff& tiff, const std::string& name = "dem.tif") const;
  /// 16-bit (or 8-bit) grey PNG; rows from the south as everywhere.
  std::string write_png(int nx, int ny, const Height& level, bool sixteen_bit = true) const;
  /// First `bytes` of a file under another name.
  std::string write_head_of(const std::string& file, std::uintmax_t bytes, const std::string& name) const;

  Terrain from_asc(int nx, int ny, double cell_m, const Height& height) const;

 private:
  std::filesystem::path folder_;
};

TerrainOptions dem(const std::string& file);
TerrainOptions mesh(const std::string& file);

/// Loads and expects the exception type with a message that holds every one of `parts`.
template <class Exception>
void expect_error(const TerrainOptions& options, const std::vector<std::string>& parts) {
  try {
    load_terrain(options);
    ADD_FAILURE() << "no error; expected one with '" << parts.front() << "'";
  } catch (const Exception& e) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos)
          << "'" << part << "' is missing in: " << e.what();
  } catch (const std::exception& e) {
    ADD_FAILURE() << "wrong class of error: " << e.what();
  }
}

}  // namespace witherfield::terrain::test
