// Looks through a mesh file before OpenMesh reads it: OpenMesh skips vertices and faces that it does not
// understand, repeats the last face of a cut-off PLY, says so on the console only, and keeps 24 bits of a
// coordinate; here the file must be whole and sound, and coordinates in the millions of metres keep their
// millimetres.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace witherfield::terrain {

/// The vertices in the order of the file.
/// @throws IoFailure naming file and line when the text is cut off or malformed; InvalidInput when a
/// coordinate is not finite or a face names a vertex that does not exist or one vertex twice.
std::vector<glm::dvec3> scan_obj(const std::string& file);

/// The same for PLY. The faces of a binary PLY are left to OpenMesh, which does notice its premature end.
std::vector<glm::dvec3> scan_ply(const std::string& file);

}  // namespace witherfield::terrain
