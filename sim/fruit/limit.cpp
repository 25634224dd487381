// Limit positions and normals.
//
// Vertices under Loop's rule have closed forms (Loop 1987; Hoppe et al. 1994): with omega = 3 / (8 alpha),
//   limit = (omega v + sum v_i) / (omega + n),  tangents sum cos(2 pi i / n) v_i and sum sin(2 pi i / n) v_i.
// On creases the first step may use other masks than all later ones (hoppe1994: 5/8, 3/8 between a regular
// and a non-regular end, 1/2, 1/2 between two of a kind), so the neighbourhood is refined once more and the
// masks that hold from then on are applied: their left eigenvectors are solved here rather than taken from
// tables, which are published for some schemes only. Hoppe's 1/6, 2/3, 1/6 and 1/5, 3/5, 1/5 and Liu's 1/10,
// 8/10, 1/10 come out.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/parallel.hpp"
#include "sim/fruit/refinement_tables.hpp"

namespace witherfield::fruit {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr double kPi = std::numbers::pi;

using Points = std::span<const glm::dvec3>;

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// A vertex and what stands around it, counter-clockwise, in the last level.
struct Star {
  int vertex = 0;
  VertexClass own;
  std::vector<int> ring;
  std::vector<std::optional<double>>
      weight;                 ///< of the vertex in the point of the edge to ring[i]; none: smooth mask
  std::vector<bool> special;  ///< edge to ring[i] is a crease or border
};

struct Limit {
  glm::dvec3 position{0}, normal{0};
  bool has_normal = false;
};

class Stars {
 public:
  explicit Stars(const Refinement::Tables& t) : t_(t), limit_(t.limit_tables()) {}

  Star control(int v) const {
    Star s;
    s.vertex = v;
    s.own = t_.base.vertex_class[std::size_t(v)];
    for (int i = t_.base.ring_start[std::size_t(v)]; i < t_.base.ring_start[std::size_t(v) + 1]; ++i)
      add(s, t_.steps == 0 ? t_.base.ring_vertex[std::size_t(i)] : across(t_.base_spoke[std::size_t(i)], 0),
          t_.base.edge_kind[std::size_t(t_.base.ring_edge[std::size_t(i)])]);
    return s;
  }

  Star line(const LineVertex& v) const {
    Star s;
    s.vertex = v.vertex;
    s.own = born_class(t_.scheme, v.kind);
    const auto at = [&](int i) { return neighbour(v.level, v.edge, i); };
    if (v.left)
      for (const int i : {0, 1, 2}) add(s, at(i), i == 0 ? v.kind : EdgeKind::smooth);
    if (v.right || v.left) add(s, at(3), v.kind);
    if (v.right)
      for (const int i : {4, 5}) add(s, at(i), EdgeKind::smooth);
    if (!v.left) add(s, at(0), v.kind);
    return s;
  }

  /// Neighbour i (in the order of kRing) of the vertex that edge e became in level `birth`.
  int neighbour(int birth, int e, int i) const {
    const std::size_t at = std::size_t(kRing) * std::size_t(e) + std::size_t(i);
    if (birth == t_.steps) return limit_.ring[at];
    return across(birth + 1 == t_.steps ? limit_.spoke[at] : t_.levels[std::size_t(birth)].spoke[at], birth);
  }

 private:
  int across(int code, int birth) const {
    return spoke_vertex(code, birth, t_.steps, t_.levels[std::size_t(t_.steps) - 1].vertices);
  }

  void add(Star& s, int other, EdgeKind kind) const {
    const VertexClass far =
        other < t_.base.vertices ? t_.base.vertex_class[std::size_t(other)] : born_class(t_.scheme, kind);
    s.ring.push_back(other);
    s.weight.push_back(edge_weight(t_.scheme, kind, s.own, far));
    s.special.push_back(kind != EdgeKind::smooth);
  }

  const Refinement::Tables& t_;
  const LimitTables& limit_;
};

/// Weights (own, then ring) that a stationary step keeps: the left eigenvector of eigenvalue 1. The others
/// are at most 5/8 or thereabouts, so the powers of the step converge within some eighty turns.
std::vector<double> kept_weights(const Star& s) {
  const std::size_t n = s.ring.size();
  std::vector<double> kept(n + 1, 1.0 / double(n + 1)), next(n + 1);
  for (int turn = 0; turn < 500; ++turn) {
    std::fill(next.begin(), next.end(), 0.0);
    next[0] += s.own.centre * kept[0];
    for (std::size_t i = 0; i < n; ++i) {
      next[1 + i] += s.own.ring * kept[0];
      const double w = kept[1 + i], own = s.weight[i].value_or(0.375);
      next[0] += own * w;
      next[1 + i] += (s.weight[i] ? 1 - own : 0.375) * w;
      if (s.weight[i]) continue;
      next[1 + (i + 1) % n] += 0.125 * w;
      next[1 + (i + n - 1) % n] += 0.125 * w;
    }
    double change = 0;
    for (std::size_t i = 0; i <= n; ++i) change = std::max(change, std::abs(next[i] - kept[i]));
    kept.swap(next);
    if (change < 1e-17) break;
  }
  return kept;
}

/// Smooth, dart and the sharp rule of Liu et al. 2007: every neighbour counts.
Limit closed_star(const Star& s, Points x) {
  const std::size_t n = s.ring.size();
  Limit out;
  glm::dvec3 sum(0), along(0), across(0);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3& p = x[std::size_t(s.ring[i])];
    const double angle = 2 * kPi * double(i) / double(n);
    sum += p;
    along += std::cos(angle) * p;
    across += std::sin(angle) * p;
  }
  const bool all_smooth =
      std::none_of(s.weight.begin(), s.weight.end(), [](const auto& w) { return w.has_value(); });
  if (all_smooth) {
    // Column of a neighbour in the step: ring * own + 3/8 + 2/8 = 1, column of the centre: (1 - centre) own =
    // 3/8 n.
    const double omega = 0.375 / s.own.ring;
    out.position = (omega * x[std::size_t(s.vertex)] + sum) / (omega + double(n));
  } else {
    const std::vector<double> kept = kept_weights(s);
    out.position = kept[0] * x[std::size_t(s.vertex)];
    for (std::size_t i = 0; i < n; ++i) out.position += kept[1 + i] * x[std::size_t(s.ring[i])];
  }
  // A vertex that is heavy enough makes its own second eigenvalue, centre - 3/8, the largest below 1: a cusp
  // (sharp, valence 8 and more).
  const double spread = 0.375 + 0.25 * std::cos(2 * kPi / double(n));
  out.has_normal = all_smooth && s.own.centre - 0.375 < spread;
  if (out.has_normal) out.normal = unit_or_zero(glm::cross(along, across));
  return out;
}

/// The tangent that points inwards from a border vertex of k faces, from its neighbourhood after a step.
/// Inner neighbours have sin(j pi / k) in the left eigenvector of 3/8 + cos(pi / k) / 4; the vertex and the
/// ends of the border follow from it.
/// @return false where that eigenvalue coincides with one along the border
bool inward_tangent(const VertexClass& c, double end_weight, const glm::dvec3& v,
                    std::span<const glm::dvec3> ring, glm::dvec3& tangent) {
  const std::size_t k = ring.size() - 1;
  const double own = 1 - end_weight;  // of an end in its own successor
  const glm::dvec3 ends = ring.front() + ring.back();
  if (k == 1) {  // no inner neighbour: the symmetric eigenvector along the border
    tangent = ends + (c.centre - 1) / c.ring * v;
    return true;
  }
  const double lambda = 0.375 + 0.25 * std::cos(kPi / double(k));
  // (lambda - own) l_end = ring l_v + 1/8 sin(pi / k)
  // (lambda - centre) l_v = 2 end_weight l_end + 3/8 sum of sines
  const double det = (lambda - own) * (lambda - c.centre) - 2 * end_weight * c.ring;
  if (std::abs(det) < 1e-9) return false;
  const double first = std::sin(kPi / double(k)) / 8, sines = 0.375 / std::tan(kPi / (2 * double(k)));
  const double l_end = (first * (lambda - c.centre) + c.ring * sines) / det;
  const double l_v = ((lambda - own) * sines + 2 * end_weight * first) / det;
  tangent = l_v * v + l_end * ends;
  for (std::size_t j = 1; j < k; ++j) tangent += std::sin(kPi * double(j) / double(k)) * ring[j];
  return true;
}

/// The tangent along the border: from end to end, unless the mode sin(2 j pi / k) of the inner neighbours
/// shrinks more slowly than the border does (masks 1/2, 1/2 and more than six faces; Biermann et al. 2000
/// name that flaw of Loop's border rules, and Hoppe's 5/8, 3/8 does not have it).
glm::dvec3 border_tangent(double end_weight, std::span<const glm::dvec3> ring) {
  const double k = double(ring.size() - 1), own = 1 - end_weight;
  const double lambda = 0.375 + 0.25 * std::cos(2 * kPi / k);
  const glm::dvec3 ends = ring.front() - ring.back();
  if (ring.size() < 4 || lambda < own + 1e-9) return ends;
  glm::dvec3 tangent = std::sin(2 * kPi / k) / 8 / (lambda - own) * ends;
  for (std::size_t j = 1; j + 1 < ring.size(); ++j) tangent += std::sin(2 * kPi * double(j) / k) * ring[j];
  return tangent;
}

/// On a crease or border.
Limit line_star(const Refinement::Tables& t, const Star& s, Points x) {
  const std::size_t n = s.ring.size();
  const glm::dvec3& v = x[std::size_t(s.vertex)];
  const auto at = [&](std::size_t i) { return x[std::size_t(s.ring[i % n])]; };
  std::vector<glm::dvec3> next(n);
  glm::dvec3 ends(0);
  for (std::size_t i = 0; i < n; ++i) {
    next[i] = s.weight[i] ? *s.weight[i] * v + (1 - *s.weight[i]) * at(i)
                          : 0.375 * (v + at(i)) + 0.125 * (at(i + 1) + at(i + n - 1));
    if (s.special[i]) ends += at(i);
  }
  const glm::dvec3 centre = s.own.centre * v + s.own.ring * ends;
  const EdgeKind kind = s.own.border ? EdgeKind::border : EdgeKind::crease;
  const double end_weight = *edge_weight(t.scheme, kind, s.own, born_class(t.scheme, kind));
  // Kept by every further step: (1, r, r) with ring + (1 - end_weight) r = r.
  const double r = s.own.ring / end_weight;
  Limit out;
  out.position = centre;
  for (std::size_t i = 0; i < n; ++i)
    if (s.special[i]) out.position += r * next[i];
  out.position /= 1 + 2 * r;
  glm::dvec3 inward;
  if (s.own.border && inward_tangent(s.own, end_weight, centre, next, inward)) {
    out.has_normal = true;
    out.normal = unit_or_zero(glm::cross(border_tangent(end_weight, next), inward));
  }
  return out;
}

Limit limit_of(const Refinement::Tables& t, const Star& s, Points x) {
  if (s.own.rule == VertexRule::crease) return line_star(t, s, x);
  if (s.own.ring > 0) return closed_star(s, x);
  return {x[std::size_t(s.vertex)], glm::dvec3(0), false};  // corners, strays
}

/// Vertices that edges of level birth - 1 became, as if all were smooth.
void smooth_born(const Refinement::Tables& t, const Stars& stars, int birth, Points x,
                 std::span<glm::dvec3> position, std::span<glm::dvec3> normal) {
  const Level& parent = t.levels[std::size_t(birth) - 1];
  const double sin60 = std::sqrt(3.0) / 2;
  parallel_for(std::size_t(parent.edges), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const std::size_t v = std::size_t(parent.vertices) + e;
      std::array<glm::dvec3, kRing> p;
      for (int i = 0; i < kRing; ++i) p[std::size_t(i)] = x[std::size_t(stars.neighbour(birth, int(e), i))];
      // Valence 6: alpha = 1/16, omega = 6.
      position[v] = 0.5 * x[v] + (p[0] + p[1] + p[2] + p[3] + p[4] + p[5]) / 12.0;
      const glm::dvec3 along = (p[0] - p[3]) + 0.5 * ((p[1] + p[5]) - (p[2] + p[4]));
      const glm::dvec3 across = sin60 * ((p[1] + p[2]) - (p[4] + p[5]));
      normal[v] = unit_or_zero(glm::cross(along, across));
    }
  });
}

/// Area-weighted mean over the faces around, in the limit.
glm::dvec3 mean_normal(const Star& s, Points position) {
  const std::size_t n = s.ring.size();
  const glm::dvec3& v = position[std::size_t(s.vertex)];
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < (s.own.border ? n - 1 : n); ++i)
    sum += glm::cross(position[std::size_t(s.ring[i])] - v, position[std::size_t(s.ring[(i + 1) % n])] - v);
  return unit_or_zero(sum);
}

}  // namespace

void limit_of_tables(const Refinement::Tables& t, Points x, std::span<glm::dvec3> position,
                     std::span<glm::dvec3> normal) {
  const Stars stars(t);
  for (int birth = 1; birth <= t.steps; ++birth) smooth_born(t, stars, birth, x, position, normal);
  const std::size_t controls = std::size_t(t.base.vertices), all = controls + t.line_vertices.size();
  const auto star = [&](std::size_t i) {
    return i < controls ? stars.control(int(i)) : stars.line(t.line_vertices[i - controls]);
  };
  std::vector<char> wants_mean(all, 0);
  parallel_for(all, kGrain / 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Star s = star(i);
      const Limit l = limit_of(t, s, x);
      position[std::size_t(s.vertex)] = l.position;
      normal[std::size_t(s.vertex)] = l.normal;
      wants_mean[i] = !l.has_normal;
    }
  });
  // After all positions are there.
  parallel_for(all, kGrain / 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!wants_mean[i]) continue;
      const Star s = star(i);
      normal[std::size_t(s.vertex)] = mean_normal(s, position);
    }
  });
}

}  // namespace witherfield::fruit
