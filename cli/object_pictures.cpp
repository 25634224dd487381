#include "cli/object_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/console.hpp"

namespace witherfield::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Camera camera_of(const ObjectStill& still, std::span<const pov::ObjectPlacement> objects) {
  Camera camera = pov::frame_objects(objects, still.azimuth_deg, still.elevation_deg, still.fov_deg,
                                     double(still.width_px) / still.height_px, still.margin);
  const pov::Bounds box = pov::bounds_of(objects);
  const double lift = still.raise * (box.high.z - box.low.z);
  camera.position_m.z += lift;
  camera.look_at_m.z += lift;
  camera.fov_deg = 2 * std::atan(std::tan(camera.fov_deg * kDegree / 2) / still.zoom) / kDegree;
  camera.aperture_m = still.aperture_m;
  return camera;
}

pov::Backdrop backdrop_of(const std::string& name) {
  return name == "dark" ? pov::Backdrop::dark : name == "sky" ? pov::Backdrop::sky : pov::Backdrop::paper;
}

pov::ObjectSceneInput scene_of(const ObjectStill& still, const std::vector<Surface>& surfaces,
                               const ObjectLooks& looks) {
  pov::ObjectSceneInput input;
  for (const Surface& surface : surfaces) {
    pov::ObjectPlacement& object = input.objects.emplace_back();
    object.surface = &surface;
    object.pitch_deg = still.pitch_deg;
    object.yaw_deg = still.yaw_deg;
    object.facets = still.subject == "subdivision";  // a mesh shows as what it is
    object.looks = looks.by_organ;
    object.other_look = looks.other;
  }
  double widest = 0;
  for (const pov::ObjectPlacement& object : input.objects) {
    const pov::Bounds box = pov::bounds_of({&object, 1});
    widest = std::max(widest, box.high.x - box.low.x);
  }
  pov::stand_in_row(input.objects, still.gap * widest, looks.common_ground);
  input.still.name = still.name;
  input.still.width_px = still.width_px;
  input.still.height_px = still.height_px;
  input.still.exposure = still.exposure;
  input.still.camera = camera_of(still, input.objects);
  input.still.sun.azimuth_deg = still.key_azimuth_deg;
  input.still.sun.elevation_deg = still.key_elevation_deg;
  input.still.looks = {"object"};
  input.backdrop = backdrop_of(still.backdrop);
  input.key_size = still.key_size;
  input.fill = still.fill;
  input.rim = still.rim;
  return input;
}

}  // namespace

void write_object_stills(const RunFolder& folder, RunRecord& record, const std::vector<ObjectStill>& stills,
                         const ObjectLooks& looks, const ObjectsOf& objects_of, Console& console) {
  const Progress bar = console.progress();
  for (const ObjectStill& still : stills) {
    check_interrupted();
    const std::vector<Surface> surfaces = objects_of(still);
    pov::ObjectSceneInput input = scene_of(still, surfaces, looks);
    const std::string stage = "scene " + still.name;
    const std::filesystem::path file = pov::write_object_scene(
        folder.path() / "pov", input, [&](std::string_view, double fraction) { bar(stage, fraction); });
    bar(stage, 1);
    input.still.wd = still.wd.back();
    record.stills.push_back(
        {input.still, {{"object", file.lexically_relative(folder.path()).generic_string()}}});
  }
}

}  // namespace witherfield::cli
