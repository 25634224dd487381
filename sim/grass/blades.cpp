#include "sim/grass/blades.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"

namespace witherfield::grass {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double wrap(double x, double period) { return x - period * std::floor(x / period); }
double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// A tuft: where it stands; its blades lean outward.
std::vector<glm::dvec2> make_tufts(const BladeOptions& o, double tile_m, std::uint64_t seed, std::uint64_t sample) {
  if (!o.tufts_at.empty()) {
    std::vector<glm::dvec2> tufts;
    for (const auto& [x, y] : o.tufts_at) tufts.emplace_back(x * tile_m, y * tile_m);
    return tufts;
  }
  const int n = std::max(1, int(std::lround(o.clumping * o.count / o.blades_per_tuft)));
  std::vector<glm::dvec2> tufts;
  for (int i = 0; i < n; ++i) {
    Random r(seed, Stream::clumps, (sample << 32) | std::uint64_t(i));
    const double x = r.uniform() * tile_m;
    tufts.emplace_back(x, r.uniform() * tile_m);
  }
  return tufts;
}

}  // namespace

std::vector<Blade> make_blades(const BladeOptions& o, double tile_m, const SeasonOptions& season, double brightness_sd,
                               std::uint64_t seed, std::uint64_t sample) {
  const std::vector<glm::dvec2> tufts = make_tufts(o, tile_m, seed, sample);
  const int grid = int(std::ceil(std::sqrt(double(o.count))));
  std::vector<Blade> blades;
  blades.reserve(std::size_t(o.count));
  for (int i = 0; i < o.count; ++i) {
    Random r(seed, Stream::blades, (sample << 32) | std::uint64_t(i));
    Blade b;
    const bool in_tuft = r.uniform() < o.clumping;
    double outward = r.uniform(0, 2 * std::numbers::pi);
    if (in_tuft) {
      const glm::dvec2 c = tufts[std::min(tufts.size() - 1, std::size_t(r.uniform() * double(tufts.size())))];
      const double dx = o.tuft_radius_m * r.normal(), dy = o.tuft_radius_m * r.normal();
      b.root_m = {wrap(c.x + dx, tile_m), wrap(c.y + dy, tile_m), 0};
      if (dx != 0 || dy != 0) outward = std::atan2(dy, dx) + 0.9 * r.normal();
    } else {  // jittered grid: even cover between the tufts
      b.root_m = {(i % grid + r.uniform()) / grid * tile_m, wrap((i / grid + r.uniform()) / grid, 1.0) * tile_m, 0};
    }
    const double size = r.uniform();  // long blades are wide: one draw moves both
    b.length_m = o.length_m.lo + (o.length_m.hi - o.length_m.lo) * size;
    b.width_m = o.width_m.lo + (o.width_m.hi - o.width_m.lo) * (0.6 * size + 0.4 * r.uniform());
    b.thickness_m = r.uniform(o.thickness_m.lo, o.thickness_m.hi);
    b.azimuth_rad = wrap(outward, 2 * std::numbers::pi);
    b.lean_rad = std::min(80 * kDegree, (o.lean_mean_deg + std::abs(r.normal()) * o.lean_sd_deg) * kDegree);
    const double u = r.uniform();
    b.curl_rad = (o.curl_deg.lo + (o.curl_deg.hi - o.curl_deg.lo) * u * u) * kDegree;
    b.sway_rad = 0.35 * r.normal();
    b.twist_rad = o.twist_sd_deg * kDegree * r.normal();
    b.fold_rad = r.uniform(o.fold_deg.lo, o.fold_deg.hi) * kDegree;
    Random onset(seed, Stream::onset, (sample << 32) | std::uint64_t(i));
    b.onset = onset.truncated_normal(season.onset_mean, season.onset_sd, 0.05, 0.95);
    Random colour(seed, Stream::colour, (sample << 32) | std::uint64_t(i));
    b.brightness = colour.truncated_normal(1.0, brightness_sd, 0.5, 1.5);
    blades.push_back(b);
  }
  return blades;
}

double width_profile(BladeForm form, double s) {
  if (form == BladeForm::cone) return std::max(0.0, 1 - s);
  if (s >= 1) return 0;
  return (0.62 + 0.38 * smooth(s / 0.25)) * (1 - std::pow(s, 2.6));  // narrow foot, parallel sides, pointed tip
}

BladeRibbons to_ribbons(const std::vector<const BladeState*>& states) {
  BladeRibbons out;
  for (const BladeState* s : states) {
    if (out.nodes_per_blade && out.nodes_per_blade != s->nodes_per_blade())
      throw InvalidInput("to_ribbons: samples differ in the number of segments");
    out.nodes_per_blade = s->nodes_per_blade();
    out.cone = s->form == BladeForm::cone;
    for (std::size_t i = 0; i < s->node_m.size(); ++i) {
      out.center_m.push_back(s->node_m[i]);
      out.tangent.push_back(glm::vec3(s->tangent[i]));
      out.side.push_back(glm::vec3(s->side[i]));
      out.half_width_m.push_back(s->half_width_m[i]);
      out.fold_rad.push_back(s->fold_rad[i]);
      out.thickness_m.push_back(s->thickness_m[i]);
      out.diffuse.push_back(s->diffuse[i]);
      out.water.push_back(s->water[i]);
      out.chlorophyll_ug_cm2.push_back(float(s->chlorophyll[i] * s->chlorophyll_fresh_ug_cm2));
    }
  }
  return out;
}

}  // namespace witherfield::grass
