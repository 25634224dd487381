// Looks through a mesh file before OpenMesh reads it: OpenMesh skips vertices and faces that it does not understand, repeats
// the last face of a cut-off PLY, and says so on the console only; here the file must be whole and sound.
#pragma once
#include <string>

namespace witherfield::terrain {

/// @throws IoFailure naming file and line when the text is cut off or malformed; InvalidInput when a coordinate is not finite or a
/// face names a vertex that does not exist.
void scan_obj(const std::string& file);

/// The same for PLY. The body of a binary PLY is left to OpenMesh, which does notice its premature end.
void scan_ply(const std::string& file);

}  // namespace witherfield::terrain
