#include "sim/leaf/wilt.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/leaf/wilt_frame.hpp"
#include "sim/leaf/wilt_mechanics.hpp"

namespace witherfield::leaf {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double s = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return s;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

LeafWater make_water(const WiltBody& body, const WiltOptions& options, const WiltMechanics& mechanics) {
  std::vector<double> radius;
  for (int k = 0; k < mechanics.rod_nodes(); ++k) radius.push_back(mechanics.rod_radius_m(k));
  const auto& x = mechanics.shape().x;
  return {body, {x.end() - mechanics.rod_nodes(), x.end()}, radius, options};
}

void note(const RelaxReport& r, WiltReport& report) {
  ++report.solves;
  report.iterations += r.iterations;
  report.unconverged += !r.converged;
  report.residual_max = std::max(report.residual_max, r.residual);
  report.touching_max = std::max(report.touching_max, r.touching);
  for (std::size_t k = 1; k < r.energy_J.size(); ++k) report.energy_fell &= r.energy_J[k] <= r.energy_J[k - 1];
}

}  // namespace

WiltReport simulate_wilt(const WiltBody& body, const WiltOptions& options, const WiltSink& sink, const Progress& progress) {
  Stopwatch watch;
  WiltReport report;
  report.stages = {{"leaf set-up", 0}, {"leaf water", 0}, {"leaf shape", 0}};
  WiltMechanics mechanics(body, options);
  LeafWater water = make_water(body, options, mechanics);
  WiltFrames frames(body, options, mechanics);
  report.stages[0].seconds = watch.lap();
  const std::vector<double> hours = frame_times_hours(options);
  const int parts = options.solver.moments_per_frame;
  double last = 0;
  for (std::size_t f = 0; f < hours.size(); ++f) {
    for (int k = 1; k <= parts; ++k) {
      const double to = last + (hours[f] - last) * k / parts, span = to - water.now_hours();
      water.advance_to(to);
      frames.age(std::max(span, 0.0), water.blade());
      mechanics.set_water(water.blade(), water.petiole());
      report.stages[1].seconds += watch.lap();
      note(mechanics.relax(), report);
      report.stages[2].seconds += watch.lap();
      if (span <= 0) break;
    }
    last = hours[f];
    WiltFrame frame;
    frame.index = int(f);
    frame.hours = hours[f];
    frames.fill(mechanics, water, frame);
    report.midrib_change_max = std::max(report.midrib_change_max, std::abs(frame.midrib_change));
    report.area_change_last = frame.area_change;
    if (sink) sink(frame);
    if (progress) progress("wilting", double(f + 1) / double(hours.size()));
    watch.lap();
  }
  report.balance = water.balance();
  report.balance_error = water.balance().error(water.start_kg());
  return report;
}

}  // namespace witherfield::leaf
