#include "vis/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace witherfield::vis {

Ticks ticks(double lo, double hi, int wanted) {
  const double rough = (hi - lo) / wanted;
  const int decade = static_cast<int>(std::floor(std::log10(rough)));
  double step = std::pow(10.0, decade + 1);
  int exponent = decade + 1;  // of the step's only digit
  for (const double factor : {5.0, 2.0, 1.0}) {
    const double finer = factor * std::pow(10.0, decade);
    const bool too_few = std::floor(hi / step + 1e-9) - std::ceil(lo / step - 1e-9) < 1;
    if (finer < rough * 0.9 && !too_few) break;
    step = finer;
    exponent = decade;
  }
  const double largest = std::max(std::abs(lo), std::abs(hi));
  const bool scientific = exponent < -4 || largest >= 1e6;
  const int digits = scientific ? static_cast<int>(std::floor(std::log10(largest))) - exponent : -exponent;

  Ticks out;
  const double first = std::ceil(lo / step - 1e-9), last = std::floor(hi / step + 1e-9);
  for (double n = first; n <= last; ++n) {
    const double value = n == 0 ? 0.0 : n * step;  // no minus zero
    out.values.push_back(value);
    out.labels.push_back(
        fmt::format(fmt::runtime(scientific ? "{:.{}e}" : "{:.{}f}"), value, std::max(0, digits)));
  }
  return out;
}

}  // namespace witherfield::vis
