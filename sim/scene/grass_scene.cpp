#include <filesystem>

#include "sim/core/errors.hpp"
#include "sim/scene/key_writers.hpp"
#include "sim/scene/kinds.hpp"
#include "sim/scene/scene.hpp"
#include "sim/scene/scene_keys.hpp"
#include "sim/scene/toml_reader.hpp"

namespace witherfield::scene {
namespace {

std::vector<std::string> all_keys() {
  SceneTables blank;
  return key_paths([&](KeyVisitor& v) { describe_scene(v, blank); });
}

}  // namespace

SceneTables to_tables(const GrassScene& scene) {
  SceneTables t;
  t.kind = scene.kind;
  t.name = scene.name;
  t.seed = scene.grass.seed;
  t.grass = scene.grass;
  if (!scene.grass.samples.empty()) t.blades = scene.grass.samples.front().blades;
  if (scene.grass.samples.size() > 1 ||
      (!scene.grass.samples.empty() && !scene.grass.samples.front().ageing.empty()))
    t.mingle = scene.grass.samples;
  if (scene.terrain) t.terrain = TerrainTable{*scene.terrain, scene.placement};
  t.stills = scene.stills;
  t.output = scene.output;
  return t;
}

GrassScene to_scene(const SceneTables& t) {
  GrassScene scene;
  scene.kind = t.kind;
  scene.name = t.name;
  scene.grass = t.grass;
  scene.grass.seed = t.seed;
  scene.grass.samples = t.mingle;
  if (t.mingle.empty()) scene.grass.samples = {{t.blades, t.grass.season, {}}};
  if (t.terrain) {
    scene.terrain = t.terrain->terrain;
    scene.placement = t.terrain->placement;
  }
  scene.placement.variants = t.grass.variants;
  scene.placement.seed = t.seed;
  scene.stills = t.stills;
  scene.output = t.output;
  return scene;
}

GrassScene load_grass_scene(const std::string& path, bool preview) {
  expect_kind(path, "grass");
  const TomlFile file(path);
  SceneTables tables;
  file.read([&](KeyVisitor& v) { describe_scene(v, tables); }, all_keys());
  if (tables.name.empty()) tables.name = std::filesystem::path(path).stem().string();
  if (tables.terrain) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    tables.terrain->terrain.dem = resolved_path(tables.terrain->terrain.dem, folder);
    tables.terrain->terrain.mesh = resolved_path(tables.terrain->terrain.mesh, folder);
  }
  GrassScene scene = to_scene(tables);
  if (preview) shrink_to_preview(scene);
  try {
    grass::validate(scene.grass);
  } catch (const InvalidInput& e) {
    throw InvalidInput(path + ": " + e.what());
  }
  return scene;
}

std::string grass_defaults() {
  // One entry of each table that may be left out or repeated, as an example; they are printed commented out.
  SceneTables example;
  example.name = "my_scene";
  example.mingle.resize(1);
  example.terrain.emplace();
  example.terrain->terrain.dem = "hill.tif";
  example.terrain->terrain.width_m = example.terrain->placement.cells_x * example.grass.texel.size_m;
  example.stills.resize(1);
  example.stills[0].name = "wd_030";
  example.stills[0].wd = 0.3;
  return commented_toml([&](KeyVisitor& v) { describe_scene(v, example); });
}

std::string resolved_json(const GrassScene& scene) {
  SceneTables tables = to_tables(scene);
  std::vector<std::string> leave_out{"view"};  // every still is spelled out
  leave_out.push_back(tables.mingle.empty() ? "mingle" : "blades");
  return values_json([&](KeyVisitor& v) { describe_scene(v, tables); }, leave_out);
}

}  // namespace witherfield::scene
