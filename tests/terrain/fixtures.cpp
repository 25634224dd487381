#include "tests/terrain/fixtures.hpp"

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <fstream>
#include <iomanip>
#include <memory>

namespace witherfield::terrain::test {
namespace {

struct Close {
  void operator()(GDALDataset* d) const { GDALClose(d); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

GDALDriver& driver(const char* name) {
  GDALAllRegister();
  GDALDriver* d = GetGDALDriverManager()->GetDriverByName(name);
  if (!d) throw std::runtime_error(std::string("GDAL driver missing: ") + name);
  return *d;
}

void fill(GDALDataset& data, int nx, int ny, const Height& height) {
  std::vector<double> rows;
  for (int j = ny - 1; j >= 0; --j)
    for (int i = 0; i < nx; ++i) rows.push_back(height(i, j));
  if (data.GetRasterBand(1)->RasterIO(GF_Write, 0, 0, nx, ny, rows.data(), nx, ny, GDT_Float64, 0, 0,
                                      nullptr) != CE_None)
    throw std::runtime_error("cannot fill raster");
}

}  // namespace

void TerrainTest::SetUp() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::temp_directory_path() / ("witherfield_terrain_" + std::to_string(::getpid()) +
                                                      "_" + info->test_suite_name() + "_" + info->name());
  std::filesystem::create_directories(folder_);
}

std::string TerrainTest::write_text(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::string TerrainTest::write_asc(int nx, int ny, double cell_m, const Height& height,
                                   const std::string& name) const {
  std::ofstream out(path(name));
  out << std::setprecision(17) << "ncols " << nx << "\nnrows " << ny
      << "\nxllcorner 0\nyllcorner 0\ncellsize " << cell_m << "\nNODATA_value -9999\n";
  for (int j = ny - 1; j >= 0; --j)
    for (int i = 0; i < nx; ++i) out << height(i, j) << (i + 1 < nx ? ' ' : '\n');
  return path(name);
}

std::string TerrainTest::write_tiff(const Tiff& t, const std::string& name) const {
  Dataset data(driver("GTiff").Create(path(name).c_str(), t.nx, t.ny, 1, GDT_Float64, nullptr));
  double transform[6] = {t.west, t.dx, 0, t.south + t.ny * t.dy, 0, -t.dy};
  if (t.georeferenced) data->SetGeoTransform(transform);
  if (t.epsg) {
    OGRSpatialReference crs;
    crs.importFromEPSG(t.epsg);
    data->SetSpatialRef(&crs);
  }
  if (!t.unit.empty()) data->GetRasterBand(1)->SetUnitType(t.unit.c_str());
  if (t.has_nodata) data->GetRasterBand(1)->SetNoDataValue(t.nodata);
  fill(*data, t.nx, t.ny, t.height);
  return path(name);
}

std::string TerrainTest::write_png(int nx, int ny, const Height& level, bool sixteen_bit) const {
  Dataset memory(driver("MEM").Create("", nx, ny, 1, sixteen_bit ? GDT_UInt16 : GDT_Byte, nullptr));
  fill(*memory, nx, ny, level);
  Dataset png(driver("PNG").CreateCopy(path("dem.png").c_str(), memory.get(), 0, nullptr, nullptr, nullptr));
  return path("dem.png");
}

std::string TerrainTest::write_head_of(const std::string& file, std::uintmax_t bytes,
                                       const std::string& name) const {
  std::filesystem::copy_file(file, path(name), std::filesystem::copy_options::overwrite_existing);
  std::filesystem::permissions(path(name), std::filesystem::perms::owner_all);
  std::filesystem::resize_file(path(name), bytes);
  return path(name);
}

Terrain TerrainTest::from_asc(int nx, int ny, double cell_m, const Height& height) const {
  return load_terrain(dem(write_asc(nx, ny, cell_m, height)));
}

TerrainOptions dem(const std::string& file) {
  TerrainOptions o;
  o.dem = file;
  return o;
}

TerrainOptions mesh(const std::string& file) {
  TerrainOptions o;
  o.mesh = file;
  return o;
}

}  // namespace witherfield::terrain::test
