#include "cli/edit_save.hpp"

#include "cli/leaf_input.hpp"
#include "sim/scene/edited_scene.hpp"
#include "vis/atomic_file.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {

namespace fs = std::filesystem;

constexpr const char* kSuffix = "_edited";

fs::path edited_name(const fs::path& scene_file) {
  const std::string stem = scene_file.stem().string();
  if (stem.ends_with(kSuffix)) return scene_file;
  return scene_file.parent_path() / (stem + kSuffix + ".toml");
}

std::vector<fs::path> save_edit(const EditSession& session, const scene::LeafScene& scene, const fs::path& scene_file,
                                const std::string& toml, const fs::path& target) {
  const fs::path folder = fs::absolute(target).parent_path(), stem = target.parent_path() / target.stem();
  const bool moves = fs::weakly_canonical(folder) != fs::weakly_canonical(fs::absolute(scene_file).parent_path());
  const auto named = [&](const char* ending) { return fs::path(stem.string() + ending); };
  std::vector<fs::path> written;
  scene::SceneEdit edit;
  edit.edit = session.edit();
  if (session.points_changed()) {
    written.push_back(named("_points.csv"));
    vis::write_whole_file(written.back(), leaf::outline_csv(session.points()));
    edit.points_file = written.back().filename().string();
  }
  // Files that the scene names are named from its folder.
  const auto from_here = [&](const std::string& file) {
    return fs::proximate(fs::weakly_canonical(fs::absolute(file)), fs::weakly_canonical(folder)).generic_string();
  };
  if (moves && !edit.points_file && !scene.leaf.points_file.empty()) {
    edit.points_file = from_here(scene.leaf.points_file);
    edit.points_unit = scene.points_unit;
  }
  if (moves && !scene.leaf.mesh_file.empty()) edit.mesh_file = from_here(scene.leaf.mesh_file);
  // A scene that states its name would run into the folder of the scene it was made of.
  if (scene.name != scene_file.stem().string() && target != scene_file && !scene.name.ends_with(kSuffix))
    edit.name = scene.name + kSuffix;

  const Surface leaf = whole_leaf(session.model(), session.positions());
  written.push_back(named(".obj"));
  vis::write_obj(written.back(), leaf);
  written.push_back(named(".vtp"));
  vis::write_surface_vtp(written.back(), leaf, {0, 0});
  written.push_back(target);
  vis::write_whole_file(target, scene::with_edit(toml, edit));
  return written;
}

}  // namespace witherfield::cli
