// witherfield edit: a leaf in a window.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/edit_app.hpp"
#include "cli/edit_save.hpp"
#include "cli/edit_texts.hpp"

namespace witherfield::cli {
namespace {

constexpr const char* kEditFooter =
    "\nSaving writes NAME_edited.toml beside the scene (or the file of -o), the leaf as .obj and .vtp and,\n"
    "when the outline was changed, its points as .csv. `witherfield run` makes the same leaf of the saved\n"
    "scene; its comments and other keys stay as they were. Nothing is ever asked.\n"
    "\nThe linear mode is Laplacian editing: exact and quick, but large turns shear the leaf. The rotation-\n"
    "aware mode bends it. The panel says after each edit how much the area drifted, the largest strain, and\n"
    "which faces flipped or cut each other.\n"
    "\nExamples:\n"
    "  witherfield run --print-defaults leaf > my_leaf.toml      a scene to start from\n"
    "  witherfield edit my_leaf.toml                             opens the window; S saves my_leaf_edited.toml\n"
    "  witherfield run my_leaf_edited.toml                       the edited leaf as data and pictures\n"
    "  witherfield edit my_leaf.toml -o curled.toml              S saves curled.toml, curled.obj, curled.vtp\n"
    "  witherfield edit my_leaf.toml --size 960x600 --samples 0  for slow machines\n"
    "\nA display is needed (X). On a machine without a screen:\n"
    "  xvfb-run -a -s \"-screen 0 1400x900x24 -noreset\" witherfield edit my_leaf.toml\n"
    "\nExit codes: 0 closed, 2 wrong input, 3 no display or a file cannot be read or written.";

std::string keys_and_mouse() {
  std::string text = "\nMouse and keys:\n";
  for (const auto& [key, what] : help_rows()) text += fmt::format("  {:<28}{}\n", key, what);
  return text;
}

struct EditOptions {
  EditRequest request;
  std::string scene, output, size;
};

void run(EditOptions& o, const bool& quiet) {
  Console console(quiet);
  o.request.scene_file = o.scene;
  o.request.target = o.output.empty() ? edited_name(o.scene) : std::filesystem::path(o.output);
  if (!o.size.empty())
    std::tie(o.request.window.width_px, o.request.window.height_px) = parse_size(o.size);
  edit_leaf(o.request, console);
}

}  // namespace

void add_edit_command(CLI::App& app, const bool& quiet) {
  const auto o = std::make_shared<EditOptions>();
  CLI::App* c = app.add_subcommand("edit", "Shape a leaf by hand, in a window");
  c->footer(keys_and_mouse() + kEditFooter);
  c->add_option("LEAF", o->scene, "Scene file of kind \"leaf\"")->required();
  c->add_option("-o,--output", o->output, "Scene file to save to; the mesh is saved beside it")->type_name("SCENE.toml");
  c->add_option("--size", o->size, "Size of the window in pixels [1280x800]")->type_name("WxH");
  c->add_option("--samples", o->request.window.samples, "Anti-aliasing of the still picture; 0 = none")
      ->type_name("N")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  c->add_option("--moving-samples", o->request.window.moving_samples, "The same while something moves")
      ->type_name("N")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  c->callback([o, &quiet] { run(*o, quiet); });
}

}  // namespace witherfield::cli
