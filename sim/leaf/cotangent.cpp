#include "sim/leaf/cotangent.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

std::vector<std::array<double, 3>> corner_cotangents(std::span<const glm::dvec3> position_m,
                                                     std::span<const std::array<int, 3>> triangles) {
  std::vector<std::array<double, 3>> cots(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& t = triangles[f];
    const glm::dvec3 p[3] = {position_m[std::size_t(t[0])], position_m[std::size_t(t[1])], position_m[std::size_t(t[2])]};
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::dot(p[k] - p[(k + 1) % 3], p[k] - p[(k + 1) % 3]));
    const double area2 = std::max(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])), kFlattest * longest);
    for (int k = 0; k < 3; ++k)
      cots[f][std::size_t(k)] = area2 > 0 ? glm::dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]) / area2 : 0.0;
  }
  return cots;
}

SparseMatrix cotangent_laplacian(std::span<const glm::dvec3> position_m, std::span<const std::array<int, 3>> triangles,
                                 std::span<const double> face_scale) {
  const auto cots = corner_cotangents(position_m, triangles);
  std::vector<Entry> entries;
  entries.reserve(triangles.size() * 12);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {  // corner k sees edge ij
      const int i = triangles[f][(k + 1) % 3], j = triangles[f][(k + 2) % 3];
      const double w = cots[f][k] * (face_scale.empty() ? 1.0 : face_scale[f]);
      entries.insert(entries.end(), {{i, j, -w}, {j, i, -w}, {i, i, w}, {j, j, w}});
    }
  SparseMatrix l = assemble(int(position_m.size()), std::move(entries));
  // The diagonal as the sum of its row: L 1 = 0 then holds to the last bits whatever was rounded above.
  for (int i = 0; i < l.rows(); ++i) {
    double sum = 0;
    int diagonal = -1;
    for (int k = l.row_start[std::size_t(i)]; k < l.row_start[std::size_t(i) + 1]; ++k) {
      if (l.column[std::size_t(k)] == i) diagonal = k;
      else sum -= l.value[std::size_t(k)];
    }
    if (diagonal >= 0) l.value[std::size_t(diagonal)] = sum;
  }
  return l;
}

SparseMatrix cotangent_laplacian(const Surface& s) { return cotangent_laplacian(s.position_m, s.triangles); }

std::vector<double> vertex_areas(std::span<const glm::dvec3> position_m, std::span<const std::array<int, 3>> triangles) {
  std::vector<double> areas(position_m.size(), 0.0);
  for (const auto& t : triangles) {
    const glm::dvec3& a = position_m[std::size_t(t[0])];
    const double third =
        glm::length(glm::cross(position_m[std::size_t(t[1])] - a, position_m[std::size_t(t[2])] - a)) / 6;
    for (const int v : t) areas[std::size_t(v)] += third;
  }
  return areas;
}

SparseMatrix scaled_plus_diagonal(const SparseMatrix& l, double a, std::span<const double> d) {
  std::vector<Entry> entries;
  entries.reserve(l.value.size() + d.size());
  for (int i = 0; i < l.rows(); ++i) {
    for (int k = l.row_start[std::size_t(i)]; k < l.row_start[std::size_t(i) + 1]; ++k)
      entries.push_back({i, l.column[std::size_t(k)], a * l.value[std::size_t(k)]});
    entries.push_back({i, i, d[std::size_t(i)]});
  }
  return assemble(l.rows(), std::move(entries));
}

int connected_pieces(std::size_t vertices, std::span<const std::array<int, 3>> triangles, std::vector<int>& piece) {
  std::vector<int> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[std::size_t(v)] != v) v = parent[std::size_t(v)] = parent[std::size_t(parent[std::size_t(v)])];
    return v;
  };
  for (const auto& t : triangles)
    for (int k = 1; k < 3; ++k) {
      const int a = root(t[0]), b = root(t[std::size_t(k)]);
      parent[std::size_t(std::max(a, b))] = std::min(a, b);  // the smallest vertex is the root
    }
  piece.assign(vertices, 0);
  int count = 0;
  for (std::size_t v = 0; v < vertices; ++v)
    piece[v] = root(int(v)) == int(v) ? count++ : piece[std::size_t(root(int(v)))];
  return count;
}

}  // namespace witherfield::leaf
