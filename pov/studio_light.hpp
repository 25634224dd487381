// The photographer's studio around an object: paper that sweeps up behind it, a softbox as key light, the room's
// light, a rim light from behind.
#pragma once
#include <glm/vec3.hpp>
#include <string>

#include "pov/object_scene.hpp"

namespace witherfield::pov {

/// Where things stand, in POV-Ray's axes and units.
struct Studio {
  glm::dvec3 center{0.0};  ///< middle of the objects
  double radius = 1;       ///< of the ball around them
  double ground = 0;       ///< height of the paper
  glm::dvec3 to_key{0, 1, 0}, to_rim{0, 1, 0}, away{0, 0, 1};  ///< unit; away: level, from the camera to the back
};
Studio make_studio(const ObjectSceneInput& input, double unit);

/// Global settings, lights, softboxes, backdrop.
std::string studio_light_text(const ObjectSceneInput& input, const Studio& studio);

}  // namespace witherfield::pov
