// What a leaf's stills show: the leaf with its skin, the stages of its construction, the handles of an edit.
#pragma once
#include <vector>

#include "cli/object_pictures.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/options.hpp"

namespace witherfield::cli {

/// @param model outlives the stills.
ObjectLooks leaf_looks(const leaf::LeafModel& model);

/// The blade's colour from chlorophyll and water alone: its veins are painted by the look.
Surface without_vein_colour(Surface whole_leaf, double fresh_chlorophyll_ug_cm2);

/// The stages of fig. 5, one surface each: points as balls, splines as cords, meshes with their edges.
/// Triangles with two border edges are red in the first mesh that is fine; what their repair made is blue in
/// the last.
std::vector<Surface> stage_objects(const leaf::LeafModel& model);

/// Balls at the edit's handles on the leaf in the pose of a key: red where held, blue where dragged; and the
/// margin before the edit as a cord.
void add_handles(Surface& whole_leaf, const leaf::LeafModel& model, const leaf::EditOptions& edit,
                 const leaf::EditKey& key);

/// A piece of stem from `low_m` to 5 cm above the petiole's end, so that a leaf that wilts hangs on
/// something. Nothing when the leaf has no petiole.
void add_stem(Surface& whole_leaf, const leaf::LeafModel& model, double low_m);

}  // namespace witherfield::cli
