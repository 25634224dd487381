// witherfield render: POV-Ray pictures of the stills of a run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/run_record.hpp"
#include "pov/render.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRenderFooter =
    "\nExamples:\n"
    "  witherfield render out/hillside                              all stills, texel look\n"
    "  witherfield render out/hillside --look blades --quality final\n"
    "  witherfield render out/hillside --scene wd_030 --look all --size 1280x720\n\n"
    "Looks (of the same simulation): texel = the volume of the texels, as participating media;\n"
    "blades = the blades themselves, as meshes. A still has the looks that its scene file names.\n"
    "Fruit and leaves have the look object, floors the look room.\n"
    "Pictures go to DIR/images/STILL_LOOK.png. Needs the program povray (Debian package povray).";

struct RenderOptions {
  std::string folder, scene, look, size, quality = "good";
  int threads = 0;
};

struct Job {
  std::string name;  ///< STILL_LOOK
  fs::path scene, png;
};

std::string names_of(const RunSummary& run) {
  std::string names;
  for (const StillRecord& s : run.stills) names += (names.empty() ? "" : ", ") + s.still.name;
  return names;
}

/// texel, if the still has it: it is the quicker one.
std::string default_look(const StillRecord& s) {
  for (const auto& [look, file] : s.scenes)
    if (look == "texel") return look;
  return s.scenes.empty() ? "" : s.scenes.front().first;
}

std::vector<Job> jobs_of(const RenderOptions& o, const RunSummary& run) {
  const fs::path folder = o.folder;
  if (run.stills.empty())
    throw InvalidInput(
        "'" + o.folder +
        "' has no stills: add a [[still]] to the scene file (and output.pov = true), then run it again");
  std::vector<Job> jobs;
  bool known = o.scene.empty();
  for (const StillRecord& s : run.stills) {
    if (!o.scene.empty() && s.still.name != o.scene) continue;
    known = true;
    // Without --look: the first of texel, blades ... that the still has.
    const std::string wanted = o.look.empty() ? default_look(s) : o.look;
    for (const auto& [look, file] : s.scenes)
      if (wanted == "all" || wanted == look) {
        const std::string name = s.still.name + "_" + look;
        jobs.push_back({name, folder / file, folder / "images" / (name + ".png")});
      }
  }
  if (!known)
    throw InvalidInput("--scene " + o.scene + ": no still of this name in '" + o.folder +
                       "'; there are: " + names_of(run));
  if (jobs.empty())
    throw InvalidInput("--look " + o.look + ": " +
                       (o.scene.empty() ? "no still of '" + o.folder + "'" : "still " + o.scene) +
                       " has this look; the scene file's key `looks` names them");
  return jobs;
}

void render(const RenderOptions& o, const bool& quiet) {
  Console console(quiet);
  pov::RenderOptions options;
  if (!o.size.empty()) std::tie(options.width_px, options.height_px) = parse_size(o.size);
  options.quality = o.quality == "draft"  ? pov::Quality::draft
                    : o.quality == "good" ? pov::Quality::good
                                          : pov::Quality::final;
  options.threads = o.threads;
  const std::vector<Job> jobs = jobs_of(o, read_run(o.folder));
  std::error_code error;
  const fs::path images = fs::path(o.folder) / "images";
  fs::create_directories(images, error);
  if (error) throw IoFailure("cannot make the folder '" + images.string() + "': " + error.message());
  const Progress bar = console.progress();
  try {
    for (const Job& job : jobs) {
      check_interrupted();
      const pov::RenderResult result =
          pov::render_scene(job.scene, job.png, options,
                            [&](std::string_view, double fraction) { bar("render " + job.name, fraction); });
      console.say(fmt::format("{}  ({})", result.png.string(), duration_text(result.seconds)));
    }
  } catch (...) {
    fs::remove(images, error);  // only if it is empty
    throw;
  }
}

}  // namespace

void add_render_command(CLI::App& app, const bool& quiet) {
  const auto o = std::make_shared<RenderOptions>();
  CLI::App* c = app.add_subcommand("render", "POV-Ray pictures of the stills of a run");
  c->footer(kRenderFooter);
  c->add_option("DIR", o->folder, "Folder of a complete run")->required();
  c->add_option("--scene", o->scene, "Only the still of this name");
  c->add_option("--look", o->look, "Which look (default: texel, or the only one that the still has)")
      ->check(CLI::IsMember({"texel", "blades", "object", "room", "all"}));
  c->add_option("--size", o->size, "Size of the pictures instead of the scene's")->type_name("WxH");
  c->add_option("--quality", o->quality, "draft: quick; final: slow and smooth")
      ->check(CLI::IsMember({"draft", "good", "final"}))
      ->capture_default_str();
  c->add_option("--threads", o->threads, "Threads; 0 = all")
      ->check(CLI::Range(0, 512))
      ->capture_default_str();
  c->callback([o, &quiet] { render(*o, quiet); });
}

}  // namespace witherfield::cli
