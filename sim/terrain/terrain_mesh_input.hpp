// Reads a terrain mesh (OBJ, PLY) through OpenMesh.
#pragma once
#include <string>

#include "sim/core/tri_mesh.hpp"

namespace witherfield::terrain {

/// @throws IoFailure when the file is missing, cut off or malformed; InvalidInput when it is neither .obj nor
/// .ply, has coordinates that are not finite, faces that name missing vertices, or edges that do not join
/// exactly two consistently oriented faces.
TriMesh read_terrain_mesh(const std::string& file);

}  // namespace witherfield::terrain
