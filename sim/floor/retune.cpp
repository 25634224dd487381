// Walks again only those whose way has changed.
#include <algorithm>
#include <memory>

#include "sim/core/errors.hpp"
#include "sim/floor/crowd.hpp"

namespace witherfield::floor {
namespace {

bool same(const Gate& a, const Gate& b) { return a.a == b.a && a.b == b.b; }

bool same(const RoomPlan& a, const RoomPlan& b) {
  return a.outline() == b.outline() && a.gates().size() == b.gates().size() &&
         std::is_permutation(a.obstacles().begin(), a.obstacles().end(), b.obstacles().begin(), b.obstacles().end()) &&
         std::equal(a.gates().begin(), a.gates().end(), b.gates().begin(),
                    [](const Gate& x, const Gate& y) { return same(x, y); });
}

bool same_place(const FloorOptions& a, int i, const FloorOptions& b, int j) {
  if (i < 0 || j < 0) return i == j;
  const Place &p = a.room.places[std::size_t(i)], &q = b.room.places[std::size_t(j)];
  return p.at_m == q.at_m && p.facing_deg == q.facing_deg && p.stay_min == q.stay_min;
}

/// What all visits depend on.
bool same_rules(const FloorOptions& a, const FloorOptions& b) {
  return a.seed == b.seed && a.gait == b.gait && a.stairs == b.stairs &&
         a.crowd.toe_slide_share == b.crowd.toe_slide_share && a.footprints.masks.size() == b.footprints.masks.size();
}

/// The room from one change to the next; none for stairs.
struct Plans {
  explicit Plans(const FloorOptions& o) {
    if (o.stairs) return;
    from_day = changes_of_plan(o.room, o.crowd.days);
    for (const double day : from_day) plan.emplace_back(o.room, day);
  }
  const RoomPlan* on(double day) const {
    if (plan.empty()) return nullptr;
    const auto next = std::upper_bound(from_day.begin(), from_day.end(), day);
    return &plan[std::size_t(std::max<std::ptrdiff_t>(0, next - from_day.begin() - 1))];
  }
  std::vector<double> from_day;
  std::vector<RoomPlan> plan;
};

bool same_pictures(const FloorOptions& a, const FloorOptions& b) {
  return std::equal(a.room.pictures.begin(), a.room.pictures.end(), b.room.pictures.begin(), b.room.pictures.end(),
                    [](const Picture& p, const Picture& q) { return p.at_m == q.at_m; });
}

bool same_visit(const FloorOptions& a, const Visit& v, const RoomPlan* before, const FloorOptions& b, const Visit& w,
                const RoomPlan* after) {
  if (v.absent != w.absent || v.day != w.day || v.behaviour != w.behaviour || v.gate_in != w.gate_in ||
      v.gate_out != w.gate_out || v.clockwise != w.clockwise || v.woman != w.woman || v.mass_kg != w.mass_kg ||
      v.foot_length_m != w.foot_length_m || v.speed_m_s != w.speed_m_s || !same_place(a, v.place, b, w.place))
    return false;
  if (!before || !after) return before == after;
  return same(*before, *after) && (v.behaviour != Behaviour::patrol || same_pictures(a, b));
}

/// Reads footprints visit by visit.
class Reader {
 public:
  explicit Reader(const FootprintSource& source) : source_(source) { next(); }

  /// Appends those of `visit` to `to`; what comes before is dropped. Calls go upward.
  void take(std::int64_t visit, std::vector<Footprint>* to) {
    while (!left_.empty() && left_.front().person <= visit) {
      if (left_.front().person == visit && to) to->push_back(left_.front());
      left_ = left_.subspan(1);
      if (left_.empty()) next();
    }
  }

 private:
  void next() {
    left_ = source_();
    for (std::size_t n = 0; n < left_.size(); ++n) {
      if (left_[n].person < last_)
        throw InvalidInput("retune: footprints are not in the order of the visits at visit " + std::to_string(left_[n].person));
      last_ = left_[n].person;
    }
  }
  FootprintSource source_;
  std::span<const Footprint> left_;
  std::uint32_t last_ = 0;
};

/// An earlier walk, made ready to be asked visit by visit.
struct Known {
  Known(const KeptWalk& walk, const FloorOptions& after)
      : options(*walk.options), visits(walk.visits), plans(options), rules(same_rules(options, after)), reader(walk.footprints) {}
  bool holds(std::int64_t n) const { return n >= visits.first && n < visits.last && n < options.crowd.visits; }

  const FloorOptions& options;
  Stretch visits;
  Plans plans;
  bool rules;
  Reader reader;
};

}  // namespace

RetuneReport retune(std::span<const KeptWalk> kept, const FloorOptions& after, const Stretch& visits,
                    const FootprintSink& sink, const Progress& progress) {
  for (const KeptWalk& k : kept) validate(*k.options);
  validate(after);
  const Crowd crowd(after);
  const Plans plans(after);
  std::vector<std::unique_ptr<Known>> known;
  for (const KeptWalk& k : kept) known.push_back(std::make_unique<Known>(k, after));
  RetuneReport report;
  constexpr std::int64_t kBatch = 4096;
  std::vector<Known*> from;
  std::vector<Footprint> walked, batch;
  const std::int64_t begin = std::max<std::int64_t>(0, visits.first), end = std::min(visits.last, after.crowd.visits);
  for (std::int64_t first = begin; first < end; first += kBatch) {
    const std::int64_t last = std::min(first + kBatch, end);
    from.assign(std::size_t(last - first), nullptr);
    for (std::int64_t n = first; n < last; ++n) {
      const Visit w = plan_visit(after, n);
      bool came = false;
      for (const auto& k : known) {
        if (!k->holds(n)) continue;
        const Visit v = plan_visit(k->options, n);
        came = came || !v.absent;
        if (k->rules && same_visit(k->options, v, k->plans.on(v.day), after, w, plans.on(w.day))) {
          from[std::size_t(n - first)] = k.get();
          break;
        }
      }
      report.dropped += w.absent && came;
      if (!w.absent) ++(from[std::size_t(n - first)] ? report.kept : report.walked);
    }
    walked.clear();
    crowd.walk({first, last}, [&](std::span<const Footprint> p) { walked.insert(walked.end(), p.begin(), p.end()); },
               report.walk, [&](std::int64_t n) { return !from[std::size_t(n - first)]; });
    batch.clear();
    std::size_t at = 0;
    for (std::int64_t n = first; n < last; ++n) {
      for (const auto& k : known) k->reader.take(n, from[std::size_t(n - first)] == k.get() ? &batch : nullptr);
      for (; at < walked.size() && walked[at].person == n; ++at) batch.push_back(walked[at]);
    }
    report.footprints += std::int64_t(batch.size());
    if (!batch.empty()) sink(batch);
    if (progress) progress("walkers", double(last - begin) / double(end - begin));
  }
  return report;
}

RetuneReport retune(const FloorOptions& before, const FootprintSource& footprints, const FloorOptions& after,
                    const FootprintSink& sink, const Progress& progress) {
  const KeptWalk all{&before, {0, before.crowd.visits}, footprints};
  RetuneReport report = retune(std::span(&all, 1), after, {0, after.crowd.visits}, sink, progress);
  report.dropped += std::max<std::int64_t>(0, before.crowd.visits - after.crowd.visits);
  return report;
}

}  // namespace witherfield::floor
