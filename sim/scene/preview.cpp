#include <algorithm>
#include <cmath>

#include "sim/scene/scene_keys.hpp"

namespace witherfield::scene {
namespace {

constexpr int kResolution = 64, kFrames = 3, kTexels = 12, kSegments = 8, kBlades = 1600, kVariants = 2;
constexpr int kWidthPx = 240, kHeightPx = 135;
constexpr double kStepsPerDay = 4, kLargestTile_m = 10;  // texel.size_m goes no higher

/// At most kFrames key frames: those that the stills show come first, then the first and the last of the
/// season.
std::vector<double> few_frames(const std::vector<double>& frames, const std::vector<Still>& stills) {
  std::vector<double> wanted;
  for (const Still& still : stills) wanted.push_back(still.wd);
  wanted.push_back(frames.front());
  wanted.push_back(frames.back());
  wanted.insert(wanted.end(), frames.begin(), frames.end());
  std::vector<double> kept;
  for (const double wd : wanted)
    if (int(kept.size()) < kFrames && std::find(kept.begin(), kept.end(), wd) == kept.end())
      kept.push_back(wd);
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Most blades of one sample: all samples together have kBlades.
int most_blades(const GrassScene& scene) {
  return std::max(1, kBlades / int(scene.grass.samples.size()));
}

/// Fewer, larger tiles over the same terrain, with the same number of blades to the square metre (up to
/// kBlades).
void fewer_texels(GrassScene& scene) {
  terrain::PlacementOptions& p = scene.placement;
  const double width = p.cells_x * scene.grass.texel.size_m;
  const int cells =
      std::min(std::max(p.cells_x, 1), std::max(kTexels, int(std::ceil(width / kLargestTile_m))));
  if (cells >= p.cells_x) {
    p.cells_y = std::min(p.cells_y, kTexels);
    return;
  }
  const double factor = double(p.cells_x) / cells;
  p.cells_y = std::max(1, int(std::floor(p.cells_y / factor)));
  p.cells_x = cells;
  scene.grass.texel.size_m = width / cells;
  for (grass::SampleOptions& s : scene.grass.samples)
    s.blades.count =
        std::max(s.blades.count, int(std::min(double(most_blades(scene)), s.blades.count * factor * factor)));
}

}  // namespace

void shrink_to_preview(GrassScene& scene) {
  grass::GrassOptions& o = scene.grass;
  o.texel.resolution = std::min(o.texel.resolution, kResolution);
  o.season.steps_per_day = std::min(o.season.steps_per_day, kStepsPerDay);
  o.variants = scene.placement.variants = std::min(o.variants, kVariants);
  o.wd_frames = few_frames(o.wd_frames, scene.stills);
  o.wd_frames_other_variants.clear();
  if (scene.terrain) fewer_texels(scene);
  for (grass::SampleOptions& s : o.samples) {
    s.season.steps_per_day = o.season.steps_per_day;
    s.blades.segments = std::min(s.blades.segments, kSegments);
    s.blades.count = std::min(s.blades.count, most_blades(scene));
  }
  std::erase_if(scene.stills, [&](const Still& still) {
    return std::find(o.wd_frames.begin(), o.wd_frames.end(), still.wd) == o.wd_frames.end();
  });
  for (Still& still : scene.stills) {
    const double factor =
        std::min({1.0, double(kWidthPx) / still.width_px, double(kHeightPx) / still.height_px});
    still.width_px = std::max(16, int(still.width_px * factor));
    still.height_px = std::max(16, int(still.height_px * factor));
  }
}

}  // namespace witherfield::scene
