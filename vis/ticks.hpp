// Round numbers for scales.
#pragma once
#include <string>
#include <vector>

namespace witherfield::vis {

struct Ticks {
  std::vector<double> values;       ///< multiples of 1, 2 or 5 times a power of ten within [lo, hi]
  std::vector<std::string> labels;  ///< as many decimals as the step needs
};

/// About `wanted` ticks, never fewer than 2 nor more than wanted + 3. @pre lo < hi, wanted >= 2.
Ticks ticks(double lo, double hi, int wanted);

}  // namespace witherfield::vis
