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
  std::vector<Node>& nodes;

  /// Where to part [begin, end), or begin when it should stay a leaf.
  int part(int begin, int end, int depth) {
    if (depth > 60) return (begin + end) / 2;  // never deeper than the stack of trace
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

  void build(int begin, int end, int depth) {
    const std::size_t self = nodes.size();
    Box box;
    for (int i = begin; i < end; ++i) box.add(boxes[std::size_t(order[std::size_t(i)])]);
    nodes.push_back({box.low, box.high, begin, end - begin});
    if (end - begin <= kLeaf) return;
    const int middle = part(begin, end, depth);
    if (middle <= begin || middle >= end) return;
    nodes[self].count = 0;
    build(begin, middle, depth + 1);
    nodes[self].first = int(nodes.size());
    build(middle, end, depth + 1);
  }
};

TriangleTree::TriangleTree(std::span<const glm::vec3> p, std::span<const std::array<int, 3>> triangles) {
  Builder b{{}, {}, std::vector<int>(triangles.size()), nodes_};
  std::iota(b.order.begin(), b.order.end(), 0);
  for (const auto& t : triangles) {
    Box box;
    for (const int v : t) box.add(p[std::size_t(v)]);
    b.boxes.push_back(box);
    b.centers.push_back(0.5f * (box.low + box.high));
  }
  if (!triangles.empty()) b.build(0, int(triangles.size()), 0);
  corners_.reserve(triangles.size());
  for (const int f : b.order) {
    const auto& t = triangles[std::size_t(f)];
    const glm::vec3 a = p[std::size_t(t[0])];
    corners_.push_back({a, p[std::size_t(t[1])] - a, p[std::size_t(t[2])] - a, f});
  }
}

template <bool kAny>
int TriangleTree::trace(const glm::vec3& o, const glm::vec3& d, float reach) const {
  if (nodes_.empty()) return -1;
  glm::vec3 inverse;  // finite, so that 0 * inverse is 0 for rays along an axis
  for (int k = 0; k < 3; ++k) inverse[k] = 1.0f / (std::abs(d[k]) > 1e-20f ? d[k] : std::copysign(1e-20f, d[k]));
  const auto enter = [&](const Node& n) {
    const glm::vec3 a = (n.low - o) * inverse, b = (n.high - o) * inverse;
    const glm::vec3 near = glm::min(a, b), far = glm::max(a, b);
    const float in = std::max({near.x, near.y, near.z, 0.0f}), out = std::min({far.x, far.y, far.z, reach});
    return in <= out * 1.000001f ? in : kFar;
  };
  int stack[128], depth = 0, hit = -1;
  if (enter(nodes_[0]) < kFar) stack[depth++] = 0;
  while (depth > 0) {
    const int at = stack[--depth];
    const Node& node = nodes_[std::size_t(at)];
    if (node.count == 0) {
      int near = at + 1, far = node.first;
      float in_near = enter(nodes_[std::size_t(near)]), in_far = enter(nodes_[std::size_t(far)]);
      if (in_far < in_near) {
        std::swap(near, far);
        std::swap(in_near, in_far);
      }
      if (in_far < kFar) stack[depth++] = far;
      if (in_near < kFar) stack[depth++] = near;
      continue;
    }
    // Moeller and Trumbore 1997.
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Corner& c = corners_[std::size_t(i)];
      const glm::vec3 p = glm::cross(d, c.ac);
      const float det = glm::dot(c.ab, p);
      if (det == 0) continue;
      const glm::vec3 s = o - c.a;
      const float u = glm::dot(s, p) / det;
      if (!(u >= 0 && u <= 1)) continue;
      const glm::vec3 q = glm::cross(s, c.ab);
      const float v = glm::dot(d, q) / det;
      if (!(v >= 0 && u + v <= 1)) continue;
      const float t = glm::dot(c.ac, q) / det;
      if (!(t > 0 && t < reach)) continue;
      if (kAny) return c.face;
      reach = t;
      hit = c.face;
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
