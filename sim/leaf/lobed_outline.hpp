// The outline of a deeply lobed leaf as the envelope of its veins: every vein carries a lobe, lobes flow together with round
// sinuses.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "sim/leaf/outline.hpp"

namespace witherfield::leaf {

struct Lobe {
  std::vector<glm::dvec2> line_m;   ///< its vein
  double half_width_base_m = 0, half_width_tip_m = 0;
};

struct LobedOutline {
  std::vector<glm::dvec3> left_m, right_m;  ///< base -> tip, both without the ends
  glm::dvec3 tip_m{0, 0, 0};
};

/// @param size_m the leaf's length: sets the grid on which the envelope is found, and how round the sinuses are.
/// The base is the origin, where the outline is cut in (petiole sinus). @throws SolverFailure when no closed outline is found.
LobedOutline lobed_outline(const std::vector<Lobe>& lobes, double size_m);

}  // namespace witherfield::leaf
