#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "sim/terrain/patches.hpp"
#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain {
namespace {

constexpr double kLodDither =
    0.05;  // of the distance: neighbouring rings of resolution mix instead of meeting in a line

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void validate(const PlacementOptions& o, const glm::dvec3& camera_m, const glm::dvec3& to_sun) {
  if (o.cells_x < 1 || o.cells_x > 1000 || o.cells_y < 1 || o.cells_y > 1000)
    throw InvalidInput(
        fmt::format("placement: cells_x {} x cells_y {}; 1 to 1000 each are expected", o.cells_x, o.cells_y));
  const double* d = o.lod_distance_m;
  if (!(d[0] >= 0 && d[0] <= d[1] && d[1] <= d[2] && std::isfinite(d[2])))
    throw InvalidInput(
        fmt::format("placement.lod_distance_m: [{}, {}, {}] must be >= 0 m and ascending", d[0], d[1], d[2]));
  if (!(o.height_scale_lo >= 0.1 && o.height_scale_lo <= o.height_scale_hi && o.height_scale_hi <= 3))
    throw InvalidInput(
        fmt::format("placement: height_scale_lo {} and height_scale_hi {} must be ascending within 0.1 to 3",
                    o.height_scale_lo, o.height_scale_hi));
  if (o.variants < 1)
    throw InvalidInput(fmt::format("placement.variants is {}; at least 1 is expected", o.variants));
  if (!(o.patchiness >= 0 && o.patchiness <= 1))
    throw InvalidInput(fmt::format("placement.patchiness is {}; 0 to 1 is expected", o.patchiness));
  if (!(o.patch_m > 0 && std::isfinite(o.patch_m)))
    throw InvalidInput(fmt::format("placement.patch_m is {}; > 0 m is expected", o.patch_m));
  if (!finite(camera_m)) throw InvalidInput("placement: the camera's position is not finite");
  if (!finite(to_sun) || glm::length(to_sun) == 0)
    throw InvalidInput("placement: the direction to the sun must be finite and not zero");
}

// Least-squares plane through the heights of a square's corners: the slopes are the mean differences, the
// centre the mean height.
void stand_on_ground(const Terrain& terrain, double tile_m, TexelInstance& t) {
  const double x = t.cell_i * tile_m, y = t.cell_j * tile_m;
  const double h00 = terrain.height(x, y), h10 = terrain.height(x + tile_m, y);
  const double h01 = terrain.height(x, y + tile_m), h11 = terrain.height(x + tile_m, y + tile_m);
  t.slope_x = (h10 + h11 - h00 - h01) / (2 * tile_m);
  t.slope_y = (h01 + h11 - h00 - h10) / (2 * tile_m);
  t.origin_m = {x, y, (h00 + h10 + h01 + h11) / 4 - (t.slope_x + t.slope_y) * tile_m / 2};
}

int lod_of(double distance_m, const double (&limits)[3]) {
  int lod = 0;
  while (lod < 3 && distance_m >= limits[lod]) ++lod;
  return lod;
}

bool alike(const TexelInstance& a, const TexelInstance& b) {
  return a.variant == b.variant && a.quarter_turns == b.quarter_turns && a.mirrored == b.mirrored;
}

// One of the eight ways to lay a square, drawn from those that differ from the neighbours already laid (west
// and south).
void turn_at_random(TexelInstance& t, const TexelInstance* west, const TexelInstance* south, Random& random) {
  const auto lay = [&](int way) {
    t.quarter_turns = way & 3;
    t.mirrored = way >= 4;
  };
  int free[8], count = 0;
  for (int way = 0; way < 8; ++way) {
    lay(way);
    if ((!west || !alike(t, *west)) && (!south || !alike(t, *south))) free[count++] = way;
  }
  lay(free[std::min(count - 1, int(random.uniform() * count))]);
}

}  // namespace

Placement place_texels(const Terrain& terrain, const PlacementOptions& o, const glm::dvec3& camera_m,
                       const glm::dvec3& to_sun) {
  validate(o, camera_m, to_sun);
  Placement out;
  out.tile_m = terrain.width_m() / o.cells_x;
  out.cells_x = o.cells_x;
  out.cells_y = int(std::min(double(o.cells_y), std::floor(terrain.depth_m() / out.tile_m + 1e-9)));
  if (out.cells_y < 1)
    throw InvalidInput(
        fmt::format("placement.cells_x is {}: a tile of {} m does not fit into the terrain's depth of {} m",
                    o.cells_x, out.tile_m, terrain.depth_m()));
  const std::size_t nx = std::size_t(out.cells_x), n = nx * std::size_t(out.cells_y);
  out.instances.resize(n);
  const glm::dvec3 sun = glm::normalize(to_sun);
  const std::vector<int> variants = patchy_variants(out.cells_x, out.cells_y, out.tile_m, o);
  parallel_for(n, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      TexelInstance& t = out.instances[k];
      t.cell_i = int(k % nx);
      t.cell_j = int(k / nx);
      t.variant = variants[k];
      stand_on_ground(terrain, out.tile_m, t);
      Random random(o.seed, Stream::placement, 2 * k);
      t.height_scale = random.uniform(o.height_scale_lo, o.height_scale_hi);
      const double half = out.tile_m / 2;
      const glm::dvec3 centre = t.origin_m + glm::dvec3(half, half, (t.slope_x + t.slope_y) * half);
      t.distance_m = glm::length(centre - camera_m);
      t.lod = lod_of(t.distance_m * (1 + random.uniform(-kLodDither, kLodDither)), o.lod_distance_m);
      t.sun_visibility = terrain.sun_visibility(centre, sun);
    }
  });
  // Each turn depends on the neighbours': one pass in order, which is cheap.
  for (std::size_t k = 0; k < n; ++k) {
    Random random(o.seed, Stream::placement, 2 * k + 1);
    turn_at_random(out.instances[k], k % nx ? &out.instances[k - 1] : nullptr,
                   k >= nx ? &out.instances[k - nx] : nullptr, random);
  }
  return out;
}

}  // namespace witherfield::terrain
