// From the flat leaf to the pose of a living one, and the relief between the veins.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sim/leaf/leaf_model.hpp"

namespace witherfield::leaf {

/// The flat blade bent: the midrib turns downwards, both halves rise from it and hang to the margin, the margin waves.
/// Arc lengths along the midrib and across it are kept.
std::vector<glm::dvec3> bent_blade(const std::vector<glm::dvec3>& flat_m, double main_vein_m, const PoseOptions& options,
                                   std::uint64_t seed);

/// Height of the upper side over the bent blade, per vertex, m: the blade bulges between side veins (a membrane under pressure
/// that is tied down at the veins: -laplace h = p, h = 0 there), a little between fine veins, and sinks at main veins.
std::vector<double> relief(const LeafModel& model, const LeafOptions& options);

}  // namespace witherfield::leaf
