#include "sim/grass/mingle.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"

namespace witherfield::grass {
namespace {

using C = TexelChannel;
constexpr int kLanes = TexelGrid::kVoxels;
constexpr int kEdge = TexelGrid::kEdge;
constexpr int kBrickFloats = kTexelChannels * kLanes;
constexpr std::size_t kGrain = 16;  // bricks per thread item

/// Channels that are density-weighted means; those that are the densest contribution's.
constexpr C kMeans[] = {C::water,         C::chlorophyll_ug_cm2, C::stress_vein_MPa, C::stress_mesophyll_MPa,
                        C::strain_shrink, C::specular,           C::diffuse_r,       C::diffuse_g,
                        C::diffuse_b};
constexpr C kOfDensest[] = {C::tissue, C::blade_id, C::arc};

const float* lanes(const float* brick, C c) {
  return brick + int(c) * kLanes;
}
float* lanes(float* brick, C c) {
  return brick + int(c) * kLanes;
}

/// What the contributions to one brick have in common, per lane.
struct Shares {
  float density[kLanes];      // summed in the order of the contributions
  double weight[kLanes];      // the same in double, never 0
  int contributions[kLanes];  // with density > 0
  int densest[kLanes];        // the first one on a tie
};

void sum_shares(const std::vector<const float*>& bricks, Shares& s) {
  float greatest[kLanes];
  for (int l = 0; l < kLanes; ++l)
    s.density[l] = greatest[l] = 0, s.weight[l] = 0, s.contributions[l] = s.densest[l] = 0;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const float* rho = lanes(bricks[i], C::density);
    for (int l = 0; l < kLanes; ++l) {
      s.density[l] += rho[l];
      s.weight[l] += rho[l];
      s.contributions[l] += rho[l] > 0 ? 1 : 0;
      s.densest[l] = rho[l] > greatest[l] ? int(i) : s.densest[l];
      greatest[l] = std::max(greatest[l], rho[l]);
    }
  }
  for (int l = 0; l < kLanes; ++l) s.weight[l] = s.weight[l] > 0 ? s.weight[l] : 1;
}

/// Sums in double: with one contribution the product is exact and the quotient gives back x; with more the
/// rounding to float keeps the mean within the range of the contributions.
void mean_channel(const std::vector<const float*>& bricks, const Shares& s, C c, float* out) {
  double sum[kLanes] = {};
  for (const float* brick : bricks) {
    const float *rho = lanes(brick, C::density), *x = lanes(brick, c);
    for (int l = 0; l < kLanes; ++l) sum[l] += double(rho[l]) * double(x[l]);
  }
  float* to = lanes(out, c);
  for (int l = 0; l < kLanes; ++l) to[l] = float(sum[l] / s.weight[l]);
}

/// Direction `first`, first + 1, first + 2 as axial data.
void mean_axis(const std::vector<const float*>& bricks, const Shares& s, C first, float* out) {
  for (int l = 0; l < kLanes; ++l) {
    if (s.contributions[l] == 0) continue;
    const auto vector = [&](std::size_t i) {
      const float* v = lanes(bricks[i], first) + l;
      return glm::vec3(v[0], v[kLanes], v[2 * kLanes]);
    };
    glm::vec3 axis = vector(std::size_t(s.densest[l]));
    if (s.contributions[l] > 1) {
      float dyad[6] = {};
      for (std::size_t i = 0; i < bricks.size(); ++i)
        add_dyad(dyad, lanes(bricks[i], C::density)[l], vector(i));
      axis = principal_axis(dyad, axis);
    }
    for (int k = 0; k < 3; ++k) lanes(out, first)[k * kLanes + l] = axis[k];
  }
}

/// Adds whole bricks voxel by voxel (Jiao et al. 2010, algorithm 2). `out` is one brick and is written in
/// full.
void combine(const std::vector<const float*>& bricks, float density_factor, float* out) {
  Shares s;
  sum_shares(bricks, s);
  std::memset(out, 0, kBrickFloats * sizeof(float));
  for (int l = 0; l < kLanes; ++l) lanes(out, C::density)[l] = s.density[l] * density_factor;
  for (C c : kMeans) mean_channel(bricks, s, c, out);
  for (C c : kOfDensest)
    for (int l = 0; l < kLanes; ++l)
      lanes(out, c)[l] = s.contributions[l] ? lanes(bricks[std::size_t(s.densest[l])], c)[l] : 0.0f;
  mean_axis(bricks, s, C::normal_x, out);
  mean_axis(bricks, s, C::tangent_x, out);
}

const float* brick_data(const TexelGrid& grid, int brick) {
  return grid.channel(brick, C::density);
}

/// A brick put together from voxels of other bricks: voxel (i, j, k) of `to` is voxel map(i, j, k) of `from`;
/// zero where that is outside the grid or in no brick. False when all of it is. The maps here are monotone
/// with steps <= 2.
using Brick = std::array<float, kBrickFloats>;
template <class Map>
bool gather(const TexelGrid& from, const Map& map, Brick& to) {
  const GridShape& g = from.shape();
  int brick_of[kLanes], lane_of[kLanes];
  bool any = false;
  for (int l = 0; l < kLanes; ++l) {
    const glm::ivec3 p = map(l & 3, (l >> 2) & 3, l >> 4);
    const bool inside = p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < g.nx && p.y < g.ny && p.z < g.nz;
    brick_of[l] =
        inside
            ? from.brick_at(((p.z / kEdge) * from.bricks_y() + p.y / kEdge) * from.bricks_x() + p.x / kEdge)
            : -1;
    lane_of[l] = ((p.z & 3) * kEdge + (p.y & 3)) * kEdge + (p.x & 3);
    any |= brick_of[l] >= 0;
  }
  if (!any) return false;
  for (int l = 0; l < kLanes; ++l) {
    const float* source = brick_of[l] < 0 ? nullptr : brick_data(from, brick_of[l]) + lane_of[l];
    const bool air = !source || !(source[0] > 0);
    for (int c = 0; c < kTexelChannels; ++c)
      to[std::size_t(c * kLanes + l)] = air ? 0.0f : source[c * kLanes];
  }
  return true;
}

std::vector<int> marked_cells(const std::vector<std::uint8_t>& marked) {
  std::vector<int> cells;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i]) cells.push_back(int(i));
  return cells;
}

std::size_t cell_count(const TexelGrid& grid) {
  return std::size_t(grid.bricks_x()) * std::size_t(grid.bricks_y()) * std::size_t(grid.bricks_z());
}

/// Writes every brick of `out` as the combination of up to `parts` gathered bricks; part_map(base, part)
/// gives the map of a part.
template <class PartMap>
void combine_parts(const TexelGrid& from, int parts, float density_factor, const PartMap& part_map,
                   TexelGrid& out) {
  parallel_for(std::size_t(out.brick_count()), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Brick> buffer{std::size_t(parts)};
    std::vector<const float*> bricks;
    for (std::size_t b = begin; b < end; ++b) {
      const glm::ivec3 base = out.brick_base(int(b));
      bricks.clear();
      for (int part = 0; part < parts; ++part) {
        Brick& brick = buffer[bricks.size()];
        if (gather(from, part_map(base, part), brick)) bricks.push_back(brick.data());
      }
      combine(bricks, density_factor, out.channel(int(b), C::density));
    }
  });
}

}  // namespace

TexelGrid mingle(const std::vector<const TexelGrid*>& samples) {
  if (samples.empty()) throw InvalidInput("mingle: needs at least one sample, got none");
  const GridShape& shape = samples.front()->shape();
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (!(samples[i]->shape() == shape))
      throw InvalidInput("mingle: sample " + std::to_string(i) + " has " +
                         std::to_string(samples[i]->shape().nx) + " voxels along x of " +
                         std::to_string(samples[i]->shape().spacing_m) +
                         " m; its grid must equal that of sample 0 (" + std::to_string(shape.nx) + " of " +
                         std::to_string(shape.spacing_m) + " m), origin and margin too");
  TexelGrid out(shape);
  std::vector<std::uint8_t> marked(cell_count(out), 0);
  for (const TexelGrid* sample : samples)
    for (int b = 0; b < sample->brick_count(); ++b) marked[std::size_t(sample->brick_cell(b))] = 1;
  out.reset_bricks(marked_cells(marked), true);
  parallel_for(std::size_t(out.brick_count()), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<const float*> bricks;
    for (std::size_t b = begin; b < end; ++b) {
      bricks.clear();
      for (const TexelGrid* sample : samples) {
        const int brick = sample->brick_at(out.brick_cell(int(b)));
        if (brick >= 0) bricks.push_back(brick_data(*sample, brick));
      }
      float* to = out.channel(int(b), C::density);
      if (bricks.size() == 1)
        std::memcpy(to, bricks.front(), kBrickFloats * sizeof(float));
      else
        combine(bricks, 1.0f, to);
    }
  });
  return out;
}

TexelGrid half_resolution(const TexelGrid& grid) {
  GridShape shape = grid.shape();
  for (int n : {shape.nx, shape.ny, shape.nz})
    if (n % 8 != 0)
      throw InvalidInput("half_resolution: voxels along a side must be a multiple of 8, got " +
                         std::to_string(n));
  if (shape.margin % 2 != 0)
    throw InvalidInput("half_resolution: the margin must be an even number of voxels, got " +
                       std::to_string(shape.margin));
  shape.nx /= 2, shape.ny /= 2, shape.nz /= 2, shape.margin /= 2, shape.spacing_m *= 2;
  TexelGrid out(shape);
  std::vector<std::uint8_t> marked(cell_count(out), 0);
  for (int b = 0; b < grid.brick_count(); ++b) {
    const glm::ivec3 coarse = grid.brick_base(b) / (2 * kEdge);
    marked[std::size_t((coarse.z * out.bricks_y() + coarse.y) * out.bricks_x() + coarse.x)] = 1;
  }
  out.reset_bricks(marked_cells(marked), true);
  const auto child = [](glm::ivec3 base, int part) {
    const glm::ivec3 first = 2 * base + glm::ivec3(part & 1, (part >> 1) & 1, part >> 2);
    return [first](int i, int j, int k) { return first + 2 * glm::ivec3(i, j, k); };
  };
  combine_parts(grid, 8, 0.25f, child, out);
  return out;
}

TexelGrid fold_to_tile(const TexelGrid& grid) {
  GridShape shape = grid.shape();
  const int margin = shape.margin, tile_x = shape.nx - 2 * margin, tile_y = shape.ny - 2 * margin;
  for (int tile : {tile_x, tile_y})
    if (tile <= 0 || tile % kEdge != 0)
      throw InvalidInput("fold_to_tile: the tile must be a positive multiple of 4 voxels, got " +
                         std::to_string(tile));
  shape.nx = tile_x, shape.ny = tile_y, shape.margin = 0;
  shape.origin_m.x += margin * shape.spacing_m, shape.origin_m.y += margin * shape.spacing_m;
  TexelGrid out(shape);
  // The tile itself and its copies that reach into the margin, on each side.
  const int reach_x = (margin + tile_x - 1) / tile_x, reach_y = (margin + tile_y - 1) / tile_y;
  const auto home = [](int i, int margin_of, int tile) { return ((i - margin_of) % tile + tile) % tile; };
  std::vector<std::uint8_t> marked(cell_count(out), 0);
  for (int b = 0; b < grid.brick_count(); ++b) {
    const float* rho = grid.channel(b, C::density);
    const glm::ivec3 base = grid.brick_base(b);
    for (int l = 0; l < kLanes; ++l) {
      if (!(rho[l] > 0)) continue;
      const int x = home(base.x + (l & 3), margin, tile_x), y = home(base.y + ((l >> 2) & 3), margin, tile_y);
      marked[std::size_t((base.z / kEdge * out.bricks_y() + y / kEdge) * out.bricks_x() + x / kEdge)] = 1;
    }
  }
  out.reset_bricks(marked_cells(marked), true);
  const int across = 2 * reach_x + 1, parts = across * (2 * reach_y + 1);
  const auto copy = [=](glm::ivec3 base, int part) {
    const glm::ivec3 shift(margin + (part % across - reach_x) * tile_x,
                           margin + (part / across - reach_y) * tile_y, 0);
    return [=](int i, int j, int k) { return base + shift + glm::ivec3(i, j, k); };
  };
  combine_parts(grid, parts, 1.0f, copy, out);
  return out;
}

}  // namespace witherfield::grass
