// Exact lowest and highest value of a piecewise bicubic function: a patch lies within its Bezier control
// values, so patches whose control values cannot beat the best value found are left out and the others are
// split.
#pragma once
#include <array>

namespace witherfield::terrain {

/// Bezier control values of one bicubic patch over the unit square; [row v][column u].
using BezierPatch = std::array<std::array<double, 4>, 4>;

/// The part of the patch over [u0, u1] x [v0, v1], as a patch over the unit square.
BezierPatch restrict_patch(const BezierPatch& patch, double u0, double u1, double v0, double v1);

class BezierRange {
 public:
  /// @param lowest, highest values that the function takes somewhere: the nearer to the extremes, the faster.
  BezierRange(double lowest, double highest);
  void add(const BezierPatch& patch);
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }

 private:
  double lowest_, highest_, tolerance_;  // 1e-7 of the first range
};

}  // namespace witherfield::terrain
