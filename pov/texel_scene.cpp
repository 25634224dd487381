#include "pov/texel_scene.hpp"

#include <algorithm>

#include "pov/media.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {
constexpr double kSharpIntervals = 2;  // a sharp edge must not fall between two samples of a ray
}

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

const TexelGrid& grid_of(const SceneInput& input, int variant, int lod) {
  const VariantFrame& v = input.variants[std::size_t(variant)];
  for (int l : {lod, lod + 1, lod + 2, lod + 3, lod - 1, lod - 2, lod - 3})
    if (l >= 0 && l < 4)
      for (const TexelGrid* g : {v.lod[l], v.tile[l]})
        if (g) return *g;
  throw InvalidInput("write_scenes: variant " + std::to_string(variant) + " has no texel");
}

glm::dvec3 slope_factor(const TexelInstance& t, const glm::dvec3& to_sun, const TexelPrelight::Shading& s) {
  const double facing =
      std::clamp((to_sun.z - t.slope_x * to_sun.x - t.slope_y * to_sun.y) / to_sun.z, 0.0, 2.2);
  const double beam = t.sun_visibility * (0.35 + 0.65 * facing);
  const glm::dvec3 all = s.mean_sun + s.mean_rest;
  glm::dvec3 f(1.0);
  for (int k = 0; k < 3; ++k)
    if (all[k] > 0) f[k] = (s.mean_sun[k] * beam + s.mean_rest[k]) / all[k];
  return f;
}

std::filesystem::path write_texel_alone(const SceneContext& c, const Progress& progress) {
  if (progress) progress("lighting the texel", 0);
  const TexelGrid& grid = grid_of(*c.input, 0, 0);
  const TexelPrelight light(grid, false, mean_blade_width_m(*c.input, 0));
  const Illumination sun{c.input->still.sun.direction(), c.day->sun_rgb, c.day->sky_rgb};
  const TexelPrelight::Shading shading = light.shade(sun, c.input->still.camera.position_m);
  const MediaBlock block = media_block(grid, false);
  MediaSamples samples(block);
  add_texel(samples, block, grid, light, shading.radiance, false);
  const std::vector<MediaPiece> pieces = find_pieces(block, samples.density, 20);
  Text declarations;
  const MediaNames names = declare_sharp(declarations, c, block, samples, {}, "A");
  const Still& still = c.input->still;
  Text t;
  t << head_text({still.width_px, still.height_px, still.exposure, "texel", false, false}, c.stem)
    << atmosphere_text(c) << quality_text() << studio_text(c, light, true) << declarations.str()
    << boxes_text(c, block, pieces, box_overlap(0, 0), names, light.per_density(), glm::dvec3(1.0), "", 1,
                  kSharpIntervals);
  const auto path = c.folder / (c.stem + ".pov");
  write_file(path, t.str());
  return path;
}

}  // namespace witherfield::pov
