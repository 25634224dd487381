#include "sim/core/fields.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "sim/core/errors.hpp"

namespace witherfield {
namespace {

constexpr std::array kFields{
    FieldSpec{"density", "1", 1, 0, 1e6, "Density"},
    FieldSpec{"water", "1", 1, 0, 1, "Relative water content"},
    FieldSpec{"chlorophyll_ug_cm2", "ug/cm2", 1, 0, 150, "Chlorophyll"},
    FieldSpec{"stress_vein_MPa", "MPa", 1, -1e4, 1e4, "Stress in the vein"},
    FieldSpec{"stress_mesophyll_MPa", "MPa", 1, -1e4, 1e4, "Stress in the mesophyll"},
    FieldSpec{"strain_shrink", "1", 1, -1, 1, "Volumetric strain"},
    FieldSpec{"tissue", "1", 1, 0, 2, "Tissue (0 air, 1 vein, 2 mesophyll)"},
    FieldSpec{"blade_id", "1", 1, 0, 1e9, "Blade"},
    FieldSpec{"normal", "1", 3, -1, 1, "Normal"},
    FieldSpec{"tangent", "1", 3, -1, 1, "Tangent"},
    FieldSpec{"diffuse", "1", 3, 0, 1, "Diffuse reflectance (linear sRGB)"},
    FieldSpec{"specular", "1", 1, 0, 1, "Specular reflectance"},
    FieldSpec{"mass_kg", "kg", 1, 0, 1e3, "Mass"},
    FieldSpec{"velocity_m_s", "m/s", 3, -100, 100, "Velocity"},
    FieldSpec{"radius_m", "m", 1, 0, 1, "Radius"},
    FieldSpec{"elevation_m", "m", 1, -1e4, 1e4, "Elevation"},
    FieldSpec{"texel_id", "1", 1, 0, 1e6, "Texel"},
    FieldSpec{"rotation", "1", 1, -4, 3, "Quarter turns (negative: mirrored)"},
    FieldSpec{"lod", "1", 1, 0, 3, "Level of detail"},
    FieldSpec{"organ_id", "1", 1, 0, 100, "Organ"},
    FieldSpec{"kernel_id", "1", 1, -1, 1e6, "Kernel (-1: none)"},
    FieldSpec{"sharpness", "1", 1, 0, 3, "Subdivision tag (0 smooth, 1 dart, 2 crease, 3 sharp)"},
    FieldSpec{"moisture_wb", "1", 1, 0, 1, "Kernel moisture, wet basis"},
    FieldSpec{"uv", "1", 2, -1e3, 1e3, "Texture coordinates"},
    FieldSpec{"vein", "1", 1, 0, 1, "Vein"},
    FieldSpec{"strain_area", "1", 1, -1, 10, "Areal strain"},
    FieldSpec{"stress_von_mises_MPa", "MPa", 1, 0, 1e4, "Von Mises stress"},
    FieldSpec{"displacement_m", "m", 3, -10, 10, "Displacement"},
    FieldSpec{"footfalls", "1", 1, 0, 1e12, "Footfalls"},
    FieldSpec{"dose_N_s_m2", "N s/m2", 1, 0, 1e15, "Pressure times time"},
    FieldSpec{"slide_m", "m", 1, 0, 1e9, "Sliding path"},
    FieldSpec{"wear_depth_um", "um", 1, 0, 1e6, "Wear depth"},
    FieldSpec{"gloss", "1", 1, 0, 1, "Gloss"},
    FieldSpec{"dirt", "1", 1, 0, 1, "Dirt"},
    FieldSpec{"height_m", "m", 1, -100, 100, "Height"},
    FieldSpec{"person", "1", 1, 0, 4.3e9, "Visit"},
    FieldSpec{"behaviour", "1", 1, 0, 2, "Behaviour (0 patrol, 1 round trip, 2 pass)"},
    FieldSpec{"phase", "1", 1, 0, 3, "Phase (0 out, 1 round, 2 stand, 3 back)"},
    FieldSpec{"foot", "1", 1, 0, 1, "Foot (0 left, 1 right)"},
    FieldSpec{"kind", "1", 1, 0, 7, "Sole (0 man, 1 woman, 2 man sliding, 3 woman sliding)"},
    FieldSpec{"heading_rad", "rad", 1, -3.15, 3.15, "Heading"},
    FieldSpec{"weight_N", "N", 1, 0, 1e4, "Weight"},
    FieldSpec{"time_s", "s", 1, 0, 1e12, "Time"},
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::span<const FieldSpec> all_fields() { return kFields; }

const FieldSpec& field_spec(std::string_view name) {
  for (const FieldSpec& f : kFields)
    if (f.name == name) return f;
  const auto nearest = std::min_element(kFields.begin(), kFields.end(), [&](const FieldSpec& a, const FieldSpec& b) {
    return edit_distance(name, a.name) < edit_distance(name, b.name);
  });
  throw InvalidInput("unknown field '" + std::string(name) + "'; did you mean '" + std::string(nearest->name) + "'?");
}

}  // namespace witherfield
