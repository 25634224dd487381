#include "pov/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace witherfield::pov {
namespace {

constexpr int kLeaf = 4, kBins = 16;
constexpr float kFar = std::numeric_limits<float>::infinity();

struct Box {
  glm::vec3 low{kFar}, high{-kFar};
  void add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  float half_area() const {
    const glm::vec3 d = high - low;
    return d.x < 0 ? 0.0f : d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

}  // namespace

struct TriangleTree::Builder {
  std::vector<Box> boxes;
  std::vector<glm::vec3> centers;
  std::vector<int> order;
  std::span<const glm::vec3> positions;
  std::span<const std::array<int, 3>> triangles;
  std::vector<Node>& nodes;
  std::vector<Group>& groups;

  /// Where to part [begin, end), or begin when it should stay a leaf.
  int part(int begin, int end, int depth) {
    if (depth > 30) return (begin + end) / 2;  // never deeper than the stack of trace
    Box spread;
    for (int i = begin; i < end; ++i) spread.add(centers[std::size_t(order[std::size_t(i)])]);
    const glm::vec3 size = spread.high - spread.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto from = order.begin() + begin, to = order.begin() + end;
    if (!(size[axis] > 0)) return end - begin > 64 ? (begin + end) / 2 : begin;
    const auto bin = [&](int t) {
      const float x = (centers[std::size_t(t)][axis] - spread.low[axis]) / size[axis];
      return std::min(kBins - 1, int(x * kBins));
    };
    std::array<Box, kBins> box;
    std::array<int, kBins> count{};
    for (auto t = from; t != to; ++t) {
      box[std::size_t(bin(*t))].add(boxes[std::size_t(*t)]);
      ++count[std::size_t(bin(*t))];
    }
    std::array<float, kBins> right{};
    Box all;
    int n = 0;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      all.add(box[b]);
      n += count[b];
      right[b] = all.half_area() * float(n);
    }
    all = {};
    n = 0;
    float best = kFar;
    int best_bin = 0;
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
      all.add(box[b]);
      n += count[b];
      const float cost = all.half_area() * float(n) + right[b + 1];
      if (n > 0 && n < end - begin && cost < best) {
        best = cost;
        best_bin = int(b);
      }
    }
    return int(std::stable_partition(from, to, [&](int t) { return bin(t) <= best_bin; }) - order.begin());
  }

  Box box_of(int begin, int end) const {
    Box box;
    for (int i = begin; i < end; ++i) box.add(boxes[std::size_t(order[std::size_t(i)])]);
    return box;
  }

  /// A node over [begin, end): parted in two, and the two parts again. @returns its number.
  int build(int begin, int end, int depth) {
    std::array<std::array<int, 2>, 4> child{{{begin, end}}};
    std::size_t children = 1;
    for (int round = 0; round < 2; ++round)
      for (std::size_t k = 0, n = children; k < n; ++k) {
        const auto [from, to] = child[k];
        if (to - from <= kLeaf) continue;
        const int middle = part(from, to, depth);
        if (middle <= from || middle >= to) continue;
        child[k] = {from, middle};
        child[children++] = {middle, to};
      }
    const int self = int(nodes.size());
    nodes.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const bool used = k < children;
      const auto [from, to] = used ? child[k] : std::array{0, 0};
      const Box box = used ? box_of(from, to) : Box{};
      // Equal boxes are not parted further.
      const bool leaf = to - from <= kLeaf || children == 1;
      const int first = !used ? 0 : leaf ? add_groups(from, to) : build(from, to, depth + 1);
      Node& n = nodes[std::size_t(self)];
      for (int a = 0; a < 3; ++a) {
        n.low[a][k] = box.low[a];
        n.high[a][k] = box.high[a];
      }
      n.first[k] = first;
      n.count[k] = !used ? -1 : leaf ? to - from : 0;
    }
    return self;
  }

  int add_groups(int begin, int end) {
    const int first = int(groups.size());
    for (int i = begin; i < end; i += 4) {
      Group g{};  // the rest stay points, which no ray meets
      for (int k = 0; k < 4; ++k) {
        g.face[k] = -1;
        if (i + k >= end) continue;
        g.face[k] = order[std::size_t(i + k)];
        const auto& t = triangles[std::size_t(g.face[k])];
        const glm::vec3 p = positions[std::size_t(t[0])], ab = positions[std::size_t(t[1])] - p,
                        ac = positions[std::size_t(t[2])] - p;
        for (int a = 0; a < 3; ++a) {
          g.a[a][k] = p[a];
          g.ab[a][k] = ab[a];
          g.ac[a][k] = ac[a];
        }
      }
      groups.push_back(g);
    }
    return first;
  }
};

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const std::array<int, 3>> triangles) {
  Builder b{{}, {}, std::vector<int>(triangles.size()), positions, triangles, nodes_, groups_};
  std::iota(b.order.begin(), b.order.end(), 0);
  for (const auto& t : triangles) {
    Box box;
    for (const int v : t) box.add(positions[std::size_t(v)]);
    b.boxes.push_back(box);
    b.centers.push_back(0.5f * (box.low + box.high));
  }
  if (!triangles.empty()) b.build(0, int(triangles.size()), 0);
}

template <bool kAny>
int TriangleTree::trace(const glm::vec3& o, const glm::vec3& d, float reach) const {
  if (nodes_.empty()) return -1;
  glm::vec3 inverse;  // finite, so that 0 * inverse is 0 for rays along an axis
  for (int k = 0; k < 3; ++k) inverse[k] = 1.0f / (std::abs(d[k]) > 1e-20f ? d[k] : std::copysign(1e-20f, d[k]));
  // Which side of the boxes the ray enters by.
  const bool back[3] = {inverse.x < 0, inverse.y < 0, inverse.z < 0};
  struct Waiting {
    int first, count;
    float in;
  };
  Waiting stack[256];
  int depth = 0, hit = -1;
  stack[depth++] = {0, 0, 0.0f};
  while (depth > 0) {
    const Waiting now = stack[--depth];
    if (now.in > reach) continue;
    if (now.count == 0) {
      const Node& n = nodes_[std::size_t(now.first)];
      Four in{}, out = Four{} + reach;
      for (int a = 0; a < 3; ++a) {
        const Four x = ((back[a] ? n.high[a] : n.low[a]) - o[a]) * inverse[a];
        const Four y = ((back[a] ? n.low[a] : n.high[a]) - o[a]) * (inverse[a] * 1.000001f);
        in = in < x ? x : in;
        out = y < out ? y : out;
      }
      const int bottom = depth;
      for (int k = 0; k < 4; ++k)
        if (n.count[k] >= 0 && in[k] <= out[k]) {
          int place = depth++;  // the nearest on top
          for (; place > bottom && stack[place - 1].in < in[k]; --place) stack[place] = stack[place - 1];
          stack[place] = {n.first[k], n.count[k], in[k]};
        }
      continue;
    }
    for (int i = now.first; i < now.first + (now.count + 3) / 4; ++i) {
      // Moeller and Trumbore 1997, four triangles at once.
      const Group& g = groups_[std::size_t(i)];
      const Four px = d.y * g.ac[2] - d.z * g.ac[1], py = d.z * g.ac[0] - d.x * g.ac[2],
                 pz = d.x * g.ac[1] - d.y * g.ac[0];
      const Four scale = 1.0f / (g.ab[0] * px + g.ab[1] * py + g.ab[2] * pz);
      const Four sx = o.x - g.a[0], sy = o.y - g.a[1], sz = o.z - g.a[2];
      const Four u = (sx * px + sy * py + sz * pz) * scale;
      const Four qx = sy * g.ab[2] - sz * g.ab[1], qy = sz * g.ab[0] - sx * g.ab[2], qz = sx * g.ab[1] - sy * g.ab[0];
      const Four v = (d.x * qx + d.y * qy + d.z * qz) * scale;
      const Four t = (g.ac[0] * qx + g.ac[1] * qy + g.ac[2] * qz) * scale;
      // Faces seen edge-on and empty places give infinity or no number: all comparisons fail.
      const auto meets = (u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f) & (t > 0.0f) & (t < reach);
      for (int k = 0; k < 4; ++k)
        if (meets[k] && t[k] < reach) {
          if (kAny) return g.face[k];
          reach = t[k];
          hit = g.face[k];
        }
    }
  }
  return hit;
}

int TriangleTree::first_hit(const glm::vec3& o, const glm::vec3& d, float reach) const {
  return trace<false>(o, d, reach);
}

bool TriangleTree::blocked(const glm::vec3& o, const glm::vec3& d, float reach) const {
  return trace<true>(o, d, reach) >= 0;
}

}  // namespace witherfield::pov
