#include "sim/leaf/edit_report.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace witherfield::leaf {
namespace {

glm::dvec3 corner(std::span<const glm::dvec3> p, const std::array<int, 3>& t, int k) { return p[std::size_t(t[std::size_t(k)])]; }

glm::dvec3 area_vector(std::span<const glm::dvec3> p, const std::array<int, 3>& t) {
  return 0.5 * glm::cross(corner(p, t, 1) - corner(p, t, 0), corner(p, t, 2) - corner(p, t, 0));
}

/// For each face: does it look against the sum of the faces across its edges?
std::vector<bool> against_neighbours(std::span<const glm::dvec3> p, std::span<const std::array<int, 3>> triangles) {
  std::unordered_map<std::uint64_t, int> face_of;  // directed edge -> face
  face_of.reserve(triangles.size() * 3);
  const auto key = [](int a, int b) { return (std::uint64_t(std::uint32_t(a)) << 32) | std::uint32_t(b); };
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) face_of[key(triangles[f][k], triangles[f][(k + 1) % 3])] = int(f);
  std::vector<bool> against(triangles.size(), false);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    glm::dvec3 around(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = face_of.find(key(triangles[f][(k + 1) % 3], triangles[f][k]));
      if (other != face_of.end()) around += area_vector(p, triangles[std::size_t(other->second)]);
    }
    against[f] = glm::dot(area_vector(p, triangles[f]), around) < 0;
  }
  return against;
}

}  // namespace

std::vector<std::array<double, 2>> principal_stretches(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
                                                       std::span<const std::array<int, 3>> triangles) {
  std::vector<std::array<double, 2>> stretches(triangles.size(), {1.0, 1.0});
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    // Right Cauchy-Green tensor C = G^-1/2 g G^-1/2 from the metrics of both triangles: eigenvalues of G^-1 g.
    const auto metric = [&](std::span<const glm::dvec3> p, double& e, double& m, double& g) {
      const glm::dvec3 a = corner(p, triangles[f], 1) - corner(p, triangles[f], 0),
                       b = corner(p, triangles[f], 2) - corner(p, triangles[f], 0);
      e = glm::dot(a, a), m = glm::dot(a, b), g = glm::dot(b, b);
    };
    double e0, m0, g0, e1, m1, g1;
    metric(before, e0, m0, g0);
    metric(after, e1, m1, g1);
    const double det0 = e0 * g0 - m0 * m0, det1 = std::max(0.0, e1 * g1 - m1 * m1);
    if (!(det0 > 0)) continue;
    const double half_trace = 0.5 * (g0 * e1 - 2 * m0 * m1 + e0 * g1) / det0, det = det1 / det0;
    const double root = std::sqrt(std::max(0.0, half_trace * half_trace - det));
    stretches[f] = {std::sqrt(half_trace + root), std::sqrt(std::max(0.0, half_trace - root))};
  }
  return stretches;
}

EditReport edit_report(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
                       std::span<const std::array<int, 3>> triangles) {
  EditReport r;
  const auto stretches = principal_stretches(before, after, triangles);
  double squares = 0;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const double area = glm::length(area_vector(before, triangles[f]));
    r.area_before_m2 += area;
    r.area_after_m2 += glm::length(area_vector(after, triangles[f]));
    for (const double s : stretches[f]) {
      squares += 0.5 * area * (s - 1) * (s - 1);
      if (std::abs(s - 1) > r.largest_strain) r.largest_strain = std::abs(s - 1), r.largest_strain_face = int(f);
    }
  }
  if (r.area_before_m2 > 0) {
    r.area_drift = r.area_after_m2 / r.area_before_m2 - 1;
    r.rms_strain = std::sqrt(squares / r.area_before_m2);
  }
  const auto was = against_neighbours(before, triangles), is = against_neighbours(after, triangles);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    if (is[f] && !was[f]) {
      ++r.flipped_faces;
      if (r.flipped_ids.size() < 100) r.flipped_ids.push_back(int(f));
    }
  return r;
}

}  // namespace witherfield::leaf
