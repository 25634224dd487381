// Water in a leaf: from the stem through the petiole and the veins into the blade, and out of it as vapour.
//
//   c_i dw_i/dt = sum_j G_ij (w_j - w_i) + supply_i - a_i e(w_i)      w = relative water content, c_i = water at full turgor, kg
// On the blade G is the cotangent operator, with more along the veins; on the petiole a chain. Backward Euler, one linear
// solve a step: the transpiration is written as g(w_old) w_new, which keeps w within 0..1 for any step. Conductances of blade and
// veins fall with turgor (those of the last step count): leaf hydraulic conductance declines as leaves dry (Scoffoni et al. 2012); how much is an estimate.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "sim/core/curve.hpp"
#include "sim/leaf/wilt_body.hpp"
#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf {

/// All water since the start, kg. in - out = stored, to rounding.
struct WaterBalance {
  double in_kg = 0;      ///< through the petiole (or the clamped vertices)
  double out_kg = 0;     ///< transpired
  double stored_kg = 0;  ///< now less at the start
  /// |in - out - stored| over the largest of in, out, |stored| and the water at the start.
  double error(double start_kg) const;
};

class LeafWater {
 public:
  /// @param rod_m, rod_radius_m nodes of the petiole, stem first (empty = none).
  /// Starts with w = 1 everywhere. @throws InvalidInput.
  LeafWater(const WiltBody& body, const std::vector<glm::dvec3>& rod_m, const std::vector<double>& rod_radius_m,
            const WiltOptions& options);
  ~LeafWater();
  LeafWater(LeafWater&&) noexcept;
  LeafWater& operator=(LeafWater&&) noexcept;

  /// Goes on to that time in equal steps no longer than 1 / steps_per_hour. @pre not before now().
  void advance_to(double hours);
  double now_hours() const;
  std::span<const double> blade() const;    ///< w per vertex
  std::span<const double> petiole() const;  ///< w per node of the rod
  const WaterBalance& balance() const;
  double start_kg() const;
  /// Mean of w over the blade, weighted with the water that it can hold.
  double mean_blade() const;
  double supply(double hours) const;        ///< openness 0..1

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::leaf
