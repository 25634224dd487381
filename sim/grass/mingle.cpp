#include "sim/grass/mingle.hpp"

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

/// A voxel is a pointer to its density; its other channels follow at steps of a brick's 64 floats.
float get(const float* voxel, C c, int component = 0) {
  return voxel[(int(c) + component) * kLanes];
}
void put(float* voxel, C c, float x, int component = 0) {
  voxel[(int(c) + component) * kLanes] = x;
}
glm::vec3 vector(const float* voxel, C first) {
  return {get(voxel, first), get(voxel, first, 1), get(voxel, first, 2)};
}

/// Direction `first` as axial data: principal axis of sum rho v v^T, on the side of the densest contribution.
glm::vec3 mean_axis(const std::vector<const float*>& voxels, const float* densest, C first) {
  float dyad[6] = {};
  for (const float* v : voxels) add_dyad(dyad, get(v, C::density), vector(v, first));
  return principal_axis(dyad, vector(densest, first));
}

/// Adds voxels, all with density > 0 (Jiao et al. 2010, algorithm 2), into one whose channels are still zero.
/// Density is summed in float in the given order; means in double, so that rounding to float keeps them in
/// the range of the contributions. One contribution is copied.
void combine(const std::vector<const float*>& voxels, float density_factor, float* out) {
  if (voxels.empty()) return;
  if (voxels.size() == 1) {
    for (int c = 0; c < kTexelChannels; ++c) out[c * kLanes] = voxels[0][c * kLanes];
    out[0] *= density_factor;
    return;
  }
  float density = 0;
  double weight = 0;
  const float* densest = voxels[0];
  for (const float* v : voxels) {
    density += *v;
    weight += *v;
    if (*v > *densest) densest = v;  // the first one on a tie
  }
  put(out, C::density, density * density_factor);
  for (C c : kMeans) {
    double sum = 0;
    for (const float* v : voxels) sum += double(*v) * get(v, c);
    put(out, c, float(sum / weight));
  }
  for (C c : kOfDensest) put(out, c, get(densest, c));
  for (C c : {C::normal_x, C::tangent_x}) {
    const glm::vec3 axis = mean_axis(voxels, densest, c);
    for (int k = 0; k < 3; ++k) put(out, c, axis[k], k);
  }
}

const float* brick_data(const TexelGrid& grid, int brick) {
  return grid.channel(brick, C::density);
}

/// The voxel at p, or null where there is no brick.
const float* voxel_at(const TexelGrid& grid, glm::ivec3 p) {
  const int brick =
      grid.brick_at(((p.z / kEdge) * grid.bricks_y() + p.y / kEdge) * grid.bricks_x() + p.x / kEdge);
  if (brick < 0) return nullptr;
  return brick_data(grid, brick) + ((p.z % kEdge) * kEdge + p.y % kEdge) * kEdge + p.x % kEdge;
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

glm::ivec3 lane_offset(int lane) {
  return {lane % kEdge, lane / kEdge % kEdge, lane / (kEdge * kEdge)};
}

/// Writes every voxel of every brick of `out` as the combination of what collect(voxel, list) puts
/// into `voxels`.
template <class Collect>
void combine_voxels(TexelGrid& out, float density_factor, const Collect& collect) {
  parallel_for(std::size_t(out.brick_count()), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<const float*> voxels;
    for (std::size_t b = begin; b < end; ++b) {
      const glm::ivec3 base = out.brick_base(int(b));
      float* brick = out.channel(int(b), C::density);
      std::memset(brick, 0, kBrickFloats * sizeof(float));
      for (int lane = 0; lane < kLanes; ++lane) {
        voxels.clear();
        collect(base + lane_offset(lane), voxels);
        combine(voxels, density_factor, brick + lane);
      }
    }
  });
}

/// Writes every brick of `out` as the sum of the bricks that collect(first voxel, list) puts into the list.
template <class Collect>
void combine_bricks(TexelGrid& out, const Collect& collect) {
  constexpr std::size_t bytes = kBrickFloats * sizeof(float);
  parallel_for(std::size_t(out.brick_count()), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<const float*> bricks, voxels;
    for (std::size_t b = begin; b < end; ++b) {
      float* to = out.channel(int(b), C::density);
      bricks.clear();
      collect(out.brick_base(int(b)), bricks);
      if (bricks.size() == 1) {
        std::memcpy(to, bricks.front(), bytes);
        continue;
      }
      std::memset(to, 0, bytes);
      for (int lane = 0; lane < kLanes; ++lane) {
        voxels.clear();
        for (const float* brick : bricks)
          if (brick[lane] > 0) voxels.push_back(brick + lane);
        combine(voxels, 1.0f, to + lane);
      }
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
  combine_bricks(out, [&](glm::ivec3 p, std::vector<const float*>& bricks) {
    for (const TexelGrid* sample : samples)
      if (const float* brick = voxel_at(*sample, p)) bricks.push_back(brick);
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
  // A coarse brick lies over 2 x 2 x 2 fine ones, and the 8 children of a voxel all lie in one of these.
  combine_voxels(out, 0.25f, [&](glm::ivec3 p, std::vector<const float*>& voxels) {
    const float* voxel = voxel_at(grid, 2 * p);
    if (!voxel) return;
    for (int step : {0, 1, kEdge, kEdge + 1, kEdge * kEdge, kEdge * kEdge + 1, kEdge * kEdge + kEdge,
                     kEdge * kEdge + kEdge + 1})
      if (voxel[step] > 0) voxels.push_back(voxel + step);
  });
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
  const auto home = [margin](int i, int tile) { return ((i - margin) % tile + tile) % tile; };
  std::vector<std::uint8_t> marked(cell_count(out), 0);
  for (int b = 0; b < grid.brick_count(); ++b) {
    const float* rho = grid.channel(b, C::density);
    const glm::ivec3 base = grid.brick_base(b);
    for (int l = 0; l < kLanes; ++l) {
      if (!(rho[l] > 0)) continue;
      const int x = home(base.x + lane_offset(l).x, tile_x), y = home(base.y + lane_offset(l).y, tile_y);
      marked[std::size_t((base.z / kEdge * out.bricks_y() + y / kEdge) * out.bricks_x() + x / kEdge)] = 1;
    }
  }
  out.reset_bricks(marked_cells(marked), true);
  // Every place of the grid that is whole tiles away from p.
  const auto copies = [&](glm::ivec3 p, std::vector<const float*>& list) {
    for (int y = (p.y + margin) % tile_y; y < grid.shape().ny; y += tile_y)
      for (int x = (p.x + margin) % tile_x; x < grid.shape().nx; x += tile_x)
        if (const float* voxel = voxel_at(grid, {x, y, p.z})) list.push_back(voxel);
  };
  if (margin % kEdge == 0)  // whole bricks come to lie on whole bricks
    combine_bricks(out, copies);
  else
    combine_voxels(out, 1.0f, [&](glm::ivec3 p, std::vector<const float*>& list) {
      copies(p, list);
      std::erase_if(list, [](const float* voxel) { return !(*voxel > 0); });
    });
  return out;
}

}  // namespace witherfield::grass
