// The ground of a single texel, as in a studio: a small heap of crumbly soil on a pale seamless backdrop, shaded by a
// picture of the light that the grass leaves on it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pov/png.hpp"
#include "pov/texel_scene.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

constexpr int kLightPixels = 768, kSoilPixels = 1536;
constexpr double kHeapTiles = 3.4;     // side of the square that holds the heap
constexpr double kReliefTiles = 0.11;  // full scale of the heap's height field

/// Smooth noise on the plane, mean 0, about +-1.
double noise(double x, double y, std::uint32_t seed) {
  const auto at = [&](int i, int j) {
    return philox4x32({std::uint32_t(i), std::uint32_t(j), seed, 7}, {11, 13})[0] * 0x1p-31 - 1;
  };
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = fade(x - i), v = fade(y - j);
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) + (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

double smoothstep(double lo, double hi, double x) {
  x = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Height of the heap (1 = full scale) at x, y in tiles from the texel's middle, without its crumbs: flat under the grass,
/// then a gentle uneven fall to the floor.
double heap(double x, double y) {
  const double angle = std::atan2(y, x), c = std::cos(angle), s = std::sin(angle);
  // Between a circle and the tile's square: |x|^4 + |y|^4.
  const double r = std::pow(x * x * x * x + y * y * y * y, 0.25) +
                   0.05 * noise(3 * c + 7, 3 * s, 1) + 0.03 * noise(9 * c, 9 * s + 5, 2);
  return 0.75 * (1 - smoothstep(0.45, 1.45, r)) + 0.03 * noise(5 * x, 5 * y, 5) * smoothstep(0.5, 0.8, r);
}

/// The heap with crumbs: overlapping rounded grains, many small and few large, sparser where the heap runs out.
std::vector<float> soil_relief() {
  std::vector<float> h(std::size_t(kSoilPixels) * kSoilPixels);
  const double pixel = kHeapTiles / kSoilPixels;
  parallel_for(kSoilPixels, 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t x = 0; x < kSoilPixels; ++x) {
        const double px = (double(x) + 0.5) * pixel - kHeapTiles / 2, py = (double(y) + 0.5) * pixel - kHeapTiles / 2;
        const double base = heap(px, py);
        h[y * kSoilPixels + x] =
            float(base + (base > 0.01 ? 0.025 * noise(30 * px, 30 * py, 3) + 0.015 * noise(70 * px, 70 * py, 4) : 0));
      }
  });
  constexpr int kGrains = 70000;
  for (int g = 0; g < kGrains; ++g) {
    Random r(0x5011, Stream::noise, std::uint64_t(g));
    const double x = r.uniform(-1.65, 1.65), y = r.uniform(-1.65, 1.65), base = heap(x, y);
    const double radius = 0.0022 * std::pow(r.uniform(0.02, 1.0), -0.55);  // tiles
    const double keep = r.uniform();
    if (base < 0.02 ? keep > 0.3 * std::exp(-9 * std::max(0.0, std::hypot(x, y) - 1.3)) : keep > 0.9) continue;
    const double rise = radius / kReliefTiles * r.uniform(0.5, 1.0), sink = r.uniform(0.2, 0.7);
    const double squeeze = r.uniform(0.7, 1.0), turn = r.uniform(0, std::numbers::pi);
    const int reach = int(radius / pixel) + 2, cx = int((x + kHeapTiles / 2) / pixel), cy = int((y + kHeapTiles / 2) / pixel);
    for (int j = std::max(0, cy - reach); j <= std::min(kSoilPixels - 1, cy + reach); ++j)
      for (int i = std::max(0, cx - reach); i <= std::min(kSoilPixels - 1, cx + reach); ++i) {
        const double dx = (i + 0.5) * pixel - kHeapTiles / 2 - x, dy = (j + 0.5) * pixel - kHeapTiles / 2 - y;
        const double u = dx * std::cos(turn) + dy * std::sin(turn), v = (dy * std::cos(turn) - dx * std::sin(turn)) / squeeze;
        const double d = (u * u + v * v) / (radius * radius) * (1 + 0.35 * noise(dx / radius * 2, dy / radius * 2, std::uint32_t(g)));
        if (d >= 1) continue;
        float& height = h[std::size_t(j) * kSoilPixels + std::size_t(i)];
        height = std::max(height, float(base + rise * (std::sqrt(1 - d) - sink)));
      }
  }
  return h;
}

double luminance(const glm::dvec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; }

/// Picture of missing light on the ground around the texel, 0 = none missing; rows from the top (north).
std::vector<float> missing_light(const TexelPrelight& light, const Illumination& sun, double low, double side, bool with_beam) {
  std::vector<glm::dvec3> points;
  for (int j = kLightPixels - 1; j >= 0; --j)
    for (int i = 0; i < kLightPixels; ++i)
      points.push_back({low + (i + 0.5) / kLightPixels * side, low + (j + 0.5) / kLightPixels * side, 0});
  const std::vector<float> sky = sky_visibility(light.block(), light.per_density(), points, 0);
  const OpticalDepth depth(light.block(), sun.to_sun, light.per_density());
  const double beam = with_beam ? luminance(sun.sun_rgb) * sun.to_sun.z : 0, dome = luminance(sun.sky_rgb);
  std::vector<float> dark(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double t = with_beam ? std::exp(-depth.at(points[i])) : 1.0;
      dark[i] = float(1 - (beam * t + dome * sky[i]) / (beam + dome));
    }
  });
  return dark;
}

}  // namespace

std::string studio_text(const SceneContext& c, const TexelPrelight& light, bool with_beam) {
  const double tile = c.input->tile_m;
  const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
  const double height = light.block().nz * light.block().spacing_m;
  const double shadow = std::min(4 * tile, height * std::hypot(sun.to_sun.x, sun.to_sun.y) / sun.to_sun.z);
  const double side = 2 * tile + 2 * shadow + height, low = tile / 2 - side / 2;
  write_png_grey(c.folder / (c.stem + "_shade.png"), kLightPixels, kLightPixels,
                 missing_light(light, sun, low, side, with_beam));
  write_png_grey(c.folder / (c.stem + "_soil.png"), kSoilPixels, kSoilPixels, soil_relief());

  const double s = side * c.unit, heap_side = kHeapTiles * kUnitsPerTile, relief = kReliefTiles * kUnitsPerTile;
  const double corner = 0.5 * kUnitsPerTile - heap_side / 2, floor = -0.74 * relief;
  const glm::dvec3 sky = c.day->sky_rgb;
  const auto soil = [&](double scale, double diffuse, const glm::dvec3& emission) {
    return (Text() << "pigment{granite scale " << 3.1 * scale << " color_map{[0 rgb<0.030,0.020,0.012>][0.45 rgb<0.062,0.042,0.025>]"
                   << "[0.8 rgb<0.105,0.075,0.047>][1 rgb<0.19,0.145,0.10>]}} normal{granite 0.25 scale " << 0.4 * scale
                   << "} finish{diffuse " << diffuse << " emission rgb" << emission << "}")
        .str();
  };
  const auto paper = [&](double diffuse, const glm::dvec3& emission) {
    return (Text() << "pigment{rgb" << kBackdrop << "} finish{diffuse " << diffuse << " emission rgb" << emission << "}").str();
  };
  // Fully shaded, a spot still gets a little light from the grass and the backdrop.
  const double dark_beam = with_beam ? 0 : 1;
  const glm::dvec3 dark_sky = sky * 0.08;
  const auto shaded = [&](const std::string& name, const std::string& lit, const std::string& dark) {
    return (Text() << "#declare " << name << "=texture{image_pattern{png \"" << c.stem
                   << "_shade.png\" gamma 1.0 once interpolate 2} texture_map{[0 " << lit << "][1 " << dark
                   << "]} rotate x*90 scale " << s << " translate <" << low * c.unit << ",0," << low * c.unit << ">}\n")
        .str();
  };
  Text t;
  // texture_map's textures are scaled with the picture: their own scale undoes it.
  t << shaded("Soil", soil(1 / s, 1, sky), soil(1 / s, dark_beam, dark_sky))
    << shaded("Paper", paper(1, sky), paper(dark_beam, dark_sky * 2.0))
    << "object{height_field{png \"" << c.stem << "_soil.png\" gamma 1.0 smooth water_level 0.012 scale <" << heap_side << ","
    << relief << "," << heap_side << ">} translate <" << corner << "," << floor << "," << corner << "> texture{Soil}}\n"
    // Far off the floor takes on the wall's brightness.
    << "plane{y," << floor + 0.01 * relief << " texture{spherical texture_map{[0 pigment{rgb" << backdrop_rgb(c)
    << "} finish{diffuse 0 emission 1}][0.75 Paper]} scale " << 12 * kUnitsPerTile << " translate <"
    << 0.5 * kUnitsPerTile << ",0," << 0.5 * kUnitsPerTile << ">}}\n";
  return t.str();
}

}  // namespace witherfield::pov
