#include "pov/near_cells.hpp"

#include <algorithm>
#include <cmath>

namespace witherfield::pov {
namespace {

/// Where a voxel of a neighbour falls in the cell: whole columns in x and y, a height in z.
struct Landing {
  int x, y;
  double height;  // in voxels above the cell's plane
};

Landing land(const TexelInstance& cell, const TexelInstance& part, double tile_m, double h,
             const glm::dvec3& p_m) {
  const glm::dvec3 w = to_world(part, tile_m, p_m);
  const double dx = w.x - cell.origin_m.x, dy = w.y - cell.origin_m.y;
  const double plane = cell.origin_m.z + cell.slope_x * dx + cell.slope_y * dy;
  return {int(std::floor(dx / h + 1e-3)), int(std::floor(dy / h + 1e-3)), std::max(0.0, (w.z - plane) / h)};
}

}  // namespace

NearCell merge_cell(const TexelInstance& cell, double tile_m, const std::vector<CellPart>& parts,
                    const std::vector<glm::dvec3>& factor) {
  const GridShape& shape = parts.front().grid->shape();
  const double h = shape.spacing_m;
  const int n = int(std::lround(tile_m / h));
  // First pass: how high the grass stands here.
  double top = 1;
  std::vector<std::vector<Landing>> landings(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const GridShape& s = parts[k].grid->shape();
    landings[k].reserve(parts[k].light->voxels().size());
    for (const glm::ivec3& v : parts[k].light->voxels()) {
      const Landing l = land(cell, *parts[k].at, tile_m, h, s.origin_m + (glm::dvec3(v) + 0.5) * h);
      landings[k].push_back(l);
      if (l.x >= -1 && l.y >= -1 && l.x <= n && l.y <= n) top = std::max(top, l.height);
    }
  }
  // One sample more on each side than the cell has columns, so that interpolation is right up to its walls.
  MediaBlock b;
  b.nx = b.ny = n + 2;
  b.nz = int(std::ceil(top)) + 3;
  b.spacing_m = h;
  b.first_m = glm::dvec3(-0.5, -0.5, -0.5) * h;
  b.box_lo_m = glm::dvec3(0.0);
  b.box_hi_m = {tile_m, tile_m, b.first_m.z + (b.nz - 1) * h};
  NearCell out{b, MediaSamples(b)};
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::size_t i = 0; i < landings[k].size(); ++i) {
      const Landing& l = landings[k][i];
      if (l.x < -1 || l.y < -1 || l.x > n || l.y > n) continue;
      // Sample z sits at height z - 1/2 above the plane; what falls between two layers is shared.
      const double at = std::max(l.height + 0.5, 1.0);
      const int z = int(at);
      const float upper = float(at - z), rho = parts[k].light->density()[i];
      const glm::vec3 radiance = (*parts[k].radiance)[i] * glm::vec3(factor[k]);
      const std::size_t base = (std::size_t(z) * b.ny + (l.y + 1)) * b.nx + (l.x + 1),
                        layer = std::size_t(b.nx) * b.ny;
      out.samples.add(base, rho * (1 - upper), radiance);
      if (upper > 0) out.samples.add(base + layer, rho * upper, radiance);
    }
  return out;
}

}  // namespace witherfield::pov
