#include "vis/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace witherfield::vis {
namespace {

using Stops = std::vector<glm::dvec3>;

// Perceptually uniform maps of N. Smith and S. van der Walt (2015, CC0), every tenth of their length.
const Stops kViridis{{0.267, 0.004, 0.329}, {0.282, 0.141, 0.459}, {0.255, 0.267, 0.529},
                     {0.208, 0.373, 0.553}, {0.165, 0.471, 0.557}, {0.129, 0.569, 0.549},
                     {0.133, 0.659, 0.518}, {0.267, 0.749, 0.439}, {0.478, 0.820, 0.318},
                     {0.741, 0.875, 0.149}, {0.992, 0.906, 0.145}};
const Stops kInferno{{0.000, 0.000, 0.016}, {0.086, 0.043, 0.224}, {0.259, 0.039, 0.408},
                     {0.416, 0.090, 0.431}, {0.576, 0.149, 0.404}, {0.737, 0.216, 0.329},
                     {0.867, 0.318, 0.227}, {0.953, 0.471, 0.098}, {0.988, 0.647, 0.039},
                     {0.965, 0.843, 0.275}, {0.988, 1.000, 0.643}};
// Straw (none) to deep green.
const Stops kGreens{{.80, .74, .50}, {.72, .74, .42}, {.58, .70, .34}, {.42, .62, .28},
                    {.26, .52, .24}, {.13, .41, .20}, {.05, .30, .15}, {.00, .20, .10}};
// Compression blue, tension red, through a grey that stands out from the light background.
const Stops kBlueGreyRed{{.09, .22, .55}, {.17, .42, .72}, {.40, .61, .80}, {.62, .72, .80}, {.74, .74, .72},
                         {.85, .65, .54}, {.85, .43, .32}, {.76, .20, .18}, {.52, .05, .12}};
const Stops kTissue{{.85, .85, .85}, {.79, .47, .14}, {.26, .57, .31}};
// Twelve hues of alternating lightness for labels.
const Stops kLabels{{.12, .47, .71}, {.65, .81, .89}, {.20, .63, .17}, {.70, .87, .54},
                    {.89, .10, .11}, {.98, .60, .60}, {1.0, .50, .00}, {.99, .75, .44},
                    {.42, .24, .60}, {.79, .70, .84}, {.69, .35, .16}, {.55, .55, .45}};

glm::dvec3 sample(const Stops& stops, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * double(stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  return glm::mix(stops[i], stops[i + 1], x - double(i));
}

Stops reversed(Stops stops) {
  std::reverse(stops.begin(), stops.end());
  return stops;
}

/// The part of a diverging map that [lo, hi] covers when 0 is its middle and both sides have the same scale.
Stops about_zero(double lo, double hi) {
  constexpr int kCount = 65;
  const double reach = std::max(-lo, hi);
  Stops out;
  for (int i = 0; i < kCount; ++i) {
    const double value = lo + (hi - lo) * i / (kCount - 1);
    out.push_back(sample(kBlueGreyRed, 0.5 + 0.5 * value / reach));
  }
  return out;
}

}  // namespace

glm::dvec3 ColourMap::at(double value) const {
  if (cyclic_labels || !categories.empty()) {
    const double last = double(colours.size()) - 1, n = std::round(value);
    return colours[static_cast<std::size_t>(cyclic_labels ? std::fmod(std::max(n, 0.0), last + 1)
                                                          : std::clamp(n, 0.0, last))];
  }
  return sample(colours, (value - lo) / (hi - lo));
}

ColourMap colour_map(std::string_view field, double lo, double hi) {
  if (field == "tissue") return {kTissue, 0, 2, {"air", "vein", "mesophyll"}, false};
  if (field == "blade_id" || field == "texel_id") return {kLabels, lo, hi, {}, true};
  if (field == "chlorophyll_ug_cm2") return {kGreens, lo, hi, {}, false};
  if ((field.starts_with("stress_") || field == "strain_area") && lo < 0 && hi > 0) return {about_zero(lo, hi), lo, hi, {}, false};
  if (field.starts_with("stress_") || field.starts_with("strain_")) return {kInferno, lo, hi, {}, false};
  return {reversed(kViridis), lo, hi, {}, false};
}

}  // namespace witherfield::vis
