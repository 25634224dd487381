#include "pov/texel_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "pov/media.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr int kMostIntervals = 250;  // POV-Ray stops above 254 ("internal nesting limit")

int wrap(int i, int n) { return ((i % n) + n) % n; }

/// Texels of one variant at one LOD, near (with overhang) or far (folded tile), by orientation.
struct Group {
  int variant, lod;
  bool near;
  auto operator<=>(const Group&) const = default;
};

const TexelGrid& grid_of(const SceneInput& in, int variant, int lod) {
  const VariantFrame& v = in.variants[std::size_t(variant)];
  for (int l = lod; l < 4; ++l)
    for (const TexelGrid* g : {v.lod[l], v.tile[l]})
      if (g) return *g;
  for (int l = lod - 1; l >= 0; --l)
    for (const TexelGrid* g : {v.lod[l], v.tile[l]})
      if (g) return *g;
  throw InvalidInput("write_scenes: variant " + std::to_string(variant) + " has no texel");
}

Illumination light_for(const SceneContext& c, const TexelInstance& t) {
  return {to_local_direction(t, c.input->still.sun.direction()), c.day->sun_rgb, c.day->sky_rgb};
}

std::string quality_text() {
  return "#declare IQ=(QUALITY=0?0.6:(QUALITY=1?1.0:1.4));\n";
}

std::string intervals_text(int samples) {
  return (Text() << "max(6,min(" << kMostIntervals << ",int(" << samples << "*IQ)))").str();
}

/// Boxes of one texel: one, or as many side by side as keep each within POV-Ray's limit of intervals.
std::string boxes_text(const SceneContext& c, const MediaBlock& b, double inset, const MediaNames& names,
                       const glm::dvec3& factor, const std::string& transform) {
  const double tile = c.input->tile_m, inset_m = inset * tile;
  const glm::dvec3 lo = b.box_lo_m + glm::dvec3(inset_m), hi = b.box_hi_m - glm::dvec3(inset_m);
  const glm::dvec3 size = hi - lo;
  const auto pieces = [&](double edge) { return std::max(1, int(std::ceil(edge / b.spacing_m / 190))); };
  const int px = pieces(size.x), py = pieces(size.y);
  const double split = 2e-5 * tile;  // pieces must not share a face either
  const int samples = int(std::ceil(std::max({size.x / px, size.y / py, size.z}) / b.spacing_m));
  Text t;
  for (int j = 0; j < py; ++j)
    for (int i = 0; i < px; ++i) {
      const glm::dvec3 a{lo.x + size.x * i / px + (i ? split : 0), lo.y + size.y * j / py + (j ? split : 0), lo.z};
      const glm::dvec3 z{lo.x + size.x * (i + 1) / px - (i + 1 < px ? split : 0),
                         lo.y + size.y * (j + 1) / py - (j + 1 < py ? split : 0), hi.z};
      t << "box{" << flip(a, c.unit) << "," << flip(z, c.unit) << " hollow no_shadow pigment{rgbt 1}\n"
        << interior_text(names, factor, intervals_text(samples)) << transform << "}\n";
    }
  return t.str();
}

/// Sun on a slope and in the terrain's shadow, for an emission that was baked for level lit ground.
glm::dvec3 slope_factor(const TexelInstance& t, const glm::dvec3& to_sun, const TexelPrelight::Shading& s) {
  const double facing = std::clamp((to_sun.z - t.slope_x * to_sun.x - t.slope_y * to_sun.y) / to_sun.z, 0.0, 2.2);
  const double beam = t.sun_visibility * (0.35 + 0.65 * facing);
  const glm::dvec3 all = s.mean_sun + s.mean_rest;
  glm::dvec3 f(1.0);
  for (int k = 0; k < 3; ++k)
    if (all[k] > 0) f[k] = (s.mean_sun[k] * beam + s.mean_rest[k]) / all[k];
  return f;
}

struct FieldWriter {
  const SceneContext& c;
  const Progress& progress;
  std::vector<Stand> stands;
  std::map<std::pair<int, int>, std::unique_ptr<TexelPrelight>> lights = {};  // variant, lod
  Text declarations = {}, boxes = {};
  GroundLight ground = {};
  double ground_weight = 0;

  TexelPrelight& light(int variant, int lod) {
    auto& p = lights[{variant, lod}];
    if (!p) p = std::make_unique<TexelPrelight>(grid_of(*c.input, variant, lod), true, mean_blade_width_m(*c.input, variant));
    return *p;
  }

  void note_ground(const TexelPrelight& p, const TexelPrelight::Shading& s, double weight) {
    const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
    const double sky = p.ground_sky(), beam = p.ground_sun(sun.to_sun), w0 = ground_weight, w = w0 + weight;
    const auto mix = [&](auto& into, const auto& value) { into = (into * w0 + value * weight) / w; };
    mix(ground.sun, beam);
    mix(ground.sky, sky);
    mix(ground.scattered_rgb, scattered_light(sun, p.mean_albedo(), sky));
    mix(ground.canopy_rgb, s.mean_sun + s.mean_rest);
    mix(ground.litter_rgb, p.mean_diffuse());
    ground_weight = w;
  }

  void write_group(const Group& g, const std::vector<const Stand*>& members) {
    TexelPrelight& p = light(g.variant, g.lod);
    const MediaBlock block = media_block(grid_of(*c.input, g.variant, g.lod), p, !g.near);
    const std::string name =
        (Text() << (g.near ? "N" : "F") << g.variant << "L" << g.lod).str();
    const double full = declare_density(declarations, c, p, block, name + "D");
    std::array<std::vector<const Stand*>, 8> by_orientation;
    for (const Stand* s : members) by_orientation[std::size_t(s->orientation())].push_back(s);
    for (std::size_t o = 0; o < 8; ++o) {
      if (by_orientation[o].empty()) continue;
      write_orientation(p, block, full, name + "o" + std::to_string(o), by_orientation[o]);
    }
  }

  void write_orientation(const TexelPrelight& p, const MediaBlock& block, double full, const std::string& name,
                         const std::vector<const Stand*>& members) {
    // One shading serves all texels that stand alike: seen from their mean direction.
    glm::dvec3 to_eye(0.0);
    for (const Stand* s : members)
      to_eye += glm::normalize(c.input->still.camera.position_m - s->at.origin_m) / s->distance_m;
    const glm::dvec3 eye = to_local_direction(members.front()->at, glm::normalize(to_eye)) * 1e4;
    const TexelPrelight::Shading shading = p.shade(light_for(c, members.front()->at), eye);
    const double full_emission = declare_emission(declarations, c, p, block, shading.radiance, full, name);
    note_ground(p, shading, double(members.size()));
    MediaNames names;
    names.density = name.substr(0, name.find('o')) + "D";
    for (int k = 0; k < 3; ++k) names.emission[k] = name + "RGB"[k];
    const double per_unit = p.per_density() / (block.spacing_m * c.unit);
    names.absorption = per_unit * full;
    names.emitted = per_unit * full_emission;
    for (const Stand* s : members)
      boxes << boxes_text(c, block, box_inset(s->at.cell_i, s->at.cell_j), names,
                          slope_factor(s->at, c.input->still.sun.direction(), shading),
                          instance_matrix(s->at, c.input->tile_m, c.unit));
  }
};

}  // namespace

double mean_blade_width_m(const SceneInput& input, int variant) {
  const BladeRibbons* b = input.variants[std::size_t(variant)].blades;
  if (!b || b->blade_count() == 0) return 0.003;
  double sum = 0;
  for (int i = 0; i < b->blade_count(); ++i) {
    const auto first = b->half_width_m.begin() + std::ptrdiff_t(i) * b->nodes_per_blade;
    sum += 2.0 * *std::max_element(first, first + b->nodes_per_blade);
  }
  return sum / b->blade_count();
}

MediaBlock media_block(const TexelGrid& grid, const TexelPrelight& light, bool folded) {
  const GridShape& s = grid.shape();
  const TexelGrid::Box box = grid.occupied_box();
  MediaBlock b;
  b.spacing_m = s.spacing_m;
  glm::ivec3 base;
  if (folded) {
    base = {s.margin, s.margin, -1};
    b.nx = s.nx - 2 * s.margin;
    b.ny = s.ny - 2 * s.margin;
  } else {
    base = {box.lo.x - 1, box.lo.y - 1, -1};
    b.nx = box.hi.x - box.lo.x + 2;
    b.ny = box.hi.y - box.lo.y + 2;
  }
  b.nz = box.hi.z + 2;
  b.first_m = s.origin_m + (glm::dvec3(base) + 0.5) * s.spacing_m;
  b.box_lo_m = folded ? s.origin_m + glm::dvec3(base.x, base.y, 0) * s.spacing_m : b.first_m;
  b.box_hi_m = folded ? b.box_lo_m + glm::dvec3(b.nx, b.ny, 0) * s.spacing_m
                      : b.first_m + glm::dvec3(b.nx - 1, b.ny - 1, 0) * s.spacing_m;
  b.box_lo_m.z = s.origin_m.z;
  b.box_hi_m.z = b.first_m.z + (b.nz - 1) * s.spacing_m;  // the empty layer: clipped before the wrap
  b.target.reserve(light.voxels().size());
  for (const glm::ivec3& v : light.voxels()) {
    glm::ivec3 p = v - base;
    if (folded) p = {wrap(p.x, b.nx), wrap(p.y, b.ny), p.z};
    b.target.push_back((std::size_t(p.z) * b.ny + p.y) * b.nx + p.x);
  }
  return b;
}

std::filesystem::path write_texel_field(const SceneContext& c, const Progress& progress) {
  FieldWriter w{c, progress, plan_stands(*c.input, c.around, 0)};
  std::map<Group, std::vector<const Stand*>> groups;
  for (const Stand& s : w.stands) groups[{s.at.variant, s.at.lod, s.near}].push_back(&s);
  double done = 0;
  for (const auto& [group, members] : groups) {
    if (progress) progress("lighting texels", done / double(groups.size()));
    w.write_group(group, members);
    done += 1;
  }
  SceneHead head{c.input->still.width_px, c.input->still.height_px, c.input->still.exposure, "texel", false};
  Text t;
  t << head_text(head, c.stem) << atmosphere_text(c) << quality_text() << terrain_text(c, w.ground, false)
    << w.declarations.str() << w.boxes.str();
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

std::filesystem::path write_texel_alone(const SceneContext& c, const Progress& progress) {
  if (progress) progress("lighting the texel", 0);
  const TexelGrid& grid = grid_of(*c.input, 0, 0);
  const TexelPrelight light(grid, false, mean_blade_width_m(*c.input, 0));
  const MediaBlock block = media_block(grid, light, false);
  const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
  const TexelPrelight::Shading shading = light.shade(sun, c.input->still.camera.position_m);
  Text declarations;
  MediaNames names{"AD", {"AER", "AEG", "AEB"}, 0, 0};
  const double full = declare_density(declarations, c, light, block, names.density);
  const double full_emission = declare_emission(declarations, c, light, block, shading.radiance, full, "AE");
  const double per_unit = light.per_density() / (block.spacing_m * c.unit);
  names.absorption = per_unit * full;
  names.emitted = per_unit * full_emission;
  SceneHead head{c.input->still.width_px, c.input->still.height_px, c.input->still.exposure, "texel", false};
  Text t;
  t << head_text(head, c.stem) << atmosphere_text(c) << quality_text() << studio_text(c, light, true)
    << declarations.str() << boxes_text(c, block, 0.0004, names, glm::dvec3(1.0), "");
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
