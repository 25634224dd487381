// witherfield volume: a picture of a field, made with VTK, without a display.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/run_record.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/core/texel_grid.hpp"
#include "vis/volume.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVolumeFooter =
    "\nExamples:\n"
    "  witherfield volume out/hillside --field water --wd 0.3 -o water.png\n"
    "  witherfield volume out/hillside --field stress_vein_MPa --day 40 --surface -o stress.png\n"
    "  witherfield volume out/hillside/texel/texel_0002.vti --azimuth 30 --elevation 60 -o top.png\n"
    "  witherfield volume out/cucumber_wilting --field stress_von_mises_MPa --wd 1 -o stress.png\n\n"
    "Fields: density, water, chlorophyll_ug_cm2, stress_vein_MPa, stress_mesophyll_MPa, strain_shrink, "
    "tissue,\n"
    "blade_id; and normal, tangent, diffuse, specular (from the optics files). Leaves: water, "
    "stress_von_mises_MPa,\n"
    "strain_area, chlorophyll_ug_cm2, vein; fruit: moisture_wb, chlorophyll_ug_cm2; floors: wear_depth_um, "
    "footfalls ...\n"
    "The colour scale is that of the whole run, so that pictures of different days can be compared; --range "
    "sets another.\n"
    "No display is needed.";

struct VolumeOptions {
  std::string input, png, size, range, field;
  std::optional<double> day, wd, azimuth_deg, elevation_deg;
  vis::VolumeOptions volume;
};

bool is_optics(const std::string& field) {
  for (const TexelField& f : texel_fields())
    if (f.name == field) return f.optics;
  return false;
}

/// The file of the run's key frame nearest to the wanted time; the last one when no time is given.
fs::path frame_file(const VolumeOptions& o, Console& console) {
  const RunSummary run = read_run(o.input);
  const bool optics = run.kind == "grass" && is_optics(o.volume.field);
  const std::string series = run.kind != "grass" ? run.kind : optics ? "optics" : "texel";
  const FrameRecord* best = nullptr;
  double best_distance = 0;
  for (const FrameRecord& f : run.frames) {
    if (f.variant != 0 || f.file(series).empty()) continue;
    const double distance = o.day ? std::abs(f.time_days - *o.day) : o.wd ? std::abs(f.wd - *o.wd) : -f.wd;
    if (!best || distance < best_distance) best = &f, best_distance = distance;
  }
  if (!best)
    throw InvalidInput(
        fmt::format("'{}' has no {} files: set output.{} = true in the scene file and run it again", o.input,
                    series, optics ? "optics" : "fields"));
  console.note(fmt::format("key frame at wd {:.4g}, day {:.4g}", best->wd, best->time_days));
  return fs::path(o.input) / best->file(series);
}

/// What a kind of run is looked at for, and from where, unless the user says otherwise.
struct Habit {
  const char* kind;
  const char* field;
  double azimuth_deg, elevation_deg;
};
constexpr Habit kHabits[] = {{"leaf", "water", -60, 40},
                             {"fruit", "moisture_wb", -90, 10},
                             {"floor", "wear_depth_um", -90, 89}};

void set_habits(VolumeOptions& o) {
  const bool folder = fs::is_directory(o.input);
  const std::string kind = folder ? read_run(o.input).kind : "";
  for (const Habit& h : kHabits) {
    if (kind != h.kind) continue;
    o.volume.field = h.field;
    o.volume.azimuth_deg = h.azimuth_deg;
    o.volume.elevation_deg = h.elevation_deg;
  }
  if (!o.field.empty()) o.volume.field = o.field;
  o.volume.azimuth_deg = o.azimuth_deg.value_or(o.volume.azimuth_deg);
  o.volume.elevation_deg = o.elevation_deg.value_or(o.volume.elevation_deg);
}

void volume(VolumeOptions& o, const bool& quiet) {
  Console console(quiet);
  if (!fs::exists(o.input)) throw IoFailure("'" + o.input + "': no such file or folder");
  set_habits(o);
  field_spec(o.volume.field);  // an unknown name is an error here, with the nearest known one
  if (!o.size.empty()) std::tie(o.volume.width_px, o.volume.height_px) = parse_size(o.size);
  if (!o.range.empty()) o.volume.range = parse_range(o.range);
  fs::path file = o.input;
  if (fs::is_directory(file))
    file = frame_file(o, console);
  else if (o.day || o.wd)
    throw InvalidInput("--day and --wd choose a key frame of a run's folder; '" + o.input +
                       "' is a single file");
  vis::render_volume(file, o.png, o.volume);
  console.say(o.png);
}

}  // namespace

void add_volume_command(CLI::App& app, const bool& quiet) {
  const auto o = std::make_shared<VolumeOptions>();
  CLI::App* c =
      app.add_subcommand("volume", "Picture of a field (volume rendering or a surface), without a display");
  c->footer(kVolumeFooter);
  c->add_option("INPUT", o->input, "A .vti or .vtp file, or the folder of a run")
      ->required();
  c->add_option("-o,--output", o->png, "Picture to write (PNG)")->required();
  c->add_option("--field", o->field, "What to show (default: water; of fruit moisture_wb, of floors wear_depth_um)");
  c->add_flag("--surface", o->volume.surface,
              "The surface of the grass coloured by the field: quicker than the volume");
  CLI::Option* day = c->add_option("--day", o->day, "Key frame of a run nearest to this day");
  c->add_option("--wd", o->wd, "Key frame of a run nearest to this weathering degree")
      ->check(CLI::Range(0.0, 1.0))
      ->excludes(day);
  c->add_option("--azimuth", o->azimuth_deg, "Camera, degrees counter-clockwise from +x (default of grass: -70)")
      ->check(CLI::Range(-360.0, 360.0));
  c->add_option("--elevation", o->elevation_deg, "Camera, degrees above the ground (default of grass: 18)")
      ->check(CLI::Range(-89.0, 89.0));
  c->add_option("--zoom", o->volume.zoom, "Larger is nearer")
      ->check(CLI::Range(0.05, 50.0))
      ->capture_default_str();
  c->add_option("--size", o->size, "Size of the picture (default 1280x720)")->type_name("WxH");
  c->add_option("--range", o->range, "Ends of the colour scale, in the field's unit")->type_name("LO,HI");
  c->callback([o, &quiet] { volume(*o, quiet); });
}

}  // namespace witherfield::cli
