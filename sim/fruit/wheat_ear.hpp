// The plan of a wheat ear: where spikelets, kernels and husks sit. Lengths in millimetres.
#pragma once
#include <vector>

#include "sim/fruit/model.hpp"

namespace witherfield::fruit {

/// The paper's order in a segment: 0 in the middle, 1 and 2 to the right of it, 3 and 4 to the left, as seen
/// from the segment's front. 1 and 2 are kernel 0 turned, 3 and 4 the mirror images of 1 and 2 in the yOz
/// plane (x -> -x). Frame of a kernel in its segment: origin in the middle of the wedge's square 4-5-6-7, -y
/// away from the shank, z up.
struct FloretPlace {
  Frame frame;            ///< kernel's base and axes; its groove looks to +y
  bool mirrored = false;  ///< apply x -> -x after the frame
  double size = 1;        ///< awn length and husk size over those of the lowest florets
};
FloretPlace floret_place(int kernel);
/// The two empty glumes below the florets; side -1 left, 1 right.
FloretPlace glume_place(int side);

struct SpikeletPlace {
  Frame frame;            ///< of the segment, in the straight ear
  double size = 1;        ///< spikelets in the middle of the ear are the largest
  bool terminal = false;  ///< the last one closes the ear: it is turned by a quarter and upright
};
/// From the lowest spikelet up; front row (-y) first, alternating.
std::vector<SpikeletPlace> spikelet_places(const WheatOptions& options);

/// Maps the straight ear to the nodding one: the axis becomes a curve in the xz plane that keeps its length.
class NoddingAxis {
 public:
  NoddingAxis(double length_mm, double nod_rad);
  glm::dvec3 operator()(const glm::dvec3& p) const;

 private:
  double length_, nod_;
  std::vector<glm::dvec2> centre_;  ///< x, z at equal steps
};

}  // namespace witherfield::fruit
