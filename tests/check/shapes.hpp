// Meshes with known measures, as plain arrays.
#pragma once
#include <cmath>
#include <numbers>

#include "sim/core/surface.hpp"

namespace witherfield::check::shapes {

inline Surface cube(glm::dvec3 corner = {0, 0, 0}, double edge = 1) {
  Surface s;
  for (const glm::dvec3& p :
       {glm::dvec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
    s.position_m.push_back(corner + edge * p);
  s.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                 {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return s;
}

/// Ball of `rings` x 2 rings quads, poles along z.
inline Surface ball(int rings, glm::dvec3 centre = {0, 0, 0}, double radius = 1) {
  Surface s;
  const int around = 2 * rings;
  const auto add = [&](double polar, double azimuth) {
    s.position_m.push_back(centre + radius * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                                        std::sin(polar) * std::sin(azimuth),
                                                        -std::cos(polar)));
  };
  add(0, 0);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j) add(std::numbers::pi * i / rings, 2 * std::numbers::pi * j / around);
  add(std::numbers::pi, 0);
  const int last = int(s.position_m.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
  for (int j = 0; j < around; ++j) {
    s.triangles.push_back({0, at(1, j + 1), at(1, j)});
    s.triangles.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
    for (int i = 1; i < rings - 1; ++i) {
      s.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return s;
}

/// n x n quads in the plane z = slope x.
inline Surface sheet(int n, double slope = 0.1) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) s.position_m.push_back({double(i), double(j), slope * i});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      s.triangles.push_back({a, a + 1, a + n + 2});
      s.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  return s;
}

inline void turn_inside_out(Surface& s) {
  for (auto& t : s.triangles) std::swap(t[1], t[2]);
}

}  // namespace witherfield::check::shapes
