#include "vis/edit_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace witherfield::vis {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

glm::dvec3 toward_eye(const EditCamera& c) {
  if (c.flat) return {0, 0, 1};
  const double a = c.azimuth_deg * kDegree, e = c.elevation_deg * kDegree;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

}  // namespace

double EditCamera::distance_m() const { return reach_m / std::tan(0.5 * view_angle_deg * kDegree); }
glm::dvec3 EditCamera::eye_m() const { return focus_m + distance_m() * toward_eye(*this); }

glm::dvec3 EditCamera::up() const {
  if (flat) return {1, 0, 0};
  // Defined straight above and below, too.
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return {-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)};
}

void EditCamera::turn(double dx, double dy) {
  if (flat) return;
  azimuth_deg = std::remainder(azimuth_deg - 0.35 * dx, 360.0);
  elevation_deg = std::clamp(elevation_deg + 0.35 * dy, -90.0, 90.0);
}

void EditCamera::shift(double dx, double dy, int height_px) {
  const double metres = 2 * reach_m / height_px;
  const glm::dvec3 right = glm::cross(up(), toward_eye(*this));
  focus_m += metres * (-dx * right + dy * up());
}

void EditCamera::zoom(double factor, const glm::dvec3& at) {
  const double before = reach_m;
  reach_m = std::clamp(reach_m * factor, 1e-4, 100.0);
  focus_m = at + (reach_m / before) * (focus_m - at);
}

ScreenMap EditCamera::screen_map(int width, int height, double near_m, double far_m) const {
  const double aspect = double(width) / height;
  const glm::dmat4 projection =
      flat ? glm::ortho(-reach_m * aspect, reach_m * aspect, -reach_m, reach_m, near_m, far_m)
           : glm::perspective(view_angle_deg * kDegree, aspect, near_m, far_m);
  ScreenMap map;
  map.to_clip = projection * glm::lookAt(eye_m(), focus_m, up());
  map.from_clip = glm::inverse(map.to_clip);
  map.width_px = width;
  map.height_px = height;
  return map;
}

}  // namespace witherfield::vis
