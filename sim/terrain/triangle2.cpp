#include "sim/terrain/triangle2.hpp"

#include <algorithm>
#include <cmath>

namespace witherfield::terrain {
namespace {

// Separating axis: true when some edge of `a` has all of `b` on its outer side or less than `tolerance`
// within.
bool separated_by_edge(const Triangle2& a, const Triangle2& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 &p = a[k], &q = a[(k + 1) % 3];
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    if (length == 0) continue;
    const double inward = std::max({turn(p, q, b[0]), turn(p, q, b[1]), turn(p, q, b[2])}) / length;
    if (inward <= tolerance) return true;
  }
  return false;
}

// Keeps the part of the polygon where distance(point) >= 0 (Sutherland & Hodgman 1974).
template <class Distance>
void clip(std::vector<glm::dvec2>& polygon, const Distance& distance) {
  std::vector<glm::dvec2> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double da = distance(a), db = distance(b);
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  polygon = std::move(kept);
}

}  // namespace

bool overlap(const Triangle2& a, const Triangle2& b, double tolerance) {
  return !separated_by_edge(a, b, tolerance) && !separated_by_edge(b, a, tolerance);
}

std::vector<glm::dvec2> clip_to_rectangle(const Triangle2& t, double width, double depth) {
  std::vector<glm::dvec2> polygon(t.begin(), t.end());
  clip(polygon, [](const glm::dvec2& p) { return p.x; });
  clip(polygon, [&](const glm::dvec2& p) { return width - p.x; });
  clip(polygon, [](const glm::dvec2& p) { return p.y; });
  clip(polygon, [&](const glm::dvec2& p) { return depth - p.y; });
  return polygon;
}

double insideness(const Triangle2& t, const glm::dvec2& q) {
  const double area = turn(t[0], t[1], t[2]);
  return std::min({turn(t[0], t[1], q), turn(t[1], t[2], q), turn(t[2], t[0], q)}) / area;
}

double polygon_area(const std::vector<glm::dvec2>& polygon) {
  double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) twice += turn(polygon[0], polygon[k - 1], polygon[k]);
  return twice / 2;
}

}  // namespace witherfield::terrain
