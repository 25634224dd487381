// The light of a photographer's studio: a softbox as key light, a smaller one from behind as rim light, the bright
// room (or the sky), paper below; and what of it reaches the vertices of meshes and the nodes of the paper.
//
// All light that is not mirrored is worked out here, at points, by rays: so tissue can spread it below its skin, leaves
// can let it through, it is free of noise, and POV-Ray needs no more than mirror images and sharp edges for its part.
#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pov/lit_mesh.hpp"
#include "pov/object_scene.hpp"
#include "pov/paper.hpp"
#include "pov/seen.hpp"

namespace witherfield::pov {

/// A glowing square.
struct Softbox {
  glm::dvec3 center_m{0.0}, side_a_m{0.0}, side_b_m{0.0}, toward{0, 0, 1};  ///< toward: where it shines, unit
  glm::dvec3 radiance{0.0};
  glm::dvec3 colour{0.0};  ///< irradiance over pi at the objects' middle, facing it
};

struct Studio {
  glm::dvec3 center_m{0.0};
  double radius_m = 1;  ///< of the ball around the objects
  std::vector<Softbox> boxes;
  Paper paper;          ///< empty in front of the sky
  glm::dvec3 paper_rgb{0.8};
  glm::dvec3 zenith{1.0}, horizon{0.5}, nadir{0.3};  ///< radiance of the room

  glm::dvec3 room(const glm::dvec3& direction) const;  ///< radiance from a unit direction
};
Studio make_studio(const ObjectSceneInput& input);

/// What falls on one side of a leaf, per vertex, so that detail finer than the mesh can be lit. Irradiances over pi.
struct SideLight {
  std::vector<glm::vec3> irradiance;  ///< all bounces, on the vertex's own normal
  std::vector<glm::mat3> lean;        ///< column c: how the irradiance of colour c grows as the normal leans
  std::vector<glm::vec2> boxes;       ///< key and rim light that arrive, facing them, over Softbox::colour: 1 = not shaded
  glm::vec3 at(std::size_t vertex, const glm::vec3& leaned) const {
    return irradiance[vertex] + leaned * lean[vertex];
  }
};

/// Radiance that leaves every vertex toward any side (all is diffuse): above or outside, and below (leaves).
struct Glow {
  std::vector<glm::vec3> front, back;
  SideLight above, below;  ///< of leaves only
};
struct StudioGlow {
  std::vector<Glow> meshes;
  std::vector<glm::vec3> paper;  ///< per node
};
/// Lights meshes and paper; what is not seen gets fewer rays. Same bits for any number of threads.
/// @param tree over the meshes as placed (LitMesh::base).
StudioGlow light_studio(const Studio& studio, const View& view, const SceneTree& tree, std::span<const LitMesh> meshes);

/// Irradiance spread over a mesh by diffusion: (M + l^2 L) s = M e with the lengths of its vertices, mass matrix M and
/// cotangent Laplacian L. Keeps the total of M e where the length is constant.
std::vector<glm::vec3> spread_light(const LitMesh& mesh, std::vector<glm::vec3> irradiance);

}  // namespace witherfield::pov
