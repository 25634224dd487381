// The connectivity and rest geometry that a thin shell of triangles needs: each triangle with its three neighbours.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::leaf {

/// A triangle and the corners across its edges. Edge i lies opposite corner i.
struct ShellPatch {
  std::array<int, 3> corner;
  std::array<int, 3> across;          ///< the neighbour's far corner; -1: edge i is on the margin
  std::array<glm::dvec2, 3> gradient; ///< of the three linear shape functions in the triangle's own plane frame, 1/m
  std::array<double, 3> rest_angle;   ///< of the hinges at rest
  double area_m2;
  glm::dvec3 axis_u, axis_v;          ///< the frame in space, at rest

  double height_m(int i) const;       ///< over edge i, at rest
  double cotangent(int i) const;      ///< of the angle at corner i, at rest
  double edge_m(int i) const;         ///< length of edge i, at rest
};

/// @throws InvalidInput naming the triangle: no area, three triangles at an edge, neighbours turned over.
std::vector<ShellPatch> make_patches(std::span<const glm::dvec3> rest_m, std::span<const std::array<int, 3>> triangles);

}  // namespace witherfield::leaf
