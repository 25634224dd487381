#include "sim/terrain/bezier_range.hpp"

#include <algorithm>

namespace witherfield::terrain {
namespace {

using Cubic = std::array<double, 4>;

// Left part [0, t] of a cubic by de Casteljau.
Cubic left_part(const Cubic& b, double t) {
  const double p01 = b[0] + t * (b[1] - b[0]), p12 = b[1] + t * (b[2] - b[1]), p23 = b[2] + t * (b[3] - b[2]);
  const double p012 = p01 + t * (p12 - p01), p123 = p12 + t * (p23 - p12);
  return {b[0], p01, p012, p012 + t * (p123 - p012)};
}

Cubic reversed(const Cubic& b) {
  return {b[3], b[2], b[1], b[0]};
}

Cubic restrict_cubic(const Cubic& b, double t0, double t1) {
  const Cubic left = t1 < 1 ? left_part(b, t1) : b;
  // [t0, t1] is the right part of [0, t1], cut at t0 / t1.
  return t0 > 0 && t1 > 0 ? reversed(left_part(reversed(left), 1 - t0 / t1)) : left;
}

double lowest_control(const BezierPatch& p) {
  double lo = p[0][0];
  for (const Cubic& row : p) lo = std::min(lo, *std::min_element(row.begin(), row.end()));
  return lo;
}

// Lowers `best` to the patch's lowest value, unless it cannot lie more than `tolerance` below.
void search_lowest(const BezierPatch& patch, double tolerance, int depth, double& best) {
  best = std::min({best, patch[0][0], patch[0][3], patch[3][0], patch[3][3]});
  if (depth == 0 || lowest_control(patch) >= best - tolerance) return;
  for (const double v : {0.0, 0.5})
    for (const double u : {0.0, 0.5})
      search_lowest(restrict_patch(patch, u, u + 0.5, v, v + 0.5), tolerance, depth - 1, best);
}

BezierPatch negated(BezierPatch p) {
  for (Cubic& row : p)
    for (double& value : row) value = -value;
  return p;
}

}  // namespace

BezierPatch restrict_patch(const BezierPatch& patch, double u0, double u1, double v0, double v1) {
  BezierPatch out;
  for (std::size_t b = 0; b < 4; ++b) out[b] = restrict_cubic(patch[b], u0, u1);
  for (std::size_t a = 0; a < 4; ++a) {
    const Cubic column = restrict_cubic({out[0][a], out[1][a], out[2][a], out[3][a]}, v0, v1);
    for (std::size_t b = 0; b < 4; ++b) out[b][a] = column[b];
  }
  return out;
}

BezierRange::BezierRange(double lowest, double highest)
    : lowest_(lowest), highest_(highest), tolerance_(1e-7 * (highest - lowest) + 1e-12) {}

void BezierRange::add(const BezierPatch& patch) {
  // Halving a patch brings its control values four times nearer; 20 halvings end far below the tolerance.
  constexpr int depth = 20;
  search_lowest(patch, tolerance_, depth, lowest_);
  double negative_highest = -highest_;
  search_lowest(negated(patch), tolerance_, depth, negative_highest);
  highest_ = -negative_highest;
}

}  // namespace witherfield::terrain
