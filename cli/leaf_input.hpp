// What a leaf's scene names in other files, and the leaf as it is written: shared by `run` and `edit`.
#pragma once
#include "sim/leaf/leaf_model.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

/// organ_id of a leaf's surfaces; markers and stem are what pictures add to them.
inline constexpr int kBladeOrgan = 0, kPetioleOrgan = 1, kMarkerOrgan = 2, kStemOrgan = 3;

/// Points and mesh of the scene. @throws IoFailure, InvalidInput naming the file.
leaf::LeafInput read_leaf_input(const scene::LeafScene& scene);

/// Blade and petiole as one surface with organ_id and chlorophyll_ug_cm2.
Surface whole_leaf(const leaf::LeafModel& model, const std::vector<glm::dvec3>& position_m);

}  // namespace witherfield::cli
