#include "vis/bleed.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "sim/core/parallel.hpp"

namespace witherfield::vis {
namespace {

constexpr int kEdge = TexelGrid::kEdge, kVoxels = TexelGrid::kVoxels;
constexpr int kPad = kEdge + 2;  // a brick and one voxel around it
constexpr int kPadded = kPad * kPad * kPad;

/// Where a voxel of the padded brick lies: which of the 27 bricks around (13 = the brick itself), and where
/// in it.
struct PaddedVoxel {
  std::uint8_t brick, local;
};
constexpr std::array<PaddedVoxel, kPadded> kPaddedVoxels = [] {
  std::array<PaddedVoxel, kPadded> table{};
  for (int p = 0; p < kPadded; ++p) {
    int brick = 0, local = 0;
    for (const int q : {p / (kPad * kPad), p / kPad % kPad, p % kPad}) {
      brick = brick * 3 + (q + kEdge - 1) / kEdge;
      local = local * kEdge + (q + kEdge - 1) % kEdge;
    }
    table[std::size_t(p)] = {static_cast<std::uint8_t>(brick), static_cast<std::uint8_t>(local)};
  }
  return table;
}();

constexpr float kNoDensity[kVoxels] = {};

/// A key orders voxels by density (to 15 bits of mantissa), then by position: of equally dense ones the first
/// in the grid's order wins. The bits of positive floats are ordered as the numbers are. 0 = empty.
std::int32_t key_of(float density, int padded) {
  return density > 0
             ? std::int32_t((std::bit_cast<std::uint32_t>(density) & ~0xFFu) | std::uint32_t(255 - padded))
             : 0;
}

void gather_keys(const float* const (&density)[27], std::int32_t (&key)[kPadded]) {
  for (int row = 0; row < kPad * kPad; ++row) {
    const PaddedVoxel first =
        kPaddedVoxels[std::size_t(row * kPad)];  // last voxel of its row, in the brick at -x
    const float *left = density[first.brick] + first.local, *own = density[first.brick + 1] + first.local - 3,
                *right = density[first.brick + 2] + first.local - 3;
    const int p = row * kPad;
    key[p] = key_of(*left, p);
    for (int x = 0; x < kEdge; ++x) key[p + 1 + x] = key_of(own[x], p + 1 + x);
    key[p + kPad - 1] = key_of(*right, p + kPad - 1);
  }
}

/// Largest key among the 27 voxels around each of the brick's 64: maxima along x, then y, then z.
void largest_around(const std::int32_t (&key)[kPadded], std::int32_t (&best)[kVoxels]) {
  std::int32_t along_x[kPad * kPad * kEdge], along_xy[kPad * kEdge * kEdge];
  for (int row = 0; row < kPad * kPad; ++row)
    for (int x = 0; x < kEdge; ++x) {
      const std::int32_t* k = key + row * kPad + x;
      along_x[row * kEdge + x] = std::max(std::max(k[0], k[1]), k[2]);
    }
  for (int z = 0; z < kPad; ++z)
    for (int i = 0; i < kEdge * kEdge; ++i) {
      const std::int32_t* k = along_x + z * kPad * kEdge + i;
      along_xy[z * kEdge * kEdge + i] = std::max(std::max(k[0], k[kEdge]), k[2 * kEdge]);
    }
  for (int i = 0; i < kVoxels; ++i)
    best[i] = std::max(std::max(along_xy[i], along_xy[i + kEdge * kEdge]), along_xy[i + 2 * kEdge * kEdge]);
}

/// Appends the brick at `cell` to the layer unless it stays empty.
void add_brick(const TexelGrid& grid, glm::ivec3 cell, BleedMap::Layer& layer) {
  int brick[27];
  const float* density[27];
  for (int n = 0; n < 27; ++n) {
    const int x = cell.x + n % 3 - 1, y = cell.y + n / 3 % 3 - 1, z = cell.z + n / 9 - 1;
    const bool inside =
        x >= 0 && y >= 0 && z >= 0 && x < grid.bricks_x() && y < grid.bricks_y() && z < grid.bricks_z();
    brick[n] = inside ? grid.brick_at((z * grid.bricks_y() + y) * grid.bricks_x() + x) : -1;
    density[n] = brick[n] >= 0 ? grid.channel(brick[n], TexelChannel::density) : kNoDensity;
  }
  std::int32_t key[kPadded], best[kVoxels];
  gather_keys(density, key);
  largest_around(key, best);

  const float* own = density[13];
  BleedMap::Brick out{cell.x, static_cast<std::uint32_t>(layer.codes.size()), 0};
  for (int v = 0; v < kVoxels; ++v) {
    if (!best[v]) continue;
    out.mask |= std::uint64_t(1) << v;
    if (own[v] > 0) {
      layer.codes.push_back(brick[13] * kVoxels + v);
    } else {
      const PaddedVoxel source = kPaddedVoxels[std::size_t(255 - (best[v] & 0xFF))];
      layer.codes.push_back(~(brick[source.brick] * kVoxels + source.local));
    }
  }
  if (out.mask) layer.bricks.push_back(out);
}

}  // namespace

BleedMap::BleedMap(const TexelGrid& grid) : layers_(static_cast<std::size_t>(grid.bricks_z())) {
  const int nx = grid.bricks_x(), ny = grid.bricks_y(), nz = grid.bricks_z();
  // Bricks per row of bricks: rows with nothing around them are passed over.
  std::vector<std::int32_t> in_row(std::size_t(ny) * std::size_t(nz), 0);
  for (int b = 0; b < grid.brick_count(); ++b) ++in_row[std::size_t(grid.brick_cell(b) / nx)];

  parallel_for(layers_.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> near(std::size_t(nx) + 2);
    for (int bz = static_cast<int>(begin); bz < static_cast<int>(end); ++bz) {
      Layer& layer = layers_[std::size_t(bz)];
      layer.row_start.assign(1, 0);
      for (int by = 0; by < ny; ++by) {
        std::fill(near.begin(), near.end(), std::uint8_t{0});
        bool any = false;
        for (int z = std::max(bz - 1, 0); z <= std::min(bz + 1, nz - 1); ++z)
          for (int y = std::max(by - 1, 0); y <= std::min(by + 1, ny - 1); ++y) {
            if (!in_row[std::size_t(z * ny + y)]) continue;
            any = true;
            for (int x = 0; x < nx; ++x)
              if (grid.brick_at((z * ny + y) * nx + x) >= 0)
                near[std::size_t(x)] = near[std::size_t(x) + 1] = near[std::size_t(x) + 2] = 1;
          }
        for (int bx = 0; any && bx < nx; ++bx)
          if (near[std::size_t(bx) + 1]) add_brick(grid, {bx, by, bz}, layer);
        layer.row_start.push_back(static_cast<std::uint32_t>(layer.bricks.size()));
      }
    }
  });
}

}  // namespace witherfield::vis
