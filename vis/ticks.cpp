#include "vis/ticks.hpp"

#include <fmt/format.h>

#include <cmath>

namespace witherfield::vis {

Ticks ticks(double lo, double hi, int wanted) {
  const double rough = (hi - lo) / wanted, decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = decade * 10;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade >= rough * 0.9) step = factor * decade;
  const int exponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const bool scientific = exponent < -4 || std::max(std::abs(lo), std::abs(hi)) >= 1e6;

  Ticks out;
  const double first = std::ceil(lo / step - 1e-9), last = std::floor(hi / step + 1e-9);
  for (double n = first; n <= last; ++n) {
    const double value = n == 0 ? 0.0 : n * step;  // no minus zero
    out.values.push_back(value);
    out.labels.push_back(scientific ? fmt::format("{:.1e}", value)
                                    : fmt::format("{:.{}f}", value, std::max(0, -exponent)));
  }
  return out;
}

}  // namespace witherfield::vis
