#include "sim/check/topology.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <string>
#include <tuple>

#include "sim/core/errors.hpp"

namespace witherfield::check {
namespace {

using std::size_t;

class UnionFind {
 public:
  explicit UnionFind(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[size_t(i)] != i) i = parent_[size_t(i)] = parent_[size_t(parent_[size_t(i)])];
    return i;
  }
  void join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[size_t(std::max(a, b))] = std::min(a, b);  // the root is the least of its set
  }

 private:
  std::vector<int> parent_;
};

/// One side of an edge as a face has it; corner = 3 * face + k, the edge runs from corner k to corner k + 1.
struct Side {
  int far;         ///< the greater vertex of the edge
  int corner;      ///< of the face, where the side begins
  bool ascending;  ///< the face runs from the lesser to the greater vertex
};

int next_corner(int corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Sides sorted by edge: those with the lesser vertex v are [first[v], first[v + 1]).
struct Sides {
  std::vector<Side> sides;
  std::vector<size_t> first;
};

Sides sides_of(const Surface& s) {
  Sides out;
  out.first.assign(s.position_m.size() + 1, 0);
  const auto each = [&](auto&& use) {
    for (size_t f = 0; f < s.triangles.size(); ++f)
      for (size_t k = 0; k < 3; ++k) {
        const int a = s.triangles[f][k], b = s.triangles[f][(k + 1) % 3];
        if (a != b) use(std::min(a, b), Side{std::max(a, b), int(3 * f + k), a < b});
      }
  };
  each([&](int near, const Side&) { ++out.first[size_t(near) + 1]; });
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.sides.resize(out.first.back());
  std::vector<size_t> at(out.first.begin(), out.first.end() - 1);
  each([&](int near, const Side& side) { out.sides[at[size_t(near)]++] = side; });
  for (size_t v = 0; v + 1 < out.first.size(); ++v)
    std::sort(
        out.sides.begin() + long(out.first[v]), out.sides.begin() + long(out.first[v + 1]),
        [](const Side& a, const Side& b) { return std::tie(a.far, a.corner) < std::tie(b.far, b.corner); });
  return out;
}

std::vector<int> first_equal_vertices(const Surface& s) {
  std::vector<int> order(s.position_m.size()), equal(s.position_m.size());
  std::iota(order.begin(), order.end(), 0);
  std::iota(equal.begin(), equal.end(), 0);
  const auto finite = [&](int v) {
    const auto& p = s.position_m[size_t(v)];
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  std::erase_if(order, [&](int v) { return !finite(v); });
  const auto key = [&](int v) {
    const auto& p = s.position_m[size_t(v)];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
  });
  for (size_t k = 1; k < order.size(); ++k)
    if (key(order[k]) == key(order[k - 1])) equal[size_t(order[k])] = equal[size_t(order[k - 1])];
  return equal;
}

template <class Id>
void count_and_list(const Id& id, size_t& count, std::vector<Id>& list, size_t listed) {
  if (++count <= listed) list.push_back(id);
}

/// Walks over the edges; joins the faces at each into shells, the corners into fans, and judges the edge.
class EdgeWalk {
 public:
  EdgeWalk(const Surface& s, size_t listed, MeshReport& report)
      : surface_(s),
        listed_(listed),
        report_(report),
        shells_(s.triangles.size()),
        fans_(3 * s.triangles.size()) {}

  void run() {
    const Sides all = sides_of(surface_);
    for (size_t v = 0; v + 1 < all.first.size(); ++v)
      for (size_t at = all.first[v], end; at < all.first[v + 1]; at = end) {
        for (end = at + 1; end < all.first[v + 1] && all.sides[end].far == all.sides[at].far;) ++end;
        edge(int(v), {all.sides.data() + at, end - at});
      }
    count_fans();
    label_shells();
    count_border_loops();
  }
  std::vector<int> component;

 private:
  void edge(int near, std::span<const Side> sides) {
    ++report_.edges;
    for (const Side& side : sides) {
      shells_.join(sides[0].corner / 3, side.corner / 3);
      fans_.join(corner_at(sides[0], true), corner_at(side, true));
      fans_.join(corner_at(sides[0], false), corner_at(side, false));
    }
    const std::array<int, 2> id{near, sides[0].far};
    const bool clash = sides.size() == 2 && sides[0].ascending == sides[1].ascending;
    if (sides.size() == 1) border_.push_back(sides[0].corner);
    if (sides.size() > 2)
      count_and_list(id, report_.non_manifold_edges, report_.non_manifold_edge_ids, listed_);
    if (clash) count_and_list(id, report_.clashing_edges, report_.clashing_edge_ids, listed_);
    if (sides.size() > 2 || clash) unclosed_.push_back(sides[0].corner / 3);
  }

  /// The face's corner at the lesser or greater vertex of the edge.
  static int corner_at(const Side& side, bool lesser) {
    return side.ascending == lesser ? side.corner : next_corner(side.corner);
  }

  /// A vertex whose corners form several fans is where the surface pinches to a point.
  void count_fans() {
    std::vector<int> fan(surface_.position_m.size(), -1);
    std::vector<bool> used(surface_.position_m.size()), pinched(surface_.position_m.size());
    for (size_t f = 0; f < surface_.triangles.size(); ++f) {
      const auto& t = surface_.triangles[f];
      const bool proper = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
      for (size_t k = 0; k < 3; ++k) {
        const auto v = size_t(t[k]);
        used[v] = true;
        if (!proper) continue;  // its corners do not go round a vertex
        const int root = fans_.find(int(3 * f + k));
        if (fan[v] < 0) fan[v] = root;
        if (fan[v] != root) pinched[v] = true;
      }
    }
    for (size_t v = 0; v < fan.size(); ++v) {
      if (!used[v]) count_and_list(int(v), report_.isolated_vertices, report_.isolated_ids, listed_);
      if (pinched[v])
        count_and_list(int(v), report_.non_manifold_vertices, report_.non_manifold_vertex_ids, listed_);
    }
  }

  void label_shells() {
    const size_t faces = surface_.triangles.size();
    component.assign(faces, -1);
    for (size_t f = 0; f < faces; ++f) {
      const auto root = size_t(shells_.find(int(f)));  // the least face: labelled before the others
      if (root == f) {
        component[f] = int(report_.component.size());
        report_.component.push_back({});
        report_.component.back().first_face = int(f);
        report_.component.back().closed = true;
      }
      component[f] = component[root];
      ++report_.component[size_t(component[f])].faces;
    }
    report_.components = report_.component.size();
    for (const int corner : border_) {
      ComponentReport& c = report_.component[size_t(component[size_t(corner / 3)])];
      ++c.border_edges;
      c.closed = false;
    }
    for (const int face : unclosed_) report_.component[size_t(component[size_t(face)])].closed = false;
    report_.closed = faces > 0 && border_.empty() && unclosed_.empty() && report_.repeated_corners == 0;
  }

  /// Border edges that follow each other around the same fans form a loop.
  void count_border_loops() {
    for (const int corner : border_) fans_.join(corner, next_corner(corner));
    std::vector<int> roots;
    for (const int corner : border_) roots.push_back(fans_.find(corner));
    std::sort(roots.begin(), roots.end());
    report_.border_loops = size_t(std::unique(roots.begin(), roots.end()) - roots.begin());
  }

  const Surface& surface_;
  const size_t listed_;
  MeshReport& report_;
  UnionFind shells_, fans_;
  std::vector<int> border_;    // corners where a border edge begins
  std::vector<int> unclosed_;  // faces at edges that no closed surface has
};

void find_duplicates(const Surface& s, const std::vector<int>& first_equal, size_t listed,
                     MeshReport& report) {
  struct Key {
    std::array<int, 3> corners;
    int face;
    bool operator<(const Key& other) const {
      return std::tie(corners, face) < std::tie(other.corners, other.face);
    }
  };
  std::vector<Key> keys;
  keys.reserve(s.triangles.size());
  for (size_t f = 0; f < s.triangles.size(); ++f) {
    Key key{{}, int(f)};
    for (size_t k = 0; k < 3; ++k) key.corners[k] = first_equal[size_t(s.triangles[f][k])];
    std::sort(key.corners.begin(), key.corners.end());
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> ids;
  for (size_t k = 1; k < keys.size(); ++k)
    if (keys[k].corners == keys[k - 1].corners) ids.push_back(keys[k].face);
  std::sort(ids.begin(), ids.end());
  report.duplicate_faces = ids.size();
  ids.resize(std::min(ids.size(), listed));
  report.duplicate_ids = std::move(ids);
}

}  // namespace

Topology analyse_topology(const Surface& s, size_t listed, MeshReport& report) {
  report.vertices = s.position_m.size();
  report.faces = s.triangles.size();
  for (size_t f = 0; f < s.triangles.size(); ++f) {
    const auto& t = s.triangles[f];
    for (const int v : t)
      if (v < 0 || size_t(v) >= s.position_m.size())
        throw InvalidInput("check_surface: triangle " + std::to_string(f) + " names vertex " +
                           std::to_string(v) + ", there are " + std::to_string(s.position_m.size()));
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) ++report.repeated_corners;
  }
  for (size_t v = 0; v < s.position_m.size(); ++v) {
    const auto& p = s.position_m[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      count_and_list(int(v), report.non_finite_vertices, report.non_finite_ids, listed);
  }
  EdgeWalk walk(s, listed, report);
  walk.run();
  Topology out{std::move(walk.component), first_equal_vertices(s)};
  find_duplicates(s, out.first_equal, listed, report);
  report.manifold =
      report.non_manifold_edges == 0 && report.clashing_edges == 0 && report.non_manifold_vertices == 0;
  return out;
}

void measure_components(const Surface& s, const std::vector<int>& component, MeshReport& r) {
  for (size_t f = 0; f < s.triangles.size(); ++f) {
    ComponentReport& c = r.component[size_t(component[f])];
    const glm::dvec3 origin = s.position_m[size_t(s.triangles[size_t(c.first_face)][0])];
    std::array<glm::dvec3, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = s.position_m[size_t(s.triangles[f][k])] - origin;
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    c.area_m2 += glm::length(normal) / 2;
    if (c.closed) c.volume_m3 += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
    if (normal.z < 0) ++r.faces_down;
  }
  for (const ComponentReport& c : r.component) {
    r.area_m2 += c.area_m2;
    if (r.closed) r.volume_m3 += c.volume_m3;
  }
  r.oriented_up = r.faces > 0 && r.faces_down == 0;
  r.oriented_outward = r.closed && std::all_of(r.component.begin(), r.component.end(),
                                               [](const ComponentReport& c) { return c.volume_m3 > 0; });
}

}  // namespace witherfield::check
