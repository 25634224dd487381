// The blades look: instanced two-sided meshes of the blades themselves.
#pragma once
#include <filesystem>

#include "pov/scene_parts.hpp"
#include "sim/core/progress.hpp"

namespace witherfield::pov {

/// Writes <stem>.pov with its meshes and pictures. Returns its path.
std::filesystem::path write_blade_field(const SceneContext& c,
                                        const Progress& progress);  ///< over a placement
std::filesystem::path write_blades_alone(const SceneContext& c, const Progress& progress);  ///< one texel

}  // namespace witherfield::pov
