// Where the camera stands so that a box fills a given part of the picture.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace witherfield::vis {

struct Framing {
  glm::dvec3 position{0.0}, focal_point{0.0};
  double view_angle_deg = 30;          ///< vertical
  glm::dvec2 window_center{0.0, 0.0};  ///< shift of the picture, as VTK's camera takes it
  /// Pixel position (from the lower left) of a point.
  glm::dvec2 project(const glm::dvec3& p) const;
  glm::dvec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  int width_px = 0, height_px = 0;
};

/// bounds = x0, x1, y0, y1, z0, z1. The box is seen from azimuth (counter-clockwise from +x) and elevation,
/// and its projection is centred in and fits the pixel rectangle [x0, x1] x [y0, y1] (from the lower left),
/// times zoom.
Framing frame_box(const std::array<double, 6>& bounds, double azimuth_deg, double elevation_deg, double zoom,
                  int width_px, int height_px, const std::array<double, 4>& rectangle_px);

}  // namespace witherfield::vis
