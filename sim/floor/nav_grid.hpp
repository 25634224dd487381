// The ground on which walkers' middles may be, as a grid: the room, shrunk by their clearance.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "sim/floor/room.hpp"

namespace witherfield::floor {

/// Samples at cell centres with bilinear interpolation; constant beyond the outermost centres.
struct NavShape {
  int nx = 0, ny = 0;
  glm::dvec2 origin_m{0.0};
  double spacing_m = 0;
  std::size_t cells() const { return std::size_t(nx) * std::size_t(ny); }
  glm::dvec2 centre_m(int i, int j) const { return origin_m + spacing_m * glm::dvec2(i + 0.5, j + 0.5); }

  /// Cell whose centre is the lower left of the four around p, and the weights of the upper right.
  struct Spot { std::size_t cell; float fx, fy; };
  Spot spot(glm::dvec2 p) const;
  float sample(const std::vector<float>& values, const Spot& s) const {
    const float* v = values.data() + s.cell;
    const float lower = v[0] + s.fx * (v[1] - v[0]);
    const float upper = v[nx] + s.fx * (v[nx + 1] - v[nx]);
    return lower + s.fy * (upper - lower);
  }
};

class NavGrid {
 public:
  /// @param clearance_m of the middle of a body. @throws InvalidInput when the room is too large for it.
  NavGrid(const RoomPlan& plan, double clearance_m);

  const NavShape& shape() const { return shape_; }
  double clearance_needed_m() const { return needed_m_; }
  bool free(std::size_t cell) const { return index_[cell] >= 0; }
  /// Free cells are numbered row by row; -1 elsewhere.
  const std::vector<int>& index() const { return index_; }
  int free_cells() const { return free_cells_; }

  double clearance_m(glm::dvec2 p) const { return shape_.sample(clearance_m_, shape_.spot(p)); }  ///< < 0 in walls
  const std::vector<float>& wall_distances() const { return wall_m_; }                           ///< per cell
  /// Moves p out of walls and obstacles until its clearance is what is needed. False when it cannot.
  bool push_out(glm::dvec2& p) const;

  /// Nearest free cell to p within `within_m`, or -1.
  std::ptrdiff_t nearest_free(glm::dvec2 p, double within_m) const;
  /// Free cells connected to `cell`, by number of the cell.
  std::vector<char> reachable(std::size_t cell) const;

 private:
  NavShape shape_;
  double needed_m_;
  std::vector<float> clearance_m_, wall_m_;
  std::vector<int> index_;
  int free_cells_ = 0;
};

}  // namespace witherfield::floor
