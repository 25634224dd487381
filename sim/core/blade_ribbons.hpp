// Blades as render geometry: a centre line with width and frame per node. What the picture writers need of blades,
// free of how they were simulated.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace witherfield {

/// Node k of blade b is at index b * nodes_per_blade + k; k = 0 is the root, the last node the tip.
struct BladeRibbons {
  int nodes_per_blade = 0;
  std::vector<glm::dvec3> center_m;    ///< texel coordinates: tile is [0, tile] x [0, tile], ground z = 0
  std::vector<glm::vec3> tangent;      ///< unit, root to tip
  std::vector<glm::vec3> side;         ///< unit, across the blade
  std::vector<float> half_width_m;     ///< 0 at the tip
  std::vector<float> fold_rad;         ///< dihedral half-opening: 0 flat, pi/2 folded shut; edges rise along side x tangent
  std::vector<float> thickness_m;
  std::vector<glm::vec3> diffuse;      ///< linear sRGB reflectance
  std::vector<float> water, chlorophyll_ug_cm2;
  bool cone = false;                   ///< render as cones of radius half_width_m instead of folded ribbons
  int blade_count() const { return nodes_per_blade ? int(center_m.size()) / nodes_per_blade : 0; }
};

}  // namespace witherfield
