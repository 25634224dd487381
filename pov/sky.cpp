#include "pov/sky.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/colour.hpp"

namespace witherfield::pov {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSunLuminance = 6.0, kSunToSky = 6.0;

struct Perez {
  std::array<double, 5> c;
  double operator()(double cos_theta, double gamma) const {
    const double cg = std::cos(gamma);
    return (1 + c[0] * std::exp(c[1] / cos_theta)) * (1 + c[2] * std::exp(c[3] * gamma) + c[4] * cg * cg);
  }
};

/// Preetham et al. 1999, appendix A.2: distribution coefficients and zenith values as functions of turbidity.
struct Preetham {
  Perez luminance, x, y;
  double zenith_luminance, zenith_x, zenith_y, theta_sun;

  explicit Preetham(const Sun& sun) : theta_sun((90 - sun.elevation_deg) * kPi / 180) {
    const double t = sun.turbidity;
    luminance.c = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                   -0.0670 * t + 0.3703};
    x.c = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
           -0.0033 * t + 0.0452};
    y.c = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
           -0.0109 * t + 0.0529};
    const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * theta_sun);
    zenith_luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const double s = theta_sun, s2 = s * s, s3 = s2 * s;
    zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
               t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
               (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
               t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
               (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
  }

  glm::dvec3 radiance(double cos_theta, double gamma) const {
    cos_theta = std::max(cos_theta, 0.02);
    const double big_y = zenith_luminance * luminance(cos_theta, gamma) / luminance(1, theta_sun);
    const double cx = zenith_x * x(cos_theta, gamma) / x(1, theta_sun);
    const double cy = zenith_y * y(cos_theta, gamma) / y(1, theta_sun);
    const glm::dvec3 rgb = xyz_to_linear_srgb({big_y * cx / cy, big_y, big_y * (1 - cx - cy) / cy});
    return {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)};
  }
};

double luminance(const glm::dvec3& c) {
  return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// Transmittance of the air along the sun's beam at 650, 550 and 450 nm.
glm::dvec3 air_transmittance(double elevation_deg, double turbidity) {
  const double mass =
      1 / (std::sin(elevation_deg * kPi / 180) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
  const double beta = 0.04608 * turbidity - 0.04586;
  glm::dvec3 out;
  const double wavelength_um[3] = {0.65, 0.55, 0.45};
  for (int c = 0; c < 3; ++c)
    out[c] = std::exp(
        -mass * (0.008735 * std::pow(wavelength_um[c], -4.08) + beta * std::pow(wavelength_um[c], -1.3)));
  return out;
}

glm::dvec3 direction_of(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

}  // namespace

glm::dvec3 preetham_radiance(const Sun& sun, const glm::dvec3& direction) {
  return Preetham(sun).radiance(direction.z,
                                std::acos(std::clamp(glm::dot(direction, sun.direction()), -1.0, 1.0)));
}

Daylight make_daylight(const Sun& sun) {
  constexpr int kWidth = 1024, kHeight = 512;
  const Preetham model(sun);
  const glm::dvec3 to_sun = sun.direction();
  Daylight day;
  day.map.width = kWidth;
  day.map.height = kHeight;
  day.map.pixel.resize(std::size_t(kWidth) * kHeight);
  glm::dvec3 irradiance(0.0), horizon(0.0);
  for (int j = 0; j < kHeight; ++j) {
    const double elevation = (0.5 - (j + 0.5) / kHeight) * kPi;
    for (int i = 0; i < kWidth; ++i) {
      // POV-Ray's map_type 1 (spherical) runs with the azimuth atan2(z, x) of its own axes, which is ours.
      const glm::dvec3 d = direction_of((i + 0.5) / kWidth * 2 * kPi, std::abs(elevation));
      const glm::dvec3 c = model.radiance(d.z, std::acos(std::clamp(glm::dot(d, to_sun), -1.0, 1.0)));
      day.map.pixel[std::size_t(j) * kWidth + i] = glm::vec3(c);
      if (elevation > 0)
        irradiance +=
            c * (std::sin(elevation) * std::cos(elevation) * (2 * kPi / kWidth) * (kPi / kHeight) / kPi);
    }
  }
  // One scale for the whole picture: the sky of a 40 degree sun at turbidity 3 has kSunLuminance / kSunToSky.
  const double scale = kSunLuminance / kSunToSky / std::max(luminance(irradiance), 1e-6);
  day.sky_rgb = irradiance * scale;
  const glm::dvec3 air = air_transmittance(sun.elevation_deg, sun.turbidity),
                   reference = air_transmittance(40, 3);
  // Extraterrestrial sunlight is close to white in sRGB; the reference beam is given luminance kSunLuminance.
  day.sun_rgb = air * (kSunLuminance / luminance(reference));
  const double relative = luminance(air) * to_sun.z / (luminance(reference) * std::sin(40 * kPi / 180));
  const double dim = std::pow(std::clamp(relative, 0.05, 1.5), 0.5);  // a low sun also leaves a darker sky
  day.sky_rgb *= dim;
  for (int i = 0; i < kWidth; ++i)
    horizon += glm::dvec3(day.map.pixel[std::size_t(kHeight / 2 - 12) * kWidth + i]);
  horizon *= scale * dim / kWidth;
  // Preetham's horizon is purplish: real haze is close to neutral, slightly blue.
  const double haze = luminance(horizon);
  day.horizon_rgb = glm::dvec3(0.25) * horizon + 0.75 * haze * glm::dvec3(0.89, 1.0, 1.12);
  for (int j = 0; j < kHeight; ++j) {
    const double elevation = (0.5 - (j + 0.5) / kHeight) * kPi;
    const float blend = float(std::exp(-std::abs(elevation) / 0.22));
    for (int i = 0; i < kWidth; ++i) {
      glm::vec3& p = day.map.pixel[std::size_t(j) * kWidth + i];
      const glm::dvec3 c = glm::dvec3(p) * (scale * dim);
      // Keep the sky's own brightness, take the haze's hue.
      const glm::dvec3 hazy = day.horizon_rgb * (luminance(c) / std::max(luminance(day.horizon_rgb), 1e-9));
      p = glm::vec3(c * double(1 - blend) + hazy * double(blend));
    }
  }
  return day;
}

}  // namespace witherfield::pov
