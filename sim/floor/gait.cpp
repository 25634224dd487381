#include "sim/floor/gait.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace witherfield::floor {
namespace {
constexpr double kRad = std::numbers::pi / 180;
}

double draw(Random& random, const Spread& s) {
  return s.sd > 0 ? random.truncated_normal(s.mean, s.sd, s.lo, s.hi) : std::clamp(s.mean, s.lo, s.hi);
}

Gait::Gait(const FloorOptions& options, const Visit& visit)
    : options_(options), random_(options.seed, Stream::footprint, std::uint64_t(visit.number)) {}

double Gait::step_length_m(double v) {
  const GaitOptions& g = options_.gait;  // Seitz & Koester 2012, eq. 6
  const double mean = g.step_base_m + g.step_per_speed_s * v;
  return draw(random_, {mean, g.step_sd_m, std::max(0.1, mean - 3 * g.step_sd_m), mean + 3 * g.step_sd_m});
}

void Gait::deviate(double& deviation, double way_m) {
  const double sd = options_.gait.heading_sd_deg * kRad, keep = std::exp(-way_m / options_.gait.heading_memory_m);
  deviation = draw(random_, {keep * deviation, sd * std::sqrt(1 - keep * keep), -3 * sd, 3 * sd});
}

Step Gait::set_foot(Body& body, Phase phase, double length_m, double v, double turned_rad) {
  const GaitOptions& g = options_.gait;
  Step s;
  s.body_m = body.at_m;
  s.heading_rad = body.heading_rad;
  s.length_m = length_m;
  s.side_m = draw(random_, g.side_m);
  s.toe_out_rad = kRad * draw(random_, g.toe_out_deg);
  s.foot = body.next;
  s.phase = phase;
  s.number = body.steps++;
  s.time_s = body.time_s;
  s.toe_slide = random_.uniform() < options_.crowd.toe_slide_share;
  s.slip_m = draw(random_, s.toe_slide ? g.toe_slide_m : g.slip_m) + g.pivot_m_per_rad * std::abs(turned_rad);
  // A stride is two steps; a foot stands for stance_share of it.
  s.contact_s = v > 0 ? g.stance_share * 2 * (length_m > 0 ? length_m : g.step_base_m) / v : 0;
  body.next = body.next == Foot::left ? Foot::right : Foot::left;
  place_foot(s);
  return s;
}

void place_foot(Step& s) {
  const double side = s.foot == Foot::left ? 1 : -1;
  s.foot_m = s.body_m + side * s.side_m * glm::dvec2(-std::sin(s.heading_rad), std::cos(s.heading_rad));
  s.foot_heading_rad = s.heading_rad + side * s.toe_out_rad;
}

void steer(double& heading, glm::dvec2 wanted, double way_m, double radius_m) {
  const double c = std::cos(heading), s = std::sin(heading);
  const double turn = std::atan2(c * wanted.y - s * wanted.x, c * wanted.x + s * wanted.y);
  heading += std::clamp(turn, -way_m / radius_m, way_m / radius_m);
}

}  // namespace witherfield::floor
