// Footprints of a run: walked anew, taken from earlier runs, or set along measured tracks; as a file, and as tables that
// VTK and spreadsheets read.
#pragma once
#include <filesystem>
#include <functional>

#include "sim/core/point_table.hpp"
#include "sim/core/progress.hpp"
#include "sim/floor/simulate.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

/// Does the scene need footprints.bin before it can wear the floor? (Else walking and wearing go hand in hand, without it.)
bool needs_footprint_file(const scene::FloorScene& scene);

/// Writes the footprints of all visits of the scene, or of its stretch. `interrupted` is called now and then and may throw.
/// @throws InvalidInput (tracks, footprints of another kind), IoFailure.
floor::RetuneReport write_footprint_file(const scene::FloorScene& scene, const std::filesystem::path& file,
                                         const std::function<void()>& interrupted, const Progress& progress);

/// Footprints as points: person, behaviour, phase, foot, kind, heading_rad, weight_N, time_s.
PointTable footprint_table(std::span<const floor::Footprint> prints);
/// The way of every visit, as a line through the middles between one foot and the next; the same columns.
PointTable walk_table(std::span<const floor::Footprint> prints);

}  // namespace witherfield::cli
