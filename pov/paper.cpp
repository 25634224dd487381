#include "pov/paper.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pov/text.hpp"

namespace witherfield::pov {

Paper::Paper(const glm::dvec3& center, const glm::dvec3& away, double fine_across, double fine_along, double size,
             int nodes)
    : center_(center),
      away_(away),
      across_(glm::cross(away, glm::dvec3(0, 0, 1))),
      side_{fine_across, 40 * size},
      depth_{fine_along, 40 * size},
      back_(std::max(3.2 * size, 1.1 * fine_along)),
      bend_(3 * size),
      nodes_(nodes) {}

double Paper::Scale::metres(double s) const {
  const double a = std::abs(s), straight = fine * a / 0.8;
  const double more = std::max(0.0, (a - 0.8) / 0.2);
  return std::copysign(straight + (far - fine / 0.8) * more * more * more, s);
}

double Paper::Scale::grid(double x) const {
  double low = 0, high = 1;
  const double a = std::abs(x);
  if (a <= fine) return x / fine * 0.8;
  for (int k = 0; k < 40; ++k) (metres(0.5 * (low + high)) < a ? low : high) = 0.5 * (low + high);
  return std::copysign(low, x);
}

Paper::Node Paper::node(int i, int j) const {
  const double x = side_.metres(coordinate(i)), q = depth_.metres(coordinate(j));
  const glm::dvec3 up(0, 0, 1), at = center_ + across_ * x;
  if (q <= back_) return {at + away_ * q, up};
  const double a = std::min((q - back_) / bend_, std::numbers::pi / 2);
  const double wall = std::max(0.0, q - back_ - bend_ * std::numbers::pi / 2);
  return {at + away_ * (back_ + bend_ * std::sin(a)) + up * (bend_ * (1 - std::cos(a)) + wall),
          up * std::cos(a) - away_ * std::sin(a)};
}

int Paper::nearest(double x, double y) const {
  const glm::dvec3 d = glm::dvec3(x, y, center_.z) - center_;
  const double s = glm::dot(d, across_), q = glm::dot(d, away_);
  if (nodes_ == 0 || std::abs(s) > side_.far || q > back_ || q < -depth_.far) return -1;
  const auto index = [&](double c) { return std::clamp(int(std::lround((c + 1) / 2 * (nodes_ - 1))), 0, nodes_ - 1); };
  return index(depth_.grid(q)) * nodes_ + index(side_.grid(s));
}

std::string Paper::mesh_text(double unit) const {
  std::vector<int> rows;
  for (int j = 0; j < nodes_ - 1; j += 4) rows.push_back(j);
  rows.push_back(nodes_ - 1);
  const int n = int(rows.size());
  Text points, normals, uv, faces;
  for (const int j : rows)
    for (const int i : rows) {
      const Node x = node(i, j);
      points << "," << flip(x.position_m, unit);
      normals << "," << flip(x.normal);
      uv << ",<" << (i + 0.5) / nodes_ << "," << (j + 0.5) / nodes_ << ">";
    }
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i;
      faces << ",<" << a << "," << a + 1 << "," << a + n + 1 << ">,<" << a << "," << a + n + 1 << "," << a + n << ">";
    }
  Text t;
  t << "mesh2{vertex_vectors{" << n * n << points.str() << "}\nnormal_vectors{" << n * n << normals.str()
    << "}\nuv_vectors{" << n * n << uv.str() << "}\nface_indices{" << 2 * (n - 1) * (n - 1) << faces.str() << "}}\n";
  return t.str();
}

}  // namespace witherfield::pov
