#include "pov/media.hpp"

#include <algorithm>
#include <cmath>

#include "pov/df3.hpp"

namespace witherfield::pov {
namespace {

/// Value that a share q of the positive entries does not exceed.
double quantile(std::vector<float> v, double q) {
  v.erase(std::remove_if(v.begin(), v.end(), [](float x) { return !(x > 0); }), v.end());
  if (v.empty()) return 1;
  const auto at = v.begin() + std::ptrdiff_t(q * double(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

/// The lowest layer of grass stands also for the half voxel below it (see media_block).
void repeat_ground(std::vector<float>& samples, const MediaBlock& b) {
  const std::size_t layer = std::size_t(b.nx) * b.ny;
  std::copy_n(samples.begin() + std::ptrdiff_t(layer), layer, samples.begin());
}

void declare(Text& scene, const SceneContext& c, const MediaBlock& b, const std::vector<float>& samples, double full,
             const std::string& name) {
  const std::string file = c.stem + "_" + name + ".df3";
  write_file(c.folder / file, encode_df3(samples, b.nx, b.ny, b.nz, full));
  const double h = b.spacing_m * c.unit;
  // DF3 sample i lies at i/N of the unit cube: scaled to N voxels, the first sample is moved to its place.
  scene << "#declare " << name << "=density{density_file df3 \"" << file << "\" interpolate 1 scale <" << b.nx * h << ","
        << b.nz * h << "," << b.ny * h << "> translate " << flip(b.first_m, c.unit) << "}\n";
}

}  // namespace

double declare_density(Text& scene, const SceneContext& c, const TexelPrelight& light, const MediaBlock& block,
                       const std::string& name) {
  std::vector<float> samples(std::size_t(block.nx) * block.ny * block.nz, 0.0f);
  for (std::size_t i = 0; i < block.target.size(); ++i) samples[block.target[i]] += light.density()[i];
  const double full = quantile(samples, 0.995);  // a few crowded voxels are opaque anyhow
  repeat_ground(samples, block);
  declare(scene, c, block, samples, full, name);
  return full;
}

double declare_emission(Text& scene, const SceneContext& c, const TexelPrelight& light, const MediaBlock& block,
                        const std::vector<glm::vec3>& radiance, double full_density, const std::string& name) {
  const std::size_t n = std::size_t(block.nx) * block.ny * block.nz;
  std::vector<float> density(n, 0.0f);
  for (std::size_t i = 0; i < block.target.size(); ++i) density[block.target[i]] += light.density()[i];
  std::vector<float> samples[3];
  double full = 0;
  for (int k = 0; k < 3; ++k) {
    samples[k].assign(n, 0.0f);
    for (std::size_t i = 0; i < block.target.size(); ++i) {
      const std::size_t s = block.target[i];
      // Where the density is cut off at full scale, the emission must be cut by the same factor.
      const float cut = std::min(1.0f, float(full_density) / density[s]);
      samples[k][s] += light.density()[i] * cut * radiance[i][k];
    }
    full = std::max(full, quantile(samples[k], 0.999));
  }
  const char* channel = "RGB";
  for (int k = 0; k < 3; ++k) {
    repeat_ground(samples[k], block);
    declare(scene, c, block, samples[k], full, name + channel[k]);
  }
  return full;
}

std::string interior_text(const MediaNames& names, const glm::dvec3& factor, const std::string& intervals) {
  // Method 2, one sample an interval, no jitter: the only setting without bias (jitter is one-sided, method 3 never samples the
  // far end and does not attenuate within a step).
  const std::string head = "media{method 2 intervals " + intervals + " samples 1,1 jitter 0 ";
  Text t;
  t << "interior{" << head << "absorption " << names.absorption << " density{" << names.density << "}}\n";
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 e(0.0);
    e[k] = names.emitted * factor[k];
    t << head << "emission rgb" << e << " density{" << names.emission[k] << "}}\n";
  }
  t << "}";
  return t.str();
}

}  // namespace witherfield::pov
