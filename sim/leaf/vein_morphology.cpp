#include "sim/leaf/vein_morphology.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"
#include "sim/leaf/lobed_outline.hpp"
#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

using glm::dvec2;

/// What the numbers of the random stream stand for.
enum Draw : std::uint64_t { kLeft = 0, kRight = 1, kJitter = 2 };

dvec2 polar(double r, double deg) {
  const double a = deg * std::numbers::pi / 180;
  return {r * std::cos(a), r * std::sin(a)};
}

CucumberHalf draw_half(Random& random, double variation) {
  const CucumberSpans s;
  const auto from = [&](const Span& span) {
    return 0.5 * (span.lo + span.hi) + 0.5 * variation * (span.hi - span.lo) * random.uniform(-1, 1);
  };
  CucumberHalf h;
  h.upper = from(s.upper), h.upper_deg = from(s.upper_deg), h.upper_bend_deg = from(s.upper_bend_deg);
  h.basal = from(s.basal), h.basal_deg = from(s.basal_deg), h.basal_bend_deg = from(s.basal_bend_deg);
  h.sinus_tip = from(s.sinus_tip), h.sinus_side = from(s.sinus_side);
  h.lobe = from(s.lobe), h.lobe_deg = from(s.lobe_deg);
  return h;
}

CucumberHalf mixed(const CucumberHalf& a, const CucumberHalf& b, double t) {
  const auto mix = [t](double x, double y) { return (1 - t) * x + t * y; };
  return {mix(a.upper, b.upper), mix(a.upper_deg, b.upper_deg), mix(a.upper_bend_deg, b.upper_bend_deg),
          mix(a.basal, b.basal), mix(a.basal_deg, b.basal_deg), mix(a.basal_bend_deg, b.basal_bend_deg),
          mix(a.sinus_tip, b.sinus_tip), mix(a.sinus_side, b.sinus_side), mix(a.lobe, b.lobe),
          mix(a.lobe_deg, b.lobe_deg)};
}

/// A vein O-C-G: half its length straight, then turned by `bend_deg`; smooth through C.
std::vector<dvec2> bent_vein(double length, double angle_deg, double bend_deg) {
  const dvec2 c = polar(0.5 * length, angle_deg), g = c + polar(0.5 * length, angle_deg + bend_deg);
  const CubicSpline s({{0, 0, 0}, {c.x, c.y, 0}, {g.x, g.y, 0}});
  std::vector<dvec2> line;
  for (const glm::dvec3& p : s.sample(length / 90, 90)) line.emplace_back(p.x, p.y);
  return line;
}

/// From a to b, sunk towards the base by depth * |ab| in between, with a little unevenness so that it is not stiff.
void add_gap(std::vector<glm::dvec3>& out, const dvec2& a, const dvec2& b, double depth, double jitter, Random& random) {
  constexpr int kPieces = 9;
  const dvec2 along = b - a;
  dvec2 inward(-along.y, along.x);
  if (glm::dot(inward, a) > 0) inward = -inward;
  const double phase = random.uniform(0, 2 * std::numbers::pi);
  for (int k = 1; k < kPieces; ++k) {
    const double t = double(k) / kPieces, wave = 4 * t * (1 - t);
    const double sink = depth * wave * wave + jitter * wave * std::sin(9 * t + phase) + 0.4 * jitter * random.uniform(-1, 1);
    const dvec2 p = a + t * along + sink * inward;
    out.emplace_back(p.x, p.y, 0);
  }
}

/// Base -> tip on the left (y > 0): quadratic curve O-F through the basal lobe, then F-G and G-E.
std::vector<glm::dvec3> cucumber_side(const CucumberHalf& h, const dvec2& f, const dvec2& g, double length, double jitter,
                                      Random& random) {
  std::vector<glm::dvec3> out;
  // Control point of the quadratic such that it passes the lobe half-way.
  const dvec2 lobe = polar(h.lobe * length, h.lobe_deg), control = 2.0 * (lobe - 0.25 * f);
  for (int k = 1; k <= 10; ++k) {
    const double t = k / 11.0;
    const dvec2 p = 2 * t * (1 - t) * control + t * t * f;
    const double uneven = 1 + 0.5 * jitter * random.uniform(-1, 1);
    out.emplace_back(uneven * p.x, uneven * p.y, 0);
  }
  out.emplace_back(f.x, f.y, 0);
  add_gap(out, f, g, h.sinus_side, jitter, random);
  out.emplace_back(g.x, g.y, 0);
  add_gap(out, g, {length, 0}, h.sinus_tip, jitter, random);
  return out;
}

Vein main_vein(std::vector<dvec2> line, double width, double share) {
  Vein v;
  v.line_m = std::move(line);
  v.width_base_m = share * width;
  v.width_tip_m = 0.22 * share * width;
  return v;
}

VeinDraft cucumber_draft(const LeafOptions& o) {
  Random left_random(o.seed, Stream::outline, kLeft), right_random(o.seed, Stream::outline, kRight);
  Random jitter_random(o.seed, Stream::outline, kJitter);
  const CucumberHalf left = draw_half(left_random, o.variation);
  const CucumberHalf right = mixed(left, draw_half(right_random, o.variation), o.asymmetry);
  const double length = o.main_vein_m, jitter = 0.012 * o.variation;
  VeinDraft d;
  std::vector<dvec2> midrib;
  for (int i = 0; i <= 40; ++i) midrib.emplace_back(length * i / 40, 0);
  d.veins.push_back(main_vein(std::move(midrib), o.veins.main_width_m, 1));
  for (const bool is_left : {true, false}) {
    const CucumberHalf& h = is_left ? left : right;
    const double mirror = is_left ? 1 : -1;
    // The veins end a little inside the margin's lobe tips.
    std::vector<dvec2> upper = bent_vein(h.upper * length, h.upper_deg, -h.upper_bend_deg);
    std::vector<dvec2> basal = bent_vein(h.basal * length, h.basal_deg, h.basal_bend_deg);
    auto side = cucumber_side(h, basal.back(), upper.back(), length, jitter, jitter_random);
    for (glm::dvec3& p : side) p.y *= mirror;
    (is_left ? d.points.left_m : d.points.right_m) = std::move(side);
    for (std::vector<dvec2>* line : {&upper, &basal}) {
      for (dvec2& p : *line) p.y *= mirror;
      d.veins.push_back(main_vein(*line, o.veins.main_width_m, line == &upper ? 0.92 : 0.8));
    }
  }
  for (int i = 0; i < 5; ++i) d.points.midrib_m.emplace_back(length * i / 4, 0, 0);
  return d;
}

/// A watermelon lobe's vein: where it leaves its parent (share of the parent's length), at which angle to it, how long
/// (over OE) and how wide its lobe is to either side (base, tip; over OE). Reconstructed, as the cucumber's.
struct LobeVein {
  int parent;
  double at, angle_deg, length, base, tip;
};

/// One half; the other is mirrored. Parent -1: the petiole; 0: the midrib; else 1 + number in this list.
constexpr LobeVein kWatermelonHalf[] = {
    {0, 0.40, 52, 0.28, 0.056, 0.084},    // 1: pairs of the long middle lobe
    {0, 0.66, 47, 0.195, 0.050, 0.070},   // 2
    {0, 0.86, 42, 0.105, 0.040, 0.050},   // 3
    {-1, 0, 52, 0.64, 0.062, 0.066},      // 4: side lobe
    {4, 0.46, 50, 0.225, 0.050, 0.074},   // 5: its lobules, towards the base ...
    {4, 0.50, -46, 0.17, 0.044, 0.062},   // 6: ... and towards the tip
    {4, 0.76, 44, 0.125, 0.040, 0.054},   // 7
    {4, 0.78, -42, 0.11, 0.040, 0.050},   // 8
    {-1, 0, 108, 0.44, 0.060, 0.066},     // 9: basal lobe
    {9, 0.48, 48, 0.18, 0.046, 0.066},    // 10
    {9, 0.52, -46, 0.155, 0.042, 0.060},  // 11
    {-1, 0, 146, 0.22, 0.050, 0.062},     // 12: auricle
};

/// A gently curved vein: it turns by `turn_deg` over its length.
std::vector<dvec2> curved_vein(const dvec2& from, double length, double angle_deg, double turn_deg) {
  std::vector<dvec2> line{from};
  constexpr int kPieces = 48;
  for (int k = 0; k < kPieces; ++k)
    line.push_back(line.back() + polar(length / kPieces, angle_deg + turn_deg * ((k + 0.5) / kPieces - 0.5)));
  return line;
}

VeinDraft watermelon_draft(const LeafOptions& o) {
  const double length = o.main_vein_m;
  VeinDraft d;
  Random left_random(o.seed, Stream::outline, kLeft), right_random(o.seed, Stream::outline, kRight);
  std::vector<Lobe> lobes;
  std::vector<dvec2> midrib;
  for (int i = 0; i <= 48; ++i) midrib.emplace_back(length * i / 48, 0);
  lobes.push_back({midrib, 0.064 * length, 0.050 * length});
  d.veins.push_back(main_vein(midrib, o.veins.main_width_m, 1));
  const std::size_t count = std::size(kWatermelonHalf);
  std::vector<std::array<double, 4>> own[2];  // draws of at, angle, length, width
  for (std::size_t k = 0; k < count; ++k) {
    std::array<double, 4> a, b;
    for (double& v : a) v = left_random.uniform(-1, 1);
    for (double& v : b) v = right_random.uniform(-1, 1);
    own[0].push_back(a);
    for (std::size_t c = 0; c < 4; ++c) b[c] = (1 - o.asymmetry) * a[c] + o.asymmetry * b[c];
    own[1].push_back(b);
  }
  for (const int side : {0, 1}) {
    const std::size_t first = d.veins.size();
    for (std::size_t k = 0; k < count; ++k) {
      const LobeVein& v = kWatermelonHalf[k];
      const auto& draw = own[side][k];
      const double at = std::min(0.93, v.at + 0.04 * o.variation * draw[0]), angle = v.angle_deg + 5 * o.variation * draw[1];
      const double size = length * v.length * (1 + 0.10 * o.variation * draw[2]), width = 1 + 0.1 * o.variation * draw[3];
      const int parent = v.parent <= 0 ? v.parent : int(first) + v.parent - 1;
      dvec2 from(0.0);
      double heading = 0;
      if (parent >= 0) {  // from a point of the parent, exactly
        const auto& line = d.veins[std::size_t(parent)].line_m;
        const std::size_t i = std::size_t(std::lround(at * double(line.size() - 1)));
        from = line[i];
        const dvec2 along = line[std::min(i + 1, line.size() - 1)] - line[i - 1];
        heading = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
      }
      const double mirror = side == 0 ? 1 : -1;
      // Side veins bend towards the tip of what they belong to.
      auto line = curved_vein(from, size, heading + mirror * angle, -mirror * 0.22 * angle);
      lobes.push_back({line, v.base * length * width, v.tip * length * width});
      const double parent_width = parent < 0 ? o.veins.main_width_m : d.veins[std::size_t(parent)].width_base_m;
      Vein vein = main_vein(std::move(line), parent_width, parent < 0 ? 0.9 : 0.62);
      vein.parent = parent;
      vein.order = parent < 0 ? 1 : 2;
      d.veins.push_back(std::move(vein));
    }
  }
  const auto outline = lobed_outline(lobes, length);
  // The midrib's lobe is round at its end: the tip of the leaf lies beyond the tip of the vein.
  d.points.right_m = outline.right_m;
  d.points.left_m = outline.left_m;
  for (int i = 0; i < 5; ++i) d.points.midrib_m.push_back(outline.tip_m * (i / 4.0));
  d.veins[0].line_m.clear();
  for (int i = 0; i <= 48; ++i) d.veins[0].line_m.emplace_back(outline.tip_m.x * i / 48, outline.tip_m.y * i / 48);
  return d;
}

}  // namespace

VeinDraft vein_draft(const LeafOptions& options) {
  if (options.species == "cucumber") return cucumber_draft(options);
  if (options.species == "watermelon") return watermelon_draft(options);
  throw InvalidInput("species = '" + options.species + "' has no vein model");
}

}  // namespace witherfield::leaf
