// Flat drawing on top of a picture, in pixels from the lower left: rectangles, lines, text.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace witherfield::vis {

enum class Align { left, centre, right };

class Overlay {
 public:
  explicit Overlay(vtkRenderer& renderer) : renderer_(renderer) {}

  struct Tile {
    glm::dvec2 lo, hi;
    glm::dvec3 colour;
  };
  void tiles(const std::vector<Tile>& tiles);
  void lines(const std::vector<std::pair<glm::dvec2, glm::dvec2>>& lines, double width_px,
             const glm::dvec3& colour);
  /// `at` is the middle of the text's height. Lines are parted by '\n'.
  /// backing: opacity of a rectangle of paper behind it.
  void text(const std::string& text, const glm::dvec2& at, int font_px, Align align, const glm::dvec3& colour,
            double backing = 0);

 private:
  vtkRenderer& renderer_;
};

inline constexpr glm::dvec3 kPaper{0.965, 0.972, 0.98};  ///< background
inline constexpr glm::dvec3 kInk{0.13, 0.15, 0.18}, kFaintInk{0.45, 0.48, 0.52};

}  // namespace witherfield::vis
