// Headless pictures of fields, for analysis: volume rendering or a fast iso-surface, with colour bar, units,
// axes, day and wd.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace witherfield::vis {

struct VolumeOptions {
  std::string field = "water";
  bool surface = false;      ///< iso-surface of density coloured by the field instead of volume rendering
  double iso_density = 0.3;  ///< the surface encloses every sheet of this density or more
  int width_px = 1280, height_px = 720;
  double azimuth_deg = -70, elevation_deg = 18,
         zoom = 1.0;  ///< camera around the data's centre; azimuth from +x counter-clockwise
  std::optional<std::pair<double, double>>
      range;  ///< colour scale; default: run.json's global range beside the file, else the file's own
};

/// Renders one .vti or .vtp to a PNG: points as balls, triangles as they are, an image of one layer (a floor) as a flat
/// sheet, any other image by its density. Densities are drawn as the
/// cubic B-spline of the voxels' values, because a blade is thinner than a voxel; attributes are means over
/// the grass nearby, labels its nearest. Needs no display: EGL surfaceless context, else an X display.
/// @throws IoFailure when the file cannot be read or no rendering context can be made (says what to install
/// or run; never aborts); InvalidInput when the field is not in the file (names those that are).
void render_volume(const std::filesystem::path& input, const std::filesystem::path& png,
                   const VolumeOptions& options);

}  // namespace witherfield::vis
