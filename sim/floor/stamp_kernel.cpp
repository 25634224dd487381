#include "sim/floor/stamp_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace witherfield::floor {
namespace {

constexpr int kWidth = StampSet::kWidth;
constexpr std::size_t kAhead = 6;  // placements to fetch before their turn

/// `now` moved up by one lane, the last of `before` in front.
template <class Vector>
[[gnu::always_inline]] inline void shift_in(const Vector& before, const Vector& now, Vector& out) {
  if constexpr (sizeof(Vector) == 16)
    out = __builtin_shufflevector(before, now, 3, 4, 5, 6);
  else if constexpr (sizeof(Vector) == 32)
    out = __builtin_shufflevector(before, now, 7, 8, 9, 10, 11, 12, 13, 14);
  else
    out = __builtin_shufflevector(before, now, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
}

/// A strip's row, each cell mixed with its left neighbour.
template <class Vector>
struct Mixed {
  static constexpr int kLanes = int(sizeof(Vector) / sizeof(float)), kParts = kWidth / kLanes;
  Vector part[kParts];

  [[gnu::always_inline]] void set(const float* cells, float left_of_first, const ReadyStamp& r) {
    Vector before = Vector{} + left_of_first;
    for (int p = 0; p < kParts; ++p) {
      Vector here, left;
      std::memcpy(&here, cells + p * kLanes, sizeof(Vector));
      shift_in(before, here, left);
      part[p] = r.right * here + r.left * left;
      before = here;
    }
  }
};

/// A strip's rows [begin, end) to rows that are `stride` apart (negative when mirrored): each mixed with the row below.
template <class Vector, int Targets>
[[gnu::always_inline]] inline void add_rows(const float* cells, const float* left, int begin, int end,
                                            std::ptrdiff_t stride, const ReadyStamp& r, const float (&scale)[3],
                                            float* const (&target)[3]) {
  constexpr int kLanes = Mixed<Vector>::kLanes;
  const float upper = Targets == 1 ? scale[0] * r.upper : r.upper, lower = Targets == 1 ? scale[0] * r.lower : r.lower;
  Mixed<Vector> row, below{};
  if (begin > 0) below.set(cells + (begin - 1) * kWidth, left[begin - 1], r);
  float* to[3] = {target[0], target[1], target[2]};
  for (int k = begin; k < end; ++k) {
    row.set(cells + k * kWidth, left[k], r);
    for (int p = 0; p < Mixed<Vector>::kParts; ++p) {
      const Vector v = upper * row.part[p] + lower * below.part[p];
      for (int t = 0; t < Targets; ++t) {
        Vector sum;
        std::memcpy(&sum, to[t] + p * kLanes, sizeof(Vector));
        sum += Targets == 1 ? v : scale[t] * v;
        std::memcpy(to[t] + p * kLanes, &sum, sizeof(Vector));
      }
    }
    below = row;
    for (int t = 0; t < Targets; ++t) to[t] += stride;
  }
}

template <class Vector, int Targets>
[[gnu::always_inline]] inline void add_all(std::span<const Placement> all, const std::uint32_t* order, std::size_t n,
                                           const StampPass& pass, const StampTile& tile) {
  for (std::size_t m = 0; m < n; ++m) {
    if (m + kAhead < n) __builtin_prefetch(&all[order[m + kAhead]]);
    const Placement& p = all[order[m]];
    const StampSet& set = (*pass.shapes)[p.shape];
    const ReadyStamp r = ready(p);
    float scale[3] = {0, 0, 0};
    for (int t = 0; t < Targets; ++t) scale[t] = p.scale[std::size_t(pass.targets[std::size_t(t)].scale)];
    // The mirror image of a mask, turned by a, is the mirror image of (the mask turned by -a).
    for (const StampSet::Strip& s : set.strips(p.mirrored && p.angle > 0 ? set.angles() - p.angle : p.angle)) {
      const int column = r.column + s.column - tile.x0;
      if (column <= -kWidth || column >= tile.width) continue;
      // Rows within the tile; mirrored, they run downward.
      const int first = (p.mirrored ? r.row + 1 - s.row : r.row + s.row) - tile.y0;
      const int begin = std::max(p.mirrored ? first - tile.height + 1 : -first, 0);
      const int end = std::min(p.mirrored ? first + 1 : tile.height - first, int(s.rows));
      if (begin >= end) continue;
      const float* cells = set.data() + s.first;
      const int row = p.mirrored ? first - begin : first + begin;
      const std::ptrdiff_t at = std::ptrdiff_t(row) * tile.stride + kWidth + column;
      float* const to[3] = {tile.plane[0] + at, tile.plane[1] + at, tile.plane[2] + at};
      add_rows<Vector, Targets>(cells, cells + s.rows * kWidth, begin, end, p.mirrored ? -tile.stride : tile.stride, r,
                                scale, to);
    }
  }
}

template <class Vector>
[[gnu::always_inline]] inline void add_with(std::span<const Placement> all, const std::uint32_t* order, std::size_t n,
                                            const StampPass& pass, const StampTile& tile) {
  switch (pass.targets.size()) {
    case 1: return add_all<Vector, 1>(all, order, n, pass, tile);
    case 2: return add_all<Vector, 2>(all, order, n, pass, tile);
    default: return add_all<Vector, 3>(all, order, n, pass, tile);
  }
}

using Add = void (*)(std::span<const Placement>, const std::uint32_t*, std::size_t, const StampPass&, const StampTile&);
using Four = float __attribute__((vector_size(16)));

void add_basic(std::span<const Placement> all, const std::uint32_t* order, std::size_t n, const StampPass& pass,
               const StampTile& tile) {
  add_with<Four>(all, order, n, pass, tile);
}

// Compiled for vectors of each width and chosen at start: a width that the processor lacks would be emulated, slowly.
// No contraction to FMA, so each gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__)
using Eight = float __attribute__((vector_size(32)));
using Sixteen = float __attribute__((vector_size(64)));

__attribute__((target("avx2"))) void add_avx2(std::span<const Placement> all, const std::uint32_t* order, std::size_t n,
                                              const StampPass& pass, const StampTile& tile) {
  add_with<Eight>(all, order, n, pass, tile);
}

__attribute__((target("avx512f"))) void add_avx512(std::span<const Placement> all, const std::uint32_t* order,
                                                   std::size_t n, const StampPass& pass, const StampTile& tile) {
  add_with<Sixteen>(all, order, n, pass, tile);
}

Add best() {
  if (__builtin_cpu_supports("avx512f")) return add_avx512;
  return __builtin_cpu_supports("avx2") ? add_avx2 : add_basic;
}
#else
Add best() { return add_basic; }
#endif

}  // namespace

ReadyStamp ready(const Placement& p) {
  const float x = p.x - 0.5f, y = p.y - 0.5f;
  const float i = std::floor(x), j = std::floor(y), fx = x - i;
  // A mirrored stamp's rows run downward: a row and the one below change their parts.
  const float up = p.mirrored ? y - j : 1 - (y - j), low = 1 - up;
  return {int(i), int(j), up, low, 1 - fx, fx};
}

void add_to_tile(std::span<const Placement> all, const std::uint32_t* order, std::size_t n, const StampPass& pass,
                 const StampTile& tile) {
  static const Add add = best();
  add(all, order, n, pass, tile);
}

}  // namespace witherfield::floor
