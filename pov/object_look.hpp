// What a look is to POV-Ray: textures from pictures of colour.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pov/object_scene.hpp"

namespace witherfield::pov {

/// Colours of a surface's vertices: light sent back by the outer (upper) side, by the other side, light let through.
struct VertexColours {
  std::vector<glm::vec3> front, back, through;
};
/// @param thin when a look of the surface is a leaf: back and through are filled.
/// @throws InvalidInput when the field `diffuse` is missing or lies on faces.
VertexColours vertex_colours(const Surface& surface, bool thin);

/// The names of declared pigments (image maps in uv).
struct Pigments {
  std::string front, back, through;
};
/// "texture{...} [interior_texture{...}] [interior{...}]" of an organ.
std::string look_text(const ObjectLook& look, const Pigments& pigments);

}  // namespace witherfield::pov
