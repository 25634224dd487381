#include "cli/grass_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/console.hpp"
#include "cli/frame_store.hpp"
#include "cli/frame_writer.hpp"
#include "cli/hill.hpp"
#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"
#include "pov/blade_mesh.hpp"
#include "pov/scene_writer.hpp"
#include "sim/check/surface_check.hpp"
#include "sim/core/parallel.hpp"
#include "sim/scene/scene.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

constexpr double kDensityErrorLimit = 1e-6;  // relative; float storage of the voxels
constexpr double kRootShiftLimit_m = 1e-9;

void tell_terrain(RunRecord& run, const check::MeshReport& m) {
  const Json j{{"faces", m.faces},
               {"area_m2", m.area_m2},
               {"manifold", m.manifold},
               {"components", m.components},
               {"border_loops", m.border_loops},
               {"degenerate_faces", m.degenerate_faces},
               {"faces_down", m.faces_down},
               {"self_intersections_checked", m.self_intersections_checked},
               {"self_intersections", m.self_intersections}};
  run.details.emplace_back("terrain_mesh", j.dump());
  run.checks.push_back({"terrain_faces_down", double(m.faces_down), 0, "faces"});
  run.checks.push_back({"terrain_degenerate_faces", double(m.degenerate_faces), 0, "faces"});
  run.checks.push_back({"terrain_self_intersections", double(m.self_intersections), 0, "pairs"});
}

void tell_simulation(RunRecord& run, const grass::GrassReport& r) {
  run.checks.push_back({"density_error_relative", r.density_error_max, kDensityErrorLimit, ""});
  run.checks.push_back({"root_shift", r.root_shift_max_m, kRootShiftLimit_m, "m"});
  run.checks.push_back({"not_finite", r.all_finite ? 0.0 : 1.0, 0.0, ""});
  Json stages = Json::array();  // parts of "simulate and write"
  for (const auto& s : r.stages) stages.push_back({{"name", s.name}, {"seconds", s.seconds}});
  run.details.emplace_back("simulation_stages", stages.dump());
  run.details.emplace_back("blades", Json(r.blades).dump());
  run.details.emplace_back(
      "points", Json{{"first", r.points_first}, {"last", r.points_last}, {"merges", r.merges}}.dump());
}

/// The blades as meshes, as the pictures and blades/*.vtp have them: what was found over all of them.
struct BladeFindings {
  std::size_t meshes = 0, shells = 0, faces = 0, not_manifold = 0, degenerate = 0, self_intersections = 0;

  void look_at(const BladeRibbons& blades) {
    const check::MeshReport r = check::check_surface(pov::blade_surface(blades, {}));
    ++meshes;
    shells += r.components;
    faces += r.faces;
    not_manifold += r.non_manifold_edges + r.non_manifold_vertices + r.clashing_edges;
    degenerate += r.degenerate_faces + r.duplicate_faces + r.non_finite_vertices;
    self_intersections += r.self_intersections;  // of a blade with itself; blades do touch one another
  }
  void tell(RunRecord& run) const {
    if (!meshes) return;
    const Json j{{"meshes", meshes}, {"blades", shells}, {"faces", faces}, {"self_intersections", self_intersections}};
    run.details.emplace_back("blade_meshes", j.dump());
    run.checks.push_back({"blades_not_manifold", double(not_manifold), 0, "edges and vertices"});
    run.checks.push_back({"blades_degenerate_faces", double(degenerate), 0, "faces"});
  }
};

/// The stages of one run, in order. See RunStages.
class GrassRun : public RunStages {
 public:
  GrassRun(scene::GrassScene scene, RunFolder& folder, RunRecord& record, Console& console)
      : scene_(std::move(scene)),
        folder_(folder),
        record_(record),
        console_(console),
        clock_(record.stages) {}

  /// Everything that can be wrong with the input shows here, before anything is written.
  void prepare() override {
    if (!scene_.terrain) return;
    clock_.start("terrain and placement");
    console_.note("terrain " + (scene_.terrain->dem.empty() ? scene_.terrain->mesh : scene_.terrain->dem));
    hill_.emplace(make_hill(scene_));
    tell_terrain(record_, hill_->report);
    clock_.start("");
  }

  void simulate(std::vector<FrameRecord> whole) override {
    clock_.start("simulate and write");
    if (scene_.output.pov)
      for (std::size_t i = 0; i < scene_.stills.size(); ++i) want_frames(i);
    FrameWriter writer(folder_, scene_, std::move(whole));
    const Progress bar = console_.progress();
    BladeFindings blades;
    const grass::GrassReport report = grass::simulate_grass(
        scene_.grass,
        [&](const grass::GrassFrame& frame) {
          check_interrupted();
          writer.write(frame);
          record_.frames = writer.frames();
          store_.take(frame);
          if (scene_.output.blades || store_.wants_blades(frame.wd)) blades.look_at(*frame.blades);
        },
        [&](std::string_view stage, double fraction) { bar(stage, fraction); });
    tell_simulation(record_, report);
    blades.tell(record_);
    writer.write_series();
    clock_.start("");
  }

  void write_pictures() override {
    if (hill_) write_hill(folder_, *hill_);
    if (!scene_.output.pov || scene_.stills.empty()) return;
    clock_.start("write POV-Ray scenes");
    for (std::size_t i = 0; i < scene_.stills.size(); ++i) {
      check_interrupted();
      write_still(i);
    }
    clock_.start("");
  }

 private:
  void want_frames(std::size_t i) {
    int finest = hill_ ? 3 : 0;
    if (hill_)
      for (const TexelInstance& t : hill_->placements[i].instances) finest = std::min(finest, t.lod);
    const Still& still = scene_.stills[i];
    const bool blades = std::find(still.looks.begin(), still.looks.end(), "blades") != still.looks.end();
    store_.want(still.wd, finest, blades);
  }

  void write_still(std::size_t i) {
    const Still& still = scene_.stills[i];
    pov::SceneInput input;
    input.still = still;
    input.variants = store_.frames(still.wd, scene_.grass.variants);
    input.tile_m = scene_.grass.texel.size_m;
    if (hill_) {
      input.placement = &hill_->placements[i];
      input.ground = &hill_->mesh;
    }
    const Progress bar = console_.progress();
    const std::string stage = "scene " + still.name;
    const std::vector<fs::path> written = pov::write_scenes(
        folder_.path() / "pov", input, [&](std::string_view, double fraction) { bar(stage, fraction); });
    bar(stage, 1);
    StillRecord record{still, {}};
    for (const std::string& look : still.looks)
      for (const fs::path& file : written)
        if (file.stem() == still.name + "_" + look)
          record.scenes.emplace_back(look, file.lexically_relative(folder_.path()).generic_string());
    record_.stills.push_back(std::move(record));
  }

  scene::GrassScene scene_;
  RunFolder& folder_;
  RunRecord& record_;
  Console& console_;
  StageClock clock_;
  std::optional<Hill> hill_;
  FrameStore store_;
};

}  // namespace

void run_grass(const RunRequest& request, Console& console) {
  scene::GrassScene scene = scene::load_grass_scene(request.scene, request.preview);
  const std::string name = scene.name, json = scene::resolved_json(scene);
  carry_out(request, "grass", name, json, console, [&](RunFolder& folder, RunRecord& record) {
    return std::make_unique<GrassRun>(std::move(scene), folder, record, console);
  });
}

}  // namespace witherfield::cli
