#include "sim/terrain/dem_georef.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "sim/core/errors.hpp"

namespace witherfield::terrain {
namespace {

struct MetresPerRadian {
  double east, north;
};

// Arc lengths on the ellipsoid (any textbook of geodesy): N cos(lat) along the parallel and M along the
// meridian, with N = a / sqrt(1 - e^2 sin^2 lat), M = a (1 - e^2) / (1 - e^2 sin^2 lat)^(3/2).
MetresPerRadian metres_per_radian(const OGRSpatialReference& crs, double latitude_rad) {
  const double a = crs.GetSemiMajor(), inverse_flattening = crs.GetInvFlattening();
  const double f = inverse_flattening > 0 ? 1 / inverse_flattening : 0;
  const double e2 = f * (2 - f), w = 1 - e2 * std::sin(latitude_rad) * std::sin(latitude_rad);
  return {a / std::sqrt(w) * std::cos(latitude_rad), a * (1 - e2) / (w * std::sqrt(w))};
}

double elevation_unit_m(GDALRasterBand& band, const std::string& file) {
  const std::string unit = band.GetUnitType() ? band.GetUnitType() : "";
  for (const char* name : {"", "m", "metre", "meter", "metres", "meters"})
    if (EQUAL(unit.c_str(), name)) return 1;
  for (const char* name : {"ft", "foot", "feet"})
    if (EQUAL(unit.c_str(), name)) return 0.3048;
  if (EQUAL(unit.c_str(), "US survey foot") || EQUAL(unit.c_str(), "sft")) return 1200.0 / 3937.0;
  throw InvalidInput(fmt::format(
      "terrain.dem: '{}' gives elevations in '{}'; metres (m) or feet (ft) are expected", file, unit));
}

}  // namespace

bool rows_run_south(GDALDataset& raster) {
  double t[6];
  return raster.GetGeoTransform(t) != CE_None || t[5] < 0;
}

DemGeoref read_georef(GDALDataset& raster, double middle_row, const std::string& file) {
  double t[6];
  if (raster.GetGeoTransform(t) != CE_None)
    throw InvalidInput(
        fmt::format("terrain.dem: '{}' has no georeference, so its cell size is unknown", file));
  for (const double value : t)
    if (!std::isfinite(value))
      throw InvalidInput(fmt::format("terrain.dem: the georeference of '{}' is not finite", file));
  if (std::abs(t[2]) > 1e-9 * std::abs(t[1]) || std::abs(t[4]) > 1e-9 * std::abs(t[5]))
    throw InvalidInput(
        fmt::format("terrain.dem: the grid of '{}' is turned against north; warp it north-up first", file));
  if (t[1] == 0 || t[5] == 0)
    throw InvalidInput(fmt::format("terrain.dem: '{}' has cells of zero area ({} x {})", file, t[1], t[5]));

  DemGeoref out{std::abs(t[1]), std::abs(t[5]), t[1] > 0, t[5] < 0,
                elevation_unit_m(*raster.GetRasterBand(1), file)};
  const OGRSpatialReference* crs = raster.GetSpatialRef();
  if (crs && crs->IsGeographic()) {
    const double radians = crs->GetAngularUnits(), latitude = (t[3] + (middle_row + 0.5) * t[5]) * radians;
    if (std::abs(latitude) > 1.57)
      throw InvalidInput(fmt::format(
          "terrain.dem: '{}' lies at latitude {} deg; a DEM in degrees must lie between the poles", file,
          latitude * 180 / M_PI));
    const MetresPerRadian scale = metres_per_radian(*crs, latitude);
    out.dx_m *= radians * scale.east;
    out.dy_m *= radians * scale.north;
  } else if (crs) {
    out.dx_m *= crs->GetLinearUnits();
    out.dy_m *= crs->GetLinearUnits();
  } else if (out.dx_m < 0.01 && std::abs(t[0]) <= 360 && std::abs(t[3]) <= 90) {
    // A grid without a coordinate system is taken in metres; cells under a centimetre are degrees whose label
    // is lost.
    throw InvalidInput(fmt::format(
        "terrain.dem: '{}' has cells of {} and no coordinate system: it looks like degrees; add a .prj file "
        "or store the coordinate system in the file",
        file, out.dx_m));
  }
  return out;
}

}  // namespace witherfield::terrain
