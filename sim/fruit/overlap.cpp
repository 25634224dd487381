// How much of the kernels' volume lies in more than one of them: by filling a common grid of voxels, column
// by column.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/fruit/simulate.hpp"

namespace witherfield::fruit {
namespace {

struct Grid {
  glm::dvec3 origin{0};
  double edge = 0;
  int nx = 0, ny = 0, nz = 0;
  std::vector<std::uint8_t> full;
};

struct Counts {
  std::size_t sum = 0, joint = 0;
};

/// Heights at which the vertical lines through the columns' centres cross the shell.
class Crossings {
 public:
  Crossings(const Grid& grid, const Surface& s, std::size_t begin, std::size_t end) : grid_(grid) {
    glm::dvec3 lo(1e300), hi(-1e300);
    for (std::size_t f = begin; f < end; ++f)
      for (const int v : s.triangles[f]) {
        lo = glm::min(lo, s.position_m[std::size_t(v)]);
        hi = glm::max(hi, s.position_m[std::size_t(v)]);
      }
    i0 = column(lo.x - grid.origin.x);
    j0 = column(lo.y - grid.origin.y);
    ni = column(hi.x - grid.origin.x) - i0 + 2;
    nj = column(hi.y - grid.origin.y) - j0 + 2;
    heights.resize(std::size_t(ni) * std::size_t(nj));
    for (std::size_t f = begin; f < end; ++f) {
      const auto& t = s.triangles[f];
      cross(s.position_m[std::size_t(t[0])], s.position_m[std::size_t(t[1])],
            s.position_m[std::size_t(t[2])]);
    }
  }
  int i0, j0, ni, nj;
  std::vector<std::vector<double>> heights;

 private:
  int column(double x) const { return int(std::floor(x / grid_.edge)); }
  void cross(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (det == 0) return;
    const int ia = std::max(i0, column(std::min({a.x, b.x, c.x}) - grid_.origin.x) - 1);
    const int ib = std::min(i0 + ni - 1, column(std::max({a.x, b.x, c.x}) - grid_.origin.x) + 1);
    const int ja = std::max(j0, column(std::min({a.y, b.y, c.y}) - grid_.origin.y) - 1);
    const int jb = std::min(j0 + nj - 1, column(std::max({a.y, b.y, c.y}) - grid_.origin.y) + 1);
    for (int j = ja; j <= jb; ++j)
      for (int i = ia; i <= ib; ++i) {
        const double x = grid_.origin.x + (i + 0.5) * grid_.edge, y = grid_.origin.y + (j + 0.5) * grid_.edge;
        const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / det;
        const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / det;
        if (u < 0 || v < 0 || u + v >= 1) continue;
        heights[std::size_t(j - j0) * std::size_t(ni) + std::size_t(i - i0)].push_back(a.z + u * (b.z - a.z) +
                                                                                       v * (c.z - a.z));
      }
  }
  const Grid& grid_;
};

void fill(Grid& grid, const Surface& s, std::size_t begin, std::size_t end, Counts& counts) {
  Crossings c(grid, s, begin, end);
  for (int j = 0; j < c.nj; ++j)
    for (int i = 0; i < c.ni; ++i) {
      auto& z = c.heights[std::size_t(j) * std::size_t(c.ni) + std::size_t(i)];
      std::sort(z.begin(), z.end());
      for (std::size_t k = 0; k + 1 < z.size(); k += 2) {
        const int from = int(std::ceil((z[k] - grid.origin.z) / grid.edge - 0.5));
        const int to = int(std::ceil((z[k + 1] - grid.origin.z) / grid.edge - 0.5));
        for (int h = from; h < to; ++h) {
          const std::size_t at =
              (std::size_t(h) * std::size_t(grid.ny) + std::size_t(j + c.j0)) * std::size_t(grid.nx) +
              std::size_t(i + c.i0);
          ++counts.sum;
          if (grid.full[at]) ++counts.joint;
          grid.full[at] = 1;
        }
      }
    }
}

}  // namespace

double overlap_share(const Surface& s, double voxel_m) {
  if (!(voxel_m > 0))
    throw InvalidInput("overlap_share: voxel edge " + std::to_string(voxel_m) + " m must be > 0");
  const auto& kernel = s.field("kernel_id").values;
  const auto id = [&](std::size_t face) { return kernel[std::size_t(s.triangles[face][0])]; };
  glm::dvec3 lo(1e300), hi(-1e300);
  for (std::size_t v = 0; v < s.position_m.size(); ++v)
    if (kernel[v] >= 0) {
      lo = glm::min(lo, s.position_m[v]);
      hi = glm::max(hi, s.position_m[v]);
    }
  if (lo.x > hi.x) return 0;
  // Off the symmetry planes, where vertices lie, and with two empty layers all round.
  Grid grid{lo - glm::dvec3(2.381, 2.417, 2.443) * voxel_m, voxel_m, 0, 0, 0, {}};
  const glm::dvec3 cells = (hi - grid.origin) / voxel_m + 3.0;
  if (cells.x * cells.y * cells.z > 2e9)
    throw InvalidInput("overlap_share: voxel edge " + std::to_string(voxel_m) +
                       " m is too small for this fruit");
  grid.nx = int(cells.x);
  grid.ny = int(cells.y);
  grid.nz = int(cells.z);
  grid.full.assign(std::size_t(grid.nx) * std::size_t(grid.ny) * std::size_t(grid.nz), 0);
  Counts counts;
  for (std::size_t f = 0; f < s.triangles.size();) {
    std::size_t end = f + 1;
    while (end < s.triangles.size() && id(end) == id(f)) ++end;
    if (id(f) >= 0) fill(grid, s, f, end, counts);
    f = end;
  }
  return counts.sum > 0 ? double(counts.joint) / double(counts.sum) : 0;
}

}  // namespace witherfield::fruit
