#include "sim/leaf/shell_patch.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <tuple>

#include "sim/core/errors.hpp"
#include "sim/leaf/hinge.hpp"

namespace witherfield::leaf {
namespace {

struct HalfEdge {
  int from, to, triangle, opposite;
};

void set_geometry(ShellPatch& p, std::span<const glm::dvec3> x, std::size_t number) {
  const glm::dvec3 a = x[std::size_t(p.corner[0])], e1 = x[std::size_t(p.corner[1])] - a, e2 = x[std::size_t(p.corner[2])] - a;
  const glm::dvec3 n = glm::cross(e1, e2);
  const double twice = glm::length(n), longest = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e2 - e1, e2 - e1)});
  if (!(twice > 1e-9 * longest))
    throw InvalidInput("WiltBody: triangle " + std::to_string(number) + " has no area (its corners lie on one line)");
  p.area_m2 = twice / 2;
  p.axis_u = e1 / glm::length(e1);
  p.axis_v = glm::cross(n / twice, p.axis_u);
  const std::array<glm::dvec2, 3> q{glm::dvec2(0.0), glm::dvec2(glm::length(e1), 0.0),
                                    glm::dvec2(glm::dot(e2, p.axis_u), glm::dot(e2, p.axis_v))};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 edge = q[(i + 2) % 3] - q[(i + 1) % 3];
    p.gradient[i] = glm::dvec2(-edge.y, edge.x) / twice;  // towards the corner, 1 / height
  }
}

}  // namespace

double ShellPatch::height_m(int i) const { return 1 / glm::length(gradient[std::size_t(i)]); }
double ShellPatch::edge_m(int i) const { return 2 * area_m2 * glm::length(gradient[std::size_t(i)]); }
double ShellPatch::cotangent(int i) const {
  // grad_j . grad_k = -cot(angle at i) / (2 A): the identity behind the cotangent operator.
  return -2 * area_m2 * glm::dot(gradient[std::size_t((i + 1) % 3)], gradient[std::size_t((i + 2) % 3)]);
}

std::vector<ShellPatch> make_patches(std::span<const glm::dvec3> x, std::span<const std::array<int, 3>> triangles) {
  std::vector<ShellPatch> patches(triangles.size());
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    ShellPatch& p = patches[t];
    p.corner = triangles[t];
    p.across = {-1, -1, -1};
    p.rest_angle = {0, 0, 0};
    set_geometry(p, x, t);
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({p.corner[(i + 1) % 3], p.corner[(i + 2) % 3], int(t), int(i)});
  }
  const auto key = [](const HalfEdge& e) { return std::pair(std::min(e.from, e.to), std::max(e.from, e.to)); };
  std::sort(edges.begin(), edges.end(), [&](const HalfEdge& a, const HalfEdge& b) {
    return std::tuple(key(a), a.triangle) < std::tuple(key(b), b.triangle);
  });
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    if (key(edges[k]) != key(edges[k + 1])) continue;
    const HalfEdge &a = edges[k], &b = edges[k + 1];
    const std::string at = "WiltBody: triangles " + std::to_string(a.triangle) + " and " + std::to_string(b.triangle);
    if (k + 2 < edges.size() && key(edges[k + 2]) == key(a)) throw InvalidInput(at + " share an edge with a third one");
    if (a.from == b.from) throw InvalidInput(at + " are neighbours with opposite orientation");
    ShellPatch &p = patches[std::size_t(a.triangle)], &q = patches[std::size_t(b.triangle)];
    p.across[std::size_t(a.opposite)] = q.corner[std::size_t(b.opposite)];
    q.across[std::size_t(b.opposite)] = p.corner[std::size_t(a.opposite)];
    const double angle = hinge_angle(x[std::size_t(p.corner[std::size_t(a.opposite)])], x[std::size_t(a.from)], x[std::size_t(a.to)],
                                     x[std::size_t(q.corner[std::size_t(b.opposite)])]);
    p.rest_angle[std::size_t(a.opposite)] = q.rest_angle[std::size_t(b.opposite)] = angle;
  }
  return patches;
}

}  // namespace witherfield::leaf
