// The floor simulator: people walk, footprints wear, key frames come out. In one go, or in two steps with the
// footprints kept between them: walk once, look small, then large; change something and walk only those it concerns.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/floor_field.hpp"
#include "sim/core/progress.hpp"
#include "sim/floor/footprint.hpp"
#include "sim/floor/options.hpp"

namespace witherfield::floor {

/// A range of visits: [first, last).
struct Stretch {
  std::int64_t first = 0, last = 0;
  bool operator==(const Stretch&) const = default;
};

/// One key frame. A room has one floor; stairs have one per tread, the lowest first, y towards the next riser.
struct FloorFrame {
  int index = 0;
  std::int64_t visits = 0;           ///< walked so far
  double footfalls_total = 0;        ///< prints so far times visits_each
  double time_days = 0;
  /// Channels: footfalls, dose_N_s_m2, slide_m, wear_depth_um, gloss, dirt, height_m, diffuse(3).
  std::span<const FloorField> floors;
};
/// Called once per frame, in order; what it points to is valid during the call only.
using FrameSink = std::function<void(const FloorFrame&)>;

/// Somebody who did not find out. His footprints up to there count.
struct Stuck {
  std::int64_t visit = 0;
  glm::dvec2 at_m{0.0};
  double day = 0;
};

struct WalkReport {
  std::int64_t visits = 0, footprints = 0;
  std::int64_t stuck = 0;
  std::vector<Stuck> stuck_first;    ///< at most 20
  std::int64_t by_behaviour[3] = {0, 0, 0};
  double way_m = 0;                  ///< walked by all
};

struct FloorReport {
  WalkReport walk;
  struct Stage { std::string name; double seconds; };
  std::vector<Stage> stages;         ///< wall clock, summed
  bool all_finite = true, monotone = true;  ///< over all frames: depth, footfalls, dose and slide never fell
  double neighbour_difference_max = 0;      ///< largest change of any diffuse value between two frames
};

/// Walks and wears. @throws InvalidInput, SolverFailure.
FloorReport simulate(const FloorOptions& options, const FrameSink& sink, const Progress& progress = {});

/// First step alone: the footprints of a stretch of visits (default: all).
WalkReport walk(const FloorOptions& options, const FootprintSink& sink, const Progress& progress = {});
WalkReport walk(const FloorOptions& options, const Stretch& stretch, const FootprintSink& sink,
                const Progress& progress = {});

/// What a retune had to do.
struct RetuneReport {
  std::int64_t kept = 0, walked = 0, dropped = 0;  ///< visits
  std::int64_t footprints = 0;                     ///< of both
  WalkReport walk;                                 ///< of those walked
};
/// Footprints of an earlier walk.
struct KeptWalk {
  const FloorOptions* options = nullptr;  ///< by which they were walked
  Stretch visits;                         ///< of which they are
  FootprintSource footprints;
};
/// The footprints of `after`, given those of `before` (all its visits): visits that go the same way in both are copied, the others are walked.
/// The result is, bit for bit, what walk(after) gives. Dropping people, changing a share, moving a desk for a time all
/// leave the visits alone that they do not concern. @throws InvalidInput.
RetuneReport retune(const FloorOptions& before, const FootprintSource& footprints, const FloorOptions& after,
                    const FootprintSink& sink, const Progress& progress = {});
/// The same for the visits of a stretch, out of several walks that may hold different stretches (of one scene or of
/// several); a visit that more than one holds is taken from the first of them.
RetuneReport retune(std::span<const KeptWalk> kept, const FloorOptions& after, const Stretch& visits,
                    const FootprintSink& sink, const Progress& progress = {});

/// The additive channels of a floor (or of every tread): footfalls, dose_N_s_m2, slide_m, and two that the look needs.
/// C_t = C_{t-1} + B_t (Su et al. 1998, sec. 2.4). Parts made apart may be added.
struct Wear {
  std::vector<FloorField> floors;               ///< footfalls, dose_N_s_m2, slide_m
  std::vector<std::vector<float>> work_J_m2;    ///< pressure times sliding path, per floor
  std::vector<std::vector<float>> soil;         ///< dirt brought, per floor
  std::int64_t prints = 0;
};
/// @throws InvalidInput when the grids differ.
void add(Wear& sum, const Wear& part);

/// Second step alone: the sum over the footprints that the source gives. `weight` may be negative (to take away).
Wear accumulate(const FloorOptions& options, const FootprintSource& footprints, double weight = 1,
                const Progress& progress = {});

/// Second step with the film: frames as `simulate` gives them, from kept footprints of all visits.
FloorReport wear_frames(const FloorOptions& options, const FootprintSource& footprints, const FrameSink& sink,
                        const Progress& progress = {});

}  // namespace witherfield::floor
