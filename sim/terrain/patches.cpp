#include "sim/terrain/patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"

namespace witherfield::terrain {
namespace {

double lattice_value(std::uint64_t seed, int octave, std::int64_t i, std::int64_t j) {
  constexpr std::uint64_t mask = (1u << 28) - 1;
  return Random(seed, Stream::noise,
                std::uint64_t(octave) << 56 | (std::uint64_t(j) & mask) << 28 | (std::uint64_t(i) & mask))
      .uniform();
}

// Value noise: random values at the corners of a lattice, blended with the quintic 6 t^5 - 15 t^4 + 10 t^3
// (C2, Perlin 2002).
double value_noise(std::uint64_t seed, int octave, double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double u = fade(x - fx), v = fade(y - fy);
  const auto i = std::int64_t(fx), j = std::int64_t(fy);
  const double south = std::lerp(lattice_value(seed, octave, i, j), lattice_value(seed, octave, i + 1, j), u);
  const double north =
      std::lerp(lattice_value(seed, octave, i, j + 1), lattice_value(seed, octave, i + 1, j + 1), u);
  return std::lerp(south, north, v);
}

// Two octaves on lattices turned against each other, so that patches show no grid. In [0, 1].
double smooth_noise(std::uint64_t seed, double x, double y) {
  constexpr double c = 0.8, s = 0.6;
  return (2 * value_noise(seed, 0, x, y) + value_noise(seed, 1, 2 * (c * x - s * y), 2 * (s * x + c * y))) /
         3;
}

}  // namespace

std::vector<int> patchy_variants(int cells_x, int cells_y, double tile_m, const PlacementOptions& o) {
  const std::size_t nx = std::size_t(cells_x), n = nx * std::size_t(cells_y);
  std::vector<int> variant(n, 0);
  if (o.variants == 1) return variant;
  std::vector<double> score(n);
  parallel_for(n, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double x = (double(k % nx) + 0.5) * tile_m, y = (double(k / nx) + 0.5) * tile_m;
      score[k] = o.patchiness * smooth_noise(o.seed, x / o.patch_m, y / o.patch_m) +
                 (1 - o.patchiness) * Random(o.seed, Stream::variant, k).uniform();
    }
  });
  // By rank, not by value: a blend of the two noises is not uniform, equal shares are.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return score[a] != score[b] ? score[a] < score[b] : a < b; });
  for (std::size_t rank = 0; rank < n; ++rank) variant[order[rank]] = int(rank * std::size_t(o.variants) / n);
  return variant;
}

}  // namespace witherfield::terrain
