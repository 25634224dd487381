#include "cli/markers.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace witherfield::cli {
namespace {

constexpr int kAround = 6, kBallRings = 8, kBallAround = 14;

void paint(Surface& s, std::size_t from, const glm::vec3& colour) {
  auto& diffuse = s.make_field("diffuse").values;
  diffuse.resize(3 * s.position_m.size());
  for (std::size_t v = from; v < s.position_m.size(); ++v)
    for (int c = 0; c < 3; ++c) diffuse[3 * v + std::size_t(c)] = colour[c];
}

/// Two triangles between ring `a` and ring `b` of `around` vertices each.
void join_rings(Surface& s, int a, int b, int around) {
  for (int k = 0; k < around; ++k) {
    const int l = (k + 1) % around;
    s.triangles.push_back({a + k, a + l, b + l});
    s.triangles.push_back({a + k, b + l, b + k});
  }
}

}  // namespace

void add_ball(Surface& s, const glm::dvec3& center, double radius, const glm::vec3& colour) {
  const std::size_t from = s.position_m.size();
  int before = -1;
  for (int i = 0; i <= kBallRings; ++i) {
    const double a = std::numbers::pi * (double(i) / kBallRings - 0.5);
    const double r = std::max(std::cos(a), 1e-3);  // the poles are tiny rings
    const int ring = int(s.position_m.size());
    for (int k = 0; k < kBallAround; ++k) {
      const double b = 2 * std::numbers::pi * k / kBallAround;
      s.position_m.push_back(center + radius * glm::dvec3(r * std::cos(b), r * std::sin(b), std::sin(a)));
    }
    if (before >= 0) join_rings(s, before, ring, kBallAround);
    before = ring;
  }
  paint(s, from, colour);
}

void add_cord(Surface& s, std::span<const glm::dvec3> points, double radius, const glm::vec3& colour) {
  if (points.size() < 2) return;
  const std::size_t from = s.position_m.size();
  glm::dvec3 side(0.0);
  int before = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 step = points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0];
    if (!(glm::length(step) > 0)) continue;
    const glm::dvec3 along = glm::normalize(step);
    side -= glm::dot(side, along) * along;
    if (!(glm::length(side) > 1e-6))
      side = glm::cross(along, std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
    side = glm::normalize(side);
    const glm::dvec3 other = glm::cross(along, side);
    const int ring = int(s.position_m.size());
    for (int k = 0; k < kAround; ++k) {
      const double a = 2 * std::numbers::pi * k / kAround;
      s.position_m.push_back(points[i] + radius * (std::cos(a) * side + std::sin(a) * other));
    }
    if (before >= 0) join_rings(s, before, ring, kAround);
    before = ring;
  }
  paint(s, from, colour);
}

}  // namespace witherfield::cli
