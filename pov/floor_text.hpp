// A floor's maps as files, and the POV-Ray texture and height field that read them.
#pragma once
#include <filesystem>
#include <string>

#include "pov/floor_maps.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

struct FloorFiles {
  std::string albedo, gloss, height;      ///< file names
  double base_m = 0, range_m = 1e-4;      ///< grey 0 and full scale of the height picture
};
/// <stem>_albedo.png, _gloss.png, _height.png. @throws IoFailure.
FloorFiles write_floor_maps(const std::filesystem::path& folder, const std::string& stem, const FloorMaps& maps);

/// Declares FloorTexture: dull to mirror by the gloss map, seen from above over the area. Fill must be declared.
std::string floor_texture_text(const FloorFiles& files, const FloorLook& look, const MapArea& area, double unit,
                               const std::string& name = "FloorTexture");
/// "height_field{...", without its end.
std::string height_field_text(const FloorFiles& files, const MapArea& area, double unit);

int map_pixels(const FloorLook& look, int picture_px);
/// @throws InvalidInput: size, camera, exposure, field of view.
void check_still(const Still& still, const std::string& what);
/// @throws IoFailure.
void make_folder(const std::filesystem::path& folder);

}  // namespace witherfield::pov
