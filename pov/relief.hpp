// Fine relief that the mesh does not have: normals leaned as a height field over the surface would lean them.
#pragma once
#include "pov/lit_mesh.hpp"

namespace witherfield::pov {

/// Leaves with a field `vein` and no pictures of detail: raised by 0.25 mm x relief on the lower side, sunken on the upper one.
/// @pre the mesh's vertices and faces are still those of the surface.
void raise_veins(LitMesh& mesh, const Surface& surface, const ObjectPlacement& object);

/// Streaks along the surface's z axis (grain), a quilt of small blisters (leaf).
void add_relief(LitMesh& mesh, const ObjectPlacement& object);

/// Smooth random height in [-1, 1], about one bump per unit of length, and its gradient.
float bumps(const glm::vec3& at, glm::vec3& gradient);

}  // namespace witherfield::pov
