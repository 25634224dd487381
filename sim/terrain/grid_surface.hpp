// A height field through a grid of samples: bicubic Catmull-Rom (tensor product), C1, exact on planes.
#pragma once
#include <array>
#include <vector>

#include "sim/terrain/surface.hpp"

namespace witherfield::terrain {

/// Elevation samples and the rectangle cut from them. Sample (i, j) is z_m[j * nx + i], i to the east, j to
/// the north.
struct DemGrid {
  int nx = 0, ny = 0;               ///< at least 2 each
  double dx_m = 0, dy_m = 0;        ///< between samples, > 0
  std::vector<double> z_m;          ///< nx * ny, finite
  double start_x = 0, start_y = 0;  ///< south-west corner of the rectangle, in samples from sample (0, 0)
  double width_m = 0, depth_m = 0;  ///< of the rectangle, which lies within the samples' hull
};

class GridSurface final : public Surface {
 public:
  /// @pre the comments of DemGrid hold.
  explicit GridSurface(const DemGrid& grid);
  double elevation_m(double x_m, double y_m) const override;
  glm::dvec2 gradient(double x_m, double y_m) const override;

 private:
  struct Place {
    int i, j;     // cell
    double u, v;  // position in it, 0..1
  };
  Place locate(double x_m, double y_m) const;
  double sample(int i, int j) const;
  std::array<double, 2> range() const;

  int nx_, ny_;
  double dx_m_, dy_m_, start_x_, start_y_;
  std::vector<double> z_;  // with one ghost sample around: (nx + 2) * (ny + 2)
};

}  // namespace witherfield::terrain
