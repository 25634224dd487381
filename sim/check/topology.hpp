// How the faces of a surface hang together, from the indices alone. Part of check_surface and
// overlap_fractions.
#pragma once
#include <vector>

#include "sim/check/mesh_check.hpp"
#include "sim/core/surface.hpp"

namespace witherfield::check {

struct Topology {
  std::vector<int> component;    ///< of each face; numbered in order of the least face id
  std::vector<int> first_equal;  ///< of each vertex: the least vertex with the same position (itself mostly)
};

/// Fills the topological part of the report: everything down to `component`, but for areas and volumes.
/// @throws InvalidInput when an index is out of range.
Topology analyse_topology(const Surface& surface, std::size_t listed, MeshReport& report);

/// Areas and volumes of the components, by the divergence theorem about a vertex of each, which keeps
/// rounding small. @pre all positions are finite.
void measure_components(const Surface& surface, const std::vector<int>& component, MeshReport& report);

}  // namespace witherfield::check
