#include "sim/leaf/margin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

/// Polyline by length.
struct Path {
  const std::vector<glm::dvec2>& line;
  std::vector<double> passed{0.0};

  explicit Path(const std::vector<glm::dvec2>& l) : line(l) {
    for (std::size_t i = 0; i + 1 < l.size(); ++i) passed.push_back(passed.back() + glm::distance(l[i], l[i + 1]));
  }
  double length() const { return passed.back(); }
  glm::dvec2 at(double s) const {
    s = std::clamp(s, 0.0, length());
    const std::size_t i = std::size_t(std::upper_bound(passed.begin() + 1, passed.end() - 1, s) - passed.begin()) - 1;
    return line[i] + (line[i + 1] - line[i]) * ((s - passed[i]) / (passed[i + 1] - passed[i]));
  }
};

}  // namespace

std::vector<glm::dvec2> toothed(const std::vector<glm::dvec2>& line, const MarginOptions& o, double outward, double spacing_m,
                                Random& random) {
  const Path path(line);
  if (o.tooth_depth_m <= 0 || path.length() < 4 * o.tooth_spacing_m) return line;
  const double reach = 1.5 * o.tooth_spacing_m;
  const double size = glm::distance(line.front(), line.back());
  std::vector<glm::dvec2> out{line.front()};
  double s = 0;
  while (s < path.length()) {
    double width = o.tooth_spacing_m * (1 + o.irregularity * random.uniform(-1, 1));
    if (path.length() - (s + width) < 0.6 * o.tooth_spacing_m) width = path.length() - s;  // the last one ends at the tip
    const glm::dvec2 middle = path.at(s + 0.5 * width);
    // Which way the lobe's tip lies: outwards from the base, seen over a few teeth.
    const double slope = (glm::length(path.at(s + 0.5 * width + reach)) - glm::length(path.at(s + 0.5 * width - reach))) / (2 * reach);
    const double lean = o.tooth_lean * std::clamp(2.5 * slope, -1.0, 1.0);
    const double peak = 0.5 + 0.42 * lean;
    const double from_base = glm::length(middle) / size;
    const double fade = std::clamp((from_base - 0.08) / 0.15, 0.0, 1.0) * std::clamp((path.length() - s) / (2 * width), 0.3, 1.0);
    const double depth = o.tooth_depth_m * (1 + o.irregularity * random.uniform(-1, 1)) * fade;
    const int pieces = std::max(4, int(std::lround(width / spacing_m)));
    const int before = std::clamp(int(std::lround(peak * pieces)), 1, pieces - 1);
    const glm::dvec2 along = path.at(s + width + 0.5 * reach) - path.at(s - 0.5 * reach);
    const glm::dvec2 normal = outward * glm::normalize(glm::dvec2(along.y, -along.x));
    for (int k = 1; k <= pieces; ++k) {
      const double t = k <= before ? peak * k / before : peak + (1 - peak) * (k - before) / (pieces - before);
      // Flanks that bulge a little: cucurbit teeth are blunt with a small point.
      const double rise = t <= peak ? t / peak : (1 - t) / (1 - peak), height = rise * (0.75 + 0.25 * rise) - 0.46;
      glm::dvec2 p = path.at(s + t * width);
      const double end = std::min(1.0, (path.length() - s - t * width) / (0.5 * o.tooth_spacing_m));  // ends stay in place
      const double start = std::min(1.0, (s + t * width) / (0.5 * o.tooth_spacing_m));
      out.push_back(p + height * depth * end * start * normal);
    }
    s += width;
    if (width <= 0) break;
  }
  out.back() = line.back();
  return out;
}

}  // namespace witherfield::leaf
