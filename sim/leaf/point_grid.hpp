// Which points are near a place: cells of one size, points sorted by cell. The order of what is found depends on the points only.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::leaf {

class PointGrid {
 public:
  /// @param cell_m side of a cell, > 0.
  PointGrid(std::span<const glm::dvec3> points_m, double cell_m);
  /// Calls visit(index) for all points of the 27 cells around `at`: all that are within cell_m of it, and others.
  template <class Visit>
  void near(const glm::dvec3& at, const Visit& visit) const {
    const std::int64_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto [first, last] = row(x - 1, x + 1, y + dy, z + dz);
        for (std::size_t k = first; k < last; ++k) visit(order_[k]);
      }
  }

 private:
  std::int64_t cell(double v) const;
  /// Points of cells (x0..x1, y, z): neighbours along x are neighbours in the order.
  std::pair<std::size_t, std::size_t> row(std::int64_t x0, std::int64_t x1, std::int64_t y, std::int64_t z) const;
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z);

  double inverse_ = 1;
  std::vector<std::uint64_t> key_;  ///< ascending
  std::vector<int> order_;
};

}  // namespace witherfield::leaf
