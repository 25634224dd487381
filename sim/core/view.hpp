// What a picture shows: camera, sun, size. Shared by the scene file (which fills it) and the picture writers.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace witherfield {

struct Camera {
  glm::dvec3 position_m{0, -1, 0.5};
  glm::dvec3 look_at_m{0, 0, 0};
  double fov_deg = 45;             ///< horizontal, 5..120
  double aperture_m = 0;           ///< > 0 gives depth of field (blades look only)
  double focus_m = 0;              ///< distance of sharpness; 0 = distance to look_at
  /// If set, position_m.z is to be replaced by the terrain's height below the camera plus this (done once the terrain is known).
  std::optional<double> height_above_ground_m;
};

struct Sun {
  double azimuth_deg = 140;        ///< counter-clockwise from +x (east) seen from above, 0..360
  double elevation_deg = 40;       ///< 5..90
  double turbidity = 3;            ///< Preetham sky, 2..8
  glm::dvec3 direction() const;    ///< unit, toward the sun
};

/// One still of a run.
struct Still {
  std::string name;                ///< file name stem of the picture, [a-z0-9_]+
  double wd = 0;                   ///< key frame shown (must be among the run's frames)
  std::vector<std::string> looks{"texel"};  ///< "texel", "blades"
  int width_px = 640, height_px = 360;
  Camera camera;
  Sun sun;
  double exposure = 1.0;           ///< 0.05..20, applied before tone mapping
};

}  // namespace witherfield
