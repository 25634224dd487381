// Colours of a mesh's vertices as a picture for POV-Ray.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace witherfield::pov {

/// Every face has two by two texels of its own: three carry its corners' colours, the fourth what makes bilinear
/// interpolation between them the linear interpolation of the corners. So colours are exact at vertices and run
/// linearly over faces; one picture serves any number of faces (a texture per vertex takes POV-Ray three full
/// evaluations a hit, and much memory).
/// POV-Ray's texel i of n sits at (i + 1/2) / n; rows of a picture count from its top, v from its bottom.
class FaceAtlas {
 public:
  /// @param colour per vertex; decides which corner lies opposite the fourth texel: the darkest, so that the
  /// fourth texel stays positive.
  FaceAtlas(std::span<const std::array<int, 3>> triangles, std::span<const glm::vec3> colour);
  int width() const { return 2 * columns_; }
  int height() const { return 2 * rows_; }
  /// Row by row from the top.
  std::vector<glm::vec3> paint(std::span<const glm::vec3> colour) const;
  /// Corner k of face f in half texels from the lower left corner: uv = this / (2 width, 2 height).
  glm::ivec2 corner(std::size_t face, int k) const;
  /// What undoes the half texels: "scale <2 width, 2 height, 1>".
  std::string scale() const;

 private:
  std::span<const std::array<int, 3>> triangles_;
  std::vector<unsigned char> first_;  ///< the corner at the block's origin, per face
  int columns_ = 1, rows_ = 1;
};

}  // namespace witherfield::pov
