// Everybody's footprints, in the order of the visits, walked by many threads. Private to the simulator.
#pragma once
#include <memory>
#include <vector>

#include "sim/floor/simulate.hpp"
#include "sim/floor/walkers.hpp"

namespace witherfield::floor {

class Crowd {
 public:
  /// @throws InvalidInput.
  explicit Crowd(const FloorOptions& options);

  /// Footprints of the visits for which `wanted` (empty: all) is true; `report` is added to.
  void walk(const Stretch& stretch, const FootprintSink& sink, WalkReport& report,
            const std::function<bool(std::int64_t)>& wanted = {}) const;
  const World* world_of(const Visit& visit) const { return worlds_.empty() ? nullptr : &world_on(worlds_, visit.day); }

 private:
  struct Block;
  void walk_block(std::int64_t first, std::int64_t last, const std::function<bool(std::int64_t)>& wanted,
                  Block& block) const;
  const FloorOptions& options_;
  std::vector<std::unique_ptr<World>> worlds_;
};

}  // namespace witherfield::floor
