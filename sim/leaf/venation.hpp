// Side veins and the net of fine veins, grown on the flat blade from its main veins.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "sim/leaf/leaf_model.hpp"

namespace witherfield::leaf {

/// Adds side veins (order 2): from both sides of every vein of `veins`, bending towards its tip, until the margin or another
/// vein is near. Every side vein starts exactly at a point of its parent's line.
void grow_side_veins(std::vector<Vein>& veins, const std::vector<glm::dvec2>& outline, const VeinOptions& options,
                     double main_vein_m, std::uint64_t seed);

/// Adds the net (order 3): borders of the cells nearest to points that stand about `net_spacing_m` apart (a Voronoi diagram:
/// the shape that areoles between fine veins have). Larger veins run along cell borders.
void grow_net(std::vector<Vein>& veins, const std::vector<glm::dvec2>& outline, const VeinOptions& options, std::uint64_t seed);

/// How much a vein of this order stands out at its middle, 0..1.
double vein_strength(int order);

}  // namespace witherfield::leaf
