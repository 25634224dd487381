// Values of refined vertices, level by level, up to four channels at a time.
//
// One step computes what stands around the vertices, edges and faces of the level before the one it starts
// from: the seven values around an edge's vertex give that vertex's successor and both halves of the edge,
// the six of a split face give its three inner edges. So a refined vertex costs 2.5 gathered values instead
// of the 4.75 of its own masks, and the tables are those of the coarser level. Creases and borders are then
// written over.
#include <algorithm>
#include <cstring>
#include <memory>

#include "sim/core/parallel.hpp"
#include "sim/fruit/refinement_tables.hpp"

namespace witherfield::fruit {
namespace {

constexpr std::size_t kGrain = 4096;

/// Four channels. GCC's and clang's vector types of 16 bytes: the same bits on every machine.
struct Float4 {
  using Scalar = float;
  typedef float V __attribute__((vector_size(16)));
  V v;
  friend Float4 operator+(Float4 a, Float4 b) { return {a.v + b.v}; }
  friend Float4 operator*(float w, Float4 a) { return {w * a.v}; }
};

struct Double4 {
  using Scalar = double;
  typedef double V __attribute__((vector_size(16)));
  V low, high;
  friend Double4 operator+(Double4 a, Double4 b) { return {a.low + b.low, a.high + b.high}; }
  friend Double4 operator*(double w, Double4 a) { return {w * a.low, w * a.high}; }
};

/// Writes values of an inner level.
template <class Pack>
struct Packed {
  Pack* out;
  void put(std::size_t i, Pack p) const { out[i] = p; }
};

/// Writes the first kLanes channels into the caller's array.
template <class Pack, int kLanes>
struct Strided {
  typename Pack::Scalar* out;
  std::size_t stride;
  void put(std::size_t i, Pack p) const {
    std::memcpy(out + i * stride, &p, kLanes * sizeof(typename Pack::Scalar));
  }
};

/// Small loops stay on this thread.
template <class Body>
void over(std::size_t n, const Body& body) {
  if (n <= kGrain)
    body(std::size_t(0), n);
  else
    parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) { body(begin, end); });
}

/// Control vertices by their own weights, whatever rule those stand for; creases are written over later.
template <class Pack, class Out>
void control_vertices(const Refinement::Tables& t, int k, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  const BaseMesh& base = t.base;
  const int below = k > 0 ? t.levels[std::size_t(k) - 1].vertices : 0;
  over(std::size_t(base.vertices), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const VertexClass& c = base.vertex_class[v];
      Pack sum{};
      for (int i = base.ring_start[v]; i < base.ring_start[v + 1]; ++i)
        sum = sum + in[k == 0 ? base.ring_vertex[std::size_t(i)]
                              : spoke_vertex(t.base_spoke[std::size_t(i)], 0, k, below)];
      out.put(v, T(c.centre) * in[v] + T(c.ring) * sum);
    }
  });
}

/// Edges of the control mesh, all by the smooth mask.
template <class Pack, class Out>
void control_edges(const Refinement::Tables& t, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  const BaseMesh& base = t.base;
  const int* corner = t.levels[0].corner;
  const auto opposite = [&](int half, int fallback) {
    return half < 0 ? fallback : corner[std::size_t(half % 3 == 0 ? half + 2 : half - 1)];
  };
  over(base.edge_ends.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [lo, hi] = base.edge_ends[e];
      const auto [up, down] = base.edge_half[e];
      out.put(std::size_t(base.vertices) + e,
              T(0.375) * (in[lo] + in[hi]) + T(0.125) * (in[opposite(up, lo)] + in[opposite(down, lo)]));
    }
  });
}

/// Vertices born in level `birth` < k: six neighbours, Loop's 5/8 and 1/16.
template <class Pack, class Out>
void older_vertices(const Refinement::Tables& t, int birth, int k, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  const std::size_t first = std::size_t(t.levels[std::size_t(birth) - 1].vertices);
  const int below = t.levels[std::size_t(k) - 1].vertices;
  const int* spokes = t.levels[std::size_t(birth)].spoke;
  over(std::size_t(t.levels[std::size_t(birth) - 1].edges), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const int* s = spokes + kRing * e;
      const auto at = [&](int i) { return in[spoke_vertex(s[i], birth, k, below)]; };
      out.put(first + e,
              T(0.625) * in[first + e] + T(0.0625) * (at(0) + at(1) + at(2) + at(3) + at(4) + at(5)));
    }
  });
}

/// Vertices born in level k > 0 and the halves of the edges that they came from.
template <class Pack, class Out>
void newest_vertices(const Refinement::Tables& t, int k, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  const Level &parent = t.levels[std::size_t(k) - 1], &level = t.levels[std::size_t(k)];
  const std::size_t first = std::size_t(parent.vertices), halves = std::size_t(level.vertices);
  const int* rings = level.ring;
  over(std::size_t(parent.edges), [&, rings](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const int* r = rings + kRing * e;
      const Pack own = in[first + e], hi = in[r[0]], left_hi = in[r[1]], left_lo = in[r[2]], lo = in[r[3]],
                 right_lo = in[r[4]], right_hi = in[r[5]];
      const Pack across_lo = left_lo + right_lo, across_hi = left_hi + right_hi;
      out.put(first + e, T(0.625) * own + T(0.0625) * ((lo + hi) + (across_lo + across_hi)));
      out.put(halves + 2 * e, T(0.375) * (own + lo) + T(0.125) * across_lo);
      out.put(halves + 2 * e + 1, T(0.375) * (own + hi) + T(0.125) * across_hi);
    }
  });
}

/// Edges of level k > 0 that lie inside a face of the level before.
template <class Pack, class Out>
void inner_edges(const Refinement::Tables& t, int k, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  const Level &parent = t.levels[std::size_t(k) - 1], &level = t.levels[std::size_t(k)];
  const std::size_t first = std::size_t(level.vertices) + 2 * std::size_t(parent.edges);
  const Pack* mid = in + parent.vertices;
  over(std::size_t(parent.faces), [&, mid](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const int* v = parent.corner + 3 * f;
      const int* e = parent.edge_of + 3 * f;
      const Pack m0 = mid[e[0]], m1 = mid[e[1]], m2 = mid[e[2]];
      out.put(first + 3 * f, T(0.375) * (m0 + m2) + T(0.125) * (in[v[0]] + m1));
      out.put(first + 3 * f + 1, T(0.375) * (m1 + m0) + T(0.125) * (in[v[1]] + m2));
      out.put(first + 3 * f + 2, T(0.375) * (m2 + m1) + T(0.125) * (in[v[2]] + m0));
    }
  });
}

template <class Pack, class Out>
void special_rules(const Level& level, const Pack* in, const Out& out) {
  using T = typename Pack::Scalar;
  over(level.edge_rules.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const EdgeOverride& r = level.edge_rules[i];
      out.put(std::size_t(level.vertices) + std::size_t(r.edge),
              T(r.weight_lo) * in[r.lo] + T(r.weight_hi) * in[r.hi]);
    }
  });
  over(level.vertex_rules.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexOverride& r = level.vertex_rules[i];
      out.put(std::size_t(r.vertex), T(r.centre) * in[r.vertex] + T(r.side) * (in[r.a] + in[r.b]));
    }
  });
}

/// Values of level k + 1 from those of level k.
template <class Pack, class Out>
void step(const Refinement::Tables& t, int k, const Pack* in, const Out& out) {
  control_vertices(t, k, in, out);
  if (k == 0) {
    control_edges(t, in, out);
  } else {
    for (int birth = 1; birth < k; ++birth) older_vertices(t, birth, k, in, out);
    newest_vertices(t, k, in, out);
    inner_edges(t, k, in, out);
  }
  special_rules(t.levels[std::size_t(k)], in, out);
}

template <class Pack, int kLanes>
void evaluate_lanes(const Refinement::Tables& t, const typename Pack::Scalar* control,
                    typename Pack::Scalar* refined, std::size_t stride) {
  using T = typename Pack::Scalar;
  const std::size_t last = std::size_t(t.steps), n = std::size_t(t.base.vertices);
  const Strided<Pack, kLanes> result{refined, stride};
  if (last == 0) {
    for (std::size_t v = 0; v < n; ++v) std::copy_n(control + v * stride, kLanes, refined + v * stride);
    return;
  }
  // Two buffers in turn; the last inner level is in the first one.
  const std::size_t larger = std::size_t(t.levels[last - 1].vertices),
                    smaller = last >= 2 ? std::size_t(t.levels[last - 2].vertices) : 0;
  const auto memory = std::make_unique_for_overwrite<Pack[]>(larger + smaller);
  Pack* in = last % 2 == 1 ? memory.get() : memory.get() + larger;
  Pack* other = last % 2 == 1 ? memory.get() + larger : memory.get();
  for (std::size_t v = 0; v < n; ++v) {
    T lanes[4] = {};
    std::copy_n(control + v * stride, kLanes, lanes);
    std::memcpy(&in[v], lanes, sizeof lanes);
  }
  for (int k = 0; k + 1 < t.steps; ++k) {
    step(t, k, in, Packed<Pack>{other});
    std::swap(in, other);
  }
  step(t, t.steps - 1, in, result);
}

template <class Pack, class T>
void evaluate_channels(const Refinement::Tables& t, const T* control, T* refined, int channels) {
  const std::size_t stride = std::size_t(channels);
  for (int c = 0; c < channels; c += 4) switch (std::min(4, channels - c)) {
      case 1:
        evaluate_lanes<Pack, 1>(t, control + c, refined + c, stride);
        break;
      case 2:
        evaluate_lanes<Pack, 2>(t, control + c, refined + c, stride);
        break;
      case 3:
        evaluate_lanes<Pack, 3>(t, control + c, refined + c, stride);
        break;
      default:
        evaluate_lanes<Pack, 4>(t, control + c, refined + c, stride);
    }
}

}  // namespace

void evaluate_tables(const Refinement::Tables& t, const float* control, float* refined, int channels) {
  evaluate_channels<Float4>(t, control, refined, channels);
}

void evaluate_tables(const Refinement::Tables& t, const double* control, double* refined, int channels) {
  evaluate_channels<Double4>(t, control, refined, channels);
}

}  // namespace witherfield::fruit
