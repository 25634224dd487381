// The words of an object scene: studio, meshes, finishes.
#pragma once
#include <span>
#include <string>

#include "pov/face_atlas.hpp"
#include "pov/studio_light.hpp"

namespace witherfield::pov {

/// Radiance that is full scale in the pictures of a scene.
inline constexpr double kFullGlow = 4;

/// Global settings, the room that shiny skin mirrors, softboxes as mirror images and as lights of highlights.
std::string studio_text(const Studio& studio, double unit);

/// mesh2 of some faces, in POV-Ray's axes and units. Outside is where the vertices' normals point; of a face
/// whose three normals are alike POV-Ray takes (p1 - p2) x (p3 - p2) instead, which the flip of space turns outside when
/// the corners keep their order.
std::string mesh2_text(const LitMesh& mesh, std::span<const int> faces, const FaceAtlas& atlas, double unit);

/// The same with the vertices' own texture coordinates.
std::string mesh2_text(const LitMesh& mesh, std::span<const int> faces, double unit);
/// Texture of a leaf painted with its sheen (paint_skin): pigments `front` above and `back` below.
std::string skin_text(const std::string& front, const std::string& back);
/// "texture{...} [interior_texture{...}] [interior{...}]" of an organ whose glow is in declared pigments.
std::string look_text(const ObjectLook& look, const std::string& front, const std::string& back);

}  // namespace witherfield::pov
