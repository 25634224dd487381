// Studio photographs of surfaces: a fruit or a leaf on seamless paper, lit by a large soft key light, the room and a
// rim light. The surface's `diffuse` field is the reflectance of every vertex; looks add gloss, fine relief and the
// softness of tissue that light enters.
#pragma once
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include "sim/core/progress.hpp"
#include "sim/core/surface.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

enum class LookKind {
  matte,  ///< the bare reflectance
  grain,  ///< wheat: matt husk with fine streaks along the surface's own z axis and a silky sheen
  waxy,   ///< maize kernels: a clear skin that mirrors the softbox, soft flesh below
  leaf,   ///< thin: front and back differ, light comes through
};

/// What of a leaf is finer than its mesh, over texture coordinates 0..1: pixels x pixels, rows from v = 0 upwards.
struct LeafDetail {
  int pixels = 0;
  std::vector<float> vein;    ///< 0 blade .. 1 middle of a main vein (side veins about 0.65, net about 0.26)
  std::vector<float> height;  ///< 0 at the veins .. 1 in the middle of the net's cells
};

struct ObjectLook {
  LookKind kind = LookKind::matte;
  double gloss = 1;     ///< factor on the kind's own sheen and mirror, 0..4
  double relief = 1;    ///< factor on the kind's own fine relief, 0..4; for leaves also the veins' height
  double softness = 1;  ///< factor on how far light wanders below the skin (waxy, grain), 0..4
  std::function<LeafDetail(int pixels)> detail;      ///< leaf: veins; without it the field `vein` raises them
  glm::vec3 vein_rgb{0.27f, 0.32f, 0.16f};           ///< leaf with detail: reflectance of the veins' tissue
};

/// One surface in the studio. world = position_m + scale * Rz(yaw) Ry(pitch) Rx(roll) * local.
struct ObjectPlacement {
  const Surface* surface = nullptr;  ///< needs the vertex field `diffuse`
  glm::dvec3 position_m{0.0};
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  double scale = 1;     ///< > 0
  bool facets = false;  ///< every face flat, as a control mesh is shown: normals are not used
  std::map<int, ObjectLook> looks;   ///< by `organ_id` (a field of faces or vertices; without it all is organ 0)
  ObjectLook other_look;             ///< of organs that `looks` does not name

  glm::dvec3 world(const glm::dvec3& local) const;
};

enum class Backdrop {
  paper,  ///< light grey paper that sweeps up behind the objects
  dark,   ///< black velvet
  sky,    ///< nothing but a bright, blurred sky: for leaves against the light
};

struct ObjectSceneInput {
  Still still;  ///< name, size, camera, exposure; `sun` is the key light's direction (turbidity is not used)
  Backdrop backdrop = Backdrop::paper;
  double key_size = 0.9;            ///< side of the softbox over the objects' diameter, 0.05 (hard) .. 4
  double fill = 0.5;                ///< light of the room over that of the key light, 0..4
  double rim = 0.5;                 ///< light from behind over that of the key light, 0..4
  double ground_gap_m = 0;          ///< the paper lies this far below the lowest point, >= 0
  std::vector<ObjectPlacement> objects;
};

/// Writes <still.name>_object.pov, its mesh2 includes and pictures of colour below `folder`.
/// @throws InvalidInput naming the object and what is wrong (no surface, missing `diffuse`, value out of range),
/// IoFailure.
std::filesystem::path write_object_scene(const std::filesystem::path& folder, const ObjectSceneInput& input,
                                         const Progress& progress = {});

/// Lower and upper corner of the box around all vertices in the world. @throws InvalidInput when there are none.
struct Bounds {
  glm::dvec3 low{0.0}, high{0.0};
};
Bounds bounds_of(std::span<const ObjectPlacement> objects);

/// The nearest camera from that side that sees every vertex inside the picture less its margin; sharp at the
/// middle of the objects' depth.
/// @param azimuth_deg where the camera stands seen from the objects, counter-clockwise from +x;
/// @param elevation_deg above the horizon, -89..89.9 (89.9: from above, with the far side at the top);
/// @param fov_deg horizontal, 1..120; @param aspect width over height; @param margin share of the picture kept free
/// at each edge, 0..0.45.
Camera frame_objects(std::span<const ObjectPlacement> objects, double azimuth_deg, double elevation_deg,
                     double fov_deg, double aspect, double margin = 0.06);

/// Moves the objects so that their boxes stand in a row along +x with `gap_m` between, their lowest points on
/// z = 0 (common_ground: the lowest of all; heights of one object over another are kept) and the middles of their
/// depth on y = 0.
void stand_in_row(std::span<ObjectPlacement> objects, double gap_m, bool common_ground = false);

}  // namespace witherfield::pov
