// Footprints kept in memory, for tests.
#pragma once
#include <algorithm>
#include <memory>
#include <vector>

#include "sim/floor/simulate.hpp"

namespace witherfield::floor {

inline std::vector<Footprint> walked(const FloorOptions& o, Stretch stretch = {0, std::int64_t(1) << 40}) {
  std::vector<Footprint> all;
  walk(o, stretch, [&](std::span<const Footprint> p) { all.insert(all.end(), p.begin(), p.end()); });
  return all;
}

/// Hands them out in portions.
inline FootprintSource source_of(std::vector<Footprint> all, std::size_t portion = 5000) {
  return [kept = std::make_shared<std::vector<Footprint>>(std::move(all)), at = std::size_t(0), portion]() mutable {
    const std::size_t n = std::min(portion, kept->size() - at);
    at += n;
    return std::span<const Footprint>(kept->data() + at - n, n);
  };
}

}  // namespace witherfield::floor
