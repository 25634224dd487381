#include "sim/fruit/ripening.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/colour.hpp"

namespace witherfield::fruit {
namespace {

using Keys = std::vector<std::pair<double, double>>;

/// Kernel moisture, wet basis, against days after flowering.
Keys moisture_keys(const std::string& crop) {
  // 41.8 -> 17.1 % within 14 days (Kirleis et al. 1982, Crop Science 22:871; season 1979, the slower of two).
  // That it begins on day 35, and the milk stage before it, are estimates.
  if (crop == "wheat")
    return {{10, 0.72}, {18, 0.64}, {26, 0.53}, {35, 0.42}, {42, 0.295}, {49, 0.171}, {54, 0.12}};
  // Days after silking: R2 85, R3 80, R4 70, R5 60, R6 35 % (Abendroth et al. 2011); then 0.75 and 0.5 % a
  // day.
  if (crop == "maize")
    return {{11, 0.85}, {19, 0.80}, {25, 0.70}, {32, 0.60}, {65, 0.35}, {85, 0.20}, {97, 0.14}};
  return {{0, 0.86}, {60, 0.84}};  // a juicy fruit keeps its water
}

Keys pigment_keys(const std::string& crop) {
  // Wheat: green until about 25 days after flowering, half at 34, golden at 45 (flag leaves: half at about
  // 30).
  if (crop == "maize") return {{0, 0}, {0.1, 0.12}, {0.3, 0.5}, {0.6, 0.85}, {1, 1}};
  if (crop == "wheat") return {{0, 0}, {0.25, 0.08}, {0.45, 0.5}, {0.65, 0.9}, {0.8, 0.99}, {1, 1}};
  return {{0, 0}, {1, 1}};
}

double ks_of(double r) {
  const double c = std::clamp(r, 0.003, 0.995);
  return (1 - c) * (1 - c) / (2 * c);
}
double reflectance_of(double ks) {
  return 1 + ks - std::sqrt(ks * ks + 2 * ks);
}

double per_dry_mass(double moisture_wb) {
  return moisture_wb / (1 - moisture_wb);
}

}  // namespace

Swelling wheat_swelling(double moisture_wb) {
  const double x = (std::clamp(moisture_wb, 0.0, 0.50) - 0.087) / (0.281 - 0.087);
  return {1 + 0.051 * x, 1 + 0.097 * x, 1 + 0.067 * x};
}

Swelling maize_swelling(double moisture_wb) {
  const double x = (std::clamp(moisture_wb, 0.0, 0.25) - 0.09) / (0.25 - 0.09);
  return {1 + (10.20 / 9.25 - 1) * x, 1 + (8.26 / 7.87 - 1) * x, 1 + (4.71 / 3.86 - 1) * x};
}

RipeningCourse::RipeningCourse(const RipeningOptions& o, const std::string& crop)
    : moisture_(o.moisture_curve.empty() ? moisture_keys(crop) : o.moisture_curve, "ripening.moisture_curve"),
      pigment_(o.pigment_curve.empty() ? pigment_keys(crop) : o.pigment_curve, "ripening.pigment_curve"),
      length_days_(o.length_days),
      start_day_(o.start_day),
      spread_(o.spread) {}

double RipeningCourse::water(double wd) const {
  const double first = per_dry_mass(moisture_wb(0));
  return first > 0 ? std::clamp(per_dry_mass(moisture_wb(wd)) / first, 0.0, 1.0) : 0.0;
}

double RipeningCourse::of_kernel(double wd, double draw) const {
  // Bounded so that 4 wd (1 - wd) lead keeps wd -> wd_k rising.
  const double lead = std::clamp(spread_ * draw, -0.24, 0.24);
  return std::clamp(wd + 4 * wd * (1 - wd) * lead, 0.0, 1.0);
}

glm::dvec3 linear_of(const Srgb& s) {
  return {srgb_decode(s.r / 255), srgb_decode(s.g / 255), srgb_decode(s.b / 255)};
}

ColourRamp::ColourRamp(std::vector<std::pair<double, Srgb>> keys) {
  for (const auto& [x, levels] : keys) {
    const glm::dvec3 c = linear_of(levels);
    keys_.push_back({x, {ks_of(c.x), ks_of(c.y), ks_of(c.z)}});
  }
}

glm::vec3 ColourRamp::operator()(double ripeness) const {
  std::size_t i = 0;
  while (i + 2 < keys_.size() && ripeness > keys_[i + 1].first) ++i;
  glm::dvec3 ks = keys_[i].second;
  if (keys_.size() > 1) {
    const auto& [x0, a] = keys_[i];
    const auto& [x1, b] = keys_[i + 1];
    const double t = std::clamp((ripeness - x0) / (x1 - x0), 0.0, 1.0);
    ks = a * (1 - t) + b * t;
  }
  return {float(reflectance_of(ks.x)), float(reflectance_of(ks.y)), float(reflectance_of(ks.z))};
}

}  // namespace witherfield::fruit
