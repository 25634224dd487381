// witherfield check: are meshes sound?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/mesh_findings.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

constexpr const char* kCheckFooter =
    "\nA mesh passes when it is manifold, its faces agree in orientation, none is degenerate or there\n"
    "twice, no shell cuts itself, and every vertex is used and finite. Open shells (a leaf) are allowed\n"
    "unless --closed; shells may run into each other (kernels on a cob) unless --max-overlap.\n"
    "The tests are exact; ids count from 0. Overlaps are estimates, with their standard error. Areas\n"
    "and volumes are in the file's own unit of length.\n"
    "\nExamples:\n"
    "  witherfield check out/ear/fruit/fruit_0000.vtp --closed     every kernel must be a closed solid\n"
    "  witherfield check ear.ply --max-overlap 0.02                shells may share 2 % of their volume\n"
    "  witherfield check *.obj --json | jq '.meshes[].checks'      for programs\n"
    "  witherfield check scan.stl --no-self-intersections          quicker, for very large meshes\n"
    "\nExit codes: 0 all passed, 1 a mesh failed, 2 a mesh is damaged or of unknown kind, 3 a file\n"
    "cannot be opened.";

struct CheckOptions {
  std::vector<std::string> files;
  CheckDemands demands;
  double max_overlap = -1;
  bool json = false, no_self_intersections = false;
};

/// Ends the command with its exit code when something is wrong.
void conclude(const std::vector<MeshFindings>& meshes) {
  std::size_t failed = 0;
  const MeshFindings *unreadable = nullptr, *first = nullptr;
  for (const MeshFindings& mesh : meshes) {
    if (!mesh.error.empty() && !unreadable) unreadable = &mesh;
    if (mesh.passed()) continue;
    if (!first) first = &mesh;
    ++failed;
  }
  if (unreadable) throw Error(unreadable->error, unreadable->error_code);
  if (failed == 0) return;
  std::string why;
  for (const Finding& f : first->findings)
    if (!f.passed()) why += fmt::format("{}{} ({})", why.empty() ? "" : ", ", f.name, f.found);
  throw Error(fmt::format("{} of {} meshes failed: '{}' has {}", failed, meshes.size(), first->file, why), 1);
}

void run(CheckOptions& o) {
  o.demands.self_intersections = !o.no_self_intersections;
  if (o.max_overlap >= 0) o.demands.max_overlap = o.max_overlap;
  std::vector<MeshFindings> meshes;
  for (const std::string& file : o.files) {
    check_interrupted();
    meshes.push_back(find_in_mesh(file, o.demands));
    if (!o.json) fmt::print("{}", findings_table(meshes.back()));
  }
  if (o.json) fmt::print("{}\n", findings_json(meshes));
  std::fflush(stdout);
  conclude(meshes);
}

}  // namespace

void add_check_command(CLI::App& app, const bool&) {
  const auto o = std::make_shared<CheckOptions>();
  CLI::App* c = app.add_subcommand("check", "Is a mesh sound? Any OBJ, PLY, OFF, STL or VTP");
  c->footer(kCheckFooter);
  c->add_option("MESH", o->files, "Mesh files: .obj, .ply, .off, .stl, .vtp")->required();
  c->add_flag("--json", o->json, "Everything as JSON on standard output, with the ids of what is wrong");
  c->add_flag("--closed", o->demands.closed, "Fail unless every shell is closed and faces outward");
  c->add_flag("--overlap", o->demands.overlap, "How much do closed shells run into each other?");
  c->add_option("--max-overlap", o->max_overlap,
                "Fail when two shells share more than this fraction of the smaller one's volume")
      ->type_name("FRACTION")
      ->check(CLI::Range(0.0, 1.0));
  c->add_flag("--no-self-intersections", o->no_self_intersections,
              "Leave out the slowest check: do faces cut each other?");
  c->callback([o] { run(*o); });
}

}  // namespace witherfield::cli
