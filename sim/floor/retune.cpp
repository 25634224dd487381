// Walks again only those whose way has changed.
#include <algorithm>

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

bool same_visit(const FloorOptions& a, const Visit& v, const World* before, const FloorOptions& b, const Visit& w,
                const World* after) {
  if (v.absent != w.absent || v.day != w.day || v.behaviour != w.behaviour || v.gate_in != w.gate_in ||
      v.gate_out != w.gate_out || v.clockwise != w.clockwise || v.woman != w.woman || v.mass_kg != w.mass_kg ||
      v.foot_length_m != w.foot_length_m || v.speed_m_s != w.speed_m_s || !same_place(a, v.place, b, w.place))
    return false;
  if (!before || !after) return before == after;
  return same(before->plan(), after->plan()) &&
         (v.behaviour != Behaviour::patrol || before->pictures() == after->pictures());
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
  const FootprintSource& source_;
  std::span<const Footprint> left_;
  std::uint32_t last_ = 0;
};

}  // namespace

RetuneReport retune(const FloorOptions& before, const FootprintSource& footprints, const FloorOptions& after,
                    const FootprintSink& sink, const Progress& progress) {
  validate(before);
  validate(after);
  const Crowd old_crowd(before), new_crowd(after);
  const bool rules = same_rules(before, after);
  RetuneReport report;
  Reader reader(footprints);
  constexpr std::int64_t kBatch = 4096;
  std::vector<char> kept;
  std::vector<Footprint> walked, batch;
  for (std::int64_t first = 0; first < after.crowd.visits; first += kBatch) {
    const std::int64_t last = std::min(first + kBatch, after.crowd.visits);
    kept.assign(std::size_t(last - first), 0);
    for (std::int64_t n = first; n < last; ++n) {
      const Visit w = plan_visit(after, n);
      if (n < before.crowd.visits) {
        const Visit v = plan_visit(before, n);
        kept[std::size_t(n - first)] =
            rules && same_visit(before, v, old_crowd.world_of(v), after, w, new_crowd.world_of(w));
        report.dropped += w.absent && !v.absent;
      }
      if (!w.absent) ++(kept[std::size_t(n - first)] ? report.kept : report.walked);
    }
    walked.clear();
    WalkReport unused;
    new_crowd.walk({first, last}, [&](std::span<const Footprint> p) { walked.insert(walked.end(), p.begin(), p.end()); },
                   unused, [&](std::int64_t n) { return !kept[std::size_t(n - first)]; });
    batch.clear();
    std::size_t at = 0;
    for (std::int64_t n = first; n < last; ++n) {
      reader.take(n, kept[std::size_t(n - first)] ? &batch : nullptr);
      for (; at < walked.size() && walked[at].person == n; ++at) batch.push_back(walked[at]);
    }
    if (!batch.empty()) sink(batch);
    if (progress) progress("walkers", double(last) / double(after.crowd.visits));
  }
  report.dropped += std::max<std::int64_t>(0, before.crowd.visits - after.crowd.visits);
  return report;
}

}  // namespace witherfield::floor
