// Tests of samples against distributions, at 1 %.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/floor/options.hpp"

namespace witherfield::floor {

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

inline double truncated_cdf(const Spread& s, double x) {
  const double lo = normal_cdf((s.lo - s.mean) / s.sd), hi = normal_cdf((s.hi - s.mean) / s.sd);
  return (normal_cdf((std::clamp(x, s.lo, s.hi) - s.mean) / s.sd) - lo) / (hi - lo);
}

/// Kolmogorov-Smirnov: sqrt(n) times the largest distance between the two distributions; above 1.628 in 1 % of cases.
inline double kolmogorov(std::vector<double> sample, const Spread& s) {
  std::sort(sample.begin(), sample.end());
  const double n = double(sample.size());
  double d = 0;
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const double f = truncated_cdf(s, sample[k]);
    d = std::max({d, f - double(k) / n, double(k + 1) / n - f});
  }
  return d * std::sqrt(n);
}
inline constexpr double kKolmogorov1Percent = 1.628;

/// Pearson's chi-square of counts against expected shares.
inline double chi_square(const std::vector<double>& counts, const std::vector<double>& shares) {
  double n = 0, all = 0, sum = 0;
  for (const double c : counts) n += c;
  for (const double s : shares) all += s;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double expected = n * shares[k] / all;
    sum += (counts[k] - expected) * (counts[k] - expected) / expected;
  }
  return sum;
}
/// 99th percentile for 1..8 degrees of freedom.
inline constexpr double kChiSquare1Percent[] = {0, 6.635, 9.210, 11.345, 13.277, 15.086, 16.812, 18.475, 20.090};

}  // namespace witherfield::floor
