// The eye of an edit window: turns about a point with the vertical kept upright, shifts, comes nearer. No VTK in it.
#pragma once
#include <glm/vec3.hpp>

#include "vis/edit_markers.hpp"

namespace witherfield::vis {

class EditCamera {
 public:
  double azimuth_deg = -60, elevation_deg = 35;  ///< of the eye as seen from the focus
  glm::dvec3 focus_m{0.0};
  double reach_m = 1;     ///< half the height that is seen at the focus
  bool flat = false;      ///< parallel projection, from above, +x upwards: azimuth and elevation are passed over
  double view_angle_deg = 28;

  glm::dvec3 eye_m() const;
  glm::dvec3 up() const;
  double distance_m() const;
  /// Turns by a movement of the mouse; does nothing when flat.
  void turn(double dx_px, double dy_px);
  void shift(double dx_px, double dy_px, int height_px);
  /// factor < 1 comes nearer; the place `at_m` stays where it is on the screen.
  void zoom(double factor, const glm::dvec3& at_m);
  ScreenMap screen_map(int width_px, int height_px, double near_m, double far_m) const;
};

}  // namespace witherfield::vis
