// Every way in which a DEM can be unusable: the right class of error, naming the key or file.
#include <cmath>
#include <limits>

#include "tests/terrain/fixtures.hpp"

namespace witherfield::terrain::test {
namespace {

using DemErrors = TerrainTest;

double flat(int, int) {
  return 1.0;
}

TEST_F(DemErrors, MissingFile) {
  expect_error<IoFailure>(dem(path("nowhere.tif")), {"terrain.dem", "nowhere.tif", "does not exist"});
}

TEST_F(DemErrors, Folder) {
  expect_error<IoFailure>(dem(path("")), {"folder"});
}

TEST_F(DemErrors, NotARaster) {
  expect_error<IoFailure>(dem(write_text("dem.tif", "this is no GeoTIFF")),
                          {"terrain.dem", "dem.tif", "cannot read"});
  expect_error<IoFailure>(dem(write_text("empty.tif", "")), {"empty.tif"});
}

TEST_F(DemErrors, CutOffGeoTiff) {
  const std::string whole = WITHERFIELD_EXAMPLE_DATA "/jacksboro.tif";
  const auto size = std::filesystem::file_size(whole);
  for (const double part : {0.001, 0.1, 0.5, 0.99})
    expect_error<IoFailure>(dem(write_head_of(whole, std::uintmax_t(double(size) * part), "cut.tif")),
                            {"terrain.dem", "cut.tif"});
}

TEST_F(DemErrors, CutOffAsciiGrid) {
  const std::string whole = WITHERFIELD_EXAMPLE_DATA "/maunga_whau.asc";
  expect_error<IoFailure>(dem(write_head_of(whole, std::filesystem::file_size(whole) / 2, "cut.asc")),
                          {"terrain.dem", "cut.asc"});
  expect_error<IoFailure>(dem(write_head_of(whole, 20, "head.asc")), {"head.asc"});
}

TEST_F(DemErrors, NanCellsAreCountedAndPlaced) {
  Tiff tiff;
  tiff.nx = 5, tiff.ny = 4;
  tiff.height = [](int i, int j) {
    return (i == 3 && j == 2) || (i == 1 && j == 0) ? std::nan("") : 1.0 * i;
  };
  // Row 2 from the south of 4 is row 2 from the top; column 3 from 0 is column 4 from 1.
  expect_error<InvalidInput>(dem(write_tiff(tiff)), {"2 void cells", "row 2, column 4"});
}

TEST_F(DemErrors, NanInAsciiGrid) {
  const std::string text = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 nan 6\n";
  expect_error<InvalidInput>(dem(write_text("nan.asc", text)), {"1 void cell ", "row 2, column 2"});
}

TEST_F(DemErrors, InfiniteCell) {
  Tiff tiff;
  tiff.height = [](int i, int j) { return i + j == 0 ? std::numeric_limits<double>::infinity() : 0.0; };
  expect_error<InvalidInput>(dem(write_tiff(tiff)), {"1 void cell ", "row 3, column 1"});
}

TEST_F(DemErrors, NoDataCells) {
  expect_error<InvalidInput>(dem(write_asc(4, 3, 1, [](int i, int) { return i == 2 ? -9999.0 : 5.0; })),
                             {"3 void cells", "row 1, column 3"});
  Tiff tiff;
  tiff.has_nodata = true;
  tiff.nodata = 0.1;
  tiff.height = [](int i, int j) { return i == 0 && j == 1 ? 0.1 : 3.0; };
  expect_error<InvalidInput>(dem(write_tiff(tiff)), {"1 void cell ", "row 2, column 1"});
  Tiff srtm;  // the void value of SRTM, not declared
  srtm.height = [](int i, int j) { return i == 0 && j == 2 ? -32768 : 3.0; };
  expect_error<InvalidInput>(dem(write_tiff(srtm, "srtm.tif")), {"row 1, column 1"});
}

TEST_F(DemErrors, VoidsOutsideTheCropDoNotMatter) {
  TerrainOptions o = dem(write_asc(21, 21, 1, [](int i, int j) { return i < 4 ? -9999.0 : 1.0 * j; }));
  expect_error<InvalidInput>(o, {"84 void cells"});
  o.crop[0] = 0.5;
  EXPECT_NEAR(load_terrain(o).max_height_m(), 20, 1e-9);
}

TEST_F(DemErrors, PngWithoutScale) {
  TerrainOptions o = dem(write_png(4, 4, flat));
  expect_error<InvalidInput>(o, {"png_elevation_per_unit_m", "png_cell_m"});
  o.png_cell_m = 1;
  expect_error<InvalidInput>(o, {"png_elevation_per_unit_m"});
  o.png_elevation_per_unit_m = -0.1;
  expect_error<InvalidInput>(o, {"-0.1"});
}

TEST_F(DemErrors, PngOfEightBits) {
  TerrainOptions o = dem(write_png(4, 4, flat, false));
  o.png_cell_m = o.png_elevation_per_unit_m = 1;
  expect_error<InvalidInput>(o, {"16-bit"});
}

TEST_F(DemErrors, CutOffPng) {
  const std::string whole =
      write_png(64, 64, [](int i, int j) { return double((i * 7919 + j * 104729) % 65536); });
  TerrainOptions o = dem(write_head_of(whole, std::filesystem::file_size(whole) / 2, "cut.png"));
  o.png_cell_m = o.png_elevation_per_unit_m = 1;
  expect_error<IoFailure>(o, {"cut.png"});
}

TEST_F(DemErrors, PngScaleForAnotherFormat) {
  TerrainOptions o = dem(write_asc(3, 3, 1, flat));
  o.png_cell_m = 2;
  expect_error<InvalidInput>(o, {"png_cell_m"});
}

TEST_F(DemErrors, BothOrNeither) {
  expect_error<InvalidInput>(TerrainOptions{}, {"terrain.dem", "terrain.mesh", "neither"});
  TerrainOptions both = dem("a.tif");
  both.mesh = "b.obj";
  expect_error<InvalidInput>(both, {"a.tif", "b.obj", "both"});
}

TEST_F(DemErrors, Crop) {
  const std::string file = write_asc(5, 5, 1, flat);
  const double bad[][4] = {
      {0.5, 0, 0.5, 1}, {0, 0.7, 1, 0.2}, {-0.1, 0, 1, 1}, {0, 0, 1, 1.5}, {0, 0, std::nan(""), 1}};
  for (const auto& crop : bad) {
    TerrainOptions o = dem(file);
    std::copy(crop, crop + 4, o.crop);
    expect_error<InvalidInput>(o, {"terrain.crop"});
  }
}

TEST_F(DemErrors, WidthAndExaggeration) {
  TerrainOptions o = dem(write_asc(5, 5, 1, flat));
  o.width_m = -1;
  expect_error<InvalidInput>(o, {"terrain.width_m", "-1"});
  o.width_m = 0;
  o.vertical_exaggeration = 0;
  expect_error<InvalidInput>(o, {"terrain.vertical_exaggeration"});
}

TEST_F(DemErrors, NoArea) {
  expect_error<InvalidInput>(dem(write_asc(7, 1, 1, flat)), {"7 x 1", "no area"});
}

TEST_F(DemErrors, NoGeoreference) {
  Tiff tiff;
  tiff.georeferenced = false;
  expect_error<InvalidInput>(dem(write_tiff(tiff)), {"no georeference"});
}

TEST_F(DemErrors, DegreesWithoutLabel) {
  expect_error<InvalidInput>(dem(write_asc(5, 5, 1.0 / 1200, flat)), {"degrees"});
}

TEST_F(DemErrors, UnknownElevationUnit) {
  Tiff tiff;
  tiff.unit = "cubit";
  expect_error<InvalidInput>(dem(write_tiff(tiff)), {"cubit"});
}

TEST_F(DemErrors, NothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  expect_error<IoFailure>(dem(write_text("dem.tif", std::string("II*\0\x08\0\0\0garbage", 15))), {"dem.tif"});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace witherfield::terrain::test
