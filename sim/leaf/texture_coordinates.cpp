#include "sim/leaf/texture_coordinates.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

PrincipalPlane principal_plane(std::span<const glm::dvec3> points, const glm::dvec3& along, const glm::dvec3& up) {
  if (points.size() < 3) throw InvalidInput("principal_plane: fewer than 3 points");
  PrincipalPlane plane;
  for (const glm::dvec3& p : points) plane.centre += p / double(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - plane.centre;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    scatter += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / double(points.size()));
  if (!(solver.eigenvalues()[1] > 1e-12 * solver.eigenvalues()[2]))
    throw InvalidInput("principal_plane: the points lie on one line");
  const auto axis = [&](int k) {
    const Eigen::Vector3d v = solver.eigenvectors().col(k);
    return glm::dvec3(v[0], v[1], v[2]);
  };
  plane.first = axis(2), plane.second = axis(1), plane.normal = axis(0);
  if (glm::dot(plane.normal, up) < 0) plane.normal = -plane.normal;
  // Either component may be the one along the leaf: wide leaves vary more across.
  if (std::abs(glm::dot(plane.first, along)) >= std::abs(glm::dot(plane.second, along))) {
    if (glm::dot(plane.first, along) < 0) plane.first = -plane.first;
    plane.second = glm::cross(plane.normal, plane.first);
  } else {
    if (glm::dot(plane.second, along) < 0) plane.second = -plane.second;
    plane.first = glm::cross(plane.second, plane.normal);
  }
  return plane;
}

std::vector<glm::dvec2> plane_uv(std::span<const glm::dvec3> points, const PrincipalPlane& plane) {
  std::vector<glm::dvec2> uv;
  glm::dvec2 low(1e300), high(-1e300);
  for (const glm::dvec3& p : points) {
    uv.emplace_back(glm::dot(p - plane.centre, plane.first), glm::dot(p - plane.centre, plane.second));
    low = glm::min(low, uv.back()), high = glm::max(high, uv.back());
  }
  const double size = std::max(high.x - low.x, high.y - low.y);
  const glm::dvec2 shift = 0.5 * (low + high) - 0.5 * size;
  for (glm::dvec2& p : uv) p = glm::clamp((p - shift) / size, 0.0, 1.0);
  return uv;
}

}  // namespace witherfield::leaf
