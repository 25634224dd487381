#include "sim/fruit/plant_grains.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace witherfield::fruit {
namespace {

constexpr double kPi = std::numbers::pi;

/// A point of the outline: height, radius, and the outward normal's parts (radial, upward).
struct OutlinePoint {
  double z, r, normal_r, normal_z;
};

/// The outline cut fine, with the area up to each point.
struct Outline {
  std::vector<OutlinePoint> point;
  std::vector<double> area;

  explicit Outline(const std::vector<std::pair<double, double>>& profile) {
    constexpr int pieces = 64;
    area.push_back(0);
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const auto [z0, r0] = profile[i];
      const auto [z1, r1] = profile[i + 1];
      const double length = std::hypot(z1 - z0, r1 - r0);
      for (int k = 0; k < pieces; ++k) {
        const double t = (k + 0.5) / pieces, r = r0 + (r1 - r0) * t;
        point.push_back({z0 + (z1 - z0) * t, r, (z1 - z0) / length, -(r1 - r0) / length});
        area.push_back(area.back() + 2 * kPi * r * length / pieces);
      }
    }
  }
  /// Point below which the share s of the area lies. Normals are averaged over a neighbourhood, so that
  /// grains do not jump at the corners of the outline.
  OutlinePoint at_share(double s) const {
    const std::size_t i = std::min(
        std::size_t(std::lower_bound(area.begin() + 1, area.end(), s * area.back()) - area.begin() - 1),
        point.size() - 1);
    OutlinePoint p = point[i];
    double nr = 0, nz = 0;
    const std::size_t reach = 24, lo = i > reach ? i - reach : 0, hi = std::min(i + reach, point.size() - 1);
    for (std::size_t k = lo; k <= hi; ++k) {
      nr += point[k].normal_r;
      nz += point[k].normal_z;
    }
    const double n = std::hypot(nr, nz);
    p.normal_r = nr / n;
    p.normal_z = nz / n;
    return p;
  }
};

Cell cell_at(const OutlinePoint& p, double angle, double side) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{p.r * c, p.r * s, p.z},
          {p.normal_r * c, p.normal_r * s, p.normal_z},
          {-p.normal_z * c, -p.normal_z * s, p.normal_r},
          side,
          side};
}

}  // namespace

Cell cell_of_quad(const std::array<glm::dvec3, 4>& q) {
  Cell cell;
  cell.centre = 0.25 * (q[0] + q[1] + q[2] + q[3]);
  cell.normal = glm::normalize(glm::cross(q[2] - q[0], q[3] - q[1]));
  const glm::dvec3 along = 0.5 * (q[2] + q[3] - q[0] - q[1]);
  cell.up = glm::normalize(along - cell.normal * glm::dot(along, cell.normal));
  cell.width = 0.5 * (glm::length(q[1] - q[0]) + glm::length(q[2] - q[3]));
  cell.height = glm::length(along);
  return cell;
}

Cell cell_of_triangle(const std::array<glm::dvec3, 3>& t) {
  Cell cell;
  cell.centre = (t[0] + t[1] + t[2]) / 3.0;
  const glm::dvec3 twice_area = glm::cross(t[1] - t[0], t[2] - t[0]);
  cell.normal = glm::normalize(twice_area);
  const glm::dvec3 wish = std::abs(cell.normal.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  cell.up = glm::normalize(wish - cell.normal * glm::dot(wish, cell.normal));
  cell.width = cell.height = std::sqrt(0.5 * glm::length(twice_area));
  return cell;
}

std::vector<Cell> cells_on_profile(const std::vector<std::pair<double, double>>& profile,
                                   Arrangement arrangement, int count) {
  const Outline outline(profile);
  const double total = outline.area.back(), side = std::sqrt(total / count);
  std::vector<Cell> cells;
  if (arrangement == Arrangement::spiral) {
    const double golden = kPi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i)
      cells.push_back(cell_at(outline.at_share((i + 0.5) / count), golden * i, side));
    return cells;
  }
  // Whorls of equal height along the outline: as many grains in each as its circumference holds.
  double share = 0;
  for (int whorl = 0; share < 1 - 0.25 / count; ++whorl) {
    const OutlinePoint p = outline.at_share(
        std::min(1.0, share + 0.5 * std::max(1.0, 2 * kPi * outline.at_share(share).r / side) / count));
    const int n = std::max(1, int(std::lround(2 * kPi * p.r / side)));
    for (int k = 0; k < n; ++k) cells.push_back(cell_at(p, 2 * kPi * (k + 0.5 * (whorl % 2)) / n, side));
    share += double(n) / count;
  }
  return cells;
}

Cell shifted(Cell cell, double across, double along) {
  cell.centre += glm::cross(cell.up, cell.normal) * (across * cell.width) + cell.up * (along * cell.height);
  return cell;
}

Frame seat_on(const Cell& cell, double depth, double lean_rad) {
  const glm::dvec3 across = glm::cross(cell.up, cell.normal);
  const glm::dmat3 on_surface(across, cell.up, cell.normal);
  return {on_surface * rotation_x(-lean_rad), cell.centre - depth * cell.normal};
}

}  // namespace witherfield::fruit
