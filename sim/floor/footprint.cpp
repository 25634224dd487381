#include "sim/floor/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace witherfield::floor {
namespace {

template <class Integer>
Integer fixed(double value, double unit) {
  return Integer(std::clamp(std::round(value / unit), 0.0, double(std::numeric_limits<Integer>::max())));
}

}  // namespace

double Footprint::heading_rad() const {
  const double turns = heading_turns / 65536.0;
  return 2 * std::numbers::pi * (turns > 0.5 ? turns - 1 : turns);
}

Footprint pack(const Step& s, std::uint32_t person, double weight_N, double foot_length_m, int sole,
               Behaviour behaviour) {
  Footprint f;
  f.time_s = s.time_s;
  f.person = person;
  f.x_m = float(s.foot_m.x);
  f.y_m = float(s.foot_m.y);
  const double turns = s.foot_heading_rad / (2 * std::numbers::pi);
  f.heading_turns = std::uint16_t(std::int64_t(std::llround((turns - std::floor(turns)) * 65536)) & 0xFFFF);
  f.weight_dN = fixed<std::uint16_t>(weight_N, 0.1);
  f.sole_length_dmm = fixed<std::uint16_t>(foot_length_m, 1e-4);
  f.contact_cs = fixed<std::uint16_t>(s.contact_s, 0.01);
  f.number = std::uint16_t(std::min<std::uint32_t>(s.number, 65535));
  f.slip_hmm = fixed<std::uint8_t>(s.slip_m, 5e-4);
  f.code = std::uint8_t(int(s.foot) | (sole & 7) << 1 | int(behaviour) << 4 | int(s.phase) << 6);
  return f;
}

}  // namespace witherfield::floor
