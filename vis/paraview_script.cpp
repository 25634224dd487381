// The ParaView start-up script of a run: the run's table before the text of its kind.
#include <fmt/format.h>

#include <algorithm>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/atomic_file.hpp"
#include "vis/paraview_text.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

struct Preset {
  std::string_view field;
  const char* name;
  bool invert;
};
// As in our own pictures (colour_map.cpp), by the names of ParaView's presets. The first that a run has is
// shown.
constexpr Preset kPresets[] = {{"wear_depth_um", "Inferno (matplotlib)", false},
                               {"moisture_wb", "Viridis (matplotlib)", true},
                               {"water", "Viridis (matplotlib)", true},
                               {"chlorophyll_ug_cm2", "Linear Green (Gr4L)", true},
                               {"stress_vein_MPa", "Inferno (matplotlib)", false},
                               {"stress_mesophyll_MPa", "Inferno (matplotlib)", false},
                               {"stress_von_mises_MPa", "Inferno (matplotlib)", false},
                               {"strain_shrink", "Inferno (matplotlib)", false},
                               {"strain_area", "Cool to Warm (Extended)", false},
                               {"vein", "Viridis (matplotlib)", true},
                               {"organ_id", "Turbo", false},
                               {"kernel_id", "Turbo", false},
                               {"footfalls", "Inferno (matplotlib)", false},
                               {"dose_N_s_m2", "Inferno (matplotlib)", false},
                               {"slide_m", "Inferno (matplotlib)", false},
                               {"gloss", "Viridis (matplotlib)", true},
                               {"dirt", "Viridis (matplotlib)", true},
                               {"height_m", "Viridis (matplotlib)", true},
                               {"tissue", "Viridis (matplotlib)", true},
                               {"blade_id", "Turbo", false},
                               {"density", "Viridis (matplotlib)", true}};

std::string field_line(const Preset& preset, ValueRange range) {
  const FieldSpec& spec = field_spec(preset.field);
  const char* name = preset.name;
  const bool either_sign = spec.name.starts_with("stress_") || spec.name == "strain_area";
  if (either_sign && range.lo < 0 && range.hi > 0) {
    name = "Cool to Warm (Extended)";
    range.hi = std::max(range.hi, -range.lo);
    range.lo = -range.hi;
  }
  if (!(range.hi > range.lo)) range.hi = range.lo + 1;
  return fmt::format("    ('{}', '{}', '{}', {}, {}, '{}', {}),\n", spec.name, spec.title, spec.unit,
                     range.lo, range.hi, name, preset.invert ? "True" : "False");
}

const char* text_of(const std::string& kind) {
  if (kind == "grass") return paraview_text::kGrass;
  if (kind == "leaf" || kind == "fruit") return paraview_text::kSurface;
  if (kind == "floor") return paraview_text::kFloor;
  throw InvalidInput("write_paraview_script: no view of kind '" + kind +
                     "'; there are grass, leaf, fruit, floor");
}

}  // namespace

void write_paraview_script(const std::filesystem::path& file, const std::string& kind,
                           const ValueRanges& ranges) {
  std::string script = paraview_text::kHead;
  script += fmt::format("SERIES = '{}.pvd'\n", kind);
  script +=
      "# name, title, unit, lowest and highest value of the run, colour preset, inverted; the first is "
      "shown\nFIELDS = [\n";
  for (const Preset& p : kPresets)
    if (const auto at = ranges.find(std::string(p.field)); at != ranges.end())
      script += field_line(p, at->second);
  script += "]\n";
  write_whole_file(file, script + paraview_text::kCommon + text_of(kind) + paraview_text::kMain);
}

}  // namespace witherfield::vis
