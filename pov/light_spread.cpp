// Light that wanders below the skin: diffusion of irradiance over the mesh, by conjugate gradients.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/studio_light.hpp"

namespace witherfield::pov {
namespace {

/// One off-diagonal entry of the Laplacian.
struct Edge {
  int a, b;
  glm::vec3 weight;  ///< cotangent weight times the square of the lengths
};

struct System {
  std::vector<Edge> edges;
  std::vector<glm::vec3> mass, diagonal;

  std::vector<glm::vec3> times(const std::vector<glm::vec3>& x) const {
    std::vector<glm::vec3> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = diagonal[i] * x[i];
    for (const Edge& e : edges) {
      y[std::size_t(e.a)] -= e.weight * x[std::size_t(e.b)];
      y[std::size_t(e.b)] -= e.weight * x[std::size_t(e.a)];
    }
    return y;
  }
};

System assemble(const LitMesh& m) {
  System s;
  s.mass.assign(m.vertices.size(), glm::vec3(1e-14f));
  for (const auto& t : m.triangles) {
    glm::vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = m.vertices[std::size_t(t[k])].position_m;
    const float twice = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      s.mass[std::size_t(t[k])] += glm::vec3(twice / 6);
      if (!(twice > 0)) continue;
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const float cotangent = glm::dot(p[i] - p[k], p[j] - p[k]) / twice;
      const glm::vec3 length = 0.5f * (m.vertices[std::size_t(t[i])].spread_m + m.vertices[std::size_t(t[j])].spread_m);
      // Obtuse corners would take light from one vertex to give more to the other: never below zero.
      const glm::vec3 w = length * length * (0.5f * std::clamp(cotangent, 0.0f, 20.0f));
      if (w.x + w.y + w.z > 0) s.edges.push_back({t[i], t[j], w});
    }
  }
  s.diagonal = s.mass;
  for (const Edge& e : s.edges) {
    s.diagonal[std::size_t(e.a)] += e.weight;
    s.diagonal[std::size_t(e.b)] += e.weight;
  }
  return s;
}

using Sums = glm::dvec3;
Sums dot(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  Sums sum(0.0);
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dvec3(a[i]) * glm::dvec3(b[i]);
  return sum;
}

glm::vec3 ratio(const Sums& a, const Sums& b) {
  glm::vec3 r(0.0f);
  for (int c = 0; c < 3; ++c) r[c] = b[c] > 0 ? float(a[c] / b[c]) : 0.0f;
  return r;
}

}  // namespace

std::vector<glm::vec3> spread_light(const LitMesh& m, std::vector<glm::vec3> light) {
  const System s = assemble(m);
  if (s.edges.empty()) return light;
  // The three colours are three systems solved side by side; start from the light as it fell.
  std::vector<glm::vec3> x = light, r = s.times(x), z(x.size()), p(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    r[i] = s.mass[i] * light[i] - r[i];
    p[i] = z[i] = r[i] / s.diagonal[i];
  }
  Sums rz = dot(r, z);
  const Sums start = rz;
  for (int step = 0; step < 60; ++step) {
    const auto q = s.times(p);
    const glm::vec3 a = ratio(rz, dot(p, q));
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += a * p[i];
      r[i] -= a * q[i];
      z[i] = r[i] / s.diagonal[i];
    }
    const Sums next = dot(r, z);
    if (next.x <= 1e-8 * start.x && next.y <= 1e-8 * start.y && next.z <= 1e-8 * start.z) break;
    const glm::vec3 b = ratio(next, rz);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + b * p[i];
    rz = next;
  }
  return x;
}

}  // namespace witherfield::pov
