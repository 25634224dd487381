#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/fruit/wheat_ear.hpp"

namespace witherfield::fruit {
namespace {

constexpr double kSquareCentre_mm = 0.9;  // of vertices 4-5-6-7 before the ear's axis, wedge_shape()

/// Kernel 0 stands in front of the square, above the lower florets, leaning a little outward.
Frame kernel_zero() {
  return {rotation_x(radians(11)), {0, -2.35, 2.6}};
}

/// Turn about the square's middle that makes kernel 1 or 2 of kernel 0: round the segment's upright and to
/// the side.
glm::dmat3 turn(double round_deg, double side_deg) {
  return rotation_y(radians(side_deg)) * rotation_z(radians(round_deg));
}

}  // namespace

FloretPlace floret_place(int kernel) {
  const Frame zero = kernel_zero();
  if (kernel == 0) return {zero, false, 0.82};
  const bool outer = kernel == 2 || kernel == 4;
  Frame f = Frame{outer ? turn(74, 16) : turn(38, 12), glm::dvec3(0)} * zero;
  f.origin.z -= outer ? 1.9 : 0.9;  // the outermost florets are the lowest on the spikelet's own axis
  return {f, kernel >= 3, outer ? 1.0 : 0.94};
}

FloretPlace glume_place(int side) {
  // The glume sits on the shank itself, below and outside of the outermost floret, and leans along its back.
  const Frame foot{rotation_x(radians(21)), {0, -1.25, -0.5}};
  return {Frame{turn(78, 12), glm::dvec3(0)} * foot, side < 0, 1.0};
}

std::vector<SpikeletPlace> spikelet_places(const WheatOptions& o) {
  std::vector<SpikeletPlace> places;
  const double internode = o.ear_length_mm / o.spikelets;
  for (int i = 0; i < o.spikelets; ++i) {
    const double x = o.spikelets > 1 ? double(i) / (o.spikelets - 1) : 0.5;
    // Largest below the middle, small at both ends.
    const double size =
        x < 0.35 ? 1 - 0.34 * std::pow(1 - x / 0.35, 2) : 1 - 0.34 * std::pow((x - 0.35) / 0.65, 2);
    const bool back = i % 2 == 1, terminal = i == o.spikelets - 1;
    const double z = o.stem_length_mm + (i + (terminal ? 0.25 : 0.8)) * internode;
    const double out = terminal ? 0.3 : kSquareCentre_mm;
    const double half_turn = terminal ? 90 : (back ? 180 : 0);
    const glm::dmat3 row = rotation_z(radians(half_turn));
    const Frame tilt{rotation_x(radians(terminal ? 0 : 7)), glm::dvec3(0)};
    places.push_back({Frame{row, row * glm::dvec3(0, -out, 0) + glm::dvec3(0, 0, z)} * tilt, size, terminal});
  }
  return places;
}

NoddingAxis::NoddingAxis(double length_mm, double nod_rad) : length_(length_mm), nod_(nod_rad) {
  constexpr int n = 64;
  centre_.push_back({0, 0});
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n, angle = nod_ * s * s;
    centre_.push_back(centre_.back() + length_ / n * glm::dvec2(std::sin(angle), std::cos(angle)));
  }
}

glm::dvec3 NoddingAxis::operator()(const glm::dvec3& p) const {
  const double s = std::clamp(p.z / length_, 0.0, 1.0), angle = nod_ * s * s;
  const double u = s * double(centre_.size() - 1);
  const std::size_t i = std::min(std::size_t(u), centre_.size() - 2);
  glm::dvec2 c = glm::mix(centre_[i], centre_[i + 1], u - double(i));
  const glm::dvec2 along(std::sin(angle), std::cos(angle));
  c += along * (p.z - s * length_);  // straight beyond both ends
  return {c.x + p.x * along.y, p.y, c.y - p.x * along.x};
}

}  // namespace witherfield::fruit
