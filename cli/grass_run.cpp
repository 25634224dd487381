#include "cli/grass_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console.hpp"
#include "cli/frame_store.hpp"
#include "cli/frame_writer.hpp"
#include "cli/hill.hpp"
#include "cli/run_folder.hpp"
#include "cli/run_record.hpp"
#include "pov/scene_writer.hpp"
#include "sim/core/parallel.hpp"
#include "sim/scene/scene.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

/// The stages of one run, in order. The folder and the record live longer than a failure, which must leave no
/// half-written run.
class GrassRun {
 public:
  GrassRun(scene::GrassScene scene, RunFolder& folder, RunRecord& record, Console& console)
      : scene_(std::move(scene)),
        folder_(folder),
        record_(record),
        console_(console),
        clock_(record.stages) {}

  /// Everything that can be wrong with the input shows here, before anything is written.
  void prepare() {
    if (!scene_.terrain) return;
    clock_.start("terrain and placement");
    console_.note("terrain " + (scene_.terrain->dem.empty() ? scene_.terrain->mesh : scene_.terrain->dem));
    hill_.emplace(make_hill(scene_));
    record_.terrain = hill_->report;
    clock_.start("");
  }

  void simulate(std::vector<FrameRecord> whole) {
    clock_.start("simulate and write");
    if (scene_.output.pov)
      for (std::size_t i = 0; i < scene_.stills.size(); ++i) want_frames(i);
    FrameWriter writer(folder_, scene_, std::move(whole));
    const Progress bar = console_.progress();
    record_.report = grass::simulate_grass(
        scene_.grass,
        [&](const grass::GrassFrame& frame) {
          check_interrupted();
          writer.write(frame);
          record_.frames = writer.frames();
          store_.take(frame);
        },
        [&](std::string_view stage, double fraction) { bar(stage, fraction); });
    writer.write_series();
    clock_.start("");
  }

  void write_pictures() {
    if (hill_) write_hill(folder_, *hill_);
    if (scene_.output.fields)
      vis::write_paraview_script(folder_.path() / "view_in_paraview.py", ranges_of(record_),
                                 hill_.has_value());
    if (!scene_.output.pov || scene_.stills.empty()) return;
    clock_.start("write POV-Ray scenes");
    for (std::size_t i = 0; i < scene_.stills.size(); ++i) {
      check_interrupted();
      write_still(i);
    }
    clock_.start("");
  }

  void finish() {
    for (const fs::path& file : folder_.files())
      if (folder_.path() / file != folder_.partial_file())
        record_.files.emplace_back(file.generic_string(), fs::file_size(folder_.path() / file));
    vis::write_whole_file(folder_.run_file(), run_json(record_));
    fs::remove(folder_.partial_file());
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

void print_summary(const RunRecord& record, const RunFolder& folder, Console& console) {
  double seconds = 0, bytes = 0;
  for (const StageRecord& s : record.stages) seconds += s.seconds;
  for (const auto& [path, size] : record.files) bytes += double(size);
  for (const Check& c : checks_of(record))
    if (!c.passed())
      console.note(
          fmt::format("warning: check {} gives {} {}, the limit is {}", c.name, c.value, c.unit, c.limit));
  const std::string where = folder.path().string();
  console.say(fmt::format("{}: {} key frames of {} blades in {}, {}", where, record.frames.size(),
                          record.report.blades, duration_text(seconds), size_text(bytes)));
  if (!record.stills.empty()) console.say("  pictures:  witherfield render " + where);
  if (fs::exists(folder.path() / "grass.pvd")) console.say("  data:      paraview " + where + "/grass.pvd");
}

}  // namespace

void run_grass(const RunRequest& request, Console& console) {
  scene::GrassScene scene = scene::load_grass_scene(request.scene, request.preview);
  const ThreadLimit limit(request.threads);
  RunFolder folder(request.folder.empty() ? fs::path("out") / scene.name : fs::path(request.folder));
  RunRecord record;
  record.scene_json = scene::resolved_json(scene);
  record.scene_file = request.scene;
  record.preview = request.preview;
  record.threads = request.threads;
  const std::string signature = run_signature(record.scene_json);
  const RunFolder::Found found = folder.inspect(signature, request.resume, request.force);
  if (found == RunFolder::Found::complete) {
    console.say(folder.path().string() + ": this run is complete; nothing to do");
    return;
  }
  GrassRun run(std::move(scene), folder, record, console);
  run.prepare();
  std::vector<FrameRecord> whole;
  if (found == RunFolder::Found::unfinished) whole = read_partial(folder.partial_file());
  try {
    folder.begin(signature, request.force);
    run.simulate(std::move(whole));
    run.write_pictures();
    run.finish();
  } catch (...) {
    // Whole key frames stay for --resume; without any there is nothing to keep.
    if (record.frames.empty() && found == RunFolder::Found::nothing) folder.abandon();
    if (!record.frames.empty())
      console.note(
          fmt::format("{} whole key frames stay in {}; `witherfield run {} -o {} --resume` finishes the run",
                      record.frames.size(), folder.path().string(), request.scene, folder.path().string()));
    throw;
  }
  print_summary(record, folder, console);
}

}  // namespace witherfield::cli
