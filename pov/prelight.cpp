#include "pov/prelight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

/// Share of the sun's beam on a blade, free of its sign: half the face's cosine, half the fibre's sin(t, l)
/// (Kajiya & Kay 1989), whose mean over the turns of the blade about its axis is 2/pi sin(t, l).
double beam_share(const glm::dvec3& normal, const glm::dvec3& tangent, const glm::dvec3& light) {
  const double along = glm::dot(tangent, light), fibre = std::sqrt(std::max(0.0, 1 - along * along));
  const double mean = 2 / std::numbers::pi * fibre;
  const double n2 = glm::dot(normal, normal);
  return n2 < 1e-6 ? mean : 0.6 * std::abs(glm::dot(normal, light)) + 0.4 * mean;
}

/// 1 when light and eye are on the same side of the face, 0 when on opposite sides, in between when nearly
/// edge-on.
double same_side(const glm::dvec3& normal, const glm::dvec3& light, const glm::dvec3& eye) {
  return 0.5 + 0.5 * std::clamp(8 * glm::dot(normal, light) * glm::dot(normal, eye), -1.0, 1.0);
}

double specular_lobe(const glm::dvec3& tangent, const glm::dvec3& light, const glm::dvec3& eye) {
  const double tl = glm::dot(tangent, light), te = glm::dot(tangent, eye);
  const double c = std::sqrt(std::max(0.0, 1 - tl * tl)) * std::sqrt(std::max(0.0, 1 - te * te)) - tl * te;
  return std::pow(std::max(0.0, c), 20.0);
}

}  // namespace

glm::dvec3 scattered_light(const Illumination& light, const glm::dvec3& mean_albedo, double sky) {
  const glm::dvec3 incoming = light.sun_rgb * (0.6 * light.to_sun.z) + light.sky_rgb;
  const double seen = std::clamp(sky, 0.0, 1.0);
  glm::dvec3 out;
  for (int c = 0; c < 3; ++c) {
    // Leaves that scatter the share w let all light together through as black ones of sqrt(1 - w) times the area
    // would; a deep canopy sends back (1 - s) / (1 + s) (Goudriaan 1977, ch. 2).
    const double s = std::sqrt(1 - std::clamp(mean_albedo[c], 0.0, 0.98)), down = std::pow(seen, s);
    out[c] = incoming[c] * (down - seen + down * (1 - s) / (1 + s));
  }
  return out;
}

std::vector<float> sky_visibility(const DenseDensity& block, double per_density,
                                  std::span<const glm::dvec3> points_m, double offset_m) {
  std::vector<double> sum(points_m.size(), 0.0);
  for (const DomeSample& d : sky_dome()) {
    const OpticalDepth depth(block, d.direction, per_density);
    parallel_for(points_m.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        sum[i] += d.weight * std::exp(-depth.at(points_m[i] + d.direction * offset_m));
    });
  }
  return {sum.begin(), sum.end()};
}

TexelPrelight::TexelPrelight(const TexelGrid& grid, bool periodic, double blade_width_m)
    : block_(densify(grid, periodic)),
      per_density_(depth_per_density(blade_width_m, grid.shape().spacing_m)),
      start_m_(ray_start_m(blade_width_m, grid.shape().spacing_m)) {
  gather(grid);
  sky_ = sky_visibility(block_, per_density_, point_m_, start_m_);
}

void TexelPrelight::gather(const TexelGrid& grid) {
  using C = TexelChannel;
  const GridShape& s = grid.shape();
  double total = 0;
  const auto vector_at = [&](int b, C first, int v) {
    const int c = static_cast<int>(first);
    return glm::vec3(grid.channel(b, C(c))[v], grid.channel(b, C(c + 1))[v], grid.channel(b, C(c + 2))[v]);
  };
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const float density = grid.channel(b, C::density)[v];
      if (!(density > 0)) continue;
      const glm::ivec3 p = grid.brick_base(b) + glm::ivec3(v & 3, (v >> 2) & 3, v >> 4);
      const glm::vec3 diffuse = vector_at(b, C::diffuse_r, v);
      voxel_.push_back(p);
      point_m_.push_back(s.origin_m + (glm::dvec3(p) + 0.5) * s.spacing_m);
      density_.push_back(density);
      specular_.push_back(grid.channel(b, C::specular)[v]);
      normal_.push_back(vector_at(b, C::normal_x, v));
      tangent_.push_back(vector_at(b, C::tangent_x, v));
      leaf_.push_back(leaf_optics(diffuse, grid.channel(b, C::chlorophyll_ug_cm2)[v] / kFreshChlorophyll));
      mean_albedo_ += double(density) * glm::dvec3(leaf_.back().reflectance + leaf_.back().transmittance);
      mean_diffuse_ += double(density) * glm::dvec3(diffuse);
      total += density;
    }
  if (total > 0) {
    mean_albedo_ /= total;
    mean_diffuse_ /= total;
  }
}

TexelPrelight::Shading TexelPrelight::shade(const Illumination& light, const glm::dvec3& eye_m) const {
  const OpticalDepth depth(block_, light.to_sun, per_density_);
  const glm::dvec3 start = light.to_sun * (start_m_);
  std::vector<glm::vec3> sun(voxel_.size()), rest(voxel_.size());
  parallel_for(voxel_.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::dvec3 n(normal_[i]), t(tangent_[i]), to_eye = glm::normalize(eye_m - point_m_[i]);
      const glm::dvec3 r(leaf_[i].reflectance), through(leaf_[i].transmittance);
      const double beam = std::exp(-depth.at(point_m_[i] + start));
      const double same = same_side(n, light.to_sun, to_eye);
      const glm::dvec3 diffuse = (r * same + through * (1 - same)) * beam_share(n, t, light.to_sun);
      const double gloss = specular_[i] * specular_lobe(t, light.to_sun, to_eye);
      sun[i] = glm::vec3(light.sun_rgb * beam * (diffuse + gloss));
      // The eye's side of the face sees (1 + n.z)/2 of the dome, its other side the rest.
      const double up = 0.5 + 0.5 * (glm::dot(n, to_eye) < 0 ? -n.z : n.z);
      rest[i] = glm::vec3(light.sky_rgb * double(sky_[i]) * (r * up + through * (1 - up)) +
                          scattered_light(light, mean_albedo_, sky_[i]) * (r + through) * 0.5);
    }
  });
  Shading out;
  out.radiance.resize(voxel_.size());
  double weight = 0;
  for (std::size_t i = 0; i < voxel_.size(); ++i) {
    out.radiance[i] = sun[i] + rest[i];
    const double w = double(density_[i]) * sky_[i] * sky_[i];  // what is seen from outside
    out.mean_sun += w * glm::dvec3(sun[i]);
    out.mean_rest += w * glm::dvec3(rest[i]);
    weight += w;
  }
  if (weight > 0) {
    out.mean_sun /= weight;
    out.mean_rest /= weight;
  }
  return out;
}

std::vector<glm::dvec3> TexelPrelight::ground_points() const {
  std::vector<glm::dvec3> points;
  constexpr int kSide = 48;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      points.push_back(block_.origin_m +
                       glm::dvec3((i + 0.5) / kSide * block_.nx, (j + 0.5) / kSide * block_.ny, 0) *
                           block_.spacing_m);
  return points;
}

GroundShares TexelPrelight::ground(const glm::dvec3& to_sun) const {
  const OpticalDepth depth(block_, to_sun, per_density_);
  const auto points = ground_points();
  const std::vector<float> seen = sky_visibility(block_, per_density_, points, 0);
  GroundShares sum;
  double weight = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = seen[i];
    sum.sun += w * std::exp(-depth.at(points[i]));
    sum.sky += w * w;
    weight += w;
  }
  return weight > 0 ? GroundShares{sum.sun / weight, sum.sky / weight} : GroundShares{};
}

}  // namespace witherfield::pov
