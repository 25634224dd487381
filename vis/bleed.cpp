#include "vis/bleed.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "sim/core/parallel.hpp"
#include "vis/block_codec.hpp"

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

/// Voxels of a brick that touch the brick in the middle, for each of the 27.
constexpr std::array<std::uint64_t, 27> kTouching = [] {
  std::array<std::uint64_t, 27> masks{};
  for (const PaddedVoxel v : kPaddedVoxels) masks[v.brick] |= std::uint64_t(1) << v.local;
  return masks;
}();

constexpr float kNoDensity[kVoxels] = {};

/// Labels are kept as they are: rounding would merge neighbouring blade ids above 2048.
bool is_label(TexelChannel c) {
  return c == TexelChannel::blade_id || c == TexelChannel::tissue;
}

// Keys order voxels by density (to 15 bits of mantissa), then by position: of equally dense ones the first in
// the grid's order wins. The low 8 bits of a density's pattern are replaced by 255 - position; the bits of
// positive floats are ordered as the numbers are, so keys are compared as floats. 0 = empty.
int position_of(float key) {
  return 255 - static_cast<int>(std::bit_cast<std::uint32_t>(key) & 0xFFu);
}

float larger(float a, float b) {
  return a > b ? a : b;
}  // one instruction, four at a time

void gather_keys(const float* const (&density)[27], float (&key)[kPadded]) {
  for (int row = 0; row < kPad * kPad; ++row) {
    const PaddedVoxel first =
        kPaddedVoxels[std::size_t(row * kPad)];  // last voxel of its row, in the brick at -x
    float* k = key + row * kPad;
    k[0] = density[first.brick][first.local];
    std::copy_n(density[first.brick + 1] + first.local - 3, kEdge, k + 1);
    k[kPad - 1] = density[first.brick + 2][first.local - 3];
  }
  for (int p = 0; p < kPadded; ++p) {
    const std::uint32_t bits = (std::bit_cast<std::uint32_t>(key[p]) & ~0xFFu) | std::uint32_t(255 - p);
    key[p] = std::bit_cast<float>(key[p] > 0 ? bits : 0u);
  }
}

/// Largest key among the 27 voxels around each of the brick's 64: maxima along x, then y, then z.
void largest_around(const float (&key)[kPadded], float (&best)[kVoxels]) {
  constexpr int kRow = kEdge, kPlane = kEdge * kEdge;
  float along_x[kPad * kPad * kRow], along_xy[kPad * kPlane];
  for (int row = 0; row < kPad * kPad; ++row)
    for (int x = 0; x < kEdge; ++x) {
      const float* k = key + row * kPad + x;
      along_x[row * kRow + x] = larger(larger(k[0], k[1]), k[2]);
    }
  for (int z = 0; z < kPad; ++z) {
    const float* k = along_x + z * kPad * kRow;
    for (int i = 0; i < kPlane; ++i)
      along_xy[z * kPlane + i] = larger(larger(k[i], k[i + kRow]), k[i + 2 * kRow]);
  }
  for (int i = 0; i < kVoxels; ++i)
    best[i] = larger(larger(along_xy[i], along_xy[i + kPlane]), along_xy[i + 2 * kPlane]);
}

/// Appends the brick at `cell` to the layer unless it stays empty.
void add_brick(const PackedVoxels& voxels, glm::ivec3 cell, BleedMap::Layer& layer) {
  const TexelGrid& grid = voxels.grid();
  int brick[27];
  const float* density[27];
  std::uint64_t touching = 0;
  for (int n = 0; n < 27; ++n) {
    const int x = cell.x + n % 3 - 1, y = cell.y + n / 3 % 3 - 1, z = cell.z + n / 9 - 1;
    const bool inside =
        x >= 0 && y >= 0 && z >= 0 && x < grid.bricks_x() && y < grid.bricks_y() && z < grid.bricks_z();
    brick[n] = inside ? grid.brick_at((z * grid.bricks_y() + y) * grid.bricks_x() + x) : -1;
    density[n] = brick[n] >= 0 ? voxels.density(brick[n]) : kNoDensity;
    if (brick[n] >= 0) touching |= voxels.mask(brick[n]) & kTouching[std::size_t(n)];
  }
  if (!touching) return;
  float key[kPadded], best[kVoxels];
  gather_keys(density, key);
  largest_around(key, best);

  const std::uint64_t filled = brick[13] >= 0 ? voxels.mask(brick[13]) : 0;
  BleedMap::Brick out{cell.x, static_cast<std::uint32_t>(layer.codes.size()), 0};
  for (int v = 0; v < kVoxels; ++v) out.mask |= std::uint64_t(best[v] != 0) << v;
  for (std::uint64_t bits = out.mask; bits; bits &= bits - 1) {
    const int v = std::countr_zero(bits);
    if (filled >> v & 1) {
      layer.codes.push_back(static_cast<std::int32_t>(voxels.number(brick[13], v)));
    } else {
      const PaddedVoxel source = kPaddedVoxels[std::size_t(position_of(best[v]))];
      layer.codes.push_back(~static_cast<std::int32_t>(voxels.number(brick[source.brick], source.local)));
    }
  }
  layer.bricks.push_back(out);
}

/// Marks the bricks of row (by, bz) that have a brick among their 26 neighbours or are one; near[bx + 1].
bool mark_near(const TexelGrid& grid, const std::vector<std::int32_t>& in_row, int by, int bz,
               std::vector<std::uint8_t>& near) {
  const int nx = grid.bricks_x(), ny = grid.bricks_y(), nz = grid.bricks_z();
  std::fill(near.begin(), near.end(), std::uint8_t{0});
  bool any = false;
  for (int z = std::max(bz - 1, 0); z <= std::min(bz + 1, nz - 1); ++z)
    for (int y = std::max(by - 1, 0); y <= std::min(by + 1, ny - 1); ++y) {
      if (!in_row[std::size_t(z * ny + y)]) continue;
      any = true;
      for (int x = 0; x < nx; ++x)
        if (grid.brick_at((z * ny + y) * nx + x) >= 0) std::fill_n(near.begin() + x, 3, std::uint8_t{1});
    }
  return any;
}

}  // namespace

PackedVoxels::PackedVoxels(const TexelGrid& grid)
    : grid_(&grid),
      mask_(static_cast<std::size_t>(grid.brick_count())),
      first_(mask_.size() + 1, 0),
      density_(mask_.size() * kVoxels) {
  parallel_for(mask_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const float* from = grid.channel(static_cast<int>(b), TexelChannel::density);
      std::copy_n(from, kVoxels, density_.data() + b * kVoxels);
      for (int v = 0; v < kVoxels; ++v) mask_[b] |= std::uint64_t(from[v] > 0) << v;
    }
  });
  for (std::size_t b = 0; b < mask_.size(); ++b)
    first_[b + 1] = first_[b] + static_cast<std::uint32_t>(std::popcount(mask_[b]));
}

std::uint32_t PackedVoxels::number(int brick, int voxel) const {
  const std::uint64_t before = mask_[std::size_t(brick)] & ((std::uint64_t(1) << voxel) - 1);
  return first_[std::size_t(brick)] + static_cast<std::uint32_t>(std::popcount(before));
}

std::vector<std::vector<float>> PackedVoxels::values(std::span<const TexelChannel> channels) const {
  std::vector<std::vector<float>> out(channels.size(), std::vector<float>(count()));
  parallel_for(mask_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      for (std::size_t c = 0; c < channels.size(); ++c) {
        const float* from = grid_->channel(static_cast<int>(b), channels[c]);
        const bool rounded = !is_label(channels[c]);
        float* to = out[c].data() + first_[b];
        for (std::uint64_t bits = mask_[b]; bits; bits &= bits - 1) {
          const float value = from[std::countr_zero(bits)];
          *to++ = rounded ? round_mantissa(value) : value;
        }
      }
  });
  return out;
}

BleedMap::BleedMap(const PackedVoxels& voxels) : layers_(static_cast<std::size_t>(voxels.grid().bricks_z())) {
  const TexelGrid& grid = voxels.grid();
  const int nx = grid.bricks_x(), ny = grid.bricks_y();
  // Bricks per row of bricks: rows with nothing around them are passed over.
  std::vector<std::int32_t> in_row(std::size_t(ny) * layers_.size(), 0);
  for (int b = 0; b < grid.brick_count(); ++b) ++in_row[std::size_t(grid.brick_cell(b) / nx)];

  parallel_for(layers_.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> near(std::size_t(nx) + 2);
    for (std::size_t bz = begin; bz < end; ++bz) {
      Layer& layer = layers_[bz];
      layer.row_start.assign(1, 0);
      for (int by = 0; by < ny; ++by) {
        if (mark_near(grid, in_row, by, static_cast<int>(bz), near))
          for (int bx = 0; bx < nx; ++bx)
            if (near[std::size_t(bx) + 1]) add_brick(voxels, {bx, by, static_cast<int>(bz)}, layer);
        layer.row_start.push_back(static_cast<std::uint32_t>(layer.bricks.size()));
      }
    }
  });
}

}  // namespace witherfield::vis
