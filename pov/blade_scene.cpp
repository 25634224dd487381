#include "pov/blade_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "pov/blade_mesh.hpp"
#include "pov/png.hpp"
#include "pov/texel_scene.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kAmbientFull = 2.0;  // radiance that is full scale in the picture of ambient light

/// Detail by the blade's width on the picture, in pixels.
int detail_level(double width_px) {
  return width_px > 6 ? 0 : width_px > 2 ? 1 : width_px > 0.6 ? 2 : 3;
}
BladeDetail detail_of(int level) {
  constexpr BladeDetail kDetail[] = {{14, true}, {8, true}, {5, false}, {3, false}};
  return kDetail[level];
}

/// A grid of the variant to carry the light: about 1.5 mm a voxel is plenty for blades.
const TexelGrid* light_grid(const VariantFrame& v) {
  const TexelGrid* best = nullptr;
  for (int l = 3; l >= 0; --l)
    for (const TexelGrid* g : {v.tile[l], v.lod[l]})
      if (g && (!best || best->shape().spacing_m > 0.0016)) best = g;
  return best;
}

struct BladeWriter {
  const SceneContext& c;
  Text declarations = {};
  GroundLight ground = {};
  std::map<int, bool> textured = {};

  const BladeRibbons& blades(int variant) const {
    const BladeRibbons* b = c.input->variants[std::size_t(variant)].blades;
    if (!b) throw InvalidInput("write_scenes: variant " + std::to_string(variant) + " has no blades");
    return *b;
  }

  /// Light along the blades of a variant and its three pictures; declares texture V<variant>.
  void declare_texture(int variant, bool alone) {
    if (textured[variant]) return;
    textured[variant] = true;
    const BladeRibbons& b = blades(variant);
    const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
    std::vector<float> sky(b.center_m.size(), 1.0f);
    glm::dvec3 albedo(0.1);
    if (const TexelGrid* grid = light_grid(c.input->variants[std::size_t(variant)])) {
      const TexelPrelight p(*grid, !alone, mean_blade_width_m(*c.input, variant));
      sky = sky_visibility(p.block(), p.per_density(), b.center_m, p.start_m());
      albedo = p.mean_albedo();
      note_ground(p, sun);
    }
    const BladeAtlas atlas = blade_atlas(b, sky, sun, albedo);
    write_pictures(atlas, variant);
    const std::string v = std::to_string(variant), stem = c.stem + "_v" + v;
    const auto picture = [&](const char* which, const char* transmit) {
      return "pigment{uv_mapping image_map{png \"" + stem + which + ".png\" gamma 1.0 interpolate 2" +
             transmit + "}}";
    };
    const double gloss = 0.07 * mean_freshness(b) + 0.03;
    // Three layers, each a third of what is seen: the sun's beam on this side, through the blade, and all
    // other light.
    declarations << "#declare V" << v << "=texture{" << picture("_reflected", "")
                 << " finish{diffuse 3,0 specular " << 3 * gloss << " roughness 0.035}}\n texture{"
                 << picture("_transmitted", " transmit all 0.5") << " finish{diffuse 0,3}}\n texture{"
                 << picture("_ambient", " transmit all 0.666667") << " finish{diffuse 0 emission "
                 << 3 * kAmbientFull << "}}\n";
  }

  static double mean_freshness(const BladeRibbons& b) {
    double sum = 0;
    for (float v : b.chlorophyll_ug_cm2) sum += std::min(1.0, v / kFreshChlorophyll);
    return b.chlorophyll_ug_cm2.empty() ? 0 : sum / double(b.chlorophyll_ug_cm2.size());
  }

  void write_pictures(const BladeAtlas& a, int variant) const {
    const std::string stem = c.stem + "_v" + std::to_string(variant);
    std::vector<glm::vec3> ambient = a.ambient;
    for (auto& p : ambient) p /= float(kAmbientFull);
    const int w = a.layout.columns, h = a.layout.height();
    write_png_linear(c.folder / (stem + "_reflected.png"), w, h, a.reflected);
    write_png_linear(c.folder / (stem + "_transmitted.png"), w, h, a.transmitted);
    write_png_linear(c.folder / (stem + "_ambient.png"), w, h, ambient);
  }

  void note_ground(const TexelPrelight& p, const Illumination& sun) {
    const auto shading = p.shade(sun, c.input->still.camera.position_m * 1e3);
    const GroundShares g = p.ground(sun.to_sun);
    ground.add({g.sun, g.sky, scattered_light(sun, p.mean_albedo(), g.sky), shading.mean_sun + shading.mean_rest,
                p.mean_diffuse()},
               1);
  }

  /// The mesh goes to a file of its own: it is large and the same for every instance.
  std::string declare_mesh(int variant, int level) {
    const std::string name = (Text() << "V" << variant << "D" << level).str();
    const std::string file = c.stem + "_" + name + ".inc";
    write_file(c.folder / file, blade_mesh(blades(variant), detail_of(level), c.unit));
    declarations << "#declare " << name << "=#include \"" << file << "\"\n";
    return name;
  }
};

SceneHead head_of(const SceneContext& c) {
  const Still& s = c.input->still;
  return {s.width_px, s.height_px, s.exposure, "blades", s.camera.aperture_m > 0, c.around != nullptr};
}

}  // namespace

std::filesystem::path write_blade_field(const SceneContext& c, const Progress& progress) {
  BladeWriter w{c};
  const Eye eye(c.input->still);
  // Grass outside the view still throws shadows into it, as long as it is tall.
  const double reach = 2 * c.input->tile_m / std::tan(c.input->still.sun.elevation_deg * 3.14159265 / 180);
  const StandPlan plan = plan_stands(*c.input, c.around, std::min(reach, 4 * c.input->tile_m));
  std::map<std::pair<int, int>, std::string> meshes;
  Text instances;
  for (const Stand& s : plan.stands) {
    const double width = mean_blade_width_m(*c.input, s.at.variant);
    const int level = std::max(1, detail_level(width * eye.pixels_per_rad / s.distance_m));
    std::string& mesh = meshes[{s.at.variant, level}];
    if (mesh.empty()) {
      if (progress) progress("writing blades", 0.5);
      w.declare_texture(s.at.variant, false);
      mesh = w.declare_mesh(s.at.variant, level);
    }
    instances << "object{" << mesh << " texture{V" << s.at.variant << "}"
              << instance_matrix(s.at, c.input->tile_m, c.unit) << "}\n";
  }
  Text t;
  t << head_text(head_of(c), c.stem) << atmosphere_text(c) << terrain_text(c, w.ground, true)
    << w.declarations.str() << instances.str();
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

std::filesystem::path write_blades_alone(const SceneContext& c, const Progress& progress) {
  if (progress) progress("writing blades", 0);
  BladeWriter w{c};
  w.declare_texture(0, true);
  const std::string mesh = w.declare_mesh(0, 0);
  const TexelGrid* grid = light_grid(c.input->variants[0]);
  if (!grid) throw InvalidInput("write_scenes: variant 0 has no texel");
  const TexelPrelight light(*grid, false, mean_blade_width_m(*c.input, 0));
  Text t;
  t << head_text(head_of(c), c.stem) << atmosphere_text(c) << studio_text(c, light, false)
    << w.declarations.str() << "object{" << mesh << " texture{V0}}\n";
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
