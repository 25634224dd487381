#include "sim/floor/masks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/core/curve.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::floor {
namespace {

constexpr double kSoleLonger_m = 0.012;  // outsole over foot
constexpr double kSmear_m = 0.045;       // how far a sliding toe draws its print
constexpr double kDesignLength_m = 0.283;
constexpr double kEdge_m = 0.004;        // over which the pressure falls off at the sole's border

/// A pressure zone: bell of the given height, place and widths (t along the sole 0..1, y to the inner side in metres).
struct Zone { double weight, t, y_m, sd_t, sd_y_m; };

// Peak pressures of barefoot walking (emed platforms), relative to the second and third metatarsal heads.
constexpr Zone kMan[] = {{0.85, 0.13, 0.002, 0.075, 0.021}, {0.25, 0.40, -0.020, 0.11, 0.016},
                         {0.70, 0.70, 0.026, 0.050, 0.014}, {1.00, 0.72, 0.005, 0.050, 0.015},
                         {0.80, 0.68, -0.015, 0.046, 0.012}, {0.55, 0.63, -0.032, 0.046, 0.011},
                         {0.80, 0.89, 0.019, 0.042, 0.013}, {0.35, 0.86, -0.008, 0.040, 0.018}};
constexpr Zone kWoman[] = {{0.95, 0.11, 0.001, 0.050, 0.015}, {0.70, 0.69, 0.024, 0.052, 0.013},
                           {1.00, 0.71, 0.005, 0.052, 0.014}, {0.80, 0.67, -0.014, 0.048, 0.011},
                           {0.50, 0.63, -0.028, 0.046, 0.010}, {0.85, 0.88, 0.013, 0.044, 0.011},
                           {0.30, 0.85, -0.006, 0.040, 0.014}};

/// Shape and pressure of one sole in its own coordinates.
class SoleModel {
 public:
  SoleModel(bool woman, double foot_length_m)
      : woman_(woman),
        length_m_(foot_length_m + kSoleLonger_m),
        scale_(length_m_ / kDesignLength_m),
        inner_(woman ? Keys{{0, 0}, {.03, .016}, {.11, .026}, {.22, .023}, {.40, .016}, {.55, .031}, {.69, .044},
                            {.82, .037}, {.93, .022}, {1, 0}}
                     : Keys{{0, 0}, {.03, .019}, {.12, .034}, {.25, .031}, {.40, .023}, {.55, .037}, {.70, .049},
                            {.82, .045}, {.93, .031}, {1, 0}},
               "sole, inner edge"),
        outer_(woman ? Keys{{0, 0}, {.03, .016}, {.11, .026}, {.22, .026}, {.40, .027}, {.55, .038}, {.66, .046},
                            {.80, .036}, {.92, .018}, {1, 0}}
                     : Keys{{0, 0}, {.03, .019}, {.12, .034}, {.25, .034}, {.40, .036}, {.55, .045}, {.66, .052},
                            {.80, .046}, {.92, .028}, {1, 0}},
               "sole, outer edge") {}

  double length_m() const { return length_m_; }

  /// 0 outside the sole .. 1 well within. x from the middle of the sole, y to the inner side.
  double contact(double x, double y) const {
    const double t = x / length_m_ + 0.5;
    if (t <= 0 || t >= 1) return 0;
    const double e = std::min({scale_ * inner_(t) - y, y + scale_ * outer_(t), t * length_m_, (1 - t) * length_m_});
    const double s = std::clamp(e / kEdge_m, 0.0, 1.0);
    // A raised heel leaves the waist of the sole off the ground.
    return s * s * (3 - 2 * s) * (woman_ ? 1 - waist(t) : 1);
  }
  double pressure(double x, double y) const {
    const double t = x / length_m_ + 0.5;
    double sum = woman_ ? 0.10 : 0.14;  // a shoe spreads some load over all of the sole
    const auto add = [&](const Zone& z) {
      const double a = (t - z.t) / z.sd_t, b = (y / scale_ - z.y_m) / z.sd_y_m;
      sum += z.weight * std::exp(-0.5 * (a * a + b * b));
    };
    if (woman_) for (const Zone& z : kWoman) add(z);
    else for (const Zone& z : kMan) add(z);
    return contact(x, y) * sum;
  }
  /// Share of the slip: the heel slips as it strikes, the forefoot as it pushes off.
  double slide(double x, double y) const {
    const double t = x / length_m_ + 0.5;
    const double heel = 1 / (1 + std::exp((t - 0.30) / 0.03)), fore = 1 / (1 + std::exp((0.58 - t) / 0.03));
    return contact(x, y) * (0.25 + 0.35 * heel + 0.75 * fore);
  }
  double forefoot(double x) const { return 1 / (1 + std::exp((0.78 - (x / length_m_ + 0.5)) / 0.03)); }

 private:
  using Keys = std::vector<std::pair<double, double>>;
  static double waist(double t) {
    return 1 / (1 + std::exp((0.24 - t) / 0.012)) / (1 + std::exp((t - 0.50) / 0.025));
  }
  bool woman_;
  double length_m_, scale_;
  Curve inner_, outer_;
};

struct Values { double pressure, slide; };

/// With toe slide the forefoot draws its print forward, fading.
Values smeared(const SoleModel& sole, double x, double y, bool toe_slide) {
  if (!toe_slide) return {sole.pressure(x, y), sole.slide(x, y)};
  Values v{sole.pressure(x, y), 0.25 * sole.slide(x, y)};
  constexpr int kParts = 9;
  for (int n = 0; n < kParts; ++n) {
    const double share = (n + 0.5) / kParts, back = x - share * kSmear_m;
    const double toe = sole.forefoot(back) * (1 - share);
    v.pressure += 1.6 / kParts * toe * sole.pressure(back, y);
    v.slide += 1.6 / kParts * toe * sole.contact(back, y);
  }
  return v;
}

void check_size(int size, const std::string& what) {
  if (size < 3 || size > 1001 || size % 2 == 0)
    throw InvalidInput(what + " = " + std::to_string(size) + " must be odd and within 3..1001 cells");
}

void scale_to_one(std::vector<float>& v) {
  const float top = *std::max_element(v.begin(), v.end());
  for (float& x : v) x /= top;
}

}  // namespace

double Mask::pressure_sum() const { return std::accumulate(pressure.begin(), pressure.end(), 0.0); }

Mask make_mask(Sole kind, double foot_length_m, double pixels_per_m, int size) {
  const bool woman = kind == Sole::woman || kind == Sole::woman_toe_slide;
  const bool toe_slide = kind == Sole::man_toe_slide || kind == Sole::woman_toe_slide;
  const SoleModel sole(woman, foot_length_m);
  const double reach_m = sole.length_m() / 2 + (toe_slide ? kSmear_m : 0);
  const int needed = 2 * int(std::ceil(reach_m * pixels_per_m + 1)) + 1;
  if (size == 0) size = needed;
  check_size(size, "footprints.mask_size");
  if (size < needed)
    throw InvalidInput("footprints.mask_size = " + std::to_string(size) + " cells cannot hold a sole of " +
                       std::to_string(2 * reach_m) + " m in any turn; at least " + std::to_string(needed) +
                       " are needed");
  Mask m{size, pixels_per_m, {}, {}};
  m.pressure.resize(std::size_t(size) * std::size_t(size));
  m.slide.resize(m.pressure.size());
  constexpr int kSub = 4;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      Values sum{0, 0};
      for (int b = 0; b < kSub; ++b)
        for (int a = 0; a < kSub; ++a) {
          const double x = (i - (size - 1) / 2 + (a + 0.5) / kSub - 0.5) / pixels_per_m;
          const double y = (j - (size - 1) / 2 + (b + 0.5) / kSub - 0.5) / pixels_per_m;
          if (std::abs(x) > reach_m || std::abs(y) > 0.08) continue;
          const Values v = smeared(sole, x, y, toe_slide);
          sum.pressure += v.pressure;
          sum.slide += v.slide;
        }
      const std::size_t n = std::size_t(j) * std::size_t(size) + std::size_t(i);
      m.pressure[n] = float(sum.pressure / (kSub * kSub));
      m.slide[n] = float(sum.slide / (kSub * kSub));
    }
  scale_to_one(m.pressure);
  scale_to_one(m.slide);
  return m;
}

void validate(const UserMask& mask) {
  const std::string what = "footprints.masks '" + mask.name + "'";
  check_size(mask.size, what + ": size");
  if (!(mask.pixels_per_m >= 10 && mask.pixels_per_m <= 5000))
    throw InvalidInput(what + ": pixels_per_m = " + std::to_string(mask.pixels_per_m) + " is outside 10..5000 1/m");
  if (mask.grey.size() != std::size_t(mask.size) * std::size_t(mask.size))
    throw InvalidInput(what + ": " + std::to_string(mask.grey.size()) + " values; size * size = " +
                       std::to_string(mask.size * mask.size) + " are needed");
  float top = 0;
  for (const float v : mask.grey) {
    if (!(v >= 0 && v <= 1)) throw InvalidInput(what + ": value " + std::to_string(v) + " is outside 0..1");
    top = std::max(top, v);
  }
  if (!(top > 0)) throw InvalidInput(what + ": nothing is above 0");
}

Mask make_mask(const UserMask& user, double pixels_per_m) {
  validate(user);
  const double ratio = user.pixels_per_m / pixels_per_m;  // user's cells per cell of ours
  const int half = std::max(1, int(std::ceil(0.5 * user.size / ratio)));
  Mask m{2 * half + 1, pixels_per_m, {}, {}};
  const int sub = std::max(1, int(std::ceil(2 * ratio)));
  m.pressure.resize(std::size_t(m.size) * std::size_t(m.size));
  const auto grey = [&](int i, int j) {
    return i < 0 || j < 0 || i >= user.size || j >= user.size
               ? 0.0
               : double(user.grey[std::size_t(j) * std::size_t(user.size) + std::size_t(i)]);
  };
  for (int j = 0; j < m.size; ++j)
    for (int i = 0; i < m.size; ++i) {
      double sum = 0;
      for (int b = 0; b < sub; ++b)
        for (int a = 0; a < sub; ++a) {
          const double x = (user.size - 1) / 2 + ratio * (i - half + (a + 0.5) / sub - 0.5);
          const double y = (user.size - 1) / 2 + ratio * (j - half + (b + 0.5) / sub - 0.5);
          const int k = int(std::floor(x)), l = int(std::floor(y));
          const double fx = x - k, fy = y - l;
          sum += (1 - fy) * ((1 - fx) * grey(k, l) + fx * grey(k + 1, l)) +
                 fy * ((1 - fx) * grey(k, l + 1) + fx * grey(k + 1, l + 1));
        }
      m.pressure[std::size_t(j) * std::size_t(m.size) + std::size_t(i)] = float(sum / (sub * sub));
    }
  if (ratio == 1) {  // nothing to resample: keep every bit
    m = Mask{user.size, pixels_per_m, user.grey, {}};
  }
  m.slide.resize(m.pressure.size());
  for (std::size_t n = 0; n < m.slide.size(); ++n) m.slide[n] = m.pressure[n] > 0 ? 1.0f : 0.0f;
  return m;
}

Rotation rotation(int part, int whole) {
  const long quarter = std::lround(4.0 * part / whole);
  const double rest = (4.0 * part - double(quarter) * whole) / (4.0 * whole) * 2 * std::numbers::pi;
  const double c = std::cos(rest), s = std::sin(rest);  // |rest| <= 45 degrees; exactly 1 and 0 for quarter turns
  switch ((quarter % 4 + 4) % 4) {
    case 1: return {-s, c};
    case 2: return {-c, -s};
    case 3: return {s, -c};
    default: return {c, s};
  }
}

std::vector<float> rotate(const std::vector<float>& values, int size, Rotation by, int out_size) {
  std::vector<float> out(std::size_t(out_size) * std::size_t(out_size));
  const int c = (size - 1) / 2, d = (out_size - 1) / 2;
  const auto grey = [&](int i, int j) {
    return i < 0 || j < 0 || i >= size || j >= size ? 0.0
                                                    : double(values[std::size_t(j) * std::size_t(size) + std::size_t(i)]);
  };
  for (int j = 0; j < out_size; ++j)
    for (int i = 0; i < out_size; ++i) {
      const double x = c + (i - d) * by.cos + (j - d) * by.sin, y = c + (j - d) * by.cos - (i - d) * by.sin;
      if (x <= -1 || y <= -1 || x >= size || y >= size) continue;
      const int k = int(std::floor(x)), l = int(std::floor(y));
      const double fx = x - k, fy = y - l;
      out[std::size_t(j) * std::size_t(out_size) + std::size_t(i)] =
          float((1 - fy) * ((1 - fx) * grey(k, l) + fx * grey(k + 1, l)) +
                fy * ((1 - fx) * grey(k, l + 1) + fx * grey(k + 1, l + 1)));
    }
  return out;
}

SoleSet::SoleSet(const FloorOptions& o) : sizes_(o.footprints.sizes), own_(!o.footprints.masks.empty()) {
  if (own_) {
    for (const UserMask& m : o.footprints.masks) masks_.push_back(make_mask(m, o.footprints.pixels_per_m));
    return;
  }
  const Spread* lengths[2] = {&o.crowd.foot_men_m, &o.crowd.foot_women_m};
  for (int sex = 0; sex < 2; ++sex) {  // sizes spread evenly over -1.2 .. 1.2 standard deviations
    step_m_[sex] = sizes_ > 1 ? 2.4 * lengths[sex]->sd / (sizes_ - 1) : 0;
    first_m_[sex] = lengths[sex]->mean - 0.5 * step_m_[sex] * (sizes_ - 1);
  }
  for (const Sole sole : {Sole::man, Sole::woman, Sole::man_toe_slide, Sole::woman_toe_slide})
    for (int n = 0; n < sizes_; ++n) {
      const int sex = int(sole) % 2;
      masks_.push_back(make_mask(sole, first_m_[sex] + n * step_m_[sex], o.footprints.pixels_per_m, o.footprints.mask_size));
    }
}

int SoleSet::mask_of(const Footprint& print) const {
  const int sole = print.sole();
  if (own_) return std::min(sole, int(masks_.size()) - 1);
  const int sex = sole % 2;
  const int size = step_m_[sex] > 0
                       ? std::clamp(int(std::lround((print.foot_length_m() - first_m_[sex]) / step_m_[sex])), 0, sizes_ - 1)
                       : 0;
  return std::min(sole, 3) * sizes_ + size;
}

}  // namespace witherfield::floor
