// The ground of a single texel, as in a studio: a small heap of crumbly soil on a pale seamless backdrop,
// shaded by a picture of the light that the grass leaves on it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pov/png.hpp"
#include "pov/texel_scene.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

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
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

double smoothstep(double lo, double hi, double x) {
  x = std::clamp((x - lo) / (hi - lo), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Height of the heap (1 = full scale) at x, y in tiles from the texel's middle, without its crumbs: flat
/// under the grass, steeper toward its edge, where it dips below the floor.
double heap(double x, double y) {
  const double r = std::hypot(x, y) / 1.4 + 0.05 * noise(2.2 * x + 7, 2.2 * y, 1);
  return 0.75 * (1 - r * r * r * r) + 0.03 * noise(4 * x, 4 * y, 5) * smoothstep(0.4, 0.7, r);
}

struct Soil {
  std::vector<float> height;      ///< 0..1 of the relief
  std::vector<glm::vec3> albedo;  ///< linear
};

/// The heap with crumbs: overlapping rounded grains, many small and few large, each with its own tone; sparse
/// on the floor.
Soil make_soil(int pixels) {
  const glm::vec3 loam(0.052f, 0.034f, 0.020f);  // moist; black loam (ECOSTRESS) is 0.080, 0.047, 0.019
  Soil soil;
  soil.height.resize(std::size_t(pixels) * pixels);
  soil.albedo.assign(soil.height.size(), loam);
  const double pixel = kHeapTiles / pixels;
  parallel_for(std::size_t(pixels), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t x = 0; x < std::size_t(pixels); ++x) {
        const double px = (double(x) + 0.5) * pixel - kHeapTiles / 2,
                     py = (double(y) + 0.5) * pixel - kHeapTiles / 2;
        soil.height[y * pixels + x] = float(std::max(
            0.0, heap(px, py) + 0.03 * noise(30 * px, 30 * py, 3) + 0.02 * noise(70 * px, 70 * py, 4)));
      }
  });
  constexpr int kGrains = 120000;
  for (int g = 0; g < kGrains; ++g) {
    Random r(0x5011, Stream::noise, std::uint64_t(g));
    const double x = r.uniform(-1.65, 1.65), y = r.uniform(-1.65, 1.65), base = std::max(0.0, heap(x, y));
    const double radius = 0.0026 * std::pow(r.uniform(0.03, 1.0), -0.55);  // tiles
    const bool off_heap = base <= 0;
    if (off_heap && r.uniform() > 0.08 * std::exp(-14 * std::max(0.0, std::hypot(x, y) - 1.35))) continue;
    const double rise = radius / kReliefTiles * r.uniform(0.6, 1.1),
                 sink = off_heap ? 0.0 : r.uniform(0.1, 0.7);
    const double squeeze = r.uniform(0.65, 1.0), turn = r.uniform(0, std::numbers::pi);
    const float tone = float(std::exp(0.45 * r.normal())), warm = float(r.uniform(0.9, 1.15));
    const int reach = int(radius / pixel) + 2, cx = int((x + kHeapTiles / 2) / pixel),
              cy = int((y + kHeapTiles / 2) / pixel);
    for (int j = std::max(0, cy - reach); j <= std::min(pixels - 1, cy + reach); ++j)
      for (int i = std::max(0, cx - reach); i <= std::min(pixels - 1, cx + reach); ++i) {
        const double dx = (i + 0.5) * pixel - kHeapTiles / 2 - x, dy = (j + 0.5) * pixel - kHeapTiles / 2 - y;
        const double u = dx * std::cos(turn) + dy * std::sin(turn),
                     v = (dy * std::cos(turn) - dx * std::sin(turn)) / squeeze;
        const double lump = 1 + 0.4 * noise(dx / radius * 1.7, dy / radius * 1.7, std::uint32_t(g));
        const double d = (u * u + v * v) / (radius * radius) * lump;
        if (d >= 1) continue;
        const std::size_t at = std::size_t(j) * pixels + std::size_t(i);
        const float height = float(base + rise * (std::sqrt(1 - d) - sink));
        if (height <= soil.height[at]) continue;
        soil.height[at] = height;
        // Darker toward a grain's foot, where its neighbours shade it.
        soil.albedo[at] = loam * glm::vec3(warm, 1, 1 / warm) * tone * float(0.55 + 0.75 * std::sqrt(1 - d));
      }
  }
  return soil;
}

double luminance(const glm::dvec3& v) {
  return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
}

/// Picture of missing light on the ground around the texel, 0 = none missing; rows from the top (north).
std::vector<float> missing_light(const TexelPrelight& light, const Illumination& sun, double low, double side,
                                 bool with_beam, int pixels) {
  std::vector<glm::dvec3> points;
  for (int j = pixels - 1; j >= 0; --j)
    for (int i = 0; i < pixels; ++i)
      points.push_back({low + (i + 0.5) / pixels * side, low + (j + 0.5) / pixels * side, 0});
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
  // No finer than the picture can show.
  const int soil_pixels = std::clamp(2 * c.input->still.width_px, 128, 1536), shade_pixels = soil_pixels / 2;
  write_png_grey(c.folder / (c.stem + "_shade.png"), shade_pixels, shade_pixels,
                 missing_light(light, sun, low, side, with_beam, shade_pixels));
  const Soil ground = make_soil(soil_pixels);
  write_png_grey(c.folder / (c.stem + "_soil.png"), soil_pixels, soil_pixels, ground.height);
  write_png_linear(c.folder / (c.stem + "_loam.png"), soil_pixels, soil_pixels, ground.albedo);

  const double s = side * c.unit, heap_side = kHeapTiles * kUnitsPerTile,
               relief = kReliefTiles * kUnitsPerTile;
  const double corner = 0.5 * kUnitsPerTile - heap_side / 2, floor = -0.74 * relief;
  const glm::dvec3 sky = c.day->sky_rgb;
  // In the space of the shade picture (unit square in x and y): undoes its scale.
  const double loam_scale = heap_side / s, loam_at = (corner - low * c.unit) / s;
  const auto soil = [&](double diffuse, const glm::dvec3& emission) {
    return (Text() << "pigment{image_map{png \"" << c.stem << "_loam.png\" gamma 1.0 interpolate 2} scale "
                   << loam_scale << " translate <" << loam_at << "," << loam_at
                   << ",0>} normal{granite 0.2 scale " << 0.3 / s << "} finish{diffuse " << diffuse
                   << " emission rgb" << emission << "}")
        .str();
  };
  const auto paper = [&](double diffuse, const glm::dvec3& emission) {
    return (Text() << "pigment{rgb" << kBackdrop << "} finish{diffuse " << diffuse << " emission rgb"
                   << emission << "}")
        .str();
  };
  // Fully shaded, a spot still gets a little light from the grass and the backdrop.
  const double dark_beam = with_beam ? 0 : 1;
  const glm::dvec3 dark_sky = sky * 0.08;
  const auto shaded = [&](const std::string& name, const std::string& lit, const std::string& dark) {
    return (Text() << "#declare " << name << "=texture{image_pattern{png \"" << c.stem
                   << "_shade.png\" gamma 1.0 once interpolate 2} texture_map{[0 " << lit << "][1 " << dark
                   << "]} rotate x*90 scale " << s << " translate <" << low * c.unit << ",0," << low * c.unit
                   << ">}\n")
        .str();
  };
  Text t;
  t << shaded("Soil", soil(1, sky), soil(dark_beam, dark_sky))
    << shaded("Paper", paper(1, sky), paper(dark_beam, dark_sky * 2.0)) << "object{height_field{png \""
    << c.stem << "_soil.png\" gamma 1.0 smooth water_level 0.02 scale <" << heap_side << "," << relief << ","
    << heap_side << ">} translate <" << corner << "," << floor << "," << corner
    << "> texture{Soil}}\n"
    // Far off the floor takes on the wall's brightness.
    << "plane{y," << floor + 0.01 * relief << " texture{spherical texture_map{[0 pigment{rgb"
    << backdrop_rgb(c) << "} finish{diffuse 0 emission 1}][0.75 Paper]} scale " << 12 * kUnitsPerTile
    << " translate <" << 0.5 * kUnitsPerTile << ",0," << 0.5 * kUnitsPerTile << ">}}\n";
  return t.str();
}

}  // namespace witherfield::pov
