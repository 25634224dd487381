#include "vis/framing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace witherfield::vis {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Rectangle {
  glm::dvec2 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
};

Rectangle projected(const Framing& f, const std::array<double, 6>& b) {
  Rectangle r;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec2 p = f.project({b[corner & 1], b[2 + (corner >> 1 & 1)], b[4 + (corner >> 2)]});
    for (int a = 0; a < 2; ++a) {
      r.lo[a] = std::min(r.lo[a], p[a]);
      r.hi[a] = std::max(r.hi[a], p[a]);
    }
  }
  return r;
}

}  // namespace

glm::dvec2 Framing::project(const glm::dvec3& p) const {
  const glm::dvec3 d = p - position;
  const double depth = std::max(glm::dot(d, forward), 1e-9),
               half = std::tan(view_angle_deg / 2 * kDegree) * depth;
  const double aspect = double(width_px) / height_px;
  // VTK's window centre shifts the picture by minus that share of half its size.
  const double x = glm::dot(d, right) / (half * aspect) - window_center.x,
               y = glm::dot(d, up) / half - window_center.y;
  return {(x + 1) / 2 * width_px, (y + 1) / 2 * height_px};
}

Framing frame_box(const std::array<double, 6>& b, double azimuth_deg, double elevation_deg, double zoom,
                  int width_px, int height_px, const std::array<double, 4>& rectangle_px) {
  Framing f;
  f.width_px = width_px;
  f.height_px = height_px;
  // Straight up or down the view's up direction would be undefined.
  const double az = azimuth_deg * kDegree, el = std::clamp(elevation_deg, -89.9, 89.9) * kDegree;
  const glm::dvec3 outward{std::cos(az) * std::cos(el), std::sin(az) * std::cos(el), std::sin(el)};
  f.focal_point = {(b[0] + b[1]) / 2, (b[2] + b[3]) / 2, (b[4] + b[5]) / 2};
  f.forward = -outward;
  f.right = glm::normalize(glm::cross(f.forward, glm::dvec3(0, 0, 1)));
  f.up = glm::cross(f.right, f.forward);

  const double diagonal = std::max(glm::length(glm::dvec3(b[1] - b[0], b[3] - b[2], b[5] - b[4])), 1e-9);
  const glm::dvec2 room{rectangle_px[1] - rectangle_px[0], rectangle_px[3] - rectangle_px[2]};
  double nearest = 0.55 * diagonal, farthest = 1000 * diagonal;  // the projection shrinks with the distance
  for (int i = 0; i < 60; ++i) {
    const double distance = std::sqrt(nearest * farthest);
    f.position = f.focal_point + outward * distance;
    const Rectangle r = projected(f, b);
    const bool fits = r.hi.x - r.lo.x <= room.x && r.hi.y - r.lo.y <= room.y;
    (fits ? farthest : nearest) = distance;
  }
  f.position = f.focal_point + outward * farthest;
  f.view_angle_deg =
      std::clamp(2 / kDegree * std::atan(std::tan(f.view_angle_deg / 2 * kDegree) / zoom), 0.01, 150.0);
  const Rectangle r = projected(f, b);
  const glm::dvec2 is = (r.lo + r.hi) / 2.0,
                   wanted{(rectangle_px[0] + rectangle_px[1]) / 2, (rectangle_px[2] + rectangle_px[3]) / 2};
  f.window_center = {(is.x - wanted.x) / width_px * 2, (is.y - wanted.y) / height_px * 2};
  return f;
}

}  // namespace witherfield::vis
