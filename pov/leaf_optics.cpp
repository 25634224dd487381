#include "pov/leaf_optics.hpp"

#include <algorithm>
#include <cmath>

namespace witherfield::pov {

LeafOptics leaf_optics(const glm::vec3& canopy, double freshness) {
  const double s = 0.75 + (0.37 - 0.75) * std::clamp(freshness, 0.0, 1.0);
  LeafOptics out;
  for (int c = 0; c < 3; ++c) {
    const double r_inf = std::clamp(double(canopy[c]), 0.002, 0.95);
    const double a = (1 / r_inf + r_inf) / 2, b = std::sqrt(a * a - 1);
    // Divided by cosh(bS), so that strong absorption does not overflow.
    const double t = std::tanh(b * s), denominator = a * t + b;
    out.reflectance[c] = float(t / denominator);
    out.transmittance[c] = float(b / (denominator * std::cosh(std::min(b * s, 300.0))));
  }
  return out;
}

}  // namespace witherfield::pov
