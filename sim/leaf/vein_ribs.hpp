// Veins as ribs of the blade: which piece of which curve lies in which triangle.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/leaf/shell_patch.hpp"
#include "sim/leaf/wilt_body.hpp"

namespace witherfield::leaf {

/// A straight piece of a rib inside one triangle. A piece that runs along an edge is shared by both triangles.
struct RibPiece {
  int triangle = 0;
  glm::dvec2 direction{1, 0};  ///< unit, in the triangle's plane frame
  double length_m = 0;         ///< the triangle's share
  double radius_m = 0;
};

/// A point of the blade that moves with it.
struct BladePoint {
  std::array<int, 3> corner{0, 0, 0};
  std::array<double, 3> weight{1, 0, 0};
  glm::dvec3 at(std::span<const glm::dvec3> position_m) const {
    glm::dvec3 p(0.0);
    for (std::size_t i = 0; i < 3; ++i) p += weight[i] * position_m[std::size_t(corner[i])];
    return p;
  }
};

struct RibLayout {
  std::vector<RibPiece> pieces;             ///< by triangle, ascending
  std::vector<BladePoint> main_vein;        ///< the first curve as points on the blade
};

/// Lays the curves onto the blade, sampled at a quarter of the mean edge.
RibLayout lay_ribs(const WiltBody& body, const std::vector<ShellPatch>& patches);

/// Vein field of a body without one: 1 within a curve's radius, falling to 0 over one mean edge beyond.
std::vector<float> vein_field(const WiltBody& body);

/// Length of a chain of points of the blade.
double chain_length_m(const std::vector<BladePoint>& chain, std::span<const glm::dvec3> position_m);

}  // namespace witherfield::leaf
