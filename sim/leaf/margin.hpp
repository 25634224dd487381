// The teeth of a leaf's margin.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "sim/core/random.hpp"
#include "sim/leaf/options.hpp"

namespace witherfield::leaf {

/// One side of the outline with teeth, base -> tip, ends kept. Teeth neither add nor take area on the whole; they lean to
/// the tip of their lobe (where the outline is farthest from the base), and fade out at the petiole.
/// @param outward +1 when the blade lies on the left of the line (right half of a leaf, base -> tip), else -1.
/// @param spacing_m distance of the points of the result.
std::vector<glm::dvec2> toothed(const std::vector<glm::dvec2>& line, const MarginOptions& options, double outward,
                                double spacing_m, Random& random);

}  // namespace witherfield::leaf
