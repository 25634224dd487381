#include "sim/core/view.hpp"

#include <cmath>
#include <numbers>

namespace witherfield {

glm::dvec3 Sun::direction() const {
  const double az = azimuth_deg * std::numbers::pi / 180, el = elevation_deg * std::numbers::pi / 180;
  return {std::cos(az) * std::cos(el), std::sin(az) * std::cos(el), std::sin(el)};
}

}  // namespace witherfield
