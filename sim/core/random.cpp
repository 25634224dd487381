#include "sim/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace witherfield {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  constexpr std::uint32_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u, w0 = 0x9E3779B9u, w1 = 0xBB67AE85u;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t(m0) * c[0], p1 = std::uint64_t(m1) * c[2];
    c = {std::uint32_t(p1 >> 32) ^ c[1] ^ k[0], std::uint32_t(p1), std::uint32_t(p0 >> 32) ^ c[3] ^ k[1],
         std::uint32_t(p0)};
    k[0] += w0;
    k[1] += w1;
  }
  return c;
}

Random::Random(std::uint64_t seed, Stream what, std::uint64_t index)
    : counter_{0, static_cast<std::uint32_t>(what), std::uint32_t(index), std::uint32_t(index >> 32)},
      key_{std::uint32_t(seed), std::uint32_t(seed >> 32)} {}

std::uint32_t Random::bits() {
  if (used_ == 4) {
    block_ = philox4x32(counter_, key_);
    ++counter_[0];
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

double Random::uniform() { return bits() * 0x1p-32; }
double Random::uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double u = (bits() + 1.0) * 0x1p-32, v = uniform();  // u in (0, 1]
  const double r = std::sqrt(-2 * std::log(u)), a = 2 * std::numbers::pi * v;
  spare_ = r * std::sin(a);
  has_spare_ = true;
  return r * std::cos(a);
}

double Random::truncated_normal(double mean, double sd, double lo, double hi) {
  for (int attempt = 0; attempt < 64; ++attempt) {
    const double x = mean + sd * normal();
    if (x >= lo && x <= hi) return x;
  }
  return std::clamp(mean, lo, hi);
}

}  // namespace witherfield
