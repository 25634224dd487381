// The rules written down plainly, vertex by vertex with maps, to compare the library with. It takes over the
// library's numbering of vertices (its children of every face) and nothing else.
#pragma once
#include <gtest/gtest.h>

#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::fruit::fixtures {

class LoopReference {
 public:
  LoopReference(const ControlMesh& mesh, Scheme scheme)
      : scheme_(scheme),
        points_(mesh.position_m),
        triangles_(mesh.triangles),
        sharp_(mesh.sharp_vertices.begin(), mesh.sharp_vertices.end()) {
    for (auto [a, b] : mesh.crease_edges) creases_.insert(std::minmax(a, b));
  }

  const Points& points() const { return points_; }

  /// One step; `children` as the library numbers them.
  void refine(std::span<const std::array<int, 3>> children, std::size_t vertices) {
    find_neighbours();
    Points next(vertices, glm::dvec3(NAN));
    for (std::size_t v = 0; v < points_.size(); ++v) next[v] = vertex_point(int(v));
    std::set<std::pair<int, int>> halves;
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = triangles_[f][i], b = triangles_[f][(i + 1) % 3];
        const int mid = children[4 * f + 3][i];
        ASSERT_GE(mid, int(points_.size()));
        ASSERT_EQ(children[4 * f + i], (std::array{a, mid, children[4 * f + 3][(i + 2) % 3]}));
        const glm::dvec3 p = edge_point(a, b);
        ASSERT_TRUE(std::isnan(next[std::size_t(mid)].x) || next[std::size_t(mid)] == p)
            << "one vertex for two edges";
        next[std::size_t(mid)] = p;
        if (creases_.contains(std::minmax(a, b)))
          for (const int end : {a, b}) halves.insert(std::minmax(end, mid));
      }
    for (const auto& p : next) ASSERT_FALSE(std::isnan(p.x)) << "a number without a vertex";
    points_ = std::move(next);
    triangles_.assign(children.begin(), children.end());
    creases_ = std::move(halves);
  }

 private:
  using Edge = std::pair<int, int>;
  enum class Kind { smooth, dart, regular, nonregular, corner, liu_sharp };

  void find_neighbours() {
    opposite_.clear();
    around_.assign(points_.size(), {});
    for (const auto& t : triangles_)
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        opposite_[std::minmax(a, b)].push_back(t[(i + 2) % 3]);
        around_[std::size_t(a)].insert(b);
        around_[std::size_t(b)].insert(a);
      }
  }

  bool border(int a, int b) const { return opposite_.at(std::minmax(a, b)).size() == 1; }
  bool line(int a, int b) const { return border(a, b) || creases_.contains(std::minmax(a, b)); }

  std::vector<int> along(int v) const {
    std::vector<int> out;
    for (const int w : around_[std::size_t(v)])
      if (line(v, w)) out.push_back(w);
    return out;
  }

  bool on_border(int v) const {
    return std::any_of(around_[std::size_t(v)].begin(), around_[std::size_t(v)].end(),
                       [&](int w) { return border(v, w); });
  }

  Kind kind(int v) const {
    const auto lines = along(v);
    if (sharp_.contains(v))
      return scheme_ == Scheme::liu2007 && !on_border(v) ? Kind::liu_sharp : Kind::corner;
    if (lines.size() > 2) return Kind::corner;
    if (lines.empty()) return Kind::smooth;
    if (lines.size() == 1) return Kind::dart;
    if (on_border(v)) return around_[std::size_t(v)].size() == 4 ? Kind::regular : Kind::nonregular;
    // Two smooth edges on each side: from one crease to the other there are two vertices in between, both
    // ways.
    if (around_[std::size_t(v)].size() != 6) return Kind::nonregular;
    int previous = -1, here = lines[0], turns = 0;
    do {  // walk round v over the triangles
      int next = -1;
      for (const int o : opposite_.at(std::minmax(v, here)))
        if (o != previous) next = o;
      previous = here;
      here = next;
      ++turns;
    } while (here != lines[1]);
    return turns == 3 ? Kind::regular : Kind::nonregular;
  }

  glm::dvec3 vertex_point(int v) const {
    const glm::dvec3& p = points_[std::size_t(v)];
    const Kind k = kind(v);
    if (k == Kind::corner || around_[std::size_t(v)].empty()) return p;
    if (k == Kind::regular || k == Kind::nonregular) {
      const auto l = along(v);
      const glm::dvec3 ends = points_[std::size_t(l[0])] + points_[std::size_t(l[1])];
      return scheme_ == Scheme::liu2007 && !on_border(v) ? 7.0 / 8 * p + 1.0 / 16 * ends
                                                         : 3.0 / 4 * p + 1.0 / 8 * ends;
    }
    glm::dvec3 sum(0);
    for (const int w : around_[std::size_t(v)]) sum += points_[std::size_t(w)];
    const double n = double(around_[std::size_t(v)].size());
    if (k == Kind::liu_sharp)
      return (std::pow(2, n - 1) - n) / std::pow(2, n - 1) * p + 1 / std::pow(2, n - 1) * sum;
    const double alpha =
        1 / n * (5.0 / 8 - std::pow(3.0 / 8 + 1.0 / 4 * std::cos(2 * std::numbers::pi / n), 2));
    return (1 - n * alpha) * p + alpha * sum;
  }

  glm::dvec3 edge_point(int from, int to) const {
    const auto [a, b] = std::minmax(from, to);
    const glm::dvec3 &p = points_[std::size_t(a)], &q = points_[std::size_t(b)];
    const Kind ka = kind(a), kb = kind(b);
    const bool dart = scheme_ == Scheme::hoppe1994 && (ka == Kind::dart || kb == Kind::dart);
    if (!line(a, b) || dart) {
      const auto& o = opposite_.at({a, b});
      return 3.0 / 8 * (p + q) + 1.0 / 8 * (points_[std::size_t(o[0])] + points_[std::size_t(o[1])]);
    }
    const bool ra = ka == Kind::regular, rb = kb == Kind::regular;
    if (scheme_ == Scheme::liu2007 || ra == rb) return 0.5 * (p + q);
    return ra ? 5.0 / 8 * p + 3.0 / 8 * q : 3.0 / 8 * p + 5.0 / 8 * q;
  }

  Scheme scheme_;
  Points points_;
  Triangles triangles_;
  std::set<int> sharp_;
  std::set<Edge> creases_;
  std::map<Edge, std::vector<int>> opposite_;
  std::vector<std::set<int>> around_;
};

}  // namespace witherfield::fruit::fixtures
