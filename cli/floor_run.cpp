#include "cli/floor_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/console.hpp"
#include "cli/floor_pictures.hpp"
#include "cli/floor_walk.hpp"
#include "cli/footprint_file.hpp"
#include "pov/png.hpp"
#include "sim/core/errors.hpp"
#include "sim/floor/simulate.hpp"
#include "sim/scene/scene.hpp"
#include "vis/atomic_file.hpp"
#include "vis/table.hpp"
#include "vis/writers.hpp"

namespace witherfield::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The user's own soles.
void load_masks(scene::FloorScene& s) {
  for (const std::string& file : s.mask_files) {
    const pov::GreyPicture picture = pov::read_png_grey(file);
    if (picture.width != picture.height || picture.width % 2 == 0)
      throw InvalidInput(
          fmt::format("footprints.masks: '{}' is {} x {} pixels; a sole's picture must be square with an odd "
                      "number of pixels, so that it has a middle to turn about",
                      file, picture.width, picture.height));
    s.floor.footprints.masks.push_back(
        {fs::path(file).stem().string(), picture.width, s.mask_pixels_per_m, picture.grey});
  }
}

class FloorRun : public RunStages {
 public:
  FloorRun(scene::FloorScene scene, RunFolder& folder, RunRecord& record, Console& console)
      : scene_(std::move(scene)),
        folder_(folder),
        record_(record),
        console_(console),
        clock_(record.stages) {}

  void prepare() override { floor::validate(scene_.floor); }

  void simulate(std::vector<FrameRecord>) override {
    if (scene_.output.fields) make_folder("floor");
    const floor::FloorReport report = needs_footprint_file(scene_) ? wear_kept() : walk_and_wear();
    write_shown_visits();
    clock_.start("write");
    std::vector<std::pair<double, std::string>> entries;
    for (const FrameRecord& f : record_.frames)
      if (!f.file("floor").empty()) entries.emplace_back(f.time_days, f.file("floor"));
    if (!entries.empty()) vis::write_pvd(folder_.path() / "floor.pvd", entries);
    if (needs_footprint_file(scene_) && !scene_.output.footprints && !scene_.walk.stretch)
      fs::remove(footprint_file());  // a stretch is for its footprints
    tell(report);
    clock_.start("");
  }

  void write_pictures() override {
    if (!scene_.output.pov || scene_.stills.empty()) return;
    clock_.start("write POV-Ray scenes");
    const Progress bar = console_.progress();
    for (const scene::RoomStill& still : scene_.stills) {
      check_interrupted();
      const std::string stage = "scene " + still.still.name;
      const Progress progress = [&](std::string_view, double fraction) { bar(stage, fraction); };
      const std::vector<FloorField>& floors = kept_.at(key_of(still.visits_share));
      const fs::path file =
          scene_.floor.stairs
              ? pov::write_stair_scene(folder_.path() / "pov", stair_input(scene_, still, floors), progress)
              : pov::write_room_scene(folder_.path() / "pov", room_input(scene_, still, floors.front()), progress);
      bar(stage, 1);
      StillRecord record{still.still, {}};
      record.still.looks = {"room"};
      record.still.wd = still.visits_share;
      record.scenes.emplace_back("room", file.lexically_relative(folder_.path()).generic_string());
      record_.stills.push_back(std::move(record));
    }
    clock_.start("");
  }

 private:
  static long key_of(double share) { return std::lround(share * 1e9); }

  void make_folder(const char* name) {
    std::error_code error;
    fs::create_directories(folder_.path() / name, error);
    if (error)
      throw IoFailure("cannot make the folder '" + (folder_.path() / name).string() +
                      "': " + error.message());
  }

  void take(const floor::FloorFrame& frame) {
    check_interrupted();
    const double share = scene_.floor.frames[std::size_t(frame.index)];
    FrameRecord r;
    r.index = frame.index;
    r.wd = share;
    r.time_days = frame.time_days;
    r.numbers = {{"visits", double(frame.visits)}, {"footfalls_total", frame.footfalls_total}};
    if (scene_.output.fields) {
      r.files.emplace_back("floor", fmt::format("floor/floor_{:04}.vti", frame.index));
      r.ranges = vis::write_floor_vti(
          folder_.path() / r.files.back().second, in_plan(frame.floors), {frame.time_days, share},
          scene_.output.compression == "zlib" ? vis::Compression::zlib : vis::Compression::lz4);
    }
    record_.frames.push_back(std::move(r));
    vis::write_whole_file(folder_.partial_file(), partial_json(record_.frames));
    for (const scene::RoomStill& still : scene_.stills)
      if (scene_.output.pov && key_of(still.visits_share) == key_of(share))
        kept_[key_of(share)].assign(frame.floors.begin(), frame.floors.end());
  }

  fs::path footprint_file() const { return folder_.path() / "footprints.bin"; }

  floor::FloorReport walk_and_wear() {
    clock_.start("walk, wear and write");
    const Progress bar = console_.progress();
    const floor::FloorReport report = floor::simulate(
        scene_.floor, [&](const floor::FloorFrame& frame) { take(frame); },
        [&](std::string_view, double fraction) { bar("walking", fraction); });
    bar("walking", 1);
    return report;
  }

  /// Footprints first, as a file; then the floor from the file. Of a run that was broken off the whole file is still good.
  floor::FloorReport wear_kept() {
    clock_.start("walk");
    const Progress bar = console_.progress();
    floor::RetuneReport walked;
    if (!fs::exists(footprint_file()))
      walked = write_footprint_file(scene_, footprint_file(), check_interrupted,
                                    [&](std::string_view, double fraction) { bar("walking", fraction); });
    clock_.start("wear and write");
    FootprintReader reader(footprint_file());
    floor::FloorReport report = floor::wear_frames(
        scene_.floor, reader.source(), [&](const floor::FloorFrame& frame) { take(frame); },
        [&](std::string_view, double fraction) { bar("wearing", fraction); });
    bar("wearing", 1);
    const std::int64_t prints = report.walk.footprints;
    report.walk = walked.walk;
    report.walk.visits = walked.kept + walked.walked;
    report.walk.footprints = prints;
    record_.details.emplace_back("footprints",
                                 Json{{"visits", {reader.visits().first, reader.visits().last}},
                                      {"visits_taken", walked.kept},
                                      {"visits_walked", walked.walked},
                                      {"visits_dropped", walked.dropped}}
                                     .dump());
    if (!scene_.walk.footprint_files.empty())
      console_.note(fmt::format("{} visits taken from earlier footprints, {} walked", walked.kept, walked.walked));
    return report;
  }

  /// Tables of the first visits, for VTK and spreadsheets.
  void write_shown_visits() {
    const std::int64_t shown = scene_.output.shown_visits;
    if (shown == 0) return;
    clock_.start("write the first visits");
    std::vector<floor::Footprint> prints;
    const auto keep = [&](std::span<const floor::Footprint> p) { prints.insert(prints.end(), p.begin(), p.end()); };
    if (needs_footprint_file(scene_)) {
      FootprintReader reader(footprint_file());
      const std::int64_t end = reader.visits().first + shown;
      const floor::FootprintSource source = reader.source();
      for (auto p = source(); !p.empty() && p.front().person < end; p = source()) keep(p);
      std::erase_if(prints, [&](const floor::Footprint& f) { return f.person >= end; });
    } else {
      floor::walk(scene_.floor, {0, shown}, keep);
    }
    const vis::Compression compression =
        scene_.output.compression == "zlib" ? vis::Compression::zlib : vis::Compression::lz4;
    const PointTable table = footprint_table(prints);
    vis::write_table_vtp(folder_.path() / "footprints.vtp", table, compression);
    vis::write_table_csv(folder_.path() / "footprints.csv", table);
    vis::write_table_vtp(folder_.path() / "walks.vtp", walk_table(prints), compression);
  }

  void tell(const floor::FloorReport& r) {
    record_.checks.push_back({"walkers_stuck", double(r.walk.stuck), 0, "walkers"});
    record_.checks.push_back({"not_finite", r.all_finite ? 0.0 : 1.0, 0, ""});
    record_.checks.push_back({"not_monotone", r.monotone ? 0.0 : 1.0, 0, ""});
    record_.details.emplace_back("walk", Json{{"visits", r.walk.visits},
                                              {"footprints", r.walk.footprints},
                                              {"way_m", r.walk.way_m},
                                              {"stuck", r.walk.stuck},
                                              {"neighbour_difference_max", r.neighbour_difference_max}}
                                             .dump());
    Json stages = Json::object();
    for (const floor::FloorReport::Stage& s : r.stages) stages[s.name] = s.seconds;
    record_.details.emplace_back("simulation_stages", stages.dump());
    for (const floor::Stuck& s : r.walk.stuck_first)
      console_.note(fmt::format("visit {} was stuck at ({:.2f}, {:.2f}) m on day {:.1f}", s.visit, s.at_m.x,
                                s.at_m.y, s.day));
  }

  scene::FloorScene scene_;
  RunFolder& folder_;
  RunRecord& record_;
  Console& console_;
  StageClock clock_;
  std::map<long, std::vector<FloorField>> kept_;
};

/// What the command line says besides the scene.
void apply(const RunRequest& request, scene::FloorScene& s) {
  if (!s.walk.footprint_files.empty() && !s.walk.track_files.empty())
    throw InvalidInput("--footprints: cannot be given together with walk.tracks of " + request.scene);
  if (request.visits.empty()) return;
  int from = 0, until = 0, used = 0;
  if (std::sscanf(request.visits.c_str(), "%d:%d%n", &from, &until, &used) != 2 ||
      std::size_t(used) != request.visits.size() || from < 0 || until <= from)
    throw InvalidInput("--visits " + request.visits + ": must be FROM:UNTIL, two whole numbers, 0 <= FROM < UNTIL");
  s.walk.stretch = {from, until};
}

void run_scene(const RunRequest& request, Console& console) {
  std::vector<std::string> footprints;
  for (const std::string& file : request.footprints)
    footprints.push_back(fs::absolute(file).lexically_normal().string());
  scene::FloorScene scene = scene::load_floor_scene(request.scene, request.preview, footprints);
  apply(request, scene);
  load_masks(scene);
  const std::string name = scene.name, json = scene::resolved_json(scene);
  carry_out(request, "floor", name, json, console, [&](RunFolder& folder, RunRecord& record) {
    return std::make_unique<FloorRun>(std::move(scene), folder, record, console);
  });
}

}  // namespace

void run_floor(const RunRequest& request, Console& console) {
  try {
    run_scene(request, console);
  } catch (const InvalidInput& e) {
    throw InvalidInput(scene::with_line(request.scene, e.what()));
  }
}

}  // namespace witherfield::cli
