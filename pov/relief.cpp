#include "pov/relief.hpp"

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

float lattice(int x, int y, int z) {
  const auto word = philox4x32({std::uint32_t(x), std::uint32_t(y), std::uint32_t(z), 0x5eedu}, {0x11e1u, 7u});
  return float(word[0]) * 0x1p-31f - 1.0f;
}

/// The normal of a surface raised by h, where `slope` is the gradient of h in space.
glm::vec3 leaned(const glm::vec3& n, const glm::vec3& slope) {
  return glm::normalize(n - (slope - n * glm::dot(n, slope)));
}

}  // namespace

float bumps(const glm::vec3& at, glm::vec3& gradient) {
  const glm::vec3 cell = glm::floor(at), f = at - cell;
  const glm::vec3 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f), dw = 30.0f * f * f * (f - 1.0f) * (f - 1.0f);
  float v[2][2][2];
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) v[i][j][k] = lattice(int(cell.x) + i, int(cell.y) + j, int(cell.z) + k);
  const auto face = [&](const float (&q)[2][2], float a, float b) {
    return glm::mix(glm::mix(q[0][0], q[0][1], b), glm::mix(q[1][0], q[1][1], b), a);
  };
  const float low = face(v[0], w.y, w.z), high = face(v[1], w.y, w.z);
  const auto across = [&](int j) { return glm::mix(glm::mix(v[0][j][0], v[0][j][1], w.z), glm::mix(v[1][j][0], v[1][j][1], w.z), w.x); };
  const auto up = [&](int k) { return glm::mix(glm::mix(v[0][0][k], v[0][1][k], w.y), glm::mix(v[1][0][k], v[1][1][k], w.y), w.x); };
  gradient = dw * glm::vec3(high - low, across(1) - across(0), up(1) - up(0));
  return glm::mix(low, high, w.x);
}

void raise_veins(LitMesh& m, const Surface& s, const ObjectPlacement& o) {
  if (!m.thin || !s.has_field("vein") || s.field("vein").on_faces) return;
  const auto& vein = s.field("vein").values;
  std::vector<glm::vec3> slope(m.vertices.size(), glm::vec3(0.0f));
  std::vector<float> area(m.vertices.size(), 0.0f);
  for (std::size_t f = 0; f < m.triangles.size(); ++f) {
    const auto& t = m.triangles[f];
    const ObjectLook& look = look_of(o, m.organ[f]);
    if (look.kind != LookKind::leaf || look.detail) continue;
    const std::size_t i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
    const glm::vec3 a = m.vertices[i].position_m, b = m.vertices[j].position_m, c = m.vertices[k].position_m;
    const glm::vec3 n = glm::cross(b - a, c - a);
    const float twice = glm::length(n);
    if (!(twice > 0)) continue;
    // Gradient of a linear function on a triangle: sum of n x (opposite edge) x value over twice the area.
    const glm::vec3 gradient =
        glm::cross(n / twice, vein[i] * (c - b) + vein[j] * (a - c) + vein[k] * (b - a)) / twice;
    for (const std::size_t v : {i, j, k}) {
      slope[v] += gradient * twice * float(-0.25e-3 * look.relief * o.scale);
      area[v] += twice;
    }
  }
  for (std::size_t v = 0; v < slope.size(); ++v)
    if (area[v] > 0) m.vertices[v].normal = leaned(m.vertices[v].normal, slope[v] / area[v]);
}

void add_relief(LitMesh& m, const ObjectPlacement& o) {
  const glm::dvec3 origin = o.world(glm::dvec3(0.0));
  const auto turned = [&](const glm::vec3& v) { return glm::vec3((o.world(glm::dvec3(v)) - origin) / o.scale); };
  std::vector<char> done(m.vertices.size(), 0);
  for (std::size_t f = 0; f < m.triangles.size(); ++f) {
    const ObjectLook& look = look_of(o, m.organ[f]);
    for (const int v : m.triangles[f]) {
      if (done[std::size_t(v)]) continue;
      done[std::size_t(v)] = 1;
      LitVertex& x = m.vertices[std::size_t(v)];
      glm::vec3 slope(0.0f), g;
      // Wave length in metres along each axis, and how steep the flanks are.
      const auto layer = [&](const glm::vec3& wave_m, float steep) {
        bumps(x.local_m / wave_m, g);
        slope += g / wave_m * std::min({wave_m.x, wave_m.y, wave_m.z}) * (steep * float(look.relief));
      };
      if (look.kind == LookKind::grain) {
        layer({0.45e-3f, 0.45e-3f, 6e-3f}, 0.16f);
        layer({1.3e-3f, 1.3e-3f, 4e-3f}, 0.08f);
      } else if (look.kind == LookKind::leaf && !look.detail) {
        layer(glm::vec3(4.5e-3f), 0.10f);
        layer(glm::vec3(1.1e-3f), 0.07f);
      } else if (look.kind == LookKind::waxy) {
        layer(glm::vec3(2.5e-3f), 0.03f);
      } else {
        continue;
      }
      x.normal = leaned(x.normal, turned(slope));
    }
  }
}

}  // namespace witherfield::pov
