#include "cli/floor_pictures.hpp"

#include <fmt/format.h>

#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

pov::FloorMaterial material_of(const floor::MaterialOptions& m) {
  const std::string top = m.layers.empty() ? "" : m.layers.front().name;
  const auto has = [&](const char* word) { return top.find(word) != std::string::npos; };
  if (has("varnish")) return pov::FloorMaterial::wood_varnished;
  if (has("oak") || has("pine") || has("wood")) return pov::FloorMaterial::wood;
  if (has("pvc") || has("linoleum")) return pov::FloorMaterial::vinyl;
  if (has("porcelain") || has("tile")) return pov::FloorMaterial::tiles;
  return pov::FloorMaterial::stone;
}

pov::ObstacleKind obstacle_of(const std::string& name) {
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (has("column") || has("pillar")) return pov::ObstacleKind::column;
  if (has("cupboard") || has("cabinet") || has("shelf") || has("box")) return pov::ObstacleKind::cabinet;
  return has("bench") ? pov::ObstacleKind::bench : pov::ObstacleKind::desk;
}

pov::FloorLook floor_look(const scene::FloorScene& scene, const scene::RoomStill& still) {
  pov::FloorLook look;
  look.material = material_of(scene.floor.material);
  look.pattern = scene.floor.material.pattern;
  look.relief_scale = still.relief_scale;
  return look;
}

}  // namespace

pov::RoomSceneInput room_input(const scene::FloorScene& scene, const scene::RoomStill& still,
                               const FloorField& floor) {
  const floor::RoomOptions& r = scene.floor.room;
  pov::RoomSceneInput in;
  in.still = still.still;
  in.floor = &floor;
  in.look = floor_look(scene, still);
  in.outline_m = r.outline_m;
  in.wall_height_m = scene.wall_height_m;
  in.haze = still.haze;
  for (const floor::Door& d : r.doors)
    in.openings.push_back({pov::OpeningKind::door, d.a_m, d.b_m, 0, 2.03});
  for (const scene::RoomWindow& w : scene.windows)
    in.openings.push_back({pov::OpeningKind::window, w.a_m, w.b_m, w.sill_m, w.height_m});
  const double day = still.visits_share * scene.floor.crowd.days;
  for (std::size_t i = 0; i < r.obstacles.size(); ++i)
    if (r.obstacles[i].from_day <= day && day <= r.obstacles[i].until_day)
      in.obstacles.push_back(
          {obstacle_of(r.obstacles[i].name), r.obstacles[i].outline_m, scene.obstacle_height_m.at(i)});
  for (const floor::Place& p : r.places)
    if (p.from_day <= day && day <= p.until_day && (p.name.find("chair") != std::string::npos || p.name.find("seat") != std::string::npos))
      in.seats.push_back({p.at_m, p.facing_deg});
  for (const floor::Picture& p : r.pictures) in.pictures.push_back({p.at_m});
  return in;
}

pov::StairSceneInput stair_input(const scene::FloorScene& scene, const scene::RoomStill& still,
                                 std::vector<FloorField> treads) {
  const floor::StairOptions& s = *scene.floor.stairs;
  pov::StairSceneInput in;
  in.still = still.still;
  in.treads = std::move(treads);
  in.look.relief_scale = still.relief_scale;
  in.look.material = material_of(scene.floor.material);
  in.going_m = s.going_m;
  in.rise_m = s.rise_m;
  in.width_m = s.width_m;
  in.wall_height_m = scene.wall_height_m;
  return in;
}

FloorField in_plan(std::span<const FloorField> floors) {
  FloorField whole = floors.front();
  for (const FloorField& tread : floors.subspan(1)) {
    whole.ny += tread.ny;
    for (FloorChannel& channel : whole.channels) {
      const std::vector<float>& more = tread.at(channel.name);
      channel.values.insert(channel.values.end(), more.begin(), more.end());
    }
  }
  return whole;
}

std::vector<FloorField> treads_of(const FloorField& plan, int treads, double going_m) {
  if (treads < 1 || plan.ny % treads != 0)
    throw IoFailure(fmt::format("{} rows of cells do not divide into {} treads", plan.ny, treads));
  std::vector<FloorField> out;
  for (int k = 0; k < treads; ++k) {
    FloorField& tread = out.emplace_back(plan.nx, plan.ny / treads, plan.origin_m + glm::dvec2(0, k * going_m), plan.spacing_m);
    for (const FloorChannel& channel : plan.channels) {
      const std::size_t size = channel.values.size() / std::size_t(treads);
      const auto first = channel.values.begin() + std::ptrdiff_t(size * std::size_t(k));
      tread.make(channel.name).assign(first, first + std::ptrdiff_t(size));
    }
  }
  return out;
}

}  // namespace witherfield::cli
