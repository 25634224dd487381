// 3 x 3 matrices of the rotation-aware edit and the rotation nearest to one.
#pragma once
#include <glm/vec3.hpp>
#include <span>

namespace witherfield::leaf {

/// Row by row.
struct Mat3 {
  double m[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

  glm::dvec3 operator*(const glm::dvec3& v) const {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
  }
  Mat3 operator*(const Mat3& b) const {
    Mat3 r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r.m[3 * i + j] = m[3 * i] * b.m[j] + m[3 * i + 1] * b.m[3 + j] + m[3 * i + 2] * b.m[6 + j];
    return r;
  }
  static Mat3 zero() { return {{0, 0, 0, 0, 0, 0, 0, 0, 0}}; }
};

/// The rotation R with the largest trace(R S), S = sum of w p q^T: it takes the p to the q in the least-squares sense.
/// Horn 1987, "Closed-form solution of absolute orientation using unit quaternions"; the eigenvalue by Newton's method as in
/// Theobald 2005. Never a reflection. When S leaves the rotation open (all p on one line), the answer is the nearest
/// such rotation to `before`.
Mat3 closest_rotation(const Mat3& s, const Mat3& before);

struct RigidMotion {
  Mat3 rotation;
  glm::dvec3 shift{0, 0, 0};
  glm::dvec3 operator()(const glm::dvec3& p) const { return rotation * p + shift; }
};
/// Best rigid motion from `from` to `to` (equal weights) and its root mean square residual.
RigidMotion fit_rigid(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, double& residual);

}  // namespace witherfield::leaf
