// The ground of a single texel: crumbly soil as a height field, shaded by a picture of the light under the grass.
#include <algorithm>
#include <cmath>

#include "pov/png.hpp"
#include "pov/texel_scene.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

constexpr int kLightPixels = 768, kSoilPixels = 1024;

/// Value noise of period n x n cells, smooth (quintic), in [0, 1].
double value_noise(double x, double y, int n, std::uint32_t seed) {
  const auto at = [&](int i, int j) {
    return philox4x32({std::uint32_t(((i % n) + n) % n), std::uint32_t(((j % n) + n) % n), seed, 7}, {11, 13})[0] * 0x1p-32;
  };
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = fade(x - i), v = fade(y - j);
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) + (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

/// Crumbs: octaves of folded noise, coarse ones rounded, fine ones sharp.
std::vector<float> soil_relief() {
  std::vector<float> h(std::size_t(kSoilPixels) * kSoilPixels);
  parallel_for(kSoilPixels, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t x = 0; x < kSoilPixels; ++x) {
        double sum = 0, amplitude = 0.42;
        int cells = 9;
        for (int o = 0; o < 6; ++o, cells = cells * 2 + 1, amplitude *= 0.6) {
          const double v = value_noise(double(x) / kSoilPixels * cells, double(y) / kSoilPixels * cells, cells, std::uint32_t(o));
          sum += amplitude * (o < 2 ? v : 1 - std::abs(2 * v - 1));
        }
        h[y * kSoilPixels + x] = float(std::clamp(sum, 0.0, 1.0));
      }
  });
  return h;
}

}  // namespace

std::string studio_text(const SceneContext& c, const TexelPrelight& light, bool with_beam) {
  const double tile = c.input->tile_m;
  const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
  const double height = light.block().nz * light.block().spacing_m;
  const double shadow = std::min(4 * tile, height * std::hypot(sun.to_sun.x, sun.to_sun.y) / sun.to_sun.z);
  const double side = 2 * tile + 2 * shadow + height, low = tile / 2 - side / 2;
  // --- light on the ground, 0 = all of it, 1 = none
  std::vector<glm::dvec3> points;
  for (int j = kLightPixels - 1; j >= 0; --j)
    for (int i = 0; i < kLightPixels; ++i)
      points.push_back({low + (i + 0.5) / kLightPixels * side, low + (j + 0.5) / kLightPixels * side, 0});
  const std::vector<float> sky = sky_visibility(light.block(), light.per_density(), points, 0);
  const OpticalDepth depth(light.block(), sun.to_sun, light.per_density());
  const auto luminance = [](const glm::dvec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; };
  const double beam = with_beam ? luminance(sun.sun_rgb) * sun.to_sun.z : 0, dome = luminance(sun.sky_rgb);
  std::vector<float> dark(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double t = with_beam ? std::exp(-depth.at(points[i])) : 1.0;
      dark[i] = float(1 - (beam * t + dome * sky[i]) / (beam + dome));
    }
  });
  write_png_grey(c.folder / (c.stem + "_shade.png"), kLightPixels, kLightPixels, dark);
  write_png_grey(c.folder / (c.stem + "_soil.png"), kSoilPixels, kSoilPixels, soil_relief());

  const double s = side * c.unit, relief = 0.035 * kUnitsPerTile;
  const glm::dvec3 sky_rgb = c.day->sky_rgb;
  const auto soil = [&](double scale, double diffuse, const glm::dvec3& emission) {
    Text t;
    t << "pigment{granite scale " << 0.5 * scale << " color_map{[0 rgb<0.052,0.036,0.022>][0.5 rgb<0.115,0.080,0.048>]"
      << "[1 rgb<0.21,0.155,0.10>]}} normal{granite 0.35 scale " << 0.12 * scale << "} finish{diffuse " << diffuse
      << " emission rgb" << emission << "}";
    return t.str();
  };
  Text t;
  t << "#declare Soil=texture{" << soil(0.1 * kUnitsPerTile, 1, sky_rgb) << "}\n"
    << "#declare Shaded=texture{image_pattern{png \"" << c.stem << "_shade.png\" gamma 1.0 once interpolate 2} texture_map{[0 "
    << soil(0.1 * kUnitsPerTile / s, 1, sky_rgb) << "][1 "
    << soil(0.1 * kUnitsPerTile / s, with_beam ? 0 : 1, sky_rgb * 0.06) << "]} rotate x*90 scale " << s
    << " translate <" << low * c.unit << ",0," << low * c.unit << ">}\n";
  // The field sinks by its mean height, so that the grass stands in it.
  t << "#declare Ground=height_field{png \"" << c.stem << "_soil.png\" gamma 1.0 smooth translate -y*0.55 scale <" << s << ","
    << relief << "," << s << "> translate <" << low * c.unit << ",0," << low * c.unit << ">}\n"
    << "object{Ground texture{Shaded}}\n"
    << "#for(I,-2,2) #for(J,-2,2) #if(I!=0|J!=0) object{Ground translate <I*" << s << ",0,J*" << s
    << "> texture{Soil}} #end #end #end\n"
    << "plane{y," << -0.6 * relief << " texture{Soil}}\n"
    << "fog{distance " << 60 * kUnitsPerTile << " color rgb" << c.day->horizon_rgb << " fog_type 2 fog_offset 0 fog_alt "
    << 8 * kUnitsPerTile << "}\n";
  return t.str();
}

}  // namespace witherfield::pov
