#include "sim/leaf/lobed_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

#include "sim/core/errors.hpp"
#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

using glm::dvec2;

constexpr int kCells = 360;             // of the grid along the leaf's length
constexpr double kRound = 0.05;         // radius over which lobes flow together, over the length
constexpr double kSinusHalfDeg = 26;    // of the petiole sinus

/// Negative inside: distance to the nearest vein minus the lobe's half-width there.
double lobe_distance(const Lobe& lobe, double length, const dvec2& p) {
  double best = 1e300, passed = 0;
  for (std::size_t i = 0; i + 1 < lobe.line_m.size(); ++i) {
    const dvec2 a = lobe.line_m[i], ab = lobe.line_m[i + 1] - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    const double u = (passed + t * glm::length(ab)) / length;
    // Narrow at the foot, widest before the tip, round there.
    const double shape = lobe.half_width_base_m + (lobe.half_width_tip_m - lobe.half_width_base_m) * std::sin(0.5 * std::numbers::pi * std::min(1.0, u / 0.8));
    best = std::min(best, glm::distance(p, a + t * ab) - shape);
    passed += glm::length(ab);
  }
  return best;
}

/// Smooth minimum of all lobes (log-sum-exp), then the petiole's sinus cut out.
double envelope(const std::vector<Lobe>& lobes, const std::vector<double>& length, const dvec2& p, double size) {
  const double k = 0.35 * kRound * size;
  double least = 1e300, sum = 0;
  std::vector<double> d(lobes.size());
  for (std::size_t i = 0; i < lobes.size(); ++i) least = std::min(least, d[i] = lobe_distance(lobes[i], length[i], p));
  for (const double v : d) sum += std::exp(-(v - least) / k);
  const double blade = least - k * std::log(sum);
  const double a = kSinusHalfDeg * std::numbers::pi / 180;
  const double wedge = p.x < 0 ? std::abs(p.y) * std::cos(a) + p.x * std::sin(a) : glm::length(p);
  return std::max(blade, -wedge);
}

/// Zero set on a grid by marching squares; the longest closed chain, counter-clockwise (inside on the left).
std::vector<dvec2> longest_loop(const std::vector<double>& f, int nx, int ny, const dvec2& origin, double h) {
  const auto value = [&](int i, int j) { return f[std::size_t(j) * std::size_t(nx) + std::size_t(i)]; };
  // A crossing lies on a grid edge: number = 2 * node + (0 along x, 1 along y).
  std::unordered_map<int, int> next;
  const auto edge = [&](int i, int j, int axis) { return 2 * (j * nx + i) + axis; };
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const std::array<bool, 4> in{value(i, j) < 0, value(i + 1, j) < 0, value(i + 1, j + 1) < 0, value(i, j + 1) < 0};
      const std::array<int, 4> cut{edge(i, j, 0), edge(i + 1, j, 1), edge(i, j + 1, 0), edge(i, j, 1)};
      // Walk around the cell: leaving the inside at an edge starts a segment, entering ends it.
      for (std::size_t c = 0; c < 4; ++c) {
        if (!(in[c] && !in[(c + 1) % 4])) continue;
        for (std::size_t s = 1; s < 4; ++s) {
          const std::size_t e = (c + s) % 4;
          if (!in[e] && in[(e + 1) % 4]) {
            next[cut[c]] = cut[e];
            break;
          }
        }
      }
    }
  const auto point = [&](int number) {
    const int node = number / 2, i = node % nx, j = node / nx, di = number % 2 == 0, dj = 1 - di;
    const double a = value(i, j), b = value(i + di, j + dj), t = a / (a - b);
    return origin + h * dvec2(i + di * t, j + dj * t);
  };
  std::vector<int> starts;
  for (const auto& [from, to] : next) starts.push_back(from);
  std::sort(starts.begin(), starts.end());
  std::vector<dvec2> best;
  std::unordered_map<int, bool> used;
  for (const int start : starts) {
    if (used[start]) continue;
    std::vector<dvec2> loop;
    int at = start;
    while (!used[at]) {
      used[at] = true;
      loop.push_back(point(at));
      const auto found = next.find(at);
      if (found == next.end()) break;
      at = found->second;
    }
    if (at == start && loop.size() > best.size()) best = std::move(loop);
  }
  if (best.size() > 2 && polygon_area(best) < 0) std::reverse(best.begin(), best.end());
  return best;
}

}  // namespace

LobedOutline lobed_outline(const std::vector<Lobe>& lobes, double size) {
  dvec2 low(0.0), high(0.0);
  for (const Lobe& l : lobes)
    for (const dvec2& p : l.line_m) low = glm::min(low, p), high = glm::max(high, p);
  const double h = size / kCells, margin = 0.15 * size;
  low -= dvec2(margin + 0.37 * h, margin + 0.41 * h);  // grid nodes off the axes: no value is exactly 0
  const int nx = int((high.x + margin - low.x) / h) + 2, ny = int((high.y + margin - low.y) / h) + 2;
  std::vector<double> length;
  for (const Lobe& l : lobes) length.push_back(polyline_length(l.line_m));
  std::vector<double> f(std::size_t(nx) * std::size_t(ny));
  // The envelope grows by at most a metre a metre: blocks whose middle lies far from it need no more than that value.
  constexpr int kBlock = 8;
  const auto at = [&](double i, double j) { return envelope(lobes, length, low + h * dvec2(i, j), size); };
  for (int bj = 0; bj < ny; bj += kBlock)
    for (int bi = 0; bi < nx; bi += kBlock) {
      const double middle = at(bi + 0.5 * kBlock, bj + 0.5 * kBlock);
      const bool near = std::abs(middle) < 0.75 * kBlock * h;
      for (int j = bj; j < std::min(ny, bj + kBlock); ++j)
        for (int i = bi; i < std::min(nx, bi + kBlock); ++i)
          f[std::size_t(j) * std::size_t(nx) + std::size_t(i)] = near ? at(i, j) : middle;
    }
  const std::vector<dvec2> loop = longest_loop(f, nx, ny, low, h);
  if (loop.size() < 16) throw SolverFailure("lobed_outline: the lobes enclose no area");
  const auto nearest = [&](const dvec2& to) {
    return std::size_t(std::min_element(loop.begin(), loop.end(), [&](const dvec2& a, const dvec2& b) {
                         return glm::distance(a, to) < glm::distance(b, to);
                       }) - loop.begin());
  };
  const std::size_t base = nearest({0, 0}), tip = nearest(lobes[0].line_m.back() + dvec2(2 * lobes[0].half_width_tip_m, 0));
  LobedOutline out;
  out.tip_m = {loop[tip].x, loop[tip].y, 0};
  const auto side = [&](bool forward) {
    std::vector<dvec2> line{{0, 0}};
    for (std::size_t i = base; i != tip; i = forward ? (i + 1) % loop.size() : (i + loop.size() - 1) % loop.size())
      if (glm::length(loop[i]) > 2 * h) line.push_back(loop[i]);
    line.push_back(loop[tip]);
    const int pieces = std::max(8, int(polyline_length(line) / (0.016 * size)));
    std::vector<glm::dvec3> points;
    const auto even = resample(line, pieces);
    for (std::size_t i = 1; i + 1 < even.size(); ++i) points.emplace_back(even[i].x, even[i].y, 0);
    return points;
  };
  out.right_m = side(true);
  out.left_m = side(false);
  return out;
}

}  // namespace witherfield::leaf
