// witherfield info: what is in a file or in a run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/run_record.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/info.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInfoFooter =
    "\nExamples:\n"
    "  witherfield info out/hillside                          a run: frames, ranges, pictures, checks\n"
    "  witherfield info out/hillside/texel/texel_0001.vti     a file: arrays, units, ranges, geometry\n"
    "  witherfield info out/hillside/grass.pvd                a series: its times";

void print_array(const std::string& name, const std::string& unit, int components, double lo, double hi) {
  fmt::print("  {:<24} {:<8} {:<2} {:>13.6g} .. {:<13.6g}\n", name, unit, components, lo, hi);
}

void print_file(const fs::path& file) {
  const vis::FileInfo info = vis::file_info(file);
  fmt::print("{}: {}\n", file.string(), info.type);
  if (info.type == "series") {
    for (const auto& [days, name] : info.series) fmt::print("  day {:<10.4g} {}\n", days, name);
    return;
  }
  if (info.has_time) fmt::print("  day {:.6g}, wd {:.6g}\n", info.time_days, info.wd);
  if (info.type == "image")
    fmt::print("  {} x {} x {} voxels of {:.6g} {}\n", info.dimensions[0], info.dimensions[1],
               info.dimensions[2], info.spacing[0], info.length_unit);
  else
    fmt::print("  {} points, {} cells\n", info.points, info.cells);
  const double* b = info.bounds;
  fmt::print("  x {:.6g} .. {:.6g}, y {:.6g} .. {:.6g}, z {:.6g} .. {:.6g} {}\n", b[0], b[1], b[2], b[3],
             b[4], b[5], info.length_unit);
  for (const vis::ArrayInfo& a : info.arrays) print_array(a.name, a.unit, a.components, a.lo, a.hi);
}

void print_run(const fs::path& folder) {
  const RunSummary run = read_run(folder);
  fmt::print("{}: {} run \"{}\", witherfield {}, seed {}\n", folder.string(), run.kind, run.name, run.version,
             run.seed_text);
  fmt::print("  {} key frames, {}, made in {}, peak memory {:.0f} MiB\n", run.frames.size(),
             size_text(double(run.bytes)), duration_text(run.seconds), run.peak_memory_MiB);
  fmt::print("frames\n");
  vis::ValueRanges ranges;
  for (const FrameRecord& f : run.frames) {
    vis::merge_ranges(ranges, f.ranges);
    fmt::print("  wd {:<8.4g} day {:<8.4g}", f.wd, f.time_days);
    if (run.kind == "grass") fmt::print(" variant {} ", f.variant);
    for (const auto& [name, value] : f.numbers) fmt::print(" {} {:.6g}", name, value);
    for (const auto& [series, path] : f.files) fmt::print("  {}", path);
    fmt::print("\n");
  }
  fmt::print("ranges over the run\n");
  for (const auto& [name, r] : ranges) {
    const FieldSpec& spec = field_spec(name);
    print_array(name, std::string(spec.unit), spec.components, r.lo, r.hi);
  }
  if (!run.stills.empty()) fmt::print("pictures\n");
  for (const StillRecord& s : run.stills)
    for (const auto& [look, scene] : s.scenes) {
      const bool rendered = fs::exists(folder / "images" / (s.still.name + "_" + look + ".png"));
      fmt::print("  {}_{}  wd {:.4g}, {} x {}{}\n", s.still.name, look, s.still.wd, s.still.width_px,
                 s.still.height_px, rendered ? "" : "  (not rendered yet)");
    }
  fmt::print("checks\n");
  for (const auto& [name, passed] : run.checks)
    fmt::print("  {:<32} {}\n", name, passed ? "passed" : "FAILED");
}

}  // namespace

void add_info_command(CLI::App& app, const bool&) {
  const auto input = std::make_shared<std::string>();
  CLI::App* c = app.add_subcommand("info", "What is in a file or in a run, with ranges and units");
  c->footer(kInfoFooter);
  c->add_option("INPUT", *input, "A .vti, .vtp or .pvd file, or the folder of a run")->required();
  c->callback([input] {
    if (!fs::exists(*input)) throw IoFailure("'" + *input + "': no such file or folder");
    fs::is_directory(*input) ? print_run(*input) : print_file(*input);
  });
}

}  // namespace witherfield::cli
