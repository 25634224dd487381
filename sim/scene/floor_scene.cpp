#include <algorithm>
#include <filesystem>

#include "sim/scene/floor_keys.hpp"
#include "sim/scene/key_writers.hpp"
#include "sim/scene/kinds.hpp"
#include "sim/scene/resolved.hpp"
#include "sim/scene/toml_reader.hpp"

namespace witherfield::scene {
namespace {

constexpr std::int64_t kPreviewVisits = 400;
constexpr double kPreviewPixelsPerM = 50;
constexpr int kPreviewPx = 240;

void shrink_to_preview(FloorScene& s) {
  floor::FloorOptions& o = s.floor;
  if (o.crowd.visits > kPreviewVisits && s.walk.footprint_files.empty()) {  // kept footprints cost no walking
    o.crowd.visits_each *= double(o.crowd.visits) / double(kPreviewVisits);
    o.crowd.visits = kPreviewVisits;
  }
  o.footprints.pixels_per_m = std::min(o.footprints.pixels_per_m, kPreviewPixelsPerM);
  o.footprints.mask_size = 0;
  for (RoomStill& still : s.stills) {
    const double factor =
        std::min(1.0, double(kPreviewPx) / std::max(still.still.width_px, still.still.height_px));
    still.still.width_px = std::max(16, int(still.still.width_px * factor));
    still.still.height_px = std::max(16, int(still.still.height_px * factor));
  }
}

FloorScene read_scene(const TomlFile& file) {
  FloorTables blank, tables;
  file.read([&](KeyVisitor& v) { describe_floor_scene(v, tables); },
            key_paths([&](KeyVisitor& v) { describe_floor_scene(v, blank); }));
  return std::move(tables.scene);
}

FloorTables tables_of(const FloorScene& scene) {
  FloorTables tables;
  tables.scene = scene;
  if (!scene.floor.frames.empty()) tables.view.visits_share = scene.floor.frames.back();
  return tables;
}

}  // namespace

FloorScene load_floor_scene(const std::string& path, bool preview, const std::vector<std::string>& footprints) {
  expect_kind(path, "floor");
  FloorScene scene = read_scene(TomlFile(path));
  const std::filesystem::path place(path);
  if (scene.name.empty()) scene.name = place.stem().string();
  for (std::vector<std::string>* files : {&scene.mask_files, &scene.walk.footprint_files, &scene.walk.track_files})
    for (std::string& file : *files) file = resolved_path(file, place.parent_path());
  scene.walk.footprint_files.insert(scene.walk.footprint_files.end(), footprints.begin(), footprints.end());
  if (preview) shrink_to_preview(scene);
  return scene;
}

std::string floor_defaults() {
  FloorTables example;
  FloorScene& s = example.scene;
  s.name = "my_floor";
  s.floor.room.outline_m = {{0, 0}, {6, 0}, {6, 5}, {0, 5}};
  s.floor.room.doors.push_back({"door", {2.5, 0}, {3.5, 0}, 1});
  s.floor.room.obstacles.resize(1);
  s.floor.room.places.resize(1);
  s.floor.room.pictures.resize(1);
  s.windows.resize(1);
  s.stills.resize(1);
  s.stills[0].still.name = "worn";
  return commented_toml([&](KeyVisitor& v) { describe_floor_scene(v, example); });
}

std::string resolved_json(const FloorScene& scene) {
  FloorTables tables = tables_of(scene);
  return values_json([&](KeyVisitor& v) { describe_floor_scene(v, tables); }, {"view"});
}

std::string resolved_toml(const FloorScene& scene) {
  FloorTables tables = tables_of(scene);
  return values_toml([&](KeyVisitor& v) { describe_floor_scene(v, tables); });
}

FloorScene floor_scene_from_text(const std::string& toml, const std::string& source) {
  return read_scene(TomlFile(toml, source));
}

std::string with_line(const std::string& path, const std::string& message) {
  const std::string key = message.substr(0, message.find_first_of(" :"));
  if (key.find('.') == std::string::npos || message.rfind(path, 0) == 0) return message;
  const int line = TomlFile(path).line_of(key);
  return line > 0 ? path + ":" + std::to_string(line) + ": " + message : path + ": " + message;
}

FloorScene floor_scene_of(const std::string& json, const std::string& what) {
  return read_scene(TomlFile::from_json(json, what));
}

}  // namespace witherfield::scene
