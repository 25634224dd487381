#include "sim/core/colour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace witherfield {

double srgb_encode(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }
double srgb_decode(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

glm::dvec3 srgb_levels(const glm::dvec3& c) {
  const auto level = [](double x) { return 255 * srgb_encode(std::clamp(x, 0.0, 1.0)); };
  return {level(c.x), level(c.y), level(c.z)};
}

glm::dvec3 xyz_to_linear_srgb(const glm::dvec3& c) {  // IEC 61966-2-1
  return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z, -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
          0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

glm::dvec3 linear_srgb_to_xyz(const glm::dvec3& c) {
  return {0.4124564 * c.x + 0.3575761 * c.y + 0.1804375 * c.z, 0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z,
          0.0193339 * c.x + 0.1191920 * c.y + 0.9503041 * c.z};
}

double lab_hue_deg(const glm::dvec3& linear) {
  const glm::dvec3 xyz = linear_srgb_to_xyz(linear);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double fx = f(xyz.x / 0.95047), fy = f(xyz.y), fz = f(xyz.z / 1.08883);
  const double h = std::atan2(200 * (fy - fz), 500 * (fx - fy)) * 180 / std::numbers::pi;
  return h < 0 ? h + 360 : h;
}

}  // namespace witherfield
