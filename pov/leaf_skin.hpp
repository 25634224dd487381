// The two sides of a leaf as pictures over its texture coordinates: veins and fine relief are far finer than
// any mesh.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "pov/lit_mesh.hpp"
#include "pov/studio_light.hpp"

namespace witherfield::pov {

struct SkinPictures {
  int pixels = 0;                      ///< square
  std::vector<glm::vec3> front, back;  ///< radiance toward the camera, rows from the top (v = 1)
};

/// How many texels a side of a mesh's skin needs so that one is about a pixel of the
/// picture, 64..kMostTexels.
int skin_pixels(const LitMesh& mesh, const View& view);

/// Reflected, transmitted and mirrored light of the faces that `look` covers. Every texel takes light,
/// reflectance and frame from its face, and the height of the relief and the veins from look.detail: the
/// normal leans with the relief, veins are paler, let less light through (main veins) or more (fine ones),
/// and are sunken on the upper side and raised on the lower one. The sheen is a microfacet lobe (GGX: Walter
/// et al. 2007) of the softboxes and a blurred mirror image of the room, worked out for the camera of the
/// picture.
/// @pre the mesh has texture coordinates, look.detail is set.
SkinPictures paint_skin(const Studio& studio, const View& view, const LitMesh& mesh,
                        std::span<const int> faces, const Glow& glow, const ObjectLook& look, double scale);

}  // namespace witherfield::pov
