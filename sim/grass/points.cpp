#include "sim/grass/points.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::grass {
namespace {

using C = TexelChannel;
constexpr int kEdge = TexelGrid::kEdge;
constexpr int kBricksPerChunk = 64;  // fixed, so that the cut into chunks does not depend on the threads

/// A voxel that gets at least one point.
struct Draw {
  std::int32_t brick;
  std::int32_t voxel;  // local index in the brick
  std::uint32_t count;
};

/// Counters are laid out as in Random: {draw, what, index}. One block holds the draws of a row of four voxels.
std::array<std::uint32_t, 4> block(std::uint32_t draw, Stream what, std::uint64_t index, std::uint64_t seed) {
  return philox4x32(
      {draw, static_cast<std::uint32_t>(what), std::uint32_t(index), std::uint32_t(index >> 32)},
      {std::uint32_t(seed), std::uint32_t(seed >> 32)});
}

glm::ivec3 voxel_of(const TexelGrid& grid, int brick, int voxel) {
  return grid.brick_base(brick) + glm::ivec3(voxel % kEdge, voxel / kEdge % kEdge, voxel / (kEdge * kEdge));
}

std::uint64_t linear_index(const GridShape& shape, const glm::ivec3& v) {
  return (std::uint64_t(v.z) * std::uint64_t(shape.ny) + std::uint64_t(v.y)) * std::uint64_t(shape.nx) +
         std::uint64_t(v.x);
}

/// floor(x + u), u = bits / 2^32: the mean over u is x (erratum E0.2).
std::uint32_t round_at_random(double x, std::uint32_t bits) {
  if (!(x >= 0 && x < 1e6))
    throw InvalidInput("sample_points: points in one voxel (proportion * density) must be within 0..1e6, got " +
                       std::to_string(x));
  return static_cast<std::uint32_t>(x + bits * 0x1p-32);
}

void count_brick(const TexelGrid& grid, int brick, double proportion, std::uint64_t seed,
                 std::vector<Draw>& draws) {
  const float* density = grid.channel(brick, C::density);
  for (int row = 0; row < kEdge * kEdge; ++row) {
    const float* d = density + row * kEdge;
    if (d[0] == 0 && d[1] == 0 && d[2] == 0 && d[3] == 0) continue;
    const std::uint64_t index = linear_index(grid.shape(), voxel_of(grid, brick, row * kEdge)) / kEdge;
    const auto bits = block(0, Stream::point_count, index, seed);
    for (int x = 0; x < kEdge; ++x)
      if (const std::uint32_t n = round_at_random(proportion * d[x], bits[std::size_t(x)]))
        draws.push_back({brick, row * kEdge + x, n});
  }
}

glm::vec3 unit_or_zero(float x, float y, float z) {
  const double length = std::sqrt(double(x) * x + double(y) * y + double(z) * z);
  return length > 0 ? glm::vec3(glm::dvec3(x, y, z) / length) : glm::vec3(0.0f);
}

/// What the points of a voxel inherit.
void inherit(const TexelGrid& grid, const Draw& draw, PointSet& points, std::size_t i) {
  const auto value = [&](C c) { return grid.channel(draw.brick, c)[draw.voxel]; };
  points.normal[i] = unit_or_zero(value(C::normal_x), value(C::normal_y), value(C::normal_z));
  points.tangent[i] = unit_or_zero(value(C::tangent_x), value(C::tangent_y), value(C::tangent_z));
  points.blade_id[i] = static_cast<std::int32_t>(std::lround(value(C::blade_id)));
  points.arc[i] = value(C::arc);
  points.tissue[i] = static_cast<std::uint8_t>(std::lround(value(C::tissue)));
  points.water[i] = value(C::water);
  points.chlorophyll_ug_cm2[i] = value(C::chlorophyll_ug_cm2);
  points.stress_vein_MPa[i] = value(C::stress_vein_MPa);
  points.stress_mesophyll_MPa[i] = value(C::stress_mesophyll_MPa);
  points.strain_shrink[i] = value(C::strain_shrink);
  points.specular[i] = value(C::specular);
  points.diffuse[i] = {value(C::diffuse_r), value(C::diffuse_g), value(C::diffuse_b)};
}

void place(const TexelGrid& grid, const Draw& draw, double mass_kg, std::uint64_t seed, PointSet& points,
           std::size_t first) {
  const GridShape& shape = grid.shape();
  const glm::ivec3 voxel = voxel_of(grid, draw.brick, draw.voxel);
  const std::uint64_t index = linear_index(shape, voxel);
  for (std::uint32_t n = 0; n < draw.count; ++n) {
    const auto bits = block(n, Stream::point_place, index, seed);
    const glm::dvec3 u(bits[0] * 0x1p-32, bits[1] * 0x1p-32, bits[2] * 0x1p-32);
    const std::size_t i = first + n;
    points.position_m[i] = shape.origin_m + (glm::dvec3(voxel) + u) * shape.spacing_m;
    points.mass_kg[i] = mass_kg;
    inherit(grid, draw, points, i);
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
  std::vector<std::vector<Draw>> draws(chunks);
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      for (std::size_t b = c * kBricksPerChunk; b < std::min(bricks, (c + 1) * kBricksPerChunk); ++b)
        count_brick(grid, int(b), proportion, seed, draws[c]);
  });

  std::vector<std::size_t> first(chunks + 1, 0);
  for (std::size_t c = 0; c < chunks; ++c) {
    first[c + 1] = first[c];
    for (const Draw& d : draws[c]) first[c + 1] += d.count;
  }

  PointSet points;
  points.resize(first[chunks]);
  points.proportion = proportion;
  points.point_mass_kg = point_mass_kg;
  // A disc of this radius has the share of blade surface that one point stands for: spacing^2 / proportion.
  points.radius_m = grid.shape().spacing_m / std::sqrt(proportion * std::numbers::pi);
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      std::size_t i = first[c];
      for (const Draw& d : draws[c]) {
        place(grid, d, point_mass_kg, seed, points, i);
        i += d.count;
      }
    }
  });
  return points;
}

}  // namespace witherfield::grass
