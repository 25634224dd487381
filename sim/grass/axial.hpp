// Means of axial data: t and -t are the same fibre, so dyads t t^T are averaged, never t (erratum E0.4), and
// the mean direction is the principal axis of the sum. Shared by the texel builders (voxelize, splat,
// mingle).
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

namespace witherfield::grass {

/// Principal axis (eigenvector of the largest eigenvalue) of the symmetric positive semi-definite matrix
/// m = {xx, xy, xz, yy, yz, zz}, unit length, dot(result, guess) >= 0. For a sum of dyads w t t^T the guess
/// is the t of the largest w; where the largest eigenvalue is double, the axis is the one nearest the guess.
/// m = 0 gives the guess itself. Only selections, no branches: a loop over arrays of matrices is vectorised
/// (GCC: with -fno-math-errno -fno-trapping-math, neither of which changes a bit of the result).
///
/// How: m^16 by four squarings, then applied four times to the guess, so that a second eigenvalue of 0.9 of
/// the first has faded to 0.9^64 = 0.1 %. Scaled by the trace once, m^64 stays above 3^-64, well inside the
/// range of float.
inline glm::vec3 principal_axis(const float m[6], glm::vec3 guess) {
  const float trace = m[0] + m[3] + m[5];
  const float scale = 1.0f / (trace > 1e-36f ? trace : 1.0f);
  float xx = m[0] * scale, xy = m[1] * scale, xz = m[2] * scale, yy = m[3] * scale, yz = m[4] * scale,
        zz = m[5] * scale;
  for (int squaring = 0; squaring < 4; ++squaring) {
    const float a = xx * xx + xy * xy + xz * xz, b = xx * xy + xy * yy + xz * yz,
                c = xx * xz + xy * yz + xz * zz;
    const float d = xy * xy + yy * yy + yz * yz, e = xy * xz + yy * yz + yz * zz,
                f = xz * xz + yz * yz + zz * zz;
    xx = a, xy = b, xz = c, yy = d, yz = e, zz = f;
  }
  float x = xx * guess.x + xy * guess.y + xz * guess.z;
  float y = xy * guess.x + yy * guess.y + yz * guess.z;
  float z = xz * guess.x + yz * guess.y + zz * guess.z;
  // A guess across the axis would leave only rounding noise: then start from the column of the largest
  // diagonal element. 0.3 lies below 1/3, what any guess keeps of a matrix without preference.
  const float power_trace = xx + yy + zz;
  const bool lost = x * x + y * y + z * z <= 0.09f * power_trace * power_trace;
  const bool first = xx >= yy && xx >= zz, second = yy >= zz;
  x = lost ? (first ? xx : second ? xy : xz) : x;
  y = lost ? (first ? xy : second ? yy : yz) : y;
  z = lost ? (first ? xz : second ? yz : zz) : z;
  for (int application = 0; application < 3; ++application) {
    const float a = xx * x + xy * y + xz * z, b = xy * x + yy * y + yz * z, c = xz * x + yz * y + zz * z;
    x = a, y = b, z = c;
  }
  // x, y, z may be as small as 3^-64: scaled up before squaring.
  const float largest = std::fabs(x) + std::fabs(y) + std::fabs(z);
  const float up = 1.0f / (largest > 0.0f ? largest : 1.0f);
  x *= up, y *= up, z *= up;
  const float sign = x * guess.x + y * guess.y + z * guess.z < 0.0f ? -1.0f : 1.0f;
  const float length2 = x * x + y * y + z * z;
  const float unit = sign / std::sqrt(length2 > 0.0f ? length2 : 1.0f);
  const bool none = !(largest > 0.0f);
  return {none ? guess.x : x * unit, none ? guess.y : y * unit, none ? guess.z : z * unit};
}

/// Adds w * v v^T to m.
inline void add_dyad(float m[6], float w, const glm::vec3& v) {
  m[0] += w * v.x * v.x, m[1] += w * v.x * v.y, m[2] += w * v.x * v.z;
  m[3] += w * v.y * v.y, m[4] += w * v.y * v.z, m[5] += w * v.z * v.z;
}

}  // namespace witherfield::grass
