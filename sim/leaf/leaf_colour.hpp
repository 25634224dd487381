// Colour of a leaf's upper side from its chlorophyll and water: thick-layer reflectance, linear sRGB.
#pragma once
#include <glm/vec3.hpp>

namespace witherfield::leaf {

/// Kubelka-Munk mixing per channel: K/S = (1 - R)^2 / 2R of tissue without pigment plus that of chlorophyll, in proportion to its
/// content, plus that of the brown that forms in tissue which has lost its water. Dry tissue scatters more (air in its pores).
/// @param chlorophyll_ug_cm2 >= 0; @param water relative water content, clamped to 0..1.
glm::dvec3 leaf_colour(double chlorophyll_ug_cm2, double water);

}  // namespace witherfield::leaf
