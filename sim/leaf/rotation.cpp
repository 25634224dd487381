#include "sim/leaf/rotation.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <glm/geometric.hpp>

namespace witherfield::leaf {
namespace {

Mat3 from_quaternion(double w, double x, double y, double z) {
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
           s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),  //
           s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
}

/// Horn's symmetric 4 x 4 matrix; the eigenvector of its largest eigenvalue is the quaternion.
struct Horn {
  double a, b, c, d;        // diagonal
  double ab, ac, ad, bc, bd, cd;
  explicit Horn(const Mat3& s)
      : a(s.m[0] + s.m[4] + s.m[8]), b(s.m[0] - s.m[4] - s.m[8]), c(-s.m[0] + s.m[4] - s.m[8]),
        d(-s.m[0] - s.m[4] + s.m[8]), ab(s.m[5] - s.m[7]), ac(s.m[6] - s.m[2]), ad(s.m[1] - s.m[3]),
        bc(s.m[1] + s.m[3]), bd(s.m[6] + s.m[2]), cd(s.m[5] + s.m[7]) {}
};

Mat3 by_eigen_solver(const Mat3& s, const Mat3& before) {
  // S is added to a trace of the earlier rotation, which decides what S leaves open.
  double norm = 0;
  for (const double v : s.m) norm += v * v;
  norm = std::sqrt(norm);
  if (!(norm > 0)) return before;
  Mat3 mixed = s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mixed.m[3 * i + j] += 1e-7 * norm * before.m[3 * j + i];
  const Horn h(mixed);
  Eigen::Matrix4d k;
  k << h.a, h.ab, h.ac, h.ad, h.ab, h.b, h.bc, h.bd, h.ac, h.bc, h.c, h.cd, h.ad, h.bd, h.cd, h.d;
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(k).eigenvectors().col(3);
  return from_quaternion(q[0], q[1], q[2], q[3]);
}

}  // namespace

Mat3 closest_rotation(const Mat3& s, const Mat3& before) {
  double norm2 = 0;
  for (const double v : s.m) norm2 += v * v;
  if (!(norm2 > 0)) return before;
  const Horn h(s);
  // Characteristic polynomial l^4 + c2 l^2 + c1 l + c0, from the largest root's upper bound sqrt(3) |S| downwards.
  const double det = s.m[0] * (s.m[4] * s.m[8] - s.m[5] * s.m[7]) - s.m[1] * (s.m[3] * s.m[8] - s.m[5] * s.m[6]) +
                     s.m[2] * (s.m[3] * s.m[7] - s.m[4] * s.m[6]);
  const double c2 = -2 * norm2, c1 = -8 * det;
  const double p0 = h.a * h.b - h.ab * h.ab, p1 = h.a * h.bc - h.ab * h.ac, p2 = h.a * h.bd - h.ab * h.ad,
               p3 = h.ab * h.bc - h.b * h.ac, p4 = h.ab * h.bd - h.b * h.ad, p5 = h.ac * h.bd - h.bc * h.ad;
  const double q5 = h.c * h.d - h.cd * h.cd, q4 = h.bc * h.d - h.cd * h.bd, q3 = h.bc * h.cd - h.c * h.bd,
               q2 = h.ac * h.d - h.cd * h.ad, q1 = h.ac * h.cd - h.c * h.ad, q0 = h.ac * h.bd - h.bc * h.ad;
  const double c0 = p0 * q5 - p1 * q4 + p2 * q3 + p3 * q2 - p4 * q1 + p5 * q0;
  double l = std::sqrt(3 * norm2);
  for (int i = 0; i < 30; ++i) {
    const double l2 = l * l, f = (l2 + c2) * l2 + c1 * l + c0, slope = (4 * l2 + 2 * c2) * l + c1;
    if (!(slope > 0)) break;
    const double step = f / slope;
    l -= step;
    if (std::abs(step) < 1e-14 * l) break;
  }
  // Eigenvector: a column of the adjugate of K - l; the third one first, it is rarely small near the identity's.
  const double a = h.a - l, b = h.b - l, c = h.c - l, d = h.d - l;
  const double m0 = c * d - h.cd * h.cd, m1 = h.bc * d - h.cd * h.bd, m2 = h.bc * h.cd - c * h.bd;
  const double w = b * m0 - h.bc * m1 + h.bd * m2;
  const double x = -(h.ab * m0 - h.bc * (h.ac * d - h.cd * h.ad) + h.bd * (h.ac * h.cd - c * h.ad));
  const double y = h.ab * m1 - b * (h.ac * d - h.cd * h.ad) + h.bd * (h.ac * h.bd - h.bc * h.ad);
  const double z = -(h.ab * m2 - b * (h.ac * h.cd - c * h.ad) + h.bc * (h.ac * h.bd - h.bc * h.ad));
  const double size2 = w * w + x * x + y * y + z * z, cubed = norm2 * norm2 * norm2;
  (void)a;
  if (!(size2 > 1e-14 * cubed)) return by_eigen_solver(s, before);
  return from_quaternion(w, x, y, z);
}

RigidMotion fit_rigid(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, double& residual) {
  glm::dvec3 centre_from(0.0), centre_to(0.0);
  const double n = double(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) centre_from += from[i] / n, centre_to += to[i] / n;
  Mat3 s = Mat3::zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec3 p = from[i] - centre_from, q = to[i] - centre_to;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) s.m[3 * a + b] += p[a] * q[b];
  }
  RigidMotion motion;
  motion.rotation = closest_rotation(s, Mat3{});
  motion.shift = centre_to - motion.rotation * centre_from;
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec3 miss = to[i] - motion(from[i]);
    sum += glm::dot(miss, miss);
  }
  residual = std::sqrt(sum / n);
  return motion;
}

}  // namespace witherfield::leaf
