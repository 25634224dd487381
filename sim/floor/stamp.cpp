#include "sim/floor/stamp.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "sim/core/parallel.hpp"
#include "sim/core/raw_buffer.hpp"
#include "sim/floor/stamp_kernel.hpp"

namespace witherfield::floor {
namespace {

constexpr int kMargin = StampSet::kWidth;

/// Sorted by shape and heading, so that a turned mask is used again while it is in the cache, and then as given: every
/// cell's order is the same whatever the tiles are.
std::vector<Placement> by_heading(std::span<const Placement> all) {
  std::uint32_t shapes = 0, angles = 0;
  for (const Placement& p : all) {
    shapes = std::max<std::uint32_t>(shapes, p.shape + 1u);
    angles = std::max<std::uint32_t>(angles, p.angle + 1u);
  }
  std::vector<std::uint32_t> next(std::size_t(shapes) * angles);
  const auto key = [&](const Placement& p) { return std::size_t(p.shape) * angles + p.angle; };
  for (const Placement& p : all) ++next[key(p)];
  std::uint32_t sum = 0;
  for (std::uint32_t& n : next) sum += std::exchange(n, sum);
  std::vector<Placement> sorted(all.size());
  for (const Placement& p : all) sorted[next[key(p)]++] = p;
  return sorted;
}

/// Placements by tile, in their order.
struct Bins {
  int tiles_x, tiles_y;
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> order;
};

Bins bin(std::span<const Placement> all, int reach, int nx, int ny, TileSize tile) {
  Bins b{(nx + tile.width - 1) / tile.width, (ny + tile.height - 1) / tile.height, {}, {}};
  b.first.assign(std::size_t(b.tiles_x) * std::size_t(b.tiles_y) + 1, 0);
  const auto for_tiles = [&](const Placement& p, const auto& visit) {
    const ReadyStamp r = ready(p);
    if (r.column + reach < 0 || r.row + reach < 0 || r.column - reach >= nx || r.row - reach >= ny) return;
    const int x0 = std::max(r.column - reach, 0) / tile.width, x1 = std::min(r.column + reach, nx - 1) / tile.width;
    const int y0 = std::max(r.row - reach, 0) / tile.height, y1 = std::min(r.row + reach, ny - 1) / tile.height;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) visit(std::size_t(y) * std::size_t(b.tiles_x) + std::size_t(x));
  };
  for (const Placement& p : all) for_tiles(p, [&](std::size_t t) { ++b.first[t + 1]; });
  for (std::size_t t = 1; t < b.first.size(); ++t) b.first[t] += b.first[t - 1];
  b.order.resize(b.first.back());
  std::vector<std::size_t> next(b.first.begin(), b.first.end() - 1);
  for (std::uint32_t n = 0; n < all.size(); ++n) for_tiles(all[n], [&](std::size_t t) { b.order[next[t]++] = n; });
  return b;
}

}  // namespace

void add_stamps(std::span<const Placement> placements, std::span<const StampPass> passes, int nx, int ny, TileSize tile) {
  int reach = 0;
  for (const StampPass& p : passes)
    for (const StampSet& s : *p.shapes) reach = std::max(reach, s.reach());
  const std::vector<Placement> all = by_heading(placements);
  const Bins bins = bin(all, reach, nx, ny, tile);
  const int stride = tile.width + 2 * kMargin;
  const std::size_t plane = std::size_t(stride) * std::size_t(tile.height);
  parallel_for(bins.first.size() - 1, 1, [&](std::size_t begin, std::size_t end) {
    thread_local RawBuffer buffer;
    buffer.require(3 * plane);
    for (std::size_t t = begin; t < end; ++t) {
      const std::size_t count = bins.first[t + 1] - bins.first[t];
      if (count == 0) continue;
      StampTile part{int(t) % bins.tiles_x * tile.width, int(t) / bins.tiles_x * tile.height, 0, 0, stride,
                     {buffer.data(), buffer.data() + plane, buffer.data() + 2 * plane}};
      part.width = std::min(tile.width, nx - part.x0);
      part.height = std::min(tile.height, ny - part.y0);
      for (const StampPass& pass : passes) {
        std::memset(buffer.data(), 0, pass.targets.size() * plane * sizeof(float));
        add_to_tile(all, bins.order.data() + bins.first[t], count, pass, part);
        for (std::size_t k = 0; k < pass.targets.size(); ++k)
          for (int j = 0; j < part.height; ++j) {
            float* to = pass.targets[k].plane + std::size_t(part.y0 + j) * std::size_t(nx) + part.x0;
            const float* from = part.plane[k] + std::size_t(j) * std::size_t(stride) + kMargin;
            for (int i = 0; i < part.width; ++i) to[i] += from[i];
          }
      }
    }
  });
}

}  // namespace witherfield::floor
