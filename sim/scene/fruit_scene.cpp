#include <algorithm>
#include <filesystem>

#include "sim/core/errors.hpp"
#include "sim/scene/fruit_keys.hpp"
#include "sim/scene/key_writers.hpp"
#include "sim/scene/kinds.hpp"
#include "sim/scene/object_keys.hpp"
#include "sim/scene/toml_reader.hpp"

namespace witherfield::scene {
namespace {

constexpr int kPreviewSpikelets = 10, kPreviewRows = 12, kPreviewPerRow = 16, kPreviewGrains = 60;

void shrink_to_preview(FruitScene& s) {
  fruit::FruitOptions& o = s.fruit;
  o.steps = std::min(o.steps, 1);
  if (o.wheat.spikelets > kPreviewSpikelets) {
    o.wheat.ear_length_mm = std::max(20.0, o.wheat.ear_length_mm * kPreviewSpikelets / o.wheat.spikelets);
    o.wheat.spikelets = kPreviewSpikelets;
  }
  o.maize.rows = std::min(o.maize.rows, kPreviewRows);
  if (o.maize.kernels_per_row > kPreviewPerRow) {
    o.maize.ear_length_mm = std::max(60.0, o.maize.ear_length_mm * kPreviewPerRow / o.maize.kernels_per_row);
    o.maize.kernels_per_row = kPreviewPerRow;
  }
  o.planted.grains = std::min(o.planted.grains, kPreviewGrains);
  shrink_stills(s.stills);
}

}  // namespace

FruitScene load_fruit_scene(const std::string& path, bool preview) {
  expect_kind(path, "fruit");
  const TomlFile file(path);
  FruitTables blank, tables;
  tables.scene.fruit = fruit::crop_preset(tables.scene.fruit.crop);
  file.read([&](KeyVisitor& v) { describe_fruit_scene(v, tables); },
            key_paths([&](KeyVisitor& v) { describe_fruit_scene(v, blank); }));
  FruitScene& scene = tables.scene;
  const std::filesystem::path place(path);
  if (scene.name.empty()) scene.name = place.stem().string();
  scene.mesh_file = resolved_path(scene.mesh_file, place.parent_path());
  if (preview) shrink_to_preview(scene);
  return scene;
}

std::string fruit_defaults() {
  FruitTables example;
  example.scene.name = "my_fruit";
  example.scene.stills.resize(1);
  example.scene.stills[0].name = "front";
  return commented_toml([&](KeyVisitor& v) { describe_fruit_scene(v, example); });
}

std::string resolved_json(const FruitScene& scene) {
  FruitTables tables;
  tables.scene = scene;
  return values_json([&](KeyVisitor& v) { describe_fruit_scene(v, tables); }, {"view"});
}

}  // namespace witherfield::scene
