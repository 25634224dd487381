// The terrain's own shadow, by marching toward the sun.
#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "sim/terrain/terrain.hpp"

namespace witherfield::terrain {
namespace {

constexpr double kSunRadius_rad =
    0.2666 * 3.14159265358979323846 / 180;  // mean angular radius seen from the Earth

// Horizontal distance to the edge of [0, width] x [0, depth] along the unit direction d.
double distance_to_edge(const glm::dvec2& p, const glm::dvec2& d, double width, double depth) {
  const auto along = [](double at, double step, double size) {
    return step > 0 ? (size - at) / step : step < 0 ? -at / step : 1e300;
  };
  return std::max(0.0, std::min(along(p.x, d.x, width), along(p.y, d.y, depth)));
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double Terrain::sun_visibility(const glm::dvec3& point_m, const glm::dvec3& to_sun) const {
  const double run = std::hypot(to_sun.x, to_sun.y);
  if (!(to_sun.z > 0)) return 0.0;
  if (run <= 1e-12 * to_sun.z) return 1.0;  // overhead: a height field hides nothing
  const glm::dvec2 p{point_m.x, point_m.y}, d{to_sun.x / run, to_sun.y / run};
  const double rise = to_sun.z / run;

  // What is smaller than a tenth of a cell is not known: the march starts that much above the ground, and
  // shadow edges are that soft.
  const double soft_m = 0.1 * cell_m();
  const double z0 = std::max(point_m.z, height(p.x, p.y) + soft_m);
  const double sun_spread = kSunRadius_rad * (1 + rise * rise);  // d tan(elevation) = (1 + tan^2) d elevation
  // Beyond this the whole of the sun's disc stands above the highest point.
  const double clear = rise > sun_spread ? (max_height_m() + soft_m - z0) / (rise - sun_spread) : 1e300;
  const double end = std::min(distance_to_edge(p, d, width_m(), depth_m()), clear);
  // The ground is looked at where the ray crosses fixed lines, a quarter of a cell apart: then all rays look
  // at the same places, and shadow edges do not flicker with the start.
  const bool by_x = std::abs(d.x) >= std::abs(d.y);
  const double along = by_x ? d.x : d.y, from = by_x ? p.x : p.y, line_m = 0.25 * cell_m();
  const double step = line_m / std::abs(along);
  const double before =
      (along > 0 ? from / line_m - std::floor(from / line_m) : std::ceil(from / line_m) - from / line_m) *
      step;
  double visible = 1.0;
  for (int k = 1; k * step - before <= end && visible > 0; ++k) {
    const double s = k * step - before;
    if (s <= 0) continue;  // the line that it stands on
    const double clearance = z0 + s * rise - height(p.x + s * d.x, p.y + s * d.y);
    const double half_width = soft_m + s * sun_spread;
    visible = std::min(visible, smooth_step(0.5 + 0.5 * clearance / half_width));
  }
  return visible;
}

}  // namespace witherfield::terrain
