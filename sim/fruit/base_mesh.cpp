// Control meshes: edges, rings, checks, and the rule of every vertex.
#include "sim/fruit/base_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::fruit {
namespace {

std::string edge_name(int a, int b) {
  return "edge " + std::to_string(a) + "-" + std::to_string(b);
}

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("subdivision: " + what);
}

void check_indices(const ControlMesh& mesh) {
  const std::size_t n = mesh.position_m.size();
  const auto good = [n](int v) { return v >= 0 && std::size_t(v) < n; };
  const std::string range = ", must be 0.." + std::to_string(std::ptrdiff_t(n) - 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    for (const int v : t)
      if (!good(v)) refuse("triangle " + std::to_string(f) + " names vertex " + std::to_string(v) + range);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      refuse("triangle " + std::to_string(f) + " names a vertex twice (" + std::to_string(t[0]) + ", " +
             std::to_string(t[1]) + ", " + std::to_string(t[2]) + ")");
  }
  for (const auto& e : mesh.crease_edges)
    for (const int v : e)
      if (!good(v)) refuse("crease " + edge_name(e[0], e[1]) + " names vertex " + std::to_string(v) + range);
  for (const int v : mesh.sharp_vertices)
    if (!good(v)) refuse("sharp vertex " + std::to_string(v) + range);
}

/// Ring of every vertex, one fan each.
void find_rings(const ControlMesh& mesh, BaseMesh& base) {
  const std::size_t n = mesh.position_m.size(), halves = 3 * mesh.triangles.size();
  const auto corner = [&](int h) { return mesh.triangles[std::size_t(h / 3)][std::size_t(h % 3)]; };
  const auto previous = [](int h) { return h % 3 == 0 ? h + 2 : h - 1; };
  const auto twin = [&](int h) {
    const auto& both = base.edge_half[std::size_t(base.edge_of[std::size_t(h)])];
    return both[0] == h ? both[1] : both[0];
  };
  std::vector<int> outgoing(n, 0), start(n, -1);
  for (int h = 0; h < int(halves); ++h) {
    const auto v = std::size_t(corner(h));
    ++outgoing[v];
    if (start[v] < 0 || twin(h) < 0) start[v] = h;
  }
  base.ring_start.assign(n + 1, 0);
  base.ring_edge.reserve(halves + n);
  base.ring_vertex.reserve(halves + n);
  for (std::size_t v = 0; v < n; ++v) {
    base.ring_start[v] = int(base.ring_edge.size());
    int seen = 0;
    for (int h = start[v]; h >= 0;) {
      base.ring_edge.push_back(base.edge_of[std::size_t(h)]);
      base.ring_vertex.push_back(corner(h % 3 == 2 ? h - 2 : h + 1));
      ++seen;
      const int back = previous(h), next = twin(back);
      if (next < 0) {  // the far border edge
        base.ring_edge.push_back(base.edge_of[std::size_t(back)]);
        base.ring_vertex.push_back(corner(back));
      }
      h = next == start[v] ? -1 : next;
    }
    if (seen != outgoing[v])
      refuse("vertex " + std::to_string(v) + " joins several fans of faces: " + std::to_string(seen) +
             " of its " + std::to_string(outgoing[v]) + " faces hang together");
  }
  base.ring_start[n] = int(base.ring_edge.size());
}

void find_creases(const ControlMesh& mesh, BaseMesh& base) {
  base.edge_kind.resize(base.edge_ends.size());
  for (std::size_t e = 0; e < base.edge_ends.size(); ++e)
    base.edge_kind[e] =
        base.edge_half[e][0] < 0 || base.edge_half[e][1] < 0 ? EdgeKind::border : EdgeKind::smooth;
  for (const auto& [a, b] : mesh.crease_edges) {
    const auto from = base.ring_vertex.begin() + base.ring_start[std::size_t(a)],
               to = base.ring_vertex.begin() + base.ring_start[std::size_t(a) + 1];
    const auto found = std::find(from, to, b);
    if (found == to) refuse("crease " + edge_name(a, b) + " is no edge of the mesh");
    EdgeKind& kind =
        base.edge_kind[std::size_t(base.ring_edge[std::size_t(found - base.ring_vertex.begin())])];
    if (kind == EdgeKind::smooth) kind = EdgeKind::crease;
  }
}

/// Weights of a sharp vertex of Liu et al. 2007: (2^(n-1) - n) / 2^(n-1) and 1 / 2^(n-1).
void set_liu_sharp(VertexClass& c, int vertex, int valence) {
  if (valence < 3)
    refuse("sharp vertex " + std::to_string(vertex) + " has valence " + std::to_string(valence) +
           ", scheme liu2007 needs 3 or more (its own weight is not positive below)");
  if (c.border) return;  // the inside must not pull the border: stays
  c.ring = std::ldexp(1.0, 1 - valence);
  c.centre = 1 - valence * c.ring;
}

VertexClass classify(const BaseMesh& base, std::size_t v, bool tagged, Scheme scheme) {
  const int begin = base.ring_start[v], end = base.ring_start[v + 1], valence = end - begin;
  int lines = 0, first = -1, second = -1;
  VertexClass c;
  for (int i = begin; i < end; ++i) {
    const EdgeKind kind = base.edge_kind[std::size_t(base.ring_edge[std::size_t(i)])];
    if (kind == EdgeKind::smooth) continue;
    c.border |= kind == EdgeKind::border;
    (lines == 0 ? first : second) = i - begin;
    ++lines;
  }
  if (tagged || valence == 0 || lines > 2) {
    c.rule = VertexRule::sharp;
    if (tagged && scheme == Scheme::liu2007) set_liu_sharp(c, int(v), valence);
  } else if (lines == 2) {
    VertexClass born = born_class(scheme, c.border ? EdgeKind::border : EdgeKind::crease);
    born.regular = c.border ? valence == 4 : valence == 6 && second - first == 3;
    return born;
  } else {
    c.rule = lines == 1 ? VertexRule::dart : VertexRule::smooth;
    c.ring = loop_alpha(valence);
    c.centre = 1 - valence * c.ring;
  }
  return c;
}

}  // namespace

double loop_alpha(int valence) {
  const double c = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / valence);
  return (0.625 - c * c) / valence;
}

VertexClass born_class(Scheme scheme, EdgeKind kind) {
  VertexClass c;
  c.rule = VertexRule::crease;
  c.border = kind == EdgeKind::border;
  c.regular = true;
  // Border and hoppe1994: the cubic B-spline. Inner creases of Liu et al. 2007: 7/8, 1/16.
  c.ring = c.border || scheme == Scheme::hoppe1994 ? 0.125 : 0.0625;
  c.centre = 1 - 2 * c.ring;
  return c;
}

std::optional<double> edge_weight(Scheme scheme, EdgeKind kind, const VertexClass& own,
                                  const VertexClass& other) {
  if (kind == EdgeKind::smooth) return std::nullopt;
  if (scheme == Scheme::liu2007) return 0.5;
  // Hoppe et al. 1994, table of crease edge masks.
  if (own.rule == VertexRule::dart || other.rule == VertexRule::dart) return std::nullopt;
  const bool own_regular = own.rule == VertexRule::crease && own.regular;
  const bool other_regular = other.rule == VertexRule::crease && other.regular;
  if (own_regular == other_regular) return 0.5;
  return own_regular ? 0.625 : 0.375;
}

void find_edges(const ControlMesh& mesh, BaseMesh& base) {
  check_indices(mesh);
  const std::size_t n = mesh.position_m.size();
  base.vertices = int(n);
  base.edge_of.resize(3 * mesh.triangles.size());
  base.edge_ends.reserve(base.edge_of.size());
  base.edge_half.reserve(base.edge_of.size());
  std::vector<int> newest(n, -1), older;  // edges of each vertex as the lower end, as chains
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = mesh.triangles[f][i], b = mesh.triangles[f][(i + 1) % 3], lo = std::min(a, b),
                hi = std::max(a, b);
      int e = newest[std::size_t(lo)];
      while (e >= 0 && base.edge_ends[std::size_t(e)][1] != hi) e = older[std::size_t(e)];
      if (e < 0) {
        e = int(base.edge_ends.size());
        base.edge_ends.push_back({lo, hi});
        base.edge_half.push_back({-1, -1});
        older.push_back(newest[std::size_t(lo)]);
        newest[std::size_t(lo)] = e;
      }
      auto& both = base.edge_half[std::size_t(e)];
      int& half = both[a < b ? 0 : 1];
      if (half >= 0) {
        const std::string where =
            edge_name(a, b) + " at triangles " + std::to_string(half / 3) + " and " + std::to_string(f);
        if (both[a < b ? 1 : 0] >= 0) refuse(where + " has more than two faces");
        refuse(where + " runs the same way in both: opposite orientation, or more than two faces");
      }
      half = int(3 * f + i);
      base.edge_of[3 * f + i] = e;
    }
}

BaseMesh analyse(const ControlMesh& mesh, Scheme scheme) {
  BaseMesh base;
  find_edges(mesh, base);
  find_rings(mesh, base);
  find_creases(mesh, base);
  std::vector<char> tagged(mesh.position_m.size(), 0);
  for (const int v : mesh.sharp_vertices) tagged[std::size_t(v)] = 1;
  base.vertex_class.resize(mesh.position_m.size());
  for (std::size_t v = 0; v < tagged.size(); ++v)
    base.vertex_class[v] = classify(base, v, tagged[v] != 0, scheme);
  return base;
}

void add_creases_by_angle(ControlMesh& mesh, double angle_deg) {
  if (!(angle_deg >= 0 && angle_deg <= 180))
    refuse("crease angle is " + std::to_string(angle_deg) + " degrees, must be 0..180");
  BaseMesh base;
  find_edges(mesh, base);
  const auto normal = [&](int half) {
    const auto& t = mesh.triangles[std::size_t(half / 3)];
    const glm::dvec3 &a = mesh.position_m[std::size_t(t[0])], &b = mesh.position_m[std::size_t(t[1])],
                     &c = mesh.position_m[std::size_t(t[2])];
    return glm::cross(b - a, c - a);
  };
  std::vector<std::array<int, 2>> known = mesh.crease_edges;
  for (auto& e : known) std::sort(e.begin(), e.end());
  std::sort(known.begin(), known.end());
  for (std::size_t e = 0; e < base.edge_ends.size(); ++e) {
    const auto [up, down] = base.edge_half[e];
    if (up < 0 || down < 0) continue;
    const glm::dvec3 p = normal(up), q = normal(down);
    const double angle =
        std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q));  // sharp for small angles, too
    if (angle * 180 / std::numbers::pi > angle_deg &&
        !std::binary_search(known.begin(), known.end(), base.edge_ends[e]))
      mesh.crease_edges.push_back(base.edge_ends[e]);
  }
}

}  // namespace witherfield::fruit
