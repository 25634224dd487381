// Systematic sampling: the voxels' expected counts are laid end to end, and a comb with teeth one apart,
// shifted by one random offset, picks the points. Each voxel's u in floor(proportion * density + u) is then
// uniform, as erratum E0.2 asks, while the total is off by less than one point; independent u would leave an
// error of sqrt(voxels) points.
#include "sim/grass/points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::grass {
namespace {

using C = TexelChannel;
constexpr int kEdge = TexelGrid::kEdge;
constexpr std::size_t kBricksPerChunk = 64;

/// Four draws; counters are laid out as in Random: {draw, what, index}.
std::array<std::uint32_t, 4> block(std::uint32_t draw, Stream what, std::uint64_t index, std::uint64_t seed) {
  return philox4x32(
      {draw, static_cast<std::uint32_t>(what), std::uint32_t(index), std::uint32_t(index >> 32)},
      {std::uint32_t(seed), std::uint32_t(seed >> 32)});
}

std::uint64_t linear_index(const GridShape& shape, const glm::ivec3& v) {
  return (std::uint64_t(v.z) * std::uint64_t(shape.ny) + std::uint64_t(v.y)) * std::uint64_t(shape.nx) +
         std::uint64_t(v.x);
}

/// Expected points of a voxel, in units of 2^-32: sums of them are exact, whatever the order.
using Expected = std::int64_t;
constexpr int kMostInVoxel = 1 << 17;  // keeps sums over a chunk below 2^63

/// Rounds to the nearest by adding 1.5 * 2^52, whose last bit is worth 1: unlike a conversion, every
/// instruction set has that for several numbers at once, and this runs over all voxels of all bricks. What is
/// not a number of points (negative, too large, not finite) comes out negative or >= kMostInVoxel * 2^32.
Expected expected_points(double proportion, float density) {
  constexpr double kMagic = 0x1.8p52;
  return std::bit_cast<Expected>(proportion * density * 0x1p32 + kMagic) - std::bit_cast<Expected>(kMagic);
}

Expected expected_points_of_brick(const TexelGrid& grid, int brick, double proportion) {
  const float* density = grid.channel(brick, C::density);
  Expected sum = 0, all = 0;
  for (int v = 0; v < TexelGrid::kVoxels; ++v) {
    const Expected e = expected_points(proportion, density[v]);
    sum += e, all |= e;
  }
  for (int v = 0; all >> 49 != 0 && v < TexelGrid::kVoxels; ++v)  // 49 = 17 + 32
    if (const double x = proportion * density[v]; !(x >= 0 && x < kMostInVoxel))
      throw InvalidInput(
          "sample_points: points in one voxel (proportion * density) must be within 0..131072, got " +
          std::to_string(x));
  return sum;
}

glm::vec3 unit_or_zero(float x, float y, float z) {
  const double length = std::sqrt(double(x) * x + double(y) * y + double(z) * z);
  return length > 0 ? glm::vec3(glm::dvec3(x, y, z) / length) : glm::vec3(0.0f);
}

/// What the points of a voxel inherit.
void inherit(const TexelGrid& grid, int brick, int voxel, PointSet& points, std::size_t i) {
  const float* values = grid.channel(brick, C::density) + voxel;
  const auto value = [values](C c) { return values[int(c) * TexelGrid::kVoxels]; };
  points.normal[i] = unit_or_zero(value(C::normal_x), value(C::normal_y), value(C::normal_z));
  points.tangent[i] = unit_or_zero(value(C::tangent_x), value(C::tangent_y), value(C::tangent_z));
  points.blade_id[i] = static_cast<std::int32_t>(value(C::blade_id) + 0.5f);
  points.arc[i] = value(C::arc);
  points.tissue[i] = static_cast<std::uint8_t>(value(C::tissue) + 0.5f);
  points.water[i] = value(C::water);
  points.chlorophyll_ug_cm2[i] = value(C::chlorophyll_ug_cm2);
  points.stress_vein_MPa[i] = value(C::stress_vein_MPa);
  points.stress_mesophyll_MPa[i] = value(C::stress_mesophyll_MPa);
  points.strain_shrink[i] = value(C::strain_shrink);
  points.specular[i] = value(C::specular);
  points.diffuse[i] = {value(C::diffuse_r), value(C::diffuse_g), value(C::diffuse_b)};
}

/// Points of one brick. `sum`: expected points of all voxels before, plus the offset, in units of 2^-32. A
/// voxel gets floor(x + u) points with u = the fraction of the sum so far.
void fill_brick(const TexelGrid& grid, int brick, std::uint64_t& sum, std::uint64_t seed, PointSet& points) {
  const GridShape& shape = grid.shape();
  const float* density = grid.channel(brick, C::density);
  const glm::ivec3 base = grid.brick_base(brick);
  Expected expected[TexelGrid::kVoxels];
  for (int v = 0; v < TexelGrid::kVoxels; ++v) expected[v] = expected_points(points.proportion, density[v]);
  for (int v = 0; v < TexelGrid::kVoxels; ++v) {
    const std::uint64_t before = sum;
    sum += std::uint64_t(expected[v]);
    const std::size_t first = before >> 32, end = sum >> 32;
    if (first == end) continue;
    const glm::ivec3 voxel = base + glm::ivec3(v % kEdge, v / kEdge % kEdge, v / (kEdge * kEdge));
    const std::uint64_t index = linear_index(shape, voxel);
    for (std::size_t i = first; i < end; ++i) {
      const auto bits = block(std::uint32_t(i - first), Stream::point_place, index, seed);
      const glm::dvec3 u(bits[0] * 0x1p-32, bits[1] * 0x1p-32, bits[2] * 0x1p-32);
      points.position_m[i] = shape.origin_m + (glm::dvec3(voxel) + u) * shape.spacing_m;
      points.mass_kg[i] = points.point_mass_kg;
      inherit(grid, brick, v, points, i);
    }
  }
}

}  // namespace

PointSet sample_points(const TexelGrid& grid, double proportion, double point_mass_kg, std::uint64_t seed) {
  if (!(proportion > 0) || !std::isfinite(proportion))
    throw InvalidInput("sample_points: proportion must be > 0 points per unit of density, got " +
                       std::to_string(proportion));
  if (!(point_mass_kg > 0) || !std::isfinite(point_mass_kg))
    throw InvalidInput("sample_points: point_mass_kg must be > 0 kg, got " + std::to_string(point_mass_kg));

  const std::size_t bricks = std::size_t(grid.brick_count());
  const std::size_t chunks = (bricks + kBricksPerChunk - 1) / kBricksPerChunk;
  const auto bricks_of = [bricks](std::size_t c) {
    return std::pair(c * kBricksPerChunk, std::min(bricks, (c + 1) * kBricksPerChunk));
  };
  std::vector<std::uint64_t> sum(chunks + 1, 0);  // before chunk c, in units of 2^-32 points
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      for (auto [b, last] = bricks_of(c); b < last; ++b)
        sum[c + 1] += std::uint64_t(expected_points_of_brick(grid, int(b), proportion));
  });
  sum[0] = block(0, Stream::point_count, 0, seed)[0];  // the offset, uniform in [0, 1)
  for (std::size_t c = 0; c < chunks; ++c) {
    sum[c + 1] += sum[c];
    if (sum[c + 1] >> 32 > 0x7FFFFFFFu)
      throw InvalidInput("sample_points: more than 2^31 - 1 points with proportion " +
                         std::to_string(proportion));
  }

  PointSet points;
  points.resize(sum[chunks] >> 32);
  points.proportion = proportion;
  points.point_mass_kg = point_mass_kg;
  // A disc of this radius has the share of blade surface that one point stands for: spacing^2 / proportion.
  points.radius_m = grid.shape().spacing_m / std::sqrt(proportion * std::numbers::pi);
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      std::uint64_t running = sum[c];
      for (auto [b, last] = bricks_of(c); b < last; ++b) fill_brick(grid, int(b), running, seed, points);
    }
  });
  return points;
}

}  // namespace witherfield::grass
