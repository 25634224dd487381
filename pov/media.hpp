// POV-Ray text and DF3 files of pre-lit media.
#pragma once
#include <string>
#include <vector>

#include "pov/texel_scene.hpp"

namespace witherfield::pov {

/// Declared densities of one texel in one light.
struct MediaNames {
  std::string density, emission[3];   ///< identifiers in the scene
  double absorption = 0, emitted = 0; ///< per unit of length at full scale
};

/// Writes the DF3 of the density and appends its #declare; `name` is the file stem's suffix and the identifier.
/// @returns the density that is full scale.
double declare_density(Text& scene, const SceneContext& c, const TexelPrelight& light, const MediaBlock& block,
                       const std::string& name);
/// The same for the emission of one shading (three DF3s). @returns the density times radiance that is full scale.
double declare_emission(Text& scene, const SceneContext& c, const TexelPrelight& light, const MediaBlock& block,
                        const std::vector<glm::vec3>& radiance, double full_density, const std::string& name);

/// interior{...} of one box. `intervals` is a POV-Ray expression.
std::string interior_text(const MediaNames& names, const glm::dvec3& factor, const std::string& intervals);

}  // namespace witherfield::pov
