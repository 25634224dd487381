// Meshes for the tests, named after the case.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

#include "sim/core/random.hpp"
#include "sim/core/surface.hpp"

namespace witherfield::leaf::test {

/// n x n vertices over [-1, 1]^2, with relief of this height; diagonals one way.
inline Surface sheet(int n, double relief = 0.08) {
  Surface s;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = 2.0 * i / (n - 1) - 1, y = 2.0 * j / (n - 1) - 1;
      s.position_m.emplace_back(x, y, relief * (std::sin(3 * x) * std::cos(2 * y) + 0.1 * std::sin(17 * x) * std::sin(13 * y)));
    }
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i;
      s.triangles.push_back({a, a + 1, a + n + 1});
      s.triangles.push_back({a, a + n + 1, a + n});
    }
  return s;
}

/// The same, flat, inner vertices moved about: no two triangles alike, some obtuse.
inline Surface crumpled_plane(int n) {
  Surface s = sheet(n, 0);
  Random random(7, Stream::test, 1);
  const double step = 2.0 / (n - 1);
  for (int j = 1; j + 1 < n; ++j)
    for (int i = 1; i + 1 < n; ++i) {
      s.position_m[std::size_t(j * n + i)].x += 0.35 * step * random.uniform(-1, 1);
      s.position_m[std::size_t(j * n + i)].y += 0.35 * step * random.uniform(-1, 1);
    }
  return s;
}

/// Five vertices along each of two opposite sides of a sheet.
inline std::vector<int> ten_handles(int n) {
  std::vector<int> v;
  for (int k = 0; k < 5; ++k) v.push_back((n - 1) * k / 4 * n);
  for (int k = 0; k < 5; ++k) v.push_back((n - 1) * k / 4 * n + n - 1);
  return v;
}

}  // namespace witherfield::leaf::test
