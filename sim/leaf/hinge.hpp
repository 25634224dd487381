// The angle between two triangles across their common edge, and how it changes with the four corners.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace witherfield::leaf {

/// Corners: edge from j to k, i on its left (first triangle i j k), o on its right (second triangle o k j).
/// Angle 0 when flat, > 0 when o and i rise towards the upper side (concave seen from above), in (-pi, pi).
inline double hinge_angle(const glm::dvec3& i, const glm::dvec3& j, const glm::dvec3& k, const glm::dvec3& o) {
  const glm::dvec3 e = k - j;
  const glm::dvec3 n1 = glm::cross(e, i - j), n2 = glm::cross(o - j, e);
  return std::atan2(glm::dot(glm::cross(n2, n1), e) / glm::length(e), glm::dot(n1, n2));
}

struct HingeGradient {
  glm::dvec3 i, j, k, o;
};

/// d angle / d corner: a corner off the edge turns its triangle by its normal over its height; the edge's ends carry what keeps
/// the sum of all four zero, split by the feet of the heights (Bridson, Marino, Fedkiw 2003).
inline HingeGradient hinge_gradient(const glm::dvec3& i, const glm::dvec3& j, const glm::dvec3& k, const glm::dvec3& o) {
  const glm::dvec3 e = k - j;
  const glm::dvec3 n1 = glm::cross(e, i - j), n2 = glm::cross(o - j, e);
  const double length = glm::length(e), square = length * length;
  HingeGradient g;
  g.i = n1 * (length / glm::dot(n1, n1));
  g.o = n2 * (length / glm::dot(n2, n2));
  const double foot1 = glm::dot(i - j, e) / square, foot2 = glm::dot(o - j, e) / square;
  g.j = -(1 - foot1) * g.i - (1 - foot2) * g.o;
  g.k = -foot1 * g.i - foot2 * g.o;
  return g;
}

/// Second derivatives of the angle; block ab = d2 angle / (d a d b); i and o are not coupled, the others follow by symmetry.
struct HingeHessian {
  glm::dmat3 ii, ij, ik, oo, oj, ok, jj, jk, kk;
};

inline HingeHessian hinge_hessian(const glm::dvec3& i, const glm::dvec3& j, const glm::dvec3& k, const glm::dvec3& o) {
  const auto cross_matrix = [](const glm::dvec3& v) { return glm::dmat3(0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0); };
  const glm::dvec3 e = k - j;
  const double length = glm::length(e), square = length * length;
  const glm::dmat3 ex = cross_matrix(e);
  HingeHessian h;
  h.kk = glm::dmat3(0.0);
  // One side: apex at `a` from j, normal N = sign e x a, gradient g = |e| N / N^2, whose change is
  // dg = d|e| N / N^2 + |e| (1 - 2 n n^T) dN / N^2.
  const auto side = [&](const glm::dvec3& a, double sign, glm::dmat3& own, glm::dmat3& with_j, glm::dmat3& with_k) {
    const glm::dvec3 normal = sign * glm::cross(e, a), g = normal * (length / glm::dot(normal, normal));
    const glm::dmat3 turn =
        (glm::dmat3(1.0) - glm::outerProduct(normal, normal) * (2 / glm::dot(normal, normal))) * (length / glm::dot(normal, normal));
    own = turn * ex * sign;
    with_k = glm::outerProduct(g, e) / square - turn * cross_matrix(a) * sign;
    with_j = -own - with_k;
    const double foot = glm::dot(a, e) / square;
    h.kk -= glm::outerProduct(g, a - 2 * foot * e) / square + foot * with_k;
  };
  side(i - j, 1, h.ii, h.ij, h.ik);
  side(o - j, -1, h.oo, h.oj, h.ok);
  h.jk = -(h.ik + h.ok + h.kk);
  h.jj = -(h.ij + h.oj + glm::transpose(h.jk));
  return h;
}

}  // namespace witherfield::leaf
