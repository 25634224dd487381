// What a leaf's scene names in other files, and the leaf as it is written: shared by `run` and `edit`.
#pragma once
#include "sim/leaf/leaf_model.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

inline constexpr int kBlade = 0, kPetiole = 1;  // organ_id

/// Points and mesh of the scene. @throws IoFailure, InvalidInput naming the file.
leaf::LeafInput read_leaf_input(const scene::LeafScene& scene);

/// Blade and petiole as one surface with organ_id and chlorophyll_ug_cm2.
Surface whole_leaf(const leaf::LeafModel& model, const std::vector<glm::dvec3>& position_m);

}  // namespace witherfield::cli
