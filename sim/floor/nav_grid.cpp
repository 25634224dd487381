#include "sim/floor/nav_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::floor {
namespace {
constexpr double kFinest_m = 0.05;
constexpr double kMostCells = 200000;
}  // namespace

NavShape::Spot NavShape::spot(glm::dvec2 p) const {
  const double x = std::clamp((p.x - origin_m.x) / spacing_m - 0.5, 0.0, nx - 1.001);
  const double y = std::clamp((p.y - origin_m.y) / spacing_m - 0.5, 0.0, ny - 1.001);
  const int i = int(x), j = int(y);
  return {std::size_t(j) * std::size_t(nx) + std::size_t(i), float(x - i), float(y - j)};
}

NavGrid::NavGrid(const RoomPlan& plan, double clearance_m) : needed_m_(clearance_m) {
  const Box box = plan.bounds();
  const double margin = kVestibule_m + 0.1;
  const glm::dvec2 size = box.hi - box.lo + 2 * margin;
  shape_.spacing_m = std::max(kFinest_m, std::sqrt(size.x * size.y / kMostCells));
  if (shape_.spacing_m > clearance_m)
    throw InvalidInput("room.outline_m: " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                       " m is too large for gait.clearance_m = " + std::to_string(clearance_m) + " m");
  shape_.nx = int(std::ceil(size.x / shape_.spacing_m));
  shape_.ny = int(std::ceil(size.y / shape_.spacing_m));
  shape_.origin_m = 0.5 * (box.lo + box.hi) - 0.5 * shape_.spacing_m * glm::dvec2(shape_.nx, shape_.ny);
  clearance_m_.resize(shape_.cells());
  wall_m_.resize(shape_.cells());
  parallel_for(std::size_t(shape_.ny), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t i = 0; i < std::size_t(shape_.nx); ++i) {
        const glm::dvec2 p = shape_.centre_m(int(i), int(j));
        const std::size_t cell = j * std::size_t(shape_.nx) + i;
        clearance_m_[cell] = float(plan.open(p) ? plan.clearance_m(p) : -plan.clearance_m(p));
        wall_m_[cell] = float(contains(plan.outline(), p) ? plan.wall_distance_m(p) : 0.0);
      }
  });
  index_.assign(shape_.cells(), -1);
  for (int j = 1; j + 1 < shape_.ny; ++j)  // the outermost cells are never free: neighbours always exist
    for (int i = 1; i + 1 < shape_.nx; ++i)
      if (const std::size_t cell = std::size_t(j) * std::size_t(shape_.nx) + std::size_t(i);
          clearance_m_[cell] >= clearance_m)
        index_[cell] = free_cells_++;
}

bool NavGrid::push_out(glm::dvec2& p) const {
  const double e = 0.5 * shape_.spacing_m;
  for (int attempt = 0; attempt < 4; ++attempt) {
    const double lack = needed_m_ - clearance_m(p);
    if (lack <= 0) return true;
    const glm::dvec2 up{clearance_m(p + glm::dvec2(e, 0)) - clearance_m(p - glm::dvec2(e, 0)),
                        clearance_m(p + glm::dvec2(0, e)) - clearance_m(p - glm::dvec2(0, e))};
    const double steep = glm::length(up);
    if (steep < 1e-6) return false;
    p += up / steep * (lack + 1e-4);
  }
  return clearance_m(p) >= needed_m_ - 0.01;
}

std::ptrdiff_t NavGrid::nearest_free(glm::dvec2 p, double within_m) const {
  std::ptrdiff_t best = -1;
  double best_m = within_m;
  const glm::dvec2 q = (p - shape_.origin_m) / shape_.spacing_m;
  const int reach = int(within_m / shape_.spacing_m) + 1;
  for (int j = std::max(0, int(q.y) - reach); j <= std::min(shape_.ny - 1, int(q.y) + reach); ++j)
    for (int i = std::max(0, int(q.x) - reach); i <= std::min(shape_.nx - 1, int(q.x) + reach); ++i) {
      const std::size_t cell = std::size_t(j) * std::size_t(shape_.nx) + std::size_t(i);
      const double d = glm::distance(p, shape_.centre_m(i, j));
      if (free(cell) && d < best_m) best_m = d, best = std::ptrdiff_t(cell);
    }
  return best;
}

std::vector<char> NavGrid::reachable(std::size_t cell) const {
  std::vector<char> seen(shape_.cells());
  std::vector<std::size_t> stack;
  if (free(cell)) seen[cell] = 1, stack.push_back(cell);
  while (!stack.empty()) {
    const std::size_t at = stack.back();
    stack.pop_back();
    for (const std::size_t next : {at - 1, at + 1, at - std::size_t(shape_.nx), at + std::size_t(shape_.nx)})
      if (free(next) && !seen[next]) seen[next] = 1, stack.push_back(next);
  }
  return seen;
}

}  // namespace witherfield::floor
