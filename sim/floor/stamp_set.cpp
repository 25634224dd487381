#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/core/parallel.hpp"
#include "sim/floor/masks.hpp"
#include "sim/floor/stamp.hpp"

namespace witherfield::floor {
namespace {

/// A turned mask, packed.
struct Turned {
  std::vector<StampSet::Strip> strips;
  std::vector<float> data;
};

Turned pack(const std::vector<float>& v, int size) {
  const int middle = (size - 1) / 2;
  const auto value = [&](int i, int j) {
    return i < 0 || j < 0 || i >= size || j >= size ? 0.0f : v[std::size_t(j) * std::size_t(size) + std::size_t(i)];
  };
  const auto column_used = [&](int i) {
    for (int j = 0; j < size; ++j)
      if (value(i, j) != 0) return true;
    return false;
  };
  int first = 0, last = size - 1;
  while (first < size && !column_used(first)) ++first;
  while (last >= first && !column_used(last)) --last;
  Turned t;
  for (int column = first; column <= last + 1; column += StampSet::kWidth) {  // + 1: shifted to the right
    int low = size, high = -1;
    for (int j = 0; j < size; ++j)
      for (int i = column - 1; i < column + StampSet::kWidth; ++i)
        if (value(i, j) != 0) low = std::min(low, j), high = j;
    if (high < 0) continue;
    t.strips.push_back({std::uint32_t(t.data.size()), std::int16_t(low - middle), std::int16_t(column - middle),
                        std::int16_t(high - low + 2)});
    for (int j = low; j <= high + 1; ++j)
      for (int i = column; i < column + StampSet::kWidth; ++i) t.data.push_back(j > high ? 0.0f : value(i, j));
    for (int j = low; j <= high + 1; ++j) t.data.push_back(j > high ? 0.0f : value(column - 1, j));
    t.data.resize((t.data.size() + StampSet::kWidth - 1) / StampSet::kWidth * StampSet::kWidth);  // rows stay aligned
  }
  return t;
}

}  // namespace

StampSet::StampSet(const std::vector<float>& values, int size, int angles) {
  sum_ = std::accumulate(values.begin(), values.end(), 0.0);
  const int middle = (size - 1) / 2;
  double reach = 0;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      if (values[std::size_t(j) * std::size_t(size) + std::size_t(i)] != 0)
        reach = std::max(reach, std::hypot(i - middle, j - middle));
  const int out = 2 * (int(std::ceil(reach)) + 1) + 1;
  std::vector<Turned> turned(static_cast<std::size_t>(angles));
  parallel_for(std::size_t(angles), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t a = begin; a < end; ++a) {
      std::vector<float> v = rotate(values, size, rotation(int(a), angles), out);
      const double sum = std::accumulate(v.begin(), v.end(), 0.0), ratio = sum > 0 ? sum_ / sum : 1;
      for (float& x : v) x = float(x * ratio);
      turned[a] = pack(v, out);
    }
  });
  reach_ = (out - 1) / 2 + 1;
  first_.push_back(0);
  std::uint32_t at = 0;
  for (const Turned& t : turned) {
    for (Strip s : t.strips) {
      s.first += at;
      strips_.push_back(s);
    }
    at += std::uint32_t(t.data.size());
    first_.push_back(strips_.size());
  }
  data_.require(at);
  float* to = data_.data();
  for (const Turned& t : turned) to = std::copy(t.data.begin(), t.data.end(), to);
}

}  // namespace witherfield::floor
