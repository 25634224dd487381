#include "cli/leaf_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/console.hpp"
#include "cli/leaf_input.hpp"
#include "cli/leaf_pictures.hpp"
#include "cli/object_writer.hpp"
#include "sim/check/mesh_check.hpp"
#include "sim/core/errors.hpp"
#include "sim/leaf/editor.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/wilt.hpp"
#include "sim/scene/scene.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kBalanceLimit = 1e-9;   // of the leaf's water, relative
constexpr double kMidribLimit = 0.02;    // change of the midrib's length in wilting (docs/physics.md)

struct KeyFrame {
  double wd = 0, time_days = 0;
  Surface surface;
};

class LeafRun : public RunStages {
 public:
  LeafRun(scene::LeafScene scene, RunFolder& folder, RunRecord& record, Console& console)
      : scene_(std::move(scene)),
        folder_(folder),
        record_(record),
        console_(console),
        clock_(record.stages) {}

  void prepare() override {
    leaf::validate(scene_.leaf);
    clock_.start("build");
    model_ = leaf::build_leaf(scene_.leaf, read_leaf_input(scene_));
    leaf::require_edit(model_, scene_.leaf.edit);
    clock_.start("");
    console_.note(
        fmt::format("leaf of {} vertices, {:.1f} cm2", model_.flat.position_m.size(), model_.area_m2 * 1e4));
    Json j{{"area_m2", model_.area_m2},
           {"natural_area_m2", model_.natural_area_m2},
           {"main_vein_m", model_.main_vein_m},
           {"ears_split", model_.ears_split}};
    if (scene_.leaf.reference_area_m2 > 0) j["area_error"] = model_.area_error;
    record_.details.emplace_back("leaf", j.dump());
  }

  void simulate(std::vector<FrameRecord> whole) override {
    writer_.emplace(folder_, "leaf", scene_.output, std::move(whole));
    write_stages();
    std::vector<glm::dvec3> pose = model_.natural.position_m;
    const bool edited = !scene_.leaf.edit.keys.empty();
    if (!scene_.leaf.wilts) take({0, 0, whole_leaf(model_, pose)}, {});
    if (edited) pose = edit();
    if (scene_.leaf.wilts) wilt(pose);
    writer_->write_series();
    check_blade();
  }

  void write_pictures() override {
    if (!scene_.output.pov || scene_.stills.empty()) return;
    clock_.start("write POV-Ray scenes");
    write_object_stills(
        folder_, record_, scene_.stills, leaf_looks(model_), [&](const ObjectStill& still) { return objects_of(still); },
        console_);
    clock_.start("");
  }

 private:
  /// The stages of the construction (Miao et al., fig. 5).
  void write_stages() {
    if (!scene_.output.obj && !scene_.output.ply && !scene_.output.fields) return;
    const fs::path folder = folder_.path() / "leaf";
    for (std::size_t i = 0; i < model_.stages.size(); ++i) {
      const leaf::Stage& stage = model_.stages[i];
      const fs::path file = folder / fmt::format("stage_{}_{}.vtp", i + 1, stage.name);
      if (stage.surface.triangles.empty())
        vis::write_curves_vtp(file, stage.surface.position_m, stage.lines, {0, 0});
      else
        vis::write_surface_vtp(file, stage.surface, {0, 0}, "mm");
    }
  }

  void take(KeyFrame frame, std::vector<std::pair<std::string, double>> numbers) {
    check_interrupted();
    const bool last = frame.wd >= 1 - 1e-12 || (!scene_.leaf.wilts && scene_.leaf.edit.keys.empty());
    FrameRecord r;
    r.index = int(frames_.size());
    r.wd = frame.wd;
    r.time_days = frame.time_days;
    r.numbers = std::move(numbers);
    writer_->write(std::move(r), frame.surface, last);
    record_.frames = writer_->frames();
    frames_.push_back(std::move(frame));
  }

  std::vector<glm::dvec3> edit() {
    clock_.start("edit");
    std::vector<glm::dvec3> pose;
    Json reports = Json::array();
    const double keys = double(scene_.leaf.edit.keys.size());
    leaf::run_edit(model_, scene_.leaf.edit, [&](const leaf::EditFrame& f) {
      pose = *f.position_m;
      Surface blade = model_.natural;
      blade.position_m = pose;
      const auto crossing = check::check_mesh(to_tri_mesh(blade, true)).self_intersections;
      const leaf::EditReport& r = f.report;
      reports.push_back({{"key", f.key->name},
                         {"area_drift", r.area_drift},
                         {"largest_strain", r.largest_strain},
                         {"rms_strain", r.rms_strain},
                         {"flipped_faces", r.flipped_faces},
                         {"intersecting_pairs", crossing},
                         {"iterations", f.iterations}});
      console_.note(fmt::format("edit '{}': area {:+.2f} %, largest strain {:.1f} %, {} faces flipped, {} pairs crossing",
                                f.key->name, 100 * r.area_drift, 100 * r.largest_strain, r.flipped_faces, crossing));
      if (scene_.leaf.wilts) return;
      take({(f.index + 1) / keys, double(f.index + 1), whole_leaf(model_, pose)},
           {{"iterations", double(f.iterations)},
            {"area_drift", r.area_drift},
            {"largest_strain", r.largest_strain},
            {"flipped_faces", double(r.flipped_faces)},
            {"intersecting_pairs", double(crossing)}});
    });
    record_.details.emplace_back("edit", reports.dump());
    clock_.start("");
    return pose;
  }

  void wilt(const std::vector<glm::dvec3>& pose) {
    clock_.start("wilt");
    const Progress bar = console_.progress();
    const leaf::WiltOptions& o = scene_.leaf.wilt;
    const leaf::WiltReport report = leaf::simulate_wilt(
        leaf::wilt_body(model_, pose), o,
        [&](const leaf::WiltFrame& f) {
          take({f.hours / o.length_hours, f.hours / 24, *f.surface},
               {{"hours", f.hours},
                {"mean_water", f.water},
                {"area_change", f.area_change},
                {"midrib_change", f.midrib_change},
                {"petiole_drop_deg", f.petiole_drop_deg},
                {"tip_drop_deg", f.tip_drop_deg}});
        },
        [&](std::string_view, double fraction) { bar("wilting", fraction); });
    bar("wilting", 1);
    record_.checks.push_back({"water_balance_relative", std::abs(report.balance_error), kBalanceLimit, ""});
    record_.checks.push_back({"midrib_length_change", report.midrib_change_max, kMidribLimit, ""});
    record_.details.emplace_back("wilting", Json{{"area_change_last", report.area_change_last},
                                                 {"equilibria", report.solves},
                                                 {"newton_steps", report.iterations},
                                                 {"unconverged", report.unconverged},
                                                 {"residual_max", report.residual_max}}
                                                .dump());
    clock_.start("");
  }

  /// The blade of the last frame.
  void check_blade() {
    clock_.start("check");
    const Surface& last = frames_.back().surface;
    const auto& organ = last.field("organ_id").values;
    const Surface blade = keep_faces(
        last, [&](std::size_t f) { return int(organ[std::size_t(last.triangles[f][0])]) == kBladeOrgan; });
    const check::MeshReport r = check::check_mesh(to_tri_mesh(blade, true));
    record_.checks.push_back({"blade_degenerate_faces", double(r.degenerate_faces), 0, "faces"});
    record_.checks.push_back({"blade_self_intersections", double(r.self_intersections), 0, "pairs"});
    record_.checks.push_back({"blade_not_manifold", double(!r.manifold), 0, ""});
    clock_.start("");
  }

  std::vector<Surface> objects_of(const ObjectStill& still) const {
    if (still.subject == "stages") return stage_objects(model_);
    std::vector<Surface> objects;
    for (const double wd : still.wd) {
      const KeyFrame* best = &frames_.front();
      for (const KeyFrame& f : frames_)
        if (std::abs(f.wd - wd) < std::abs(best->wd - wd)) best = &f;
      Surface leaf = without_vein_colour(best->surface, model_.chlorophyll_ug_cm2);
      if (still.subject == "handles") show_handles(leaf, *best);
      if (scene_.leaf.wilts) add_stem(leaf, model_, lowest_m() - 0.005);
      objects.push_back(without(leaf, still.hide));
    }
    return objects;
  }

  double lowest_m() const {
    double low = 0;
    for (const KeyFrame& f : frames_)
      for (const glm::dvec3& p : f.surface.position_m) low = std::min(low, p.z);
    return low;
  }

  /// At the key that the frame shows; before the first key all handles are held where they are.
  void show_handles(Surface& leaf, const KeyFrame& frame) const {
    const leaf::EditOptions& edit = scene_.leaf.edit;
    const std::size_t shown = std::size_t(&frame - frames_.data());
    const bool edited = !scene_.leaf.wilts && shown > 0 && shown <= edit.keys.size();
    add_handles(leaf, model_, edit, edited ? edit.keys[shown - 1] : leaf::EditKey{});
  }

  static Surface without(const Surface& surface, const std::vector<std::string>& organs) {
    if (organs.empty()) return surface;
    const auto& organ = surface.field("organ_id").values;
    return keep_faces(surface, [&](std::size_t f) {
      const int id = int(organ[std::size_t(surface.triangles[f][0])]);
      const char* name = id == kBladeOrgan ? "blade" : id == kPetioleOrgan ? "petiole" : id == kStemOrgan ? "stem" : "marker";
      return std::find(organs.begin(), organs.end(), name) == organs.end();
    });
  }

  scene::LeafScene scene_;
  RunFolder& folder_;
  RunRecord& record_;
  Console& console_;
  StageClock clock_;
  leaf::LeafModel model_;
  std::optional<ObjectWriter> writer_;
  std::vector<KeyFrame> frames_;
};

}  // namespace

void run_leaf(const RunRequest& request, Console& console) {
  scene::LeafScene scene = scene::load_leaf_scene(request.scene, request.preview);
  const std::string name = scene.name, json = scene::resolved_json(scene);
  carry_out(request, "leaf", name, json, console, [&](RunFolder& folder, RunRecord& record) {
    return std::make_unique<LeafRun>(std::move(scene), folder, record, console);
  });
}

}  // namespace witherfield::cli
