// Plane geometry of triangles seen from above.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace witherfield::terrain {

using Triangle2 = std::array<glm::dvec2, 3>;

/// Twice the signed area of (a, b, c): positive when counter-clockwise.
inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// True when the interiors of two counter-clockwise triangles overlap by more than `tolerance` (a length).
bool overlap(const Triangle2& a, const Triangle2& b, double tolerance);

/// Corners of the part of a counter-clockwise triangle within [0, width] x [0, depth]; empty when nothing is.
std::vector<glm::dvec2> clip_to_rectangle(const Triangle2& t, double width, double depth);

/// How far inside the triangle a point is: the least barycentric coordinate, negative outside.
double insideness(const Triangle2& t, const glm::dvec2& q);

/// Area of a simple polygon, positive when counter-clockwise.
double polygon_area(const std::vector<glm::dvec2>& polygon);

}  // namespace witherfield::terrain
