// A placed surface made ready to be lit and drawn: in the world, fine enough for the picture, with reflectances,
// relief and the tissue's softness at every vertex.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pov/object_scene.hpp"

namespace witherfield::pov {

struct LitVertex {
  glm::vec3 position_m{0.0f}, normal{0.0f};  ///< world; the normal with its relief
  glm::vec3 local_m{0.0f};                   ///< in the surface's own axes: what relief is made from
  glm::vec2 uv{0.0f};                        ///< texture coordinates; 0 where the surface has none
  glm::vec3 front{0.0f};                     ///< reflectance of the outer (upper) side
  glm::vec3 back{0.0f}, through{0.0f};       ///< leaves: reflectance of the lower side, transmittance
  glm::vec3 spread_m{0.0f};                  ///< how far red, green, blue light wanders below the skin
  bool seen = true;                          ///< by the camera, or close to what it sees
};

struct LitMesh {
  std::vector<LitVertex> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<int> organ;                     ///< per triangle
  std::vector<int> base;                      ///< per triangle: the face of the placed surface that it lies on
  bool thin = false;                          ///< a leaf: both sides are seen
};

const ObjectLook& look_of(const ObjectPlacement& object, int organ);

/// The surface in the world, face by face, with the relief of a leaf's veins.
LitMesh place_mesh(const ObjectPlacement& object);

/// Halves edges at seen vertices until none is longer, or a further round would exceed max_faces; then adds the
/// fine relief. Flat faces stay flat; colours and normals in between are interpolated.
void refine_mesh(LitMesh& mesh, const ObjectPlacement& object, double longest_edge_m, std::size_t max_faces);

/// One round: every edge longer than the limit gets a vertex in its middle; faces with one, two or three such edges
/// become two, three or four. Neighbours stay joined. @returns whether anything was halved.
bool halve_long_edges(LitMesh& mesh, double longest_edge_m, std::size_t max_faces);

}  // namespace witherfield::pov
