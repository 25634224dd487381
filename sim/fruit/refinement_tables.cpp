// Refinement of a topology: arithmetic on indices, face by face.
#include "sim/fruit/refinement_tables.hpp"

#include <algorithm>
#include <cstring>

#include "sim/core/parallel.hpp"

namespace witherfield::fruit {
namespace {

constexpr std::size_t kFaceGrain = 8192;

/// The four children of face f. Edge i of a child runs from its corner i to its corner i + 1.
inline void write_children(const int* v, const int* e, const int* mid, int inner, int* corner, int* edge_of) {
  for (int i = 0; i < 3; ++i) {
    const int back = i == 0 ? 2 : i - 1;
    corner[3 * i] = v[i];
    corner[3 * i + 1] = mid[i];
    corner[3 * i + 2] = mid[back];
    corner[9 + i] = mid[i];
    if (!edge_of) continue;
    edge_of[3 * i] = 2 * e[i] + (v[i] > v[i == 2 ? 0 : i + 1]);
    edge_of[3 * i + 1] = inner + i;
    edge_of[3 * i + 2] = 2 * e[back] + (v[i] > v[back]);
    edge_of[9 + i] = inner + (i == 2 ? 0 : i + 1);
  }
}

/// What face f knows of the rings of its edges' vertices: one side each.
inline void write_rings(const int* v, const int* e, const int* mid, int inner, int* ring, int* spoke) {
  for (int i = 0; i < 3; ++i) {
    const int next = i == 2 ? 0 : i + 1, back = i == 0 ? 2 : i - 1;
    const bool down = v[i] > v[next];
    const std::size_t side = std::size_t(kRing) * std::size_t(e[i]) + (down ? 3 : 0);
    if (ring) {
      ring[side] = v[next];
      ring[side + 1] = mid[next];
      ring[side + 2] = mid[back];
    }
    if (spoke) {
      spoke[side] = 2 * (2 * e[i] + !down) + 1;  // the edge's vertex is the higher end of both halves
      spoke[side + 1] = 2 * (inner + next) + (e[i] > e[next]);
      spoke[side + 2] = 2 * (inner + i) + (e[i] > e[back]);
    }
  }
}

template <bool kEdges, bool kRings, bool kSpokes>
void split_range(const Level& from, const Level& to, std::size_t begin, std::size_t end) {
  for (std::size_t f = begin; f < end; ++f) {
    const int* v = from.corner + 3 * f;
    const int* e = from.edge_of + 3 * f;
    const int mid[3] = {from.vertices + e[0], from.vertices + e[1], from.vertices + e[2]};
    const int inner = 2 * from.edges + int(3 * f);
    if (to.corner)
      write_children(v, e, mid, inner, to.corner + 12 * f, kEdges ? to.edge_of + 12 * f : nullptr);
    if (kRings || kSpokes)
      write_rings(v, e, mid, inner, kRings ? to.ring : nullptr, kSpokes ? to.spoke : nullptr);
  }
}

/// The side of a border that has no face.
void fill_border(const LineVertex& v, int* ring, int* spoke) {
  const std::size_t at = std::size_t(kRing) * std::size_t(v.edge), missing = at + (v.left ? 3 : 0);
  if (ring) std::fill_n(ring + missing, 3, v.left ? v.lo : v.hi);
  if (spoke) std::fill_n(spoke + missing, 3, 2 * (2 * v.edge + (v.left ? 0 : 1)) + 1);
}

struct SpecialEdge {
  int edge, lo, hi;
  EdgeKind kind;
  bool left, right;
};

std::vector<SpecialEdge> special_edges(const BaseMesh& base) {
  std::vector<SpecialEdge> all;
  for (std::size_t e = 0; e < base.edge_ends.size(); ++e)
    if (base.edge_kind[e] != EdgeKind::smooth)
      all.push_back({int(e), base.edge_ends[e][0], base.edge_ends[e][1], base.edge_kind[e],
                     base.edge_half[e][0] >= 0, base.edge_half[e][1] >= 0});
  return all;
}

/// Rules along creases and borders in the step from level k to the next; moves `line` on to that level.
void special_step(Refinement::Tables& t, int k, std::vector<SpecialEdge>& line) {
  Level &from = t.levels[std::size_t(k)], &to = t.levels[std::size_t(k) + 1];
  const auto class_of = [&](int v, EdgeKind kind) {
    return v < t.base.vertices ? t.base.vertex_class[std::size_t(v)] : born_class(t.scheme, kind);
  };
  std::vector<SpecialEdge> halves;
  halves.reserve(2 * line.size());
  from.edge_rules.reserve(line.size());
  for (const SpecialEdge& s : line) {
    const auto w = edge_weight(t.scheme, s.kind, class_of(s.lo, s.kind), class_of(s.hi, s.kind));
    if (w) from.edge_rules.push_back({s.edge, s.lo, s.hi, *w, 1 - *w});
    const int mid = from.vertices + s.edge;
    const LineVertex born{mid, k + 1, s.lo, s.hi, s.edge, s.kind, s.left, s.right};
    t.line_vertices.push_back(born);
    if (s.kind == EdgeKind::border) fill_border(born, to.ring, to.spoke);
    halves.push_back({2 * s.edge, s.lo, mid, s.kind, s.left, s.right});
    halves.push_back({2 * s.edge + 1, s.hi, mid, s.kind, s.right, s.left});  // runs the other way
  }
  line = std::move(halves);
}

/// Crease and border vertices in every step.
void line_rules(Refinement::Tables& t) {
  for (int v = 0; v < t.base.vertices; ++v) {
    const VertexClass& c = t.base.vertex_class[std::size_t(v)];
    if (c.rule != VertexRule::crease) continue;
    int on_line[2], found = 0;
    for (int i = t.base.ring_start[std::size_t(v)]; i < t.base.ring_start[std::size_t(v) + 1]; ++i)
      if (t.base.edge_kind[std::size_t(t.base.ring_edge[std::size_t(i)])] != EdgeKind::smooth)
        on_line[found++] = i;
    for (int k = 0; k < t.steps; ++k) {
      const auto across = [&](int i) {
        return k == 0
                   ? t.base.ring_vertex[std::size_t(i)]
                   : spoke_vertex(t.base_spoke[std::size_t(i)], 0, k, t.levels[std::size_t(k) - 1].vertices);
      };
      t.levels[std::size_t(k)].vertex_rules.push_back(
          {v, across(on_line[0]), across(on_line[1]), c.centre, c.ring});
    }
  }
  for (const LineVertex& v : t.line_vertices) {
    const VertexClass c = born_class(t.scheme, v.kind);
    const int to_lo = 2 * (2 * v.edge) + 1, to_hi = 2 * (2 * v.edge + 1) + 1;
    for (int k = v.level; k < t.steps; ++k) {
      const int below = t.levels[std::size_t(k) - 1].vertices;
      t.levels[std::size_t(k)].vertex_rules.push_back(
          {v.vertex, k == v.level ? v.lo : spoke_vertex(to_lo, v.level, k, below),
           k == v.level ? v.hi : spoke_vertex(to_hi, v.level, k, below), c.centre, c.ring});
    }
  }
}

/// Sizes of all levels and their place in one block of memory.
void lay_out(Refinement::Tables& t) {
  t.levels.assign(std::size_t(t.steps) + 1, Level{});
  Level& first = t.levels[0];
  first.vertices = t.base.vertices;
  first.edges = int(t.base.edge_ends.size());
  first.faces = int(t.base.edge_of.size() / 3);
  for (std::size_t k = 1; k < t.levels.size(); ++k) {
    const Level& from = t.levels[k - 1];
    t.levels[k].vertices = from.vertices + from.edges;
    t.levels[k].edges = 2 * from.edges + 3 * from.faces;
    t.levels[k].faces = 4 * from.faces;
  }
  const auto each_array = [&](const auto& take) {
    const std::size_t last = std::size_t(t.steps);
    for (std::size_t k = 0; k <= last; ++k) {
      Level& l = t.levels[k];
      take(l.corner, 3 * std::size_t(l.faces));
      if (k < last) take(l.edge_of, 3 * std::size_t(l.faces));
      // Evaluation reads rings up to the level before the last and spokes one level less; the limit makes the
      // rest.
      if (k >= 1 && k < last) take(l.ring, kRing * std::size_t(t.levels[k - 1].edges));
      if (k >= 1 && k + 1 < last) take(l.spoke, kRing * std::size_t(t.levels[k - 1].edges));
    }
  };
  std::size_t total = (std::size_t(t.levels.back().vertices) + sizeof(int) - 1) / sizeof(int);
  const std::size_t rules = total;
  each_array([&](int*&, std::size_t n) { total += n; });
  int* free = t.memory.require(total);
  t.rules = reinterpret_cast<VertexRule*>(free);
  free += rules;
  each_array([&](int*& array, std::size_t n) {
    array = free;
    free += n;
  });
}

void set_rules(Refinement::Tables& t) {
  if (t.base.vertices == 0) return;
  std::memset(t.rules, int(VertexRule::smooth), std::size_t(t.levels.back().vertices));
  for (std::size_t v = 0; v < t.base.vertex_class.size(); ++v) t.rules[v] = t.base.vertex_class[v].rule;
  for (const LineVertex& v : t.line_vertices) t.rules[v.vertex] = VertexRule::crease;
}

}  // namespace

int* IndexMemory::require(std::size_t n) {
  constexpr std::size_t kLarge = std::size_t(1) << 20;
  static_assert(sizeof(int) == sizeof(float) && alignof(int) == alignof(float));
  if (n >= kLarge) {
    large_.require(n);
    return reinterpret_cast<int*>(large_.data());
  }
  if (n > capacity_) {
    small_ = std::make_unique_for_overwrite<int[]>(n);
    capacity_ = n;
  }
  return small_.get();
}

void split_faces(const Level& from, const Level& to) {
  parallel_for(std::size_t(from.faces), kFaceGrain, [&](std::size_t begin, std::size_t end) {
    if (!to.edge_of && !to.ring && !to.spoke) return split_range<false, false, false>(from, to, begin, end);
    if (!to.edge_of)
      return (to.ring ? split_range<false, true, false> : split_range<false, false, true>)(from, to, begin,
                                                                                           end);
    if (!to.ring) return split_range<true, false, false>(from, to, begin, end);
    if (!to.spoke) return split_range<true, true, false>(from, to, begin, end);
    split_range<true, true, true>(from, to, begin, end);
  });
}

void Refinement::Tables::build(const ControlMesh& mesh) {
  lay_out(*this);
  Level& first = levels[0];
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    std::copy_n(mesh.triangles[f].data(), 3, first.corner + 3 * f);
  if (first.edge_of) std::copy(base.edge_of.begin(), base.edge_of.end(), first.edge_of);
  base_spoke.resize(base.ring_edge.size());
  for (int v = 0; v < base.vertices; ++v)
    for (int i = base.ring_start[std::size_t(v)]; i < base.ring_start[std::size_t(v) + 1]; ++i)
      base_spoke[std::size_t(i)] =
          2 * base.ring_edge[std::size_t(i)] + (v > base.ring_vertex[std::size_t(i)]);
  std::vector<SpecialEdge> line = special_edges(base);
  for (int k = 0; k < steps; ++k) {
    split_faces(levels[std::size_t(k)], levels[std::size_t(k) + 1]);
    special_step(*this, k, line);
  }
  line_rules(*this);
  set_rules(*this);
}

int Refinement::Tables::born_in(int vertex) const {
  int k = 0;
  while (vertex >= levels[std::size_t(k)].vertices) ++k;
  return k;
}

const LimitTables& Refinement::Tables::limit_tables() const {
  const std::lock_guard hold(limit_lock);
  if (limit) return *limit;
  auto made = std::make_unique<LimitTables>();
  const std::size_t last = std::size_t(steps);
  const std::size_t rings = last >= 1 ? kRing * std::size_t(levels[last - 1].edges) : 0;
  const std::size_t spokes = last >= 2 ? kRing * std::size_t(levels[last - 2].edges) : 0;
  int* ring = made->memory.require(rings + spokes);
  int* spoke = ring + rings;
  Level to;
  if (rings > 0) to.ring = ring, split_faces(levels[last - 1], to);
  to.ring = nullptr;
  if (spokes > 0) to.spoke = spoke, split_faces(levels[last - 2], to);
  for (const LineVertex& v : line_vertices) {
    if (v.kind != EdgeKind::border) continue;
    if (v.level == steps) fill_border(v, ring, nullptr);
    if (v.level + 1 == steps) fill_border(v, nullptr, spoke);
  }
  made->ring = ring;
  made->spoke = spoke;
  limit = std::move(made);
  return *limit;
}

}  // namespace witherfield::fruit
