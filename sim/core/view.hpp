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
  double fov_deg = 45;    ///< horizontal, 5..120
  double aperture_m = 0;  ///< > 0 gives depth of field (blades look only)
  double focus_m = 0;     ///< distance of sharpness; 0 = distance to look_at
  /// If set, position_m.z is to be replaced by the terrain's height below the camera plus this (done once the
  /// terrain is known).
  std::optional<double> height_above_ground_m;
};

struct Sun {
  double azimuth_deg = 140;      ///< counter-clockwise from +x (east) seen from above, 0..360
  double elevation_deg = 40;     ///< 5..90
  double turbidity = 3;          ///< Preetham sky, 2..8
  glm::dvec3 direction() const;  ///< unit, toward the sun
};

/// One still of a run.
struct Still {
  std::string name;                         ///< file name stem of the picture, [a-z0-9_]+
  double wd = 0;                            ///< key frame shown (must be among the run's frames)
  std::vector<std::string> looks{"texel"};  ///< "texel", "blades"
  int width_px = 640, height_px = 360;
  Camera camera;
  Sun sun;
  double exposure = 1.0;  ///< 0.05..20, applied before tone mapping
};

/// A picture of an object in a studio (fruit, leaves).
struct ObjectStill {
  std::string name;               ///< file name stem of the picture, [a-z0-9_]+
  std::vector<double> wd{1};      ///< key frames shown, side by side from the left (must be among the run's)
  std::string subject = "whole";  ///< what of the object; the kinds of scene name theirs
  std::vector<std::string> hide;  ///< organs left out
  int width_px = 640, height_px = 640;
  double azimuth_deg = 270;  ///< where the camera stands, counter-clockwise from +x, 0..360
  double elevation_deg = 8;  ///< of the camera above the horizon, -89..89.9
  double fov_deg = 20;       ///< horizontal, 1..120
  double margin = 0.07;      ///< share of the picture kept free at each edge, 0..0.45
  double pitch_deg = 0;   ///< the object turned about y before it is set down: 90 = lying along x, -180..180
  double yaw_deg = 0;     ///< then turned about the vertical, -360..360
  double gap = 0.15;      ///< between objects side by side, in widths of the object, 0..5
  double zoom = 1;        ///< > 1: nearer, about the middle (details), 0.1..50
  double raise = 0;       ///< middle of the picture above the object's middle, in heights of it, -1..1
  double aperture_m = 0;  ///< depth of field, 0 = all sharp, 0..0.2
  std::string backdrop = "paper";                        ///< "paper", "dark", "sky"
  double key_azimuth_deg = 230, key_elevation_deg = 45;  ///< direction of the key light, 0..360, 5..90
  double key_size = 0.9;                                 ///< of the softbox over the object's size, 0.05..4
  double fill = 0.5, rim = 0.5;  ///< light of the room, from behind, over that of the key light, 0..4
  double exposure = 1;           ///< 0.05..20
};

}  // namespace witherfield
