// Control meshes named after the case, generated.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "sim/fruit/subdivision.hpp"

namespace witherfield::fruit::fixtures {

using Triangles = std::vector<std::array<int, 3>>;
using Points = std::vector<glm::dvec3>;

inline ControlMesh mesh_of(Points p, Triangles t) {
  ControlMesh m;
  m.position_m = std::move(p);
  m.triangles = std::move(t);
  return m;
}

inline ControlMesh tetrahedron() {
  const double s = 1 / std::sqrt(3.0);
  return mesh_of({{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}},
                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

inline ControlMesh octahedron() {
  return mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

inline ControlMesh icosahedron() {
  const double g = std::numbers::phi, r = 1 / std::sqrt(1 + g * g);
  Points p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (auto& v : p) v *= r;
  return mesh_of(p, {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

/// Two apexes of valence n over a regular n-gon of radius 1: vertex 0 at height 1, vertex 1 at height -1.
inline ControlMesh bipyramid(int n) {
  ControlMesh m;
  m.position_m = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    m.position_m.emplace_back(std::cos(a), std::sin(a), 0);
    m.triangles.push_back({0, 2 + i, 2 + (i + 1) % n});
    m.triangles.push_back({1, 2 + (i + 1) % n, 2 + i});
  }
  return m;
}

/// (n + 1)^2 vertices of the unit square, row by row from y = 0; cells cut along the same diagonal: inside,
/// every valence is 6.
inline ControlMesh sheet(int n) {
  ControlMesh m;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) m.position_m.emplace_back(double(x) / n, double(y) / n, 0);
  const auto at = [n](int x, int y) { return y * (n + 1) + x; };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      m.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      m.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return m;
}

inline double draw(std::uint32_t what, std::uint32_t i) {  // uniform, the same on every machine
  std::uint64_t h = (std::uint64_t(what) << 32 | i) * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
  return double((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

inline void jiggle(ControlMesh& m, double by) {
  for (std::size_t v = 0; v < m.position_m.size(); ++v)
    for (int a = 0; a < 3; ++a)
      m.position_m[v][a] += by * (draw(7, std::uint32_t(3 * v) + std::uint32_t(a)) - 0.5);
}

/// Closed, nx * ny * 2 faces; with edges flipped at random, so that valences run from 3 or 4 to 9 or so.
inline ControlMesh torus(int nx, int ny, int flips) {
  ControlMesh m;
  const auto at = [&](int x, int y) { return (y + ny) % ny * nx + (x + nx) % nx; };
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      const double a = 2 * std::numbers::pi * x / nx, b = 2 * std::numbers::pi * y / ny,
                   r = 1 + 0.4 * std::cos(b);
      m.position_m.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
      m.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      m.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  for (std::uint32_t tried = 0; flips > 0 && tried < 100000; ++tried) {
    std::map<std::pair<int, int>, std::pair<std::size_t, int>>
        half;  // directed edge -> face, opposite vertex
    std::vector<int> valence(m.position_m.size(), 0);
    for (std::size_t f = 0; f < m.triangles.size(); ++f)
      for (int i = 0; i < 3; ++i) {
        const auto& t = m.triangles[f];
        half[{t[std::size_t(i)], t[std::size_t((i + 1) % 3)]}] = {f, t[std::size_t((i + 2) % 3)]};
        ++valence[std::size_t(t[std::size_t(i)])];
      }
    for (int now = 0; now < 20 && flips > 0; ++now, ++tried) {
      const std::size_t f = std::size_t(draw(11, 2 * tried) * double(m.triangles.size()));
      const int i = int(draw(11, 2 * tried + 1) * 3);
      const int a = m.triangles[f][std::size_t(i)], b = m.triangles[f][std::size_t((i + 1) % 3)];
      const auto one = half.find({a, b}), two = half.find({b, a});
      if (one == half.end() || two == half.end()) continue;  // flipped before in this round
      const int c = one->second.second, d = two->second.second;
      if (half.contains({c, d}) || half.contains({d, c}) || c == d) continue;
      if (valence[std::size_t(a)] <= 3 || valence[std::size_t(b)] <= 3) continue;
      const std::size_t g = two->second.first;
      m.triangles[one->second.first] = {a, d, c};
      m.triangles[g] = {d, b, c};
      --flips;
      break;  // the map is out of date
    }
  }
  return m;
}

/// Tags every `every`-th edge in the order of the triangles as a crease and every `every`-th vertex as sharp.
inline void tag(ControlMesh& m, std::size_t every) {
  std::set<std::pair<int, int>> seen;
  for (const auto& t : m.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = std::min(t[i], t[(i + 1) % 3]), b = std::max(t[i], t[(i + 1) % 3]);
      if (seen.insert({a, b}).second && draw(3, std::uint32_t(seen.size())) * double(every) < 1)
        m.crease_edges.push_back({b, a});
    }
  for (std::size_t v = 0; v < m.position_m.size(); ++v)
    if (draw(4, std::uint32_t(v)) * 4 * double(every) < 1) m.sharp_vertices.push_back(int(v));
}

inline Points evaluated(const Refinement& r, const Points& control) {
  Points out(r.vertices());
  r.evaluate(control, out);
  return out;
}

inline double furthest(const Points& a, const Points& b) {
  double worst = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    worst = std::max(worst, glm::length(a[i] - b[i]));
  return worst;
}

}  // namespace witherfield::fruit::fixtures
