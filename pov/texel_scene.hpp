// The texel look: pre-lit emission + absorption media in sheared boxes, one texel each.
#pragma once
#include <filesystem>
#include <string>

#include "pov/prelight.hpp"
#include "pov/scene_parts.hpp"
#include "sim/core/progress.hpp"

namespace witherfield::pov {

/// Mean full width of the blades at their widest, for the opacity of their voxels (3 mm when there are none).
double mean_blade_width_m(const SceneInput& input, int variant);

/// A variant's texel at a LOD, or the nearest one there is (coarser first). @throws InvalidInput when it has
/// none.
const TexelGrid& grid_of(const SceneInput& input, int variant, int lod);

/// Sun on a slope and in the terrain's shadow: factor on an emission that was shaded for level, lit ground.
glm::dvec3 slope_factor(const TexelInstance& t, const glm::dvec3& to_sun,
                        const TexelPrelight::Shading& shading);

/// Ground for a texel that stands alone: soil with the light that the grass leaves on it, as a picture from
/// the same transport. @param with_beam true: the picture holds the sun's shadow too (media cast none);
/// false: only the sky's.
std::string studio_text(const SceneContext& c, const TexelPrelight& light, bool with_beam);

/// Writes <stem>.pov with its DF3s. Returns its path.
std::filesystem::path write_texel_field(const SceneContext& c,
                                        const Progress& progress);  ///< over a placement
std::filesystem::path write_texel_alone(const SceneContext& c, const Progress& progress);  ///< one texel

}  // namespace witherfield::pov
