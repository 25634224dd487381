// Draws of a step and the motion of the body between two steps. Private to the walkers.
#pragma once
#include "sim/core/random.hpp"
#include "sim/floor/footprint.hpp"
#include "sim/floor/walkers.hpp"

namespace witherfield::floor {

double draw(Random& random, const Spread& spread);

/// The state that a step depends on, and nothing before it.
struct Body {
  glm::dvec2 at_m{0.0};
  double heading_rad = 0;
  double deviation_rad = 0;  ///< of the heading from the field, remembered over heading_memory_m
  double time_s = 0;
  std::uint32_t steps = 0;
  Foot next = Foot::left;
};

/// Draws steps for one walker.
class Gait {
 public:
  Gait(const FloorOptions& options, const Visit& visit);

  Random& random() { return random_; }
  double step_length_m(double speed_m_s);
  /// Heading's deviation after another `way_m`: a first-order autoregression with the standard deviation asked for.
  void deviate(double& deviation_rad, double way_m);
  /// A foot set down by the body as it stands. @param turned_rad since the last step: the other foot turned on the floor.
  Step set_foot(Body& body, Phase phase, double length_m, double speed_m_s, double turned_rad);

 private:
  const FloorOptions& options_;
  Random random_;
};

/// Turns the body's heading towards `wanted` (unit), no tighter than radius_m, over way_m.
void steer(double& heading_rad, glm::dvec2 wanted, double way_m, double radius_m);

}  // namespace witherfield::floor
