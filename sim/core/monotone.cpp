#include "sim/core/monotone.hpp"

#include <algorithm>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield {
namespace {

/// Slope at a key with secants d0 over h0 before it and d1 over h1 behind it; 0 at a turning point.
double slope_at(double h0, double d0, double h1, double d1) {
  if (!(d0 * d1 > 0)) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

}  // namespace

KeyPlace place_among(std::span<const double> times, double moment) {
  if (times.size() < 2)
    throw InvalidInput("key frames: at least 2 are needed, got " + std::to_string(times.size()));
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw InvalidInput("key frames: time must increase from key to key; key " + std::to_string(i) + " is at " +
                         std::to_string(times[i]) + " after " + std::to_string(times[i - 1]));
  KeyPlace place;
  place.window.at = std::clamp(moment, times.front(), times.back());
  const auto next = std::upper_bound(times.begin(), times.end(), place.window.at);
  place.first = std::min(std::size_t(next - times.begin()), times.size() - 1) - 1;
  place.window.before = place.first > 0;
  place.window.after = place.first + 2 < times.size();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t i = std::clamp<std::size_t>(place.first + k, 1, times.size()) - 1;
    place.window.time[k] = times[i];
  }
  return place;
}

double monotone_between(const KeyWindow& w, double y0, double y1, double y2, double y3) {
  const double h = w.time[2] - w.time[1], d = (y2 - y1) / h;
  const double h0 = w.time[1] - w.time[0], h3 = w.time[3] - w.time[2];
  // At an end the secant itself: a parabola that keeps the neighbour's slope.
  const double m1 = w.before ? slope_at(h0, (y1 - y0) / h0, h, d) : d;
  const double m2 = w.after ? slope_at(h, d, h3, (y3 - y2) / h3) : d;
  const double t = (w.at - w.time[1]) / h, s = 1 - t;
  const double y = y1 * (1 + 2 * t) * s * s + h * m1 * t * s * s + y2 * t * t * (3 - 2 * t) - h * m2 * t * t * s;
  return std::clamp(y, std::min(y1, y2), std::max(y1, y2));  // the cubic stays within but for rounding
}

FloorField floor_between(const KeyWindow& window, const FloorField* const (&keys)[4]) {
  const FloorField *a = keys[1], *b = keys[2];
  const FloorField& before = window.before ? *keys[0] : *a;
  const FloorField& after = window.after ? *keys[3] : *b;
  for (const FloorField* f : {&before, b, &after})
    if (!a->same_grid(*f)) throw InvalidInput("key frames of a floor must have the same grid");
  FloorField out(a->nx, a->ny, a->origin_m, a->spacing_m);
  for (const FloorChannel& channel : a->channels) {
    const std::vector<float>&y0 = before.at(channel.name), &y2 = b->at(channel.name), &y3 = after.at(channel.name);
    std::vector<float>& y = out.make(channel.name);
    parallel_for(y.size(), 1 << 15, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        y[i] = float(monotone_between(window, y0[i], channel.values[i], y2[i], y3[i]));
    });
  }
  return out;
}

}  // namespace witherfield
