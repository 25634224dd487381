// witherfield run: simulate a scene, write its data and its POV-Ray scenes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/floor_run.hpp"
#include "cli/fruit_run.hpp"
#include "cli/grass_run.hpp"
#include "cli/leaf_run.hpp"
#include "sim/core/errors.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {
namespace {

constexpr const char* kRunFooter =
    "\nExamples:\n"
    "  witherfield run examples/hillside.toml                 writes out/hillside\n"
    "  witherfield run examples/maize_ear.toml --preview -o try   small, in seconds, to check a scene\n"
    "  witherfield run meadow.toml --resume                   go on after an interruption or a full disk\n"
    "  witherfield run office.toml --footprints out/office/footprints.bin -o again   new look, same walks\n"
    "  witherfield run --print-defaults fruit > my.toml       every key, commented, with its default and "
    "range\n\n"
    "A run holds a series for ParaView, KIND.pvd (grass.pvd, fruit.pvd, leaf.pvd, floor.pvd), and the files\n"
    "of its key frames below; pov/ (scenes for `witherfield render`); and run.json (the scene with every\n"
    "default, value ranges, checks, timings), written last. docs/formats.md lists all files and arrays.\n"
    "The same scene gives the same files, byte for byte, for any number of threads.";

struct RunOptions {
  RunRequest request;
  std::string print_defaults;
};

void run(RunOptions& o, const bool& quiet) {
  if (!o.print_defaults.empty()) {
    fmt::print("{}", scene::print_defaults(o.print_defaults));
    return;
  }
  if (o.request.scene.empty())
    throw InvalidInput(
        "run needs a scene file, e.g. `witherfield run examples/hillside.toml`; see `witherfield run "
        "--help`");
  Console console(quiet);
  const std::string kind = scene::scene_kind(o.request.scene);
  if (kind != "floor" && (!o.request.visits.empty() || !o.request.footprints.empty()))
    throw InvalidInput("--visits and --footprints are for floors; " + o.request.scene + " is of kind \"" + kind + "\"");
  if (kind == "grass") run_grass(o.request, console);
  if (kind == "fruit") run_fruit(o.request, console);
  if (kind == "leaf") run_leaf(o.request, console);
  if (kind == "floor") run_floor(o.request, console);
}

}  // namespace

void add_run_command(CLI::App& app, const bool& quiet) {
  const auto o = std::make_shared<RunOptions>();
  CLI::App* c = app.add_subcommand("run", "Simulate a scene: VTK data, POV-Ray scenes, run.json");
  c->footer(kRunFooter);
  c->add_option("SCENE", o->request.scene, "Scene file (TOML)");
  c->add_option("-o,--output", o->request.folder, "Folder of the run (default: out/NAME of the scene)");
  c->add_option("--threads", o->request.threads, "Threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  c->add_flag("--preview", o->request.preview, "Small grid, few frames and texels, small pictures");
  CLI::Option* resume =
      c->add_flag("--resume", o->request.resume, "Finish a run of this very scene that was broken off");
  c->add_flag("--force", o->request.force, "Replace the run that is in the folder (removes its files only)")
      ->excludes(resume);
  c->add_option("--visits", o->request.visits, "Floors: walk only these visits (several machines can share the work)")
      ->type_name("FROM:UNTIL");
  c->add_option("--footprints", o->request.footprints,
                "Floors: take the footprints of earlier runs; only visits that go another way are walked")
      ->type_name("FILE.bin");
  c->add_option("--print-defaults", o->print_defaults,
                "Print a complete commented scene of KIND (grass, fruit, leaf, floor) and exit")
      ->type_name("KIND");
  c->callback([o, &quiet] { run(*o, quiet); });
}

}  // namespace witherfield::cli
