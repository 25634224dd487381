// From footprints to what they do to the floor: additive fields first, then depth, gloss, dirt and colour, which are
// functions of those fields alone. So parts of the time may be summed apart, in any order.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "sim/floor/masks.hpp"
#include "sim/floor/simulate.hpp"
#include "sim/floor/stamp.hpp"

namespace witherfield::floor {

/// The grids of the floor, without channels: one of the room, or one per tread.
std::vector<FloorField> make_grids(const FloorOptions& options);

/// Sums footprints; keeps the fields and at most 2^18 footprints.
class Accumulator {
 public:
  /// @param weight of every footprint, beside crowd.visits_each.
  Accumulator(const FloorOptions& options, double weight);
  void add(std::span<const Footprint> prints);
  /// Everything added so far. Cells outside the room count too.
  const Wear& wear();

 private:
  void flush();
  Placement placement(const Footprint& print, const FloorField& grid) const;

  const FloorOptions& options_;
  double weight_;
  SoleSet soles_;
  std::vector<StampSet> pressure_, slide_, work_;  // per mask
  std::vector<Footprint> waiting_;
  Wear wear_;
};

/// Sets all of `wear` outside the room to zero.
void clear_outside(const FloorOptions& options, Wear& wear);

/// A step that wears like the ones in the literature's tables: 750 N on 125 cm2, sliding 10 mm.
inline constexpr double kReferenceHit_J_m2 = 750 / 0.0125 * 0.010;

/// Depth of wear after `work_J_m2` (Archard: volume = K F s / H, so depth = K p s / H), layer by layer.
/// @param finish, hardness factors on the thickness of the upper layers and on the hardness of the last.
double wear_depth_m(const std::vector<Layer>& layers, double work_J_m2, double finish = 1, double hardness = 1);

/// Gloss and colour of the worn floor; a layer that is worn through shows the next.
struct Look { double gloss = 0; glm::dvec3 colour{0.0}; double dirt_hold = 0; };
Look look_of(const std::vector<Layer>& layers, double work_J_m2, double finish = 1, double hardness = 1);

/// Dirt on a place: dm = soil brought - (rubbed per step + mopped per day) m, both spread evenly over the days; 1 - exp(-m).
double dirt_of(const SoilOptions& soil, double brought, double footfalls, double days);

/// What differs from place to place, made once; then a frame's channels from the wear so far.
class Finish {
 public:
  explicit Finish(const FloorOptions& options);
  ~Finish();
  /// Fills `floors` (made by make_grids) with all channels. Returns how they changed against what was in them.
  struct Change { double diffuse_max = 0; bool fell = false, finite = true; };
  Change apply(const Wear& wear, double days, std::vector<FloorField>& floors) const;

 private:
  struct Place;
  const FloorOptions& options_;
  std::vector<std::vector<Place>> places_;  // per floor, per cell
};

}  // namespace witherfield::floor
