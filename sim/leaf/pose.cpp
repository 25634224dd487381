#include "sim/leaf/pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/random.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/segment_grid.hpp"

namespace witherfield::leaf {
namespace {

constexpr double kRad = std::numbers::pi / 180;
enum Draw : std::uint64_t { kWaves = 32 };

/// A curve in a plane given by its slope angle along its length; extended straight before its start.
class Arc {
 public:
  template <class Angle>
  Arc(double length, Angle angle) : step_(length / kSteps), angle_(kSteps + 1), x_(kSteps + 1), y_(kSteps + 1) {
    for (int i = 0; i <= kSteps; ++i) {
      angle_[std::size_t(i)] = angle(double(i) / kSteps);
      if (i == 0) continue;
      const double middle = angle((i - 0.5) / kSteps);
      x_[std::size_t(i)] = x_[std::size_t(i) - 1] + step_ * std::cos(middle);
      y_[std::size_t(i)] = y_[std::size_t(i) - 1] + step_ * std::sin(middle);
    }
  }
  void at(double s, double& x, double& y, double& angle) const {
    const double t = std::clamp(s / step_, 0.0, double(kSteps));
    const std::size_t i = std::min<std::size_t>(std::size_t(t), kSteps - 1);
    const double f = t - double(i), beyond = s - t * step_;
    angle = (1 - f) * angle_[i] + f * angle_[i + 1];
    x = (1 - f) * x_[i] + f * x_[i + 1] + beyond * std::cos(angle);
    y = (1 - f) * y_[i] + f * y_[i + 1] + beyond * std::sin(angle);
  }

 private:
  static constexpr int kSteps = 256;
  double step_;
  std::vector<double> angle_, x_, y_;
};

/// How far the blade reaches in each direction from the base: to know how near to the margin a point is.
class Reach {
 public:
  Reach(const std::vector<glm::dvec3>& flat) : most_(kSectors, 1e-9) {
    for (const glm::dvec3& p : flat) most_[sector(p)] = std::max(most_[sector(p)], glm::length(glm::dvec2(p)));
    // Lobes share their reach with the sinuses beside them, so that waves do not jump.
    for (int round = 0; round < 12; ++round) {
      std::vector<double> next = most_;
      for (int i = 0; i < kSectors; ++i)
        next[std::size_t(i)] = 0.5 * most_[std::size_t(i)] +
                               0.25 * (most_[std::size_t((i + 1) % kSectors)] + most_[std::size_t((i + kSectors - 1) % kSectors)]);
      most_ = next;
    }
  }
  double share(const glm::dvec3& p) const {
    const double a = (std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5) * kSectors - 0.5, below = std::floor(a), t = a - below;
    const std::size_t i = std::size_t((int(below) + kSectors) % kSectors), j = (i + 1) % kSectors;
    return std::min(1.2, glm::length(glm::dvec2(p)) / ((1 - t) * most_[i] + t * most_[j]));
  }

 private:
  static constexpr int kSectors = 90;
  static std::size_t sector(const glm::dvec3& p) {
    const double a = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
    return std::size_t(std::min<int>(kSectors - 1, int(a * kSectors)));
  }
  std::vector<double> most_;
};

}  // namespace

std::vector<glm::dvec3> bent_blade(const std::vector<glm::dvec3>& flat, double main_vein_m, const PoseOptions& o,
                                   std::uint64_t seed) {
  const Arc midrib(main_vein_m, [&](double t) { return kRad * (o.midrib_rise_deg - o.midrib_bend_deg * std::pow(t, 1.4)); });
  // Beyond the half-width the curvature does not go on growing.
  const double half = 0.72 * main_vein_m;
  const Arc across(half, [&](double t) { return kRad * (o.fold_deg - o.droop_deg * std::pow(t, 1.3)); });
  const Reach reach(flat);
  Random random(seed, Stream::outline, kWaves);
  std::vector<double> phase, size;
  for (int k = 0; k < 3; ++k) {
    phase.push_back(random.uniform(0, 2 * std::numbers::pi));
    size.push_back(random.uniform(0.6, 1.0));
  }
  std::vector<glm::dvec3> out(flat.size());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const glm::dvec3& p = flat[i];
    double x, z, slope, y, rise, tilt;
    midrib.at(p.x, x, z, slope);
    across.at(std::abs(p.y), y, rise, tilt);
    // Waves of the margin: a few frequencies around the base, growing outwards.
    const double around = std::atan2(p.y, p.x), r = reach.share(p);
    double wave = 0;
    for (std::size_t k = 0; k < 3; ++k)
      wave += size[k] * std::sin((o.waves + double(k) - 1) * around + phase[k]) / 1.7;
    // Near the petiole the margin is near, too, but it does not wave there.
    const double away = std::min(1.0, glm::length(glm::dvec2(p)) / (0.55 * main_vein_m));
    const double grown = r * r * r * away * away;
    const double height = rise + (o.waves > 0 ? o.waviness * main_vein_m * grown * wave : 0.0) * std::cos(tilt);
    const glm::dvec3 normal(-std::sin(slope), 0, std::cos(slope));
    out[i] = glm::dvec3(x, std::copysign(y, p.y), z) + height * normal;
  }
  return out;
}

std::vector<double> relief(const LeafModel& m, const LeafOptions& o) {
  const std::size_t n = m.flat.position_m.size();
  const auto& flat = m.flat.position_m;
  const double side_spacing = o.veins.side_spacing * o.main_vein_m;
  SegmentGrid large(1.5 * side_spacing), net(1.5 * std::max(o.veins.net_spacing_m, 1e-4));
  for (std::size_t v = 0; v < m.veins.size(); ++v)
    (m.veins[v].order < 3 ? large : net).add_line(m.veins[v].line_m, int(v));
  large.build();
  net.build();

  // Tied down where veins run; a weak tie everywhere keeps wide bays and the margin from rising without bound.
  const auto area = vertex_areas(flat, m.flat.triangles);
  std::vector<double> tie(n), pressure(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto hit = large.nearest(glm::dvec2(flat[i]));
    const double width = 0.0012 * std::sqrt(o.main_vein_m / 0.15);
    const double on_vein = std::exp(-(hit.distance_m / width) * (hit.distance_m / width));
    const double order = hit.tag >= 0 && m.veins[std::size_t(hit.tag)].order == 1 ? 1.0 : 0.6;
    tie[i] = area[i] * (1.5 / (side_spacing * side_spacing) + 40 * order * on_vein / (width * width));
    pressure[i] = area[i];
  }
  for (const int v : m.border) tie[std::size_t(v)] += area[std::size_t(v)] * 30 / (side_spacing * side_spacing);
  const SparseCholesky solver(scaled_plus_diagonal(cotangent_laplacian(m.flat), 0.5, tie));
  std::vector<double> bulge(n);
  solver.solve(pressure, bulge);
  std::vector<double> sorted = bulge;
  const std::size_t high = n * 9 / 10;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(high), sorted.end());
  const double unit = std::max(sorted[high], 1e-300);

  std::vector<double> height(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto fine = net.nearest(glm::dvec2(flat[i]));
    const double half = 0.45 * o.veins.net_spacing_m;
    const double cushion = fine.tag >= 0 ? 1 - std::pow(1 - std::min(1.0, fine.distance_m / half), 2.0) : 0.0;
    height[i] = o.pose.pucker_m * bulge[i] / unit + o.pose.fine_pucker_m * (cushion - 0.5);
    const auto hit = large.nearest(glm::dvec2(flat[i]));
    if (hit.tag < 0) continue;
    const Vein& vein = m.veins[std::size_t(hit.tag)];
    const double width = vein.width_base_m + (vein.width_tip_m - vein.width_base_m) * hit.along;
    const double share = width / o.veins.main_width_m, q = hit.distance_m / (0.8 * width + 0.0004);
    height[i] -= o.pose.vein_groove_m * share * std::exp(-q * q);
  }
  return height;
}

}  // namespace witherfield::leaf
