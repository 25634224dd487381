#include <algorithm>
#include <filesystem>

#include "sim/scene/key_writers.hpp"
#include "sim/scene/kinds.hpp"
#include "sim/scene/leaf_keys.hpp"
#include "sim/scene/object_keys.hpp"
#include "sim/scene/toml_reader.hpp"

namespace witherfield::scene {
namespace {

constexpr double kPreviewEdge_m = 0.006;
constexpr int kPreviewFrames = 3;

void shrink_to_preview(LeafScene& s) {
  leaf::LeafOptions& o = s.leaf;
  o.mesh.edge_m = std::max(o.mesh.edge_m, kPreviewEdge_m);
  o.mesh.vein_edge_m = std::max(o.mesh.vein_edge_m, kPreviewEdge_m / 2);
  o.mesh.outline_spacing_m = std::max(o.mesh.outline_spacing_m, kPreviewEdge_m / 2);
  o.wilt.frames = std::min(o.wilt.frames, kPreviewFrames);
  o.wilt.frame_hours.clear();
  shrink_stills(s.stills);
}

}  // namespace

LeafScene load_leaf_scene(const std::string& path, bool preview) {
  expect_kind(path, "leaf");
  const TomlFile file(path);
  LeafTables blank, tables;
  file.read([&](KeyVisitor& v) { describe_leaf_scene(v, tables); },
            key_paths([&](KeyVisitor& v) { describe_leaf_scene(v, blank); }));
  LeafScene& scene = tables.scene;
  const std::filesystem::path place(path);
  if (scene.name.empty()) scene.name = place.stem().string();
  scene.leaf.points_file = resolved_path(scene.leaf.points_file, place.parent_path());
  scene.leaf.mesh_file = resolved_path(scene.leaf.mesh_file, place.parent_path());
  if (preview) shrink_to_preview(scene);
  return scene;
}

std::string leaf_defaults() {
  LeafTables example;
  example.scene.name = "my_leaf";
  example.scene.leaf.edit.handles.resize(1);
  example.scene.leaf.edit.keys.resize(1);
  example.scene.leaf.edit.keys[0].move_m.resize(1);
  example.scene.stills.resize(1);
  example.scene.stills[0].name = "above";
  return commented_toml([&](KeyVisitor& v) { describe_leaf_scene(v, example); });
}

std::string resolved_json(const LeafScene& scene) {
  LeafTables tables;
  tables.scene = scene;
  return values_json([&](KeyVisitor& v) { describe_leaf_scene(v, tables); }, {"view"});
}

}  // namespace witherfield::scene
