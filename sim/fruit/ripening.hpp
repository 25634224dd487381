// Ripening: water leaves the kernels, pigments turn, kernels shrink (docs/physics.md).
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/curve.hpp"
#include "sim/fruit/options.hpp"

namespace witherfield::fruit {

/// Linear size relative to the dry kernel of the measurement.
struct Swelling {
  double length = 1, width = 1, thickness = 1;
};
/// 1 at 8.7 % water; + 5.1 % length, 9.7 % width, 6.7 % thickness at 28.1 % (Sirvinta wheat). Linear; beyond
/// what was measured carried on to 50 %, where it comes within 5 % of measured green kernels of other wheats,
/// then constant.
/// @param moisture_wb wet basis, 0..1.
Swelling wheat_swelling(double moisture_wb);
/// 1 at 9 % water; 9.25 x 7.87 x 3.86 mm -> 10.20 x 8.26 x 4.71 mm at 25 % (maize HQPM 5). Constant above:
/// the kernel fills its cell.
Swelling maize_swelling(double moisture_wb);

/// Course of ripening of one fruit.
class RipeningCourse {
 public:
  /// @param crop decides the moisture curve when the options have none.
  RipeningCourse(const RipeningOptions& options, const std::string& crop);
  double days(double wd) const { return wd * length_days_; }
  double moisture_wb(double wd) const { return moisture_(start_day_ + days(wd)); }
  /// Water per dry mass relative to that at wd = 0.
  double water(double wd) const;
  /// 0 green .. 1 ripe.
  double ripeness(double wd) const { return pigment_(wd); }
  /// The wd that a kernel has which is early (draw > 0) or late by draw standard deviations. All kernels
  /// start and end together: the lead is 4 wd (1 - wd) spread draw.
  double of_kernel(double wd, double draw) const;

 private:
  Curve moisture_, pigment_;
  double length_days_, start_day_, spread_;
};

/// A colour that ripens: key colours against ripeness, mixed as Kubelka-Munk mixes, linearly in K/S per
/// channel, so that a little chlorophyll still shows. Linear sRGB.
class ColourRamp {
 public:
  explicit ColourRamp(
      std::vector<std::pair<double, Srgb>> keys);  ///< @pre ripeness ascends, at least one key
  glm::vec3 operator()(double ripeness) const;

 private:
  std::vector<std::pair<double, glm::dvec3>> keys_;  ///< K/S
};

glm::dvec3 linear_of(const Srgb& levels);

}  // namespace witherfield::fruit
