#include "sim/floor/crowd.hpp"

#include <algorithm>

#include "sim/core/parallel.hpp"

namespace witherfield::floor {
namespace {
constexpr std::int64_t kBlock = 32;    // visits that one thread walks in turn
constexpr std::int64_t kBatch = 4096;  // visits between two calls of the sink
constexpr std::size_t kStuckNamed = 20;
}  // namespace

struct Crowd::Block {
  std::vector<Footprint> prints;
  WalkReport report;
  Walk walk;
};

Crowd::Crowd(const FloorOptions& options) : options_(options), worlds_(make_worlds(options)) {}

void Crowd::walk_block(std::int64_t first, std::int64_t last, const std::function<bool(std::int64_t)>& wanted,
                       Block& block) const {
  block.prints.clear();
  block.report = {};
  for (std::int64_t n = first; n < last; ++n) {
    if (wanted && !wanted(n)) continue;
    const Visit visit = plan_visit(options_, n);
    if (visit.absent) continue;
    if (const World* world = world_of(visit)) walk_visit(options_, *world, visit, block.walk);
    else walk_stairs(options_, visit, block.walk);
    for (const Step& s : block.walk.steps)
      block.prints.push_back(pack(s, std::uint32_t(n), visit.weight_N(), visit.foot_length_m,
                                  sole_of(options_, visit, s), visit.behaviour));
    WalkReport& r = block.report;
    ++r.visits;
    r.footprints += std::int64_t(block.walk.steps.size());
    ++r.by_behaviour[int(visit.behaviour)];
    r.way_m += block.walk.way_m;
    if (!block.walk.out) {
      ++r.stuck;
      if (r.stuck_first.size() < kStuckNamed) r.stuck_first.push_back({n, block.walk.end_m, visit.day});
    }
  }
}

void Crowd::walk(const Stretch& stretch, const FootprintSink& sink, WalkReport& report,
                 const std::function<bool(std::int64_t)>& wanted) const {
  std::vector<Block> blocks;
  std::vector<Footprint> batch;
  for (std::int64_t first = stretch.first; first < stretch.last; first += kBatch) {
    const std::int64_t last = std::min(first + kBatch, stretch.last);
    blocks.resize(std::size_t((last - first + kBlock - 1) / kBlock));
    parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        walk_block(first + std::int64_t(b) * kBlock, std::min(first + std::int64_t(b + 1) * kBlock, last), wanted,
                   blocks[b]);
    });
    batch.clear();
    for (const Block& b : blocks) {
      batch.insert(batch.end(), b.prints.begin(), b.prints.end());
      report.visits += b.report.visits;
      report.footprints += b.report.footprints;
      report.stuck += b.report.stuck;
      report.way_m += b.report.way_m;
      for (int k = 0; k < 3; ++k) report.by_behaviour[k] += b.report.by_behaviour[k];
      for (const Stuck& s : b.report.stuck_first)
        if (report.stuck_first.size() < kStuckNamed) report.stuck_first.push_back(s);
    }
    if (!batch.empty()) sink(batch);
  }
}

}  // namespace witherfield::floor
