#include "cli/run_stages.hpp"

#include <fmt/format.h>

#include "cli/console.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "vis/atomic_file.hpp"
#include "vis/writers.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

/// run.json, last: it marks the run as complete.
void finish(const RunFolder& folder, RunRecord& record) {
  for (const fs::path& file : folder.files())
    if (folder.path() / file != folder.partial_file())
      record.files.emplace_back(file.generic_string(), fs::file_size(folder.path() / file));
  vis::write_whole_file(folder.run_file(), run_json(record));
  fs::remove(folder.partial_file());
}

void print_summary(const RunRecord& record, const RunFolder& folder, Console& console) {
  double seconds = 0, bytes = 0;
  for (const StageRecord& s : record.stages) seconds += s.seconds;
  for (const auto& [path, size] : record.files) bytes += double(size);
  const std::string where = folder.path().string();
  console.say(fmt::format("{}: {} key frames in {}, {}", where, record.frames.size(), duration_text(seconds),
                          size_text(bytes)));
  if (!record.stills.empty()) console.say("  pictures:  witherfield render " + where);
  const fs::path series = folder.path() / (record.kind + ".pvd");
  if (fs::exists(series)) console.say("  data:      paraview --script=" + where + "/view_in_paraview.py");
}

/// The run is whole, and stays; but the caller must hear of it.
void insist_on_checks(const RunRecord& record, const RunFolder& folder) {
  std::string failed;
  for (const Check& c : record.checks)
    if (!c.passed())
      failed += fmt::format("{}{} is {}{}{}, the limit is {}", failed.empty() ? "" : "; ", c.name, c.value,
                            c.unit.empty() ? "" : " ", c.unit, c.limit);
  if (!failed.empty())
    throw Error(
        fmt::format("the run in {} is complete, but a check failed: {}", folder.path().string(), failed), 1);
}

}  // namespace

void carry_out(const RunRequest& request, const std::string& kind, const std::string& name,
               const std::string& scene_json, Console& console, const MakeStages& make) {
  const ThreadLimit limit(request.threads);
  RunFolder folder(request.folder.empty() ? fs::path("out") / name : fs::path(request.folder));
  RunRecord record;
  record.kind = kind;
  record.scene_json = scene_json;
  record.scene_file = request.scene;
  record.preview = request.preview;
  record.threads = request.threads;
  const std::string signature = run_signature(record.scene_json);
  const RunFolder::Found found = folder.inspect(signature, request.resume, request.force);
  if (found == RunFolder::Found::complete) {
    console.say(folder.path().string() + ": this run is complete; nothing to do");
    return;
  }
  const std::unique_ptr<RunStages> run = make(folder, record);
  run->prepare();
  std::vector<FrameRecord> whole;
  if (found == RunFolder::Found::unfinished) whole = read_partial(folder.partial_file());
  try {
    folder.begin(signature, request.force);
    run->simulate(std::move(whole));
    run->write_pictures();
    if (fs::exists(folder.path() / (kind + ".pvd")))
      vis::write_paraview_script(folder.path() / "view_in_paraview.py", kind, ranges_of(record));
    finish(folder, record);
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
  insist_on_checks(record, folder);
}

}  // namespace witherfield::cli
