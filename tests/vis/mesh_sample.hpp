// A surface with everything that a mesh file can carry.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/random.hpp"
#include "sim/core/surface.hpp"

namespace witherfield::vis::sample {

/// A wavy sheet of n x n quads, some 6 cm wide, with positions that no short decimal gives, normals, uv,
/// fields of vertices (scalar, label, vector, colour) and of faces.
inline Surface sheet(int n) {
  Surface s;
  Random random(7, Stream::test, 0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double u = double(i) / n, v = double(j) / n;
      s.position_m.push_back(
          {0.06 * u + 1e-5 * random.uniform(), 0.05 * v - 0.0217, 1e-3 * std::sin(7 * u) * v});
      s.normal.push_back(glm::normalize(glm::dvec3(0.2 * u, -0.1 * v, 1)));
      s.uv.push_back({u, 1 - v * v});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      s.triangles.push_back({a, a + 1, a + n + 2});
      s.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  const auto fill = [&](const char* name, bool on_faces, auto&& value) {
    auto& values = s.make_field(name, on_faces).values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = float(value(k));
  };
  fill("water", false, [&](std::size_t) { return random.uniform(); });
  fill("organ_id", false, [](std::size_t k) { return k % 5; });
  fill("displacement_m", false, [&](std::size_t) { return random.uniform(-0.01, 0.01); });
  fill("diffuse", false, [&](std::size_t) { return random.uniform(); });
  fill("kernel_id", true, [](std::size_t k) { return double(k) - 1; });
  fill("strain_area", true, [&](std::size_t) { return random.uniform(-1, 1); });
  return s;
}

}  // namespace witherfield::vis::sample
