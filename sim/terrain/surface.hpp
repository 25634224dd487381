// What a terrain is made of: one height field over a rectangle, in true metres. Two kinds: a grid of samples
// and a mesh.
#pragma once
#include <glm/vec2.hpp>

namespace witherfield::terrain {

/// A rectangle [0, width] x [0, depth] (x east, y north, true metres) and the heights found in it.
struct SurfaceExtent {
  double width_m = 0, depth_m = 0;
  double cell_m = 0;  ///< spacing of the samples: how fine the surface is known
  double lowest_m = 0, highest_m = 0;
};

class Surface {
 public:
  explicit Surface(const SurfaceExtent& extent) : extent_(extent) {}
  virtual ~Surface() = default;
  /// Metres above the datum; points outside the rectangle are moved to its edge.
  virtual double elevation_m(double x_m, double y_m) const = 0;
  /// d elevation / d(x, y).
  virtual glm::dvec2 gradient(double x_m, double y_m) const = 0;
  const SurfaceExtent& extent() const { return extent_; }

 protected:
  SurfaceExtent extent_;
};

}  // namespace witherfield::terrain
