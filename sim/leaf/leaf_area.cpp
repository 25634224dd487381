#include "sim/leaf/leaf_area.hpp"

#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

double surface_area_m2(const Surface& s) {
  double sum = 0;
  for (const auto& t : s.triangles) {
    const glm::dvec3& a = s.position_m[std::size_t(t[0])];
    sum += glm::length(glm::cross(s.position_m[std::size_t(t[1])] - a, s.position_m[std::size_t(t[2])] - a));
  }
  return 0.5 * sum;
}

double area_error(double area_m2, double reference_m2) {
  if (!(reference_m2 > 0)) throw InvalidInput("area_error: reference area " + std::to_string(reference_m2) + " m2 must be > 0");
  return (area_m2 - reference_m2) / reference_m2;
}

}  // namespace witherfield::leaf
