#include "sim/floor/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/floor/crowd.hpp"
#include "sim/floor/wear.hpp"

namespace witherfield::floor {
namespace {

using Clock = std::chrono::steady_clock;

/// Wall clock of a stage, added to the report.
class Timer {
 public:
  explicit Timer(FloorReport& report) : report_(report) {}
  template <class Body>
  void time(const char* stage, const Body& body) {
    const auto start = Clock::now();
    body();
    const double s = std::chrono::duration<double>(Clock::now() - start).count();
    for (FloorReport::Stage& known : report_.stages)
      if (known.name == stage) return void(known.seconds += s);
    report_.stages.push_back({stage, s});
  }

 private:
  FloorReport& report_;
};

/// Key frames, as the wear grows.
class Film {
 public:
  Film(const FloorOptions& options, const FrameSink& sink, FloorReport& report)
      : options_(options), sink_(sink), report_(report), finish_(options), floors_(make_grids(options)) {}

  std::int64_t visits(std::size_t frame) const {
    return std::llround(options_.frames[frame] * double(options_.crowd.visits));
  }
  void show(std::size_t frame, const Wear& wear) {
    const double share = options_.frames[frame], days = share * options_.crowd.days;
    const Finish::Change change = finish_.apply(wear, days, floors_);
    report_.all_finite = report_.all_finite && change.finite;
    report_.monotone = report_.monotone && !change.fell;
    report_.neighbour_difference_max = std::max(report_.neighbour_difference_max, change.diffuse_max);
    sink_({int(frame), visits(frame), double(wear.prints) * options_.crowd.visits_each, days, floors_});
  }

 private:
  const FloorOptions& options_;
  const FrameSink& sink_;
  FloorReport& report_;
  Finish finish_;
  std::vector<FloorField> floors_;
};

}  // namespace

FloorReport simulate(const FloorOptions& options, const FrameSink& sink, const Progress& progress) {
  validate(options);
  FloorReport report;
  Timer timer(report);
  std::unique_ptr<Crowd> crowd;
  std::unique_ptr<Accumulator> sum;
  std::unique_ptr<Film> film;
  timer.time("orientation_field", [&] { crowd = std::make_unique<Crowd>(options); });
  timer.time("footprint_masks", [&] { sum = std::make_unique<Accumulator>(options, 1.0); });
  timer.time("look", [&] { film = std::make_unique<Film>(options, sink, report); });
  constexpr std::int64_t kReportEvery = 32768;
  std::int64_t done = 0;
  for (std::size_t frame = 0; frame < options.frames.size(); ++frame) {
    for (const std::int64_t until = film->visits(frame); done < until;) {
      const std::int64_t next = std::min(until, done + kReportEvery);
      std::vector<Footprint> prints;
      timer.time("walk", [&] {
        crowd->walk({done, next}, [&](std::span<const Footprint> p) { prints.insert(prints.end(), p.begin(), p.end()); },
                    report.walk);
      });
      timer.time("stamp", [&] { sum->add(prints); });
      done = next;
      if (progress) progress("walkers", double(done) / double(options.crowd.visits));
    }
    const Wear* wear = nullptr;
    timer.time("stamp", [&] { wear = &sum->wear(); });
    timer.time("look", [&] { film->show(frame, *wear); });
  }
  return report;
}

WalkReport walk(const FloorOptions& options, const Stretch& stretch, const FootprintSink& sink, const Progress& progress) {
  validate(options);
  const Crowd crowd(options);
  WalkReport report;
  const Stretch all{std::max<std::int64_t>(stretch.first, 0), std::min(stretch.last, options.crowd.visits)};
  constexpr std::int64_t kReportEvery = 32768;
  for (std::int64_t at = all.first; at < all.last; at += kReportEvery) {
    crowd.walk({at, std::min(at + kReportEvery, all.last)}, sink, report);
    if (progress) progress("walkers", double(std::min(at + kReportEvery, all.last) - all.first) / double(all.last - all.first));
  }
  return report;
}

WalkReport walk(const FloorOptions& options, const FootprintSink& sink, const Progress& progress) {
  return walk(options, {0, options.crowd.visits}, sink, progress);
}

Wear accumulate(const FloorOptions& options, const FootprintSource& footprints, double weight, const Progress& progress) {
  validate(options);
  Accumulator sum(options, weight);
  for (std::span<const Footprint> p = footprints(); !p.empty(); p = footprints()) {
    sum.add(p);
    if (progress) progress("footprints", std::min(1.0, double(p.back().person + 1) / double(options.crowd.visits)));
  }
  Wear wear = sum.wear();
  clear_outside(options, wear);
  return wear;
}

FloorReport wear_frames(const FloorOptions& options, const FootprintSource& footprints, const FrameSink& sink,
                        const Progress& progress) {
  validate(options);
  FloorReport report;
  Timer timer(report);
  Accumulator sum(options, 1.0);
  Film film(options, sink, report);
  std::size_t frame = 0;
  const auto show = [&] {
    const Wear* wear = nullptr;
    timer.time("stamp", [&] { wear = &sum.wear(); });
    timer.time("look", [&] { film.show(frame, *wear); });
    ++frame;
  };
  for (std::span<const Footprint> p = footprints(); !p.empty(); p = footprints()) {
    while (!p.empty()) {
      const auto end = frame < options.frames.size()
                           ? std::find_if(p.begin(), p.end(), [&](const Footprint& f) { return f.person >= film.visits(frame); })
                           : p.end();
      const std::size_t n = std::size_t(end - p.begin());
      timer.time("stamp", [&] { sum.add(p.first(n)); });
      report.walk.footprints += std::int64_t(n);
      p = p.subspan(n);
      if (!p.empty()) show();
    }
    if (progress && frame < options.frames.size()) progress("footprints", double(frame) / double(options.frames.size()));
  }
  while (frame < options.frames.size()) show();
  return report;
}

}  // namespace witherfield::floor
