#include "sim/leaf/vein_ribs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/leaf/point_grid.hpp"

namespace witherfield::leaf {
namespace {

using Frame = std::span<const glm::dvec3>;

double mean_edge_m(const std::vector<ShellPatch>& patches) {
  double sum = 0;
  for (const ShellPatch& p : patches)
    for (int i = 0; i < 3; ++i) sum += p.edge_m(i);
  return sum / double(3 * patches.size());
}

/// Squared distance of `p` to a triangle and the weights of the nearest point (Ericson 2005, sec. 5.1.5, by regions of the plane).
double nearest_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       std::array<double, 3>& w) {
  const glm::dvec3 ab = b - a, ac = c - a, n = glm::cross(ab, ac);
  const double nn = glm::dot(n, n);
  w = {glm::dot(glm::cross(c - b, p - b), n) / nn, glm::dot(glm::cross(a - c, p - c), n) / nn,
       glm::dot(glm::cross(ab, p - a), n) / nn};
  if (w[0] < 0 || w[1] < 0 || w[2] < 0) {  // outside: the nearest of the three edges
    const std::array<glm::dvec3, 3> q{a, b, c};
    double best = 1e300;
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 &from = q[i], e = q[(i + 1) % 3] - from;
      const double t = std::clamp(glm::dot(p - from, e) / glm::dot(e, e), 0.0, 1.0);
      const glm::dvec3 d = p - from - t * e;
      if (glm::dot(d, d) < best) {
        best = glm::dot(d, d);
        at = {0, 0, 0};
        at[i] = 1 - t;
        at[(i + 1) % 3] = t;
      }
    }
    w = at;
  }
  const glm::dvec3 d = p - w[0] * a - w[1] * b - w[2] * c;
  return glm::dot(d, d);
}

struct Locator {
  Frame x;
  const std::vector<ShellPatch>& patches;
  double reach;
  std::vector<glm::dvec3> centre;
  PointGrid grid;

  Locator(Frame frame, const std::vector<ShellPatch>& p, double longest)
      : x(frame), patches(p), reach(longest), centre(centres(frame, p)), grid(centre, 1.5 * longest) {}
  static std::vector<glm::dvec3> centres(Frame x, const std::vector<ShellPatch>& patches) {
    std::vector<glm::dvec3> c;
    for (const ShellPatch& p : patches)
      c.push_back((x[std::size_t(p.corner[0])] + x[std::size_t(p.corner[1])] + x[std::size_t(p.corner[2])]) / 3.0);
    return c;
  }
  /// Triangles that are as near as the nearest one to within `slack`, ascending; none when all are farther than `reach`.
  void find(const glm::dvec3& at, double slack, std::vector<std::pair<int, std::array<double, 3>>>& found) const {
    std::vector<std::tuple<int, double, std::array<double, 3>>> near;
    double best = reach * reach;
    grid.near(at, [&](int t) {
      std::array<double, 3> w;
      const auto& c = patches[std::size_t(t)].corner;
      const double d = nearest_weights(at, x[std::size_t(c[0])], x[std::size_t(c[1])], x[std::size_t(c[2])], w);
      if (d <= best + slack * slack) near.emplace_back(t, d, w);
      best = std::min(best, d);
    });
    found.clear();
    for (const auto& [t, d, w] : near)
      if (std::sqrt(d) <= std::sqrt(best) + slack) found.emplace_back(t, w);
    std::sort(found.begin(), found.end());
  }
};

/// Direction of a vector of the curve's frame in the triangle's own plane frame.
glm::dvec2 plane_direction(const ShellPatch& p, Frame x, const glm::dvec3& d) {
  // The tangent as a combination of the triangle's edges in the curve's frame, put together again from its rest frame.
  const glm::dvec3 a = x[std::size_t(p.corner[0])], e1 = x[std::size_t(p.corner[1])] - a, e2 = x[std::size_t(p.corner[2])] - a;
  const double a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2), det = a11 * a22 - a12 * a12;
  const double b1 = glm::dot(d, e1), b2 = glm::dot(d, e2);
  const double s = (a22 * b1 - a12 * b2) / det, t = (a11 * b2 - a12 * b1) / det;
  // Rest edges from the gradients: N_1, N_2 are the coordinates along them, so that [e1 e2] = [g1 g2]^-T.
  const glm::dvec2 g1 = p.gradient[1], g2 = p.gradient[2];
  const double inverse = 1 / (g1.x * g2.y - g1.y * g2.x);
  const glm::dvec2 r1 = glm::dvec2(g2.y, -g2.x) * inverse, r2 = glm::dvec2(-g1.y, g1.x) * inverse;
  const glm::dvec2 v = s * r1 + t * r2;
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec2(1, 0);
}

}  // namespace

RibLayout lay_ribs(const WiltBody& body, const std::vector<ShellPatch>& patches) {
  RibLayout layout;
  if (body.veins.empty()) return layout;
  const Frame x = body.vein_frame_m.empty() ? Frame(body.rest.position_m) : Frame(body.vein_frame_m);
  const double mean = mean_edge_m(patches);
  double longest = 0;
  for (const ShellPatch& p : patches)
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, glm::distance(x[std::size_t(p.corner[std::size_t(i)])], x[std::size_t(p.corner[std::size_t((i + 1) % 3)])]));
  const Locator locator(x, patches, longest);
  std::vector<std::pair<int, std::array<double, 3>>> found;
  for (std::size_t v = 0; v < body.veins.size(); ++v) {
    const VeinCurve& curve = body.veins[v];
    double total = 0, done = 0;
    for (std::size_t k = 1; k < curve.points_m.size(); ++k) total += glm::distance(curve.points_m[k], curve.points_m[k - 1]);
    for (std::size_t k = 1; k < curve.points_m.size(); ++k) {
      const glm::dvec3 from = curve.points_m[k - 1], d = curve.points_m[k] - from;
      const double length = glm::length(d);
      const int parts = std::max(1, int(std::ceil(4 * length / mean)));
      for (int q = 0; q < parts; ++q) {
        const double s = (q + 0.5) / parts, along = (done + s * length) / total;
        locator.find(from + s * d, 0.01 * mean, found);
        for (const auto& [t, w] : found)
          layout.pieces.push_back({t, plane_direction(patches[std::size_t(t)], x, d), length / parts / double(found.size()),
                                   curve.radius_base_m + (curve.radius_tip_m - curve.radius_base_m) * along});
        if (v == 0 && !found.empty()) {
          const auto& [t, w] = found.front();
          layout.main_vein.push_back({patches[std::size_t(t)].corner, w});
        }
      }
      done += length;
    }
  }
  std::stable_sort(layout.pieces.begin(), layout.pieces.end(),
                   [](const RibPiece& a, const RibPiece& b) { return a.triangle < b.triangle; });
  return layout;
}

std::vector<float> vein_field(const WiltBody& body) {
  const std::vector<glm::dvec3>& x = body.vein_frame_m.empty() ? body.rest.position_m : body.vein_frame_m;
  std::vector<float> field(x.size(), 0.0f);
  if (body.veins.empty()) return field;
  const double mean = mean_edge_m(make_patches(x, body.rest.triangles));
  double reach = mean;
  for (const VeinCurve& c : body.veins) reach = std::max(reach, std::max(c.radius_base_m, c.radius_tip_m) + mean);
  const PointGrid grid(x, reach);
  for (const VeinCurve& c : body.veins)
    for (std::size_t k = 1; k < c.points_m.size(); ++k) {
      const glm::dvec3 from = c.points_m[k - 1], d = c.points_m[k] - from;
      const int parts = std::max(1, int(std::ceil(4 * glm::length(d) / mean)));
      for (int q = 0; q <= parts; ++q) {
        const glm::dvec3 at = from + d * (double(q) / parts);
        const double along = (double(k - 1) + double(q) / parts) / double(c.points_m.size() - 1);
        const double radius = c.radius_base_m + (c.radius_tip_m - c.radius_base_m) * along;
        grid.near(at, [&](int i) {
          const double share = std::clamp(1 - (glm::distance(x[std::size_t(i)], at) - radius) / mean, 0.0, 1.0);
          field[std::size_t(i)] = std::max(field[std::size_t(i)], float(share));
        });
      }
    }
  return field;
}

double chain_length_m(const std::vector<BladePoint>& chain, Frame x) {
  double sum = 0;
  for (std::size_t k = 1; k < chain.size(); ++k) sum += glm::distance(chain[k].at(x), chain[k - 1].at(x));
  return sum;
}

}  // namespace witherfield::leaf
