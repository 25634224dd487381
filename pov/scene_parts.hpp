// What both looks share: the head of a scene (what render_scene reads back), camera, daylight, haze and
// ground.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "pov/plan.hpp"
#include "pov/sky.hpp"
#include "pov/text.hpp"

namespace witherfield::pov {

/// Settings that travel in the first lines of a scene file from the writer to render_scene.
struct SceneHead {
  int width_px = 640, height_px = 360;
  double exposure = 1;
  std::string look = "texel";
  bool depth_of_field = false;
  bool field = true;  ///< over a terrain; false: one texel
};
std::string head_text(const SceneHead& head, const std::string& title);
/// @throws InvalidInput naming the file when the text is no scene of ours.
SceneHead parse_head(const std::string& scene_text, const std::string& file);

/// Everything a look's writer works with.
struct SceneContext {
  const SceneInput* input = nullptr;
  std::filesystem::path folder;
  std::string stem;  ///< "<still>_<look>"; all files of the scene begin with it
  double unit = 1;   ///< POV-Ray units per metre
  const Daylight* day = nullptr;
  const Surroundings* around = nullptr;  ///< null for a single texel
};

/// What of the light reaches the ground, and what the canopy sends back: mean over the texels of a scene.
struct GroundLight {
  double sun = 1, sky = 1;        ///< mean shares on the ground under the grass
  glm::dvec3 scattered_rgb{0.0};  ///< light from the blades above
  glm::dvec3 canopy_rgb{0.1};     ///< radiance of the canopy as seen from outside
  glm::dvec3 litter_rgb{0.0};     ///< mean reflectance of the blades: what lies on the soil
  double weight = 0;
  void add(const GroundLight& more, double more_weight);
};

/// Reflectance of the studio's floor, and radiance of the wall behind a single texel (somewhat darker than
/// the lit floor).
inline const glm::dvec3 kBackdrop{0.205, 0.205, 0.195};
glm::dvec3 backdrop_rgb(const SceneContext& c);

/// camera{...}, with depth of field when there is an aperture; sampling follows QUALITY.
std::string camera_text(const Camera& camera, double unit);
/// Version, global settings, camera, sun, sky sphere (writes its picture), haze.
std::string atmosphere_text(const SceneContext& c);
/// Terrain mesh with its surroundings, and the plain to the horizon.
/// @param shadows true when the scene's grass casts real shadows on the ground, else the beam is dimmed by
/// light.sun.
std::string terrain_text(const SceneContext& c, const GroundLight& light, bool shadows);

}  // namespace witherfield::pov
