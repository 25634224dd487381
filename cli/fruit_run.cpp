#include "cli/fruit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/console.hpp"
#include "cli/object_pictures.hpp"
#include "cli/object_writer.hpp"
#include "sim/check/mesh_check.hpp"
#include "sim/core/errors.hpp"
#include "sim/fruit/simulate.hpp"
#include "sim/scene/scene.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {
namespace {

using Json = nlohmann::ordered_json;
using fruit::OrganKind;

constexpr int kSubdivisionSteps = 2;  // that the picture of the subdivision shows

ObjectLooks looks_of(const std::string& crop) {
  using pov::LookKind;
  ObjectLooks looks;
  const bool wheat = crop == "wheat";
  looks.other.kind = wheat ? LookKind::grain : LookKind::matte;
  pov::ObjectLook& kernel = looks.by_organ[int(OrganKind::kernel)];
  kernel.kind = wheat ? LookKind::grain : LookKind::waxy;
  if (crop == "planted") {  // berries: a downy skin over juicy flesh
    kernel.gloss = 0.25;
    kernel.softness = 1.5;
  }
  looks.by_organ[int(OrganKind::user_mesh)].kind = LookKind::waxy;
  return looks;
}

/// The user's own control mesh, in metres, with the tags of the scene file.
void load_control_mesh(scene::FruitScene& s) {
  const vis::MeshFile file = vis::read_mesh_file(s.mesh_file);
  const int n = int(file.surface.position_m.size());
  const auto known = [&](const char* key, int vertex) {
    if (vertex >= n)
      throw InvalidInput(fmt::format("{} names vertex {}, but '{}' has {} vertices, numbered from 0", key,
                                     vertex, s.mesh_file, n));
  };
  fruit::ControlMesh& mesh = s.fruit.mesh;
  for (const glm::dvec3& p : file.surface.position_m)
    mesh.position_m.push_back(file.length_unit.empty() ? p * (s.mesh_unit_mm * 1e-3) : p);
  mesh.triangles = file.surface.triangles;
  for (const auto& [a, b] : s.mesh_creases) {
    for (const int v : {a, b}) known("mesh_creases", v);
    mesh.crease_edges.push_back({a, b});
  }
  for (const int v : s.mesh_sharp) known("mesh_sharp", v);
  mesh.sharp_vertices = s.mesh_sharp;
  s.fruit.mesh_uv = file.surface.uv;
}

void check_shells(const fruit::FruitOptions& options, RunRecord& record) {
  std::size_t shells = 0, open = 0, inside_out = 0, degenerate = 0, crossing = 0;
  for (const double wd : {options.frames.front(), options.frames.back()}) {
    for (const fruit::Shell& shell : fruit::shells(options, wd)) {
      check_interrupted();
      const check::MeshReport r = check::check_mesh(to_tri_mesh(shell.surface, true));
      ++shells;
      open += !r.closed || !r.manifold;
      inside_out += !r.oriented_outward;
      degenerate += r.degenerate_faces > 0;
      crossing += r.self_intersections > 0;
    }
    if (options.frames.size() == 1) break;
  }
  record.details.emplace_back("shells_checked", Json(shells).dump());
  if (options.crop == "mesh") return;  // the user's mesh may be open
  for (const auto& [name, count] : {std::pair{"shells_open", open},
                                    {"shells_inside_out", inside_out},
                                    {"shells_degenerate", degenerate},
                                    {"shells_self_intersecting", crossing}})
    record.checks.push_back({name, double(count), 0, "shells"});
}

class FruitRun : public RunStages {
 public:
  FruitRun(scene::FruitScene scene, RunFolder& folder, RunRecord& record, Console& console)
      : scene_(std::move(scene)),
        folder_(folder),
        record_(record),
        console_(console),
        clock_(record.stages) {}

  void prepare() override {
    if (!scene_.mesh_file.empty()) load_control_mesh(scene_);
    fruit::validate(scene_.fruit);
  }

  void simulate(std::vector<FrameRecord> whole) override {
    clock_.start("simulate and write");
    ObjectWriter writer(folder_, "fruit", scene_.output, std::move(whole));
    const Progress bar = console_.progress();
    const fruit::FruitReport report = fruit::simulate(
        scene_.fruit,
        [&](const fruit::FruitFrame& frame) {
          check_interrupted();
          FrameRecord r;
          r.index = frame.index;
          r.wd = frame.wd;
          r.time_days = frame.time_days;
          r.numbers = {{"vertices", double(frame.surface.position_m.size())},
                       {"triangles", double(frame.surface.triangles.size())}};
          writer.write(std::move(r), frame.surface, frame.wd == scene_.fruit.frames.back());
          record_.frames = writer.frames();
          if (is_shown(frame.wd)) kept_.emplace_back(frame.wd, frame.surface);
        },
        bar);
    bar("fruit", 1);
    writer.write_series();
    tell(report);
    clock_.start("check");
    console_.note("checking every shell");
    check_shells(scene_.fruit, record_);
    clock_.start("");
  }

  void write_pictures() override {
    if (!scene_.output.pov || scene_.stills.empty()) return;
    clock_.start("write POV-Ray scenes");
    write_object_stills(
        folder_, record_, scene_.stills, looks_of(scene_.fruit.crop),
        [&](const ObjectStill& still) { return objects_of(still); }, console_);
    clock_.start("");
  }

 private:
  bool is_shown(double wd) const {
    return scene_.output.pov &&
           std::any_of(scene_.stills.begin(), scene_.stills.end(), [&](const ObjectStill& s) {
             return std::any_of(s.wd.begin(), s.wd.end(), [&](double w) { return std::abs(w - wd) < 1e-9; });
           });
  }

  std::vector<Surface> objects_of(const ObjectStill& still) const {
    std::vector<Surface> objects;
    if (still.subject == "subdivision") {
      for (int step = 0; step <= kSubdivisionSteps; ++step)
        objects.push_back(fruit::kernel_step(scene_.fruit, step));
      return objects;
    }
    for (const double wd : still.wd)
      for (const auto& [at, surface] : kept_)
        if (std::abs(at - wd) < 1e-9) objects.push_back(without(surface, still.hide));
    return objects;
  }

  static Surface without(const Surface& surface, const std::vector<std::string>& organs) {
    if (organs.empty()) return surface;
    const SurfaceField& organ = surface.field("organ_id");
    return keep_faces(surface, [&](std::size_t face) {
      const std::size_t at = organ.on_faces ? face : std::size_t(surface.triangles[face][0]);
      const std::string name = fruit::organ_name(OrganKind(int(organ.values[at])));
      return std::find(organs.begin(), organs.end(), name) == organs.end();
    });
  }

  void tell(const fruit::FruitReport& r) {
    record_.details.emplace_back("spikelets", Json(r.spikelets).dump());
    record_.details.emplace_back("rows", Json(r.rows).dump());
    record_.details.emplace_back("kernels", Json(r.kernels).dump());
    record_.details.emplace_back("organs", Json(r.organs).dump());
    record_.details.emplace_back("kernel_overlap", Json(r.overlap).dump());
    Json frames = Json::array();
    for (const auto& f : r.frames)
      frames.push_back({{"wd", f.wd},
                        {"moisture_wb", f.moisture_wb},
                        {"kernel_volume_mm3", f.kernel_volume_mm3},
                        {"kernel_area_mm2", f.kernel_area_mm2},
                        {"size_m", {f.size_m.x, f.size_m.y, f.size_m.z}},
                        {"seconds", f.seconds}});
    record_.details.emplace_back("kernel_means", frames.dump());
  }

  scene::FruitScene scene_;
  RunFolder& folder_;
  RunRecord& record_;
  Console& console_;
  StageClock clock_;
  std::vector<std::pair<double, Surface>> kept_;
};

}  // namespace

void run_fruit(const RunRequest& request, Console& console) {
  scene::FruitScene scene = scene::load_fruit_scene(request.scene, request.preview);
  const std::string name = scene.name, json = scene::resolved_json(scene);
  carry_out(request, "fruit", name, json, console, [&](RunFolder& folder, RunRecord& record) {
    return std::make_unique<FruitRun>(std::move(scene), folder, record, console);
  });
}

}  // namespace witherfield::cli
