// The texel look: pre-lit emission + absorption media in one sheared box per texel.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "pov/prelight.hpp"
#include "pov/scene_parts.hpp"
#include "sim/core/progress.hpp"

namespace witherfield::pov {

/// Density or emission of a texel laid out for a DF3: samples with an empty border where needed, and where they lie.
struct MediaBlock {
  int nx = 0, ny = 0, nz = 0;
  glm::dvec3 first_m{0.0};            ///< position of sample (0, 0, 0)
  double spacing_m = 1;
  glm::dvec3 box_lo_m{0.0}, box_hi_m{0.0};  ///< where the samples may be used without meeting the wrap
  std::vector<std::size_t> target;    ///< per voxel of the prelight: its sample
};
/// @param folded true: the periodic tile (x and y wrap, as DF3 interpolation does); false: all that is there, with an empty
/// sample around. Below the ground the lowest layer is repeated, above the grass one layer is empty.
MediaBlock media_block(const TexelGrid& grid, const TexelPrelight& light, bool folded);

/// Mean full width of the blades at their widest, for the opacity of their voxels (3 mm when there are none).
double mean_blade_width_m(const SceneInput& input, int variant);

/// Ground for a texel that stands alone: soil with the light that the grass leaves on it, as a picture from the same
/// transport. @param with_beam true: the picture holds the sun's shadow too (media cast none); false: only the sky's.
std::string studio_text(const SceneContext& c, const TexelPrelight& light, bool with_beam);

/// Writes <stem>.pov with its DF3s. Returns its path.
std::filesystem::path write_texel_field(const SceneContext& c, const Progress& progress);   ///< over a placement
std::filesystem::path write_texel_alone(const SceneContext& c, const Progress& progress);   ///< one texel

}  // namespace witherfield::pov
