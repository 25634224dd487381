// User curves as key frames: monotone cubic interpolation (Fritsch & Carlson 1980), no overshoot between keys.
#pragma once
#include <utility>
#include <vector>

namespace witherfield {

class Curve {
 public:
  Curve() = default;
  /// @param keys (x, y) pairs, x strictly increasing, at least 2, finite.
  /// @throws InvalidInput naming `what`, the key number and the value otherwise.
  Curve(std::vector<std::pair<double, double>> keys, const char* what);
  /// Value; constant beyond the first and the last key.
  double operator()(double x) const;
  double derivative(double x) const;  ///< 0 beyond the ends
  bool empty() const { return x_.empty(); }
  bool non_decreasing() const;
  bool non_increasing() const;
  std::vector<std::pair<double, double>> keys() const;

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace witherfield
