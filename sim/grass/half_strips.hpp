// Blades as surfaces: half strips from the centre line to the rims, segment by segment. Voxelisation and
// total area both see the blade through this, so they cannot disagree.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/grass/blades.hpp"

namespace witherfield::grass {

/// One segment of one half strip: from the centre line (axis) to the rim, nodes k (0) and k + 1 (1).
/// Its two triangles are (axis0, rim0, rim1) and (axis0, rim1, axis1).
struct HalfStrip {
  glm::dvec3 axis[2], rim[2], outward[2];
  double half_width[2];
  int node;  // k, counted over all blades
};

/// Half strips of a blade around its axis: 2 for the ribbon, 8 for the cone (4 silhouettes), and their share
/// of the area.
inline int half_strips(BladeForm form) {
  return form == BladeForm::ribbon ? 2 : 8;
}
inline double area_share(BladeForm form) {
  return form == BladeForm::ribbon ? 1.0 : 0.25;
}

/// Unit direction from the axis to the rim of half strip `strip` at a node.
inline glm::dvec3 outward(const BladeState& s, std::size_t node, int strip) {
  const glm::dvec3 normal = blade_normal(s.tangent[node], s.side[node]);
  if (s.form == BladeForm::ribbon) {
    const double fold = s.fold_rad[node];
    return (strip ? -std::cos(fold) : std::cos(fold)) * s.side[node] + std::sin(fold) * normal;
  }
  constexpr double r = 0.70710678118654752440;
  static constexpr double cosine[8] = {1, r, 0, -r, -1, -r, 0, r}, sine[8] = {0, r, 1, r, 0, -r, -1, -r};
  return cosine[strip] * s.side[node] + sine[strip] * normal;
}

/// Area of the two triangles, m^2.
inline double area(const HalfStrip& h) {
  const glm::dvec3 diagonal = h.rim[1] - h.axis[0];
  return 0.5 * (glm::length(glm::cross(h.rim[0] - h.axis[0], diagonal)) +
                glm::length(glm::cross(diagonal, h.axis[1] - h.axis[0])));
}

/// Calls visit for every segment of every half strip of one blade, from root to tip.
template <class Visit>
void visit_half_strips(const BladeState& s, int blade, const Visit& visit) {
  const int strips = half_strips(s.form);
  const std::size_t first = std::size_t(blade) * std::size_t(s.nodes_per_blade());
  for (int strip = 0; strip < strips; ++strip) {
    HalfStrip h{};
    for (int k = 0; k <= s.segments; ++k) {
      const std::size_t node = first + std::size_t(k);
      h.axis[0] = h.axis[1], h.rim[0] = h.rim[1], h.outward[0] = h.outward[1],
      h.half_width[0] = h.half_width[1];
      h.axis[1] = s.node_m[node];
      h.outward[1] = outward(s, node, strip);
      h.half_width[1] = s.half_width_m[node];
      h.rim[1] = h.axis[1] + h.half_width[1] * h.outward[1];
      h.node = int(node) - 1;
      if (k > 0) visit(h);
    }
  }
}

}  // namespace witherfield::grass
