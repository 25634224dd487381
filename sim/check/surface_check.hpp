// The checks of mesh_check.hpp on plain arrays that may hold anything: edges with three faces, faces twice,
// shells that share vertices. Every fault is counted and named; nothing is repaired.
#pragma once
#include "sim/check/mesh_check.hpp"
#include "sim/core/surface.hpp"

namespace witherfield::check {

/// Two faces intersect when they meet elsewhere than in corners and edges that they share; corners are shared
/// when they have the same position, so that seams (vertices doubled for texture coordinates) are no
/// intersections. Faces with the same three corners count as duplicates, degenerate faces as degenerate,
/// neither as intersections. Same result for any number of threads.
/// @throws InvalidInput when an index is out of range (Surface::validate says the same).
MeshReport check_surface(const Surface& surface, const MeshCheckOptions& options = {});

}  // namespace witherfield::check
