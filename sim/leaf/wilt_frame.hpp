// The picture of one moment: mechanics and water as a Surface with fields.
#pragma once
#include <vector>

#include "sim/leaf/leaf_water.hpp"
#include "sim/leaf/wilt.hpp"
#include "sim/leaf/wilt_mechanics.hpp"

namespace witherfield::leaf {

class WiltFrames {
 public:
  WiltFrames(const WiltBody& body, const WiltOptions& options, const WiltMechanics& mechanics);

  /// Chlorophyll decays over that time at the present water content.
  void age(double hours, std::span<const double> water);
  /// Everything of `frame` but its index and time.
  void fill(const WiltMechanics& mechanics, const LeafWater& water, WiltFrame& frame);

 private:
  void fill_blade(const WiltMechanics& mechanics, const LeafWater& water);
  void fill_petiole(const WiltMechanics& mechanics, const LeafWater& water);

  const WiltBody& body_;
  const WiltOptions& options_;
  std::vector<double> chlorophyll_ug_cm2_;  ///< per vertex, on the area at rest
  std::vector<double> rest_area_m2_;
  double rest_midrib_m_ = 0;
  glm::dvec3 rest_centre_m_{0.0};
  std::vector<glm::dvec3> rest_petiole_m_, rest_tube_m_, petiole_m_;
  Surface surface_;
};

}  // namespace witherfield::leaf
