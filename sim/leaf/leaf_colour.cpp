#include "sim/leaf/leaf_colour.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "sim/core/colour.hpp"

namespace witherfield::leaf {
namespace {

glm::dvec3 from_levels(double r, double g, double b) {
  return {srgb_decode(r / 255), srgb_decode(g / 255), srgb_decode(b / 255)};
}
glm::dvec3 k_over_s(const glm::dvec3& r) { return (1.0 - r) * (1.0 - r) / (2.0 * r); }

}  // namespace

glm::dvec3 leaf_colour(double chlorophyll, double water) {
  // Leaf without chlorophyll: dry long grass; green: a maize leaf's upper side (LOPEX), taken to hold 42 ug/cm2 (estimate); brown: oak leaf litter.
  const glm::dvec3 pale = k_over_s(from_levels(176, 160, 112)), green = k_over_s(from_levels(78, 98, 46));
  const glm::dvec3 brown = k_over_s(from_levels(122, 92, 60));
  const double w = std::clamp(water, 0.0, 1.0), dry = (1 - w) * (1 - w);
  const glm::dvec3 absorbed = pale + (green - pale) * (std::max(chlorophyll, 0.0) / 42) + dry * (brown - pale);
  const glm::dvec3 k = glm::max(absorbed, glm::dvec3(1e-3)) / (1 + 0.45 * dry);
  return 1.0 + k - glm::sqrt(k * (k + 2.0));
}

}  // namespace witherfield::leaf
