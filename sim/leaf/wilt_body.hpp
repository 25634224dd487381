// What wilts: any triangle mesh with a margin, ribs (veins) in it, and a stalk (or a clamp) that holds it.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sim/core/surface.hpp"

namespace witherfield::leaf {

/// A rib: a round rod that lies in the blade, bends with it and conducts water.
struct VeinCurve {
  std::vector<glm::dvec3> points_m;  ///< from its origin outwards, on (or near) the blade in the frame of `vein_frame_m`
  double radius_base_m = 0, radius_tip_m = 0;
};

struct WiltBody {
  Surface rest;                     ///< natural pose at full turgor (upper side = counter-clockwise)
  std::vector<float> vein;          ///< per vertex, 0 blade .. 1 vein: shrinks less; empty = from the curves
  std::vector<VeinCurve> veins;     ///< ribs; number 0 is the main vein, whose length is reported; may be empty
  std::vector<glm::dvec3> vein_frame_m;  ///< other positions of the same vertices in which the curves are given (the flat blade); empty = rest
  std::vector<int> clamp;           ///< vertices of the blade that are held: by the petiole's end, or in space when there is none
  std::vector<int> inlet;           ///< vertices that the petiole feeds, each by its share of their area, through veins finer than the mesh;
                                    ///< empty = the clamped ones, from which the curves lead on
  std::vector<glm::dvec3> petiole_m;     ///< centre line from the stem (clamped) to the blade; empty = none
  double petiole_radius_stem_m = 0, petiole_radius_blade_m = 0;
  bool rest_carries_weight = true;  ///< true: the natural pose is in equilibrium under its weight at full turgor;
                                    ///< false: it is the shape without any load
};

/// @throws InvalidInput: no triangle, an edge with three triangles, an index or radius out of range, nothing that holds the blade,
/// wrong lengths of arrays, positions that are not finite.
void validate(const WiltBody& body);

}  // namespace witherfield::leaf
