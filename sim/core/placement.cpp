#include "sim/core/placement.hpp"

namespace witherfield {

glm::dvec3 to_world(const TexelInstance& t, double tile_m, const glm::dvec3& p) {
  double ux = p.x / tile_m - 0.5, uy = p.y / tile_m - 0.5;
  if (t.mirrored) ux = -ux;
  for (int q = 0; q < (t.quarter_turns & 3); ++q) {
    const double x = -uy;
    uy = ux;
    ux = x;
  }
  const double dx = (ux + 0.5) * tile_m, dy = (uy + 0.5) * tile_m;
  return {t.origin_m.x + dx, t.origin_m.y + dy,
          t.origin_m.z + t.slope_x * dx + t.slope_y * dy + t.height_scale * p.z};
}

}  // namespace witherfield
