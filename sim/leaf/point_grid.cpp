#include "sim/leaf/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace witherfield::leaf {
namespace {
constexpr std::int64_t kOffset = 1 << 20;  // 21 bits a side: cells from -2^20 to 2^20 - 1
}

PointGrid::PointGrid(std::span<const glm::dvec3> points, double cell_m) : inverse_(1 / cell_m) {
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = key(cell(points[i].x), cell(points[i].y), cell(points[i].z));
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    return keys[std::size_t(a)] != keys[std::size_t(b)] ? keys[std::size_t(a)] < keys[std::size_t(b)] : a < b;
  });
  key_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) key_[i] = keys[std::size_t(order_[i])];
}

std::int64_t PointGrid::cell(double v) const {
  return std::clamp(std::int64_t(std::floor(v * inverse_)), -kOffset + 2, kOffset - 3);
}

std::uint64_t PointGrid::key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (std::uint64_t(z + kOffset) << 42) | (std::uint64_t(y + kOffset) << 21) | std::uint64_t(x + kOffset);
}

std::pair<std::size_t, std::size_t> PointGrid::row(std::int64_t x0, std::int64_t x1, std::int64_t y, std::int64_t z) const {
  const auto first = std::lower_bound(key_.begin(), key_.end(), key(x0, y, z));
  const auto last = std::upper_bound(first, key_.end(), key(x1, y, z));
  return {std::size_t(first - key_.begin()), std::size_t(last - key_.begin())};
}

}  // namespace witherfield::leaf
