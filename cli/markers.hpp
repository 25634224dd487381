// Balls and cords that pictures add to surfaces: points, curves, edges of meshes.
#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "sim/core/surface.hpp"

namespace witherfield::cli {

/// @param colour linear sRGB, into the field `diffuse`.
void add_ball(Surface& surface, const glm::dvec3& center_m, double radius_m, const glm::vec3& colour);
/// A tube along the points, open at both ends; nothing for fewer than two points.
void add_cord(Surface& surface, std::span<const glm::dvec3> points_m, double radius_m,
              const glm::vec3& colour);

}  // namespace witherfield::cli
