#include "sim/terrain/dem_gdal.hpp"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "sim/core/errors.hpp"
#include "sim/terrain/dem_georef.hpp"

namespace witherfield::terrain {
namespace {

constexpr double kMostCells = 2e8;  // 1.6 GB of samples

// Keeps GDAL from printing in this thread and remembers the first thing that went wrong.
class GdalMessages {
 public:
  GdalMessages() { CPLPushErrorHandlerEx(&GdalMessages::receive, this); }
  ~GdalMessages() { CPLPopErrorHandler(); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;
  std::string first() const { return text_.empty() ? "no reason given" : text_; }

 private:
  static void CPL_STDCALL receive(CPLErr severity, CPLErrorNum, const char* message) {
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure && self->text_.empty()) self->text_ = message;
  }
  std::string text_;
};

struct CloseDataset {
  void operator()(GDALDataset* d) const { GDALClose(d); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

Dataset open_dem(const std::string& file, const GdalMessages& messages) {
  static std::once_flag registered;
  std::call_once(registered, [] {
    GDALRegister_GTiff();
    GDALRegister_AAIGrid();
    GDALRegister_PNG();
  });
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw IoFailure(fmt::format("terrain.dem: file '{}' does not exist", file));
  if (std::filesystem::is_directory(file, ignored))
    throw IoFailure(fmt::format("terrain.dem: '{}' is a folder, not a file", file));
  const char* const drivers[] = {"GTiff", "AAIGrid", "PNG", nullptr};
  const char* const options[] = {"DATATYPE=Float64", nullptr};  // ASCII grids are read in float otherwise
  Dataset data(static_cast<GDALDataset*>(GDALOpenEx(
      file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, drivers, options, nullptr)));
  if (!data)
    throw IoFailure(fmt::format("terrain.dem: cannot read '{}' as GeoTIFF, ESRI ASCII grid or PNG: {}", file,
                                messages.first()));
  return data;
}

// Window of samples that a crop needs: the cells that it touches and one more sample on each side for the
// cubic.
struct Window {
  int first = 0, count = 0;      // in samples counted eastward or northward
  double start = 0, length = 0;  // of the crop, in samples; start counts from `first`
};

Window window_of(int samples, double crop_lo, double crop_hi) {
  const double lo = crop_lo * (samples - 1), hi = crop_hi * (samples - 1);
  const int first = std::max(0, int(std::floor(lo)) - 1),
            last = std::min(samples - 1, int(std::ceil(hi)) + 1);
  return {first, last - first + 1, lo - first, hi - lo};
}

struct Voids {
  std::size_t count = 0;
  int row = 0, column = 0;  // of the first, in the file, counted from 1
};

// NaN, infinity, the declared no-data value, and the two customary ones (-32768 of SRTM, -9999 of ESRI),
// which are no elevation on land.
bool is_void(double value, const std::optional<double>& nodata) {
  return !std::isfinite(value) || (nodata && (value == *nodata || float(value) == float(*nodata))) ||
         value == -32768 || value == -9999;
}

void require_no_voids(const std::vector<double>& raw, int columns, int column0, int row0,
                      const std::optional<double>& nodata, const std::string& file) {
  Voids voids;
  for (std::size_t k = 0; k < raw.size(); ++k) {
    if (!is_void(raw[k], nodata)) continue;
    if (voids.count++) continue;
    voids.row = row0 + int(k / std::size_t(columns)) + 1;
    voids.column = column0 + int(k % std::size_t(columns)) + 1;
  }
  if (voids.count)
    throw InvalidInput(
        fmt::format("terrain.dem: '{}' has {} void cell{} (NaN or no data) in the part used, the first at "
                    "row {}, column {} "
                    "(from 1, row 1 on top); fill them or crop",
                    file, voids.count, voids.count == 1 ? "" : "s", voids.row, voids.column));
}

void require_png_scale(const TerrainOptions& o, GDALDataset& data, bool png) {
  const auto given = [](double v) { return std::isfinite(v) && v > 0; };
  if (png && (!given(o.png_elevation_per_unit_m) || !given(o.png_cell_m)))
    throw InvalidInput(
        fmt::format("terrain.dem: '{}' is a PNG, which has no scale of its own: "
                    "terrain.png_elevation_per_unit_m ({}) and "
                    "terrain.png_cell_m ({}) must both be > 0 m",
                    o.dem, o.png_elevation_per_unit_m, o.png_cell_m));
  if (!png && (o.png_elevation_per_unit_m != 0 || o.png_cell_m != 0))
    throw InvalidInput(fmt::format(
        "terrain.png_elevation_per_unit_m and terrain.png_cell_m are for PNG files; '{}' has its own scale",
        o.dem));
  if (png && (data.GetRasterCount() != 1 || data.GetRasterBand(1)->GetRasterDataType() != GDT_UInt16))
    throw InvalidInput(fmt::format(
        "terrain.dem: '{}' is not a 16-bit grey PNG (256 levels would make steps in the ground)", o.dem));
}

std::vector<double> read_window(GDALRasterBand& band, int column0, int row0, int columns, int rows,
                                const std::string& file, const GdalMessages& messages) {
  if (double(columns) * rows > kMostCells)
    throw InvalidInput(fmt::format("terrain.dem: {} x {} cells of '{}' are more than {}; use terrain.crop",
                                   columns, rows, file, kMostCells));
  std::vector<double> raw(std::size_t(columns) * std::size_t(rows));
  if (band.RasterIO(GF_Read, column0, row0, columns, rows, raw.data(), columns, rows, GDT_Float64, 0, 0,
                    nullptr) != CE_None)
    throw IoFailure(fmt::format("terrain.dem: '{}' is cut off or damaged: {}", file, messages.first()));
  return raw;
}

}  // namespace

DemGrid load_dem(const TerrainOptions& o) {
  const GdalMessages messages;
  const Dataset data = open_dem(o.dem, messages);
  const bool png = std::strcmp(data->GetDriver()->GetDescription(), "PNG") == 0;
  require_png_scale(o, *data, png);
  if (data->GetRasterCount() != 1)
    throw InvalidInput(fmt::format("terrain.dem: '{}' has {} bands; an elevation model has one", o.dem,
                                   data->GetRasterCount()));
  const int nx = data->GetRasterXSize(), ny = data->GetRasterYSize();
  if (nx < 2 || ny < 2)
    throw InvalidInput(fmt::format(
        "terrain.dem: '{}' has {} x {} cells, which span no area; at least 2 x 2 are needed", o.dem, nx, ny));

  const Window wx = window_of(nx, o.crop[0], o.crop[2]), wy = window_of(ny, o.crop[1], o.crop[3]);
  const double middle = wy.first + wy.start + wy.length / 2;
  const DemGeoref place = png ? DemGeoref{o.png_cell_m, o.png_cell_m, true, true, o.png_elevation_per_unit_m}
                              : read_georef(*data, rows_run_south(*data) ? ny - 1 - middle : middle, o.dem);
  const int column0 = place.west_to_east ? wx.first : nx - wx.first - wx.count;
  const int row0 = place.north_to_south ? ny - wy.first - wy.count : wy.first;

  GDALRasterBand& band = *data->GetRasterBand(1);
  const std::vector<double> raw = read_window(band, column0, row0, wx.count, wy.count, o.dem, messages);
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  if (!png)
    require_no_voids(raw, wx.count, column0, row0, has_nodata ? std::optional(nodata) : std::nullopt, o.dem);

  DemGrid grid{wx.count,
               wy.count,
               place.dx_m,
               place.dy_m,
               {},
               wx.start,
               wy.start,
               wx.length * place.dx_m,
               wy.length * place.dy_m};
  grid.z_m.resize(raw.size());
  const double scale = band.GetScale() * place.metres_per_unit,
               offset = band.GetOffset() * place.metres_per_unit;
  for (int j = 0; j < wy.count; ++j)
    for (int i = 0; i < wx.count; ++i) {
      const int row = place.north_to_south ? wy.count - 1 - j : j,
                column = place.west_to_east ? i : wx.count - 1 - i;
      grid.z_m[std::size_t(j) * std::size_t(wx.count) + std::size_t(i)] =
          raw[std::size_t(row) * std::size_t(wx.count) + std::size_t(column)] * scale + offset;
    }
  return grid;
}

}  // namespace witherfield::terrain
