// witherfield: withering vegetation, simulated, written as VTK data and rendered. This program joins the
// libraries; it alone prints.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/film.hpp"
#include "sim/core/errors.hpp"

namespace {

constexpr const char* kDescription =
    "witherfield - things that change with time: grass that withers, ears that ripen, leaves that wilt,\n"
    "floors that wear\n\n"
    "A scene file (TOML; kind = grass, fruit, leaf or floor) is simulated into a run: a folder with VTK\n"
    "data for ParaView and with POV-Ray scenes, which are then turned into pictures.";

constexpr const char* kFooter =
    "\nFrom a scene to pictures:\n"
    "  witherfield run --print-defaults grass > meadow.toml    a commented scene to start from; also\n"
    "                                                          fruit, leaf, floor\n"
    "  witherfield run meadow.toml --preview                   try it, small and quick\n"
    "  witherfield run meadow.toml                             simulate; writes out/meadow\n"
    "  witherfield render out/meadow                           POV-Ray pictures, in out/meadow/images\n"
    "  witherfield volume out/meadow --field water --wd 0.3 -o water.png\n"
    "  paraview out/meadow/grass.pvd                           look at the data\n"
    "  witherfield check ear.obj                               is a mesh sound?\n\n"
    "`witherfield COMMAND --help` explains each command.\n"
    "Exit codes: 0 done, 1 a check failed, 2 wrong input, 3 a file or program failed, 4 a solver failed.";

/// The first word of the command line when it names no command; the parser itself would only say that one is
/// missing.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.empty() || word[0] == '-') continue;
    for (const CLI::App* command : app.get_subcommands({}))
      if (command->check_name(word)) return "";
    return word;
  }
  return "";
}

int fail(const std::string& message, int code) {
  fmt::print(stderr, "witherfield: error: {}\n", message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace witherfield;
  cli::install_signal_handlers();
  bool quiet = false;
  CLI::App app(kDescription, "witherfield");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("witherfield ") + cli::kProgramVersion,
                       "Show the version and exit");
  app.set_help_flag("-h,--help", "Show this help and exit");
  app.add_flag("-q,--quiet", quiet, "No progress, no remarks; results and errors only");
  app.require_subcommand(1);
  app.fallthrough();
  cli::add_run_command(app, quiet);
  cli::add_render_command(app, quiet);
  cli::add_film_command(app, quiet);
  cli::add_volume_command(app, quiet);
  cli::add_info_command(app, quiet);
  cli::add_check_command(app, quiet);
  cli::add_edit_command(app, quiet);
  if (const std::string word = unknown_command(app, argc, argv); !word.empty())
    return fail(
        "unknown command '" + word + "'; there are run, render, film, volume, info, check, edit (witherfield --help)", 2);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const Error& e) {
    return fail(e.what(), e.exit_code());
  } catch (const cli::Interrupted& e) {
    return fail("interrupted", 128 + e.signal);
  } catch (const std::bad_alloc&) {
    return fail(
        "out of memory; try --preview, or a coarser scene (texel.resolution, steps, fewer variants or "
        "grains)",
        4);
  } catch (const std::exception& e) {
    return fail(std::string("internal error, please report it: ") + e.what(), 4);
  }
}
