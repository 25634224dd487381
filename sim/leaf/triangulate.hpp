// Triangles in the plane: constrained Delaunay triangulation of a leaf's outline with its veins as edges, coarse or refined.
// (The paper names the DeWall algorithm, which makes Delaunay tetrahedra of points in space; what it needs is this.)
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace witherfield::leaf {

struct PlanarDomain {
  std::vector<glm::dvec2> outline;             ///< closed by itself, counter-clockwise, not crossing itself
  std::vector<std::vector<glm::dvec2>> lines;  ///< become edges; may touch one another, must lie inside
};

struct PlanarMesh {
  std::vector<glm::dvec2> point;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
};

/// No other points than those given. @throws InvalidInput when the outline crosses itself or encloses no area.
PlanarMesh triangulate(const PlanarDomain& domain);

/// Points are added (Ruppert 1995; Shewchuk 2002, as in CGAL's Mesh_2) until no edge is longer than `edge_m` at the
/// triangle's middle and no angle is below 20 degrees, save between given edges that meet more sharply.
/// @throws InvalidInput as above, and when more than `max_vertices` would be needed.
PlanarMesh triangulate(const PlanarDomain& domain, const std::function<double(const glm::dvec2&)>& edge_m,
                       int max_vertices);

}  // namespace witherfield::leaf
