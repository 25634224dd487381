#include "pov/floor_text.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "pov/png.hpp"
#include "pov/text.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

/// How a material shines at some gloss. A dull surface spreads its mirror image so far that only the highlight of a wide
/// lobe is left; between, the image fades. (A fine relief of normals would spread it too, but in specks.)
struct Shine {
  double mirror, bumps, specular, roughness;
};

std::string layer(const FloorFiles& files, const Shine& s, const MapArea& area, double grain_m) {
  const glm::dvec2 size = area.size_m();
  Text t;
  t << "pigment{image_map{png \"" << files.albedo << "\" gamma 1.0 interpolate 2}}";
  if (s.bumps > 0) t << " normal{bumps " << s.bumps << " scale " << glm::dvec3(grain_m / size.x, grain_m / size.y, 1) << "}";
  t << " finish{diffuse 1 ambient Fill specular " << s.specular << " roughness " << s.roughness << " reflection{0,"
    << s.mirror << " fresnel on} conserve_energy}";
  return t.str();
}

}  // namespace

FloorFiles write_floor_maps(const std::filesystem::path& folder, const std::string& stem, const FloorMaps& maps) {
  FloorFiles f{stem + "_albedo.png", stem + "_gloss.png", stem + "_height.png"};
  const auto [low, high] = std::minmax_element(maps.relief_m.begin(), maps.relief_m.end());
  f.base_m = *low;
  f.range_m = std::max(1e-4, double(*high) - *low);
  std::vector<float> grey(maps.relief_m.size());
  for (std::size_t k = 0; k < grey.size(); ++k) grey[k] = float((maps.relief_m[k] - f.base_m) / f.range_m);
  write_png_linear(folder / f.albedo, maps.width, maps.height, maps.albedo);
  write_png_grey(folder / f.gloss, maps.width, maps.height, maps.gloss);
  write_png_grey(folder / f.height, maps.width, maps.height, grey);
  return f;
}

std::string floor_texture_text(const FloorFiles& files, const FloorLook& look, const MapArea& area, double unit,
                               const std::string& name) {
  const bool varnish = look.material == FloorMaterial::wood_varnished;
  const glm::dvec2 size = area.size_m();
  Text t;
  // Inner textures stand in the picture's own square: texture_map transforms them along with the pattern.
  t << "#declare " << name << "=texture{image_pattern{png \"" << files.gloss << "\" gamma 1.0 interpolate 2} texture_map{[0 "
    << layer(files, {0.0, 0, 0.04, 0.2}, area, 0.001) << "]\n [0.30 "
    << layer(files, {0.08, 0, 0.12, 0.07}, area, 0.004) << "]\n [0.60 "
    << layer(files, {0.45, 0, 0.06, 0.03}, area, 0.006) << "]\n [0.9 "
    << layer(files, {1.0, varnish ? 0.0035 : 0.002, 0.0, 0.01}, area, 0.08) << "]}\n rotate x*90 scale "
    << glm::dvec3(size.x, 1, size.y) * unit << " translate " << glm::dvec3(area.low_m.x, 0, area.low_m.y) * unit << "}\n";
  return t.str();
}

std::string height_field_text(const FloorFiles& files, const MapArea& area, double unit) {
  const glm::dvec2 size = area.size_m();
  Text t;
  t << "height_field{png \"" << files.height << "\" gamma 1.0 smooth scale " << glm::dvec3(size.x, files.range_m, size.y) * unit
    << " translate " << glm::dvec3(area.low_m.x, files.base_m, area.low_m.y) * unit;
  return t.str();
}

int map_pixels(const FloorLook& look, int picture_px) {
  return look.map_px > 0 ? look.map_px : std::clamp(int(3.2 * picture_px), 256, 4096);
}

void check_still(const Still& s, const std::string& what) {
  const auto check = [&](double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
      throw InvalidInput(what + " '" + s.name + "': " + name + " must be " + std::to_string(low) + " to " +
                         std::to_string(high) + ", got " + std::to_string(value));
  };
  check(s.width_px, 1, 16384, "width_px");
  check(s.height_px, 1, 16384, "height_px");
  check(s.exposure, 0.05, 20, "exposure");
  check(s.camera.fov_deg, 5, 120, "fov_deg");
  check(s.sun.elevation_deg, 1, 90, "sun elevation in degrees");
  if (!(glm::length(s.camera.look_at_m - s.camera.position_m) > 0))
    throw InvalidInput(what + " '" + s.name + "': the camera looks at itself (position equals look_at)");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoFailure("cannot make folder " + folder.string() + ": " + error.message());
}

}  // namespace witherfield::pov
