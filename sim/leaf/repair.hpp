// Triangles with two border edges break the deformation (their corner hangs on one triangle only): none may remain.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/core/surface.hpp"

namespace witherfield::leaf {

/// A vertex that was put on the middle of an edge.
struct EdgeSplit {
  int a, b, middle;
};

/// The split of Miao et al. (fig. 4): triangle ABC with A in no other triangle, neighbour BCD across BC: E at the middle of
/// BC, ABC -> ABE + AEC, BCD -> BDE + EDC. Vertices are added at the end; uv, normals and vertex fields are averaged.
/// @throws InvalidInput when a triangle has three border edges (nothing to lean on).
std::vector<EdgeSplit> split_ears(Surface& surface);

/// Vertices that lie in exactly one triangle.
std::vector<int> ear_vertices(const Surface& surface);

/// Border of the surface as closed chains of vertices, the inside on the left; each starts at its smallest vertex.
std::vector<std::vector<int>> border_loops(const std::vector<std::array<int, 3>>& triangles);

}  // namespace witherfield::leaf
