// Colours of scalar fields. Encoded sRGB 0..1, as pictures and screens take them (VTK blends encoded
// colours).
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield::vis {

struct ColourMap {
  std::vector<glm::dvec3>
      colours;  ///< evenly spaced from lo to hi; categories: one per category, from value 0 on
  double lo = 0, hi = 1;
  std::vector<std::string>
      categories;  ///< names of the values 0, 1, ... that the legend shows; empty = continuous scale
  bool cyclic_labels = false;  ///< value n has colour n mod size: labels without order, no legend of values

  /// Clamped to the range. Categories and labels take the nearest whole value.
  glm::dvec3 at(double value) const;
};

/// The map of a field over [lo, hi]: water viridis, dark = wet; chlorophyll greens; stress and
/// areal strain diverging about 0 where the range spans it, else inferno; other strain inferno; tissue and
/// blade_id categorical; others viridis, light = low.
/// @pre lo < hi.
ColourMap colour_map(std::string_view field, double lo, double hi);

}  // namespace witherfield::vis
