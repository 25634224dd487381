// Where a raster's cells lie, in metres. Private to the DEM reader.
#pragma once
#include <string>

class GDALDataset;

namespace witherfield::terrain {

struct DemGeoref {
  double dx_m = 0, dy_m = 0;   ///< between cell centres, > 0
  bool west_to_east = true;    ///< columns run eastward
  bool north_to_south = true;  ///< rows run southward
  double metres_per_unit = 1;  ///< of elevation
};

/// @param middle_row row (may be fractional) whose latitude sets the scale of a geographic raster.
/// @throws InvalidInput naming `file` when there is no georeference, the grid is turned, or a unit is
/// unknown.
DemGeoref read_georef(GDALDataset& raster, double middle_row, const std::string& file);

/// Only the direction of rows, which is needed before the middle row of a crop is known.
bool rows_run_south(GDALDataset& raster);

}  // namespace witherfield::terrain
