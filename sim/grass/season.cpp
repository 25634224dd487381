#include "sim/grass/season.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::grass {
namespace {

struct Logistic { double mid, slope, end; };

// Logistic stand-ins for the curves of Jiao et al. 2010, fig. 9 (the figure has no numbers), for a season of 60 days.
Logistic water_of(Climate climate) {
  switch (climate) {
    case Climate::water_rich: return {0.78, 0.10, 0.12};
    case Climate::cold: return {0.42, 0.06, 0.04};
    case Climate::standard: break;
  }
  return {0.60, 0.10, 0.04};
}

constexpr Logistic kChlorophyll{0.50, 0.09, 0.02};
// One spot of one blade empties in about a week of a 60-day season: 10 to 90 % within 0.12 (Mattila et al. 2018, on trees).
constexpr double kSpotSlope = 0.027;

void require_fraction_curve(const Curve& curve, const char* what) {
  if (!curve.non_increasing())
    throw InvalidInput(std::string(what) + ": the value must not rise in time (grass that withers does not recover)");
  for (const auto& [x, y] : curve.keys()) {
    if (x < 0 || x > 1) throw InvalidInput(std::string(what) + ": wd " + std::to_string(x) + " is outside 0..1");
    if (y < 0 || y > 1) throw InvalidInput(std::string(what) + ": value " + std::to_string(y) + " is outside 0..1");
  }
}

}  // namespace

double falling_logistic(double wd, double mid, double slope, double end) {
  const auto l = [&](double x) { return 1 / (1 + std::exp((x - mid) / slope)); };
  return end + (1 - end) * (l(wd) - l(1)) / (l(0) - l(1));
}

SeasonCurves::SeasonCurves(const SeasonOptions& options) : options_(options) {
  if (!options.water_curve.empty()) {
    water_ = Curve(options.water_curve, "season.water_curve");
    require_fraction_curve(water_, "season.water_curve");
  }
  if (!options.chlorophyll_curve.empty()) {
    chlorophyll_ = Curve(options.chlorophyll_curve, "season.chlorophyll_curve");
    require_fraction_curve(chlorophyll_, "season.chlorophyll_curve");
  }
}

double SeasonCurves::water(double wd) const {
  if (!water_.empty()) return water_(wd);
  const Logistic l = water_of(options_.climate);
  return falling_logistic(std::clamp(wd, 0.0, 1.0), l.mid, l.slope, l.end);
}

double SeasonCurves::chlorophyll(double wd) const {
  if (!chlorophyll_.empty()) return chlorophyll_(wd);
  return falling_logistic(std::clamp(wd, 0.0, 1.0), kChlorophyll.mid, kChlorophyll.slope, kChlorophyll.end);
}

double SeasonCurves::spot_wd(double wd, double onset, double arc) const {
  // The Moebius warp m -> 1/2 that fixes 0 and 1: a shift in logit space, smooth, monotone, never leaves [0, 1].
  const double advance = options_.tip_advance * (arc - 0.5);
  const double m = std::clamp(onset - advance, 0.05, 0.95);
  const double x = std::clamp(wd, 0.0, 1.0);
  return x * (1 - m) / (x * (1 - 2 * m) + m);
}

double SeasonCurves::spot_water(double wd, double onset, double arc) const {
  return water(spot_wd(wd, onset, arc));
}

double SeasonCurves::spot_chlorophyll(double wd, double onset, double arc) const {
  const double x = spot_wd(wd, onset, arc);
  if (!chlorophyll_.empty()) return chlorophyll_(x);  // the user's curve is taken as it is
  return falling_logistic(x, kChlorophyll.mid, kSpotSlope, kChlorophyll.end);
}

}  // namespace witherfield::grass
