// Cubic splines through points in space, and polylines made of them.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace witherfield::leaf {

/// Natural cubic spline that interpolates the points: twice continuously differentiable, no curvature at the ends. The
/// parameter grows with the square root of the distance (centripetal: no loops and little overshoot where points are
/// unevenly spaced; Lee 1989, "Choosing nodes in parametric curve interpolation").
class CubicSpline {
 public:
  /// @throws InvalidInput: fewer than 2 points, points that coincide with their neighbour, not finite.
  explicit CubicSpline(std::vector<glm::dvec3> points);
  double begin() const { return t_.front(); }
  double end() const { return t_.back(); }
  glm::dvec3 operator()(double t) const;
  glm::dvec3 second_derivative(double t) const;
  double knot(std::size_t i) const { return t_[i]; }
  double length_m() const;
  /// Points about `spacing_m` apart along the curve, at least `least` + 1, ends included; nearer (down to a quarter) where
  /// the curve would turn by more than `max_turn_rad` between two of them.
  std::vector<glm::dvec3> sample(double spacing_m, int least = 1, double max_turn_rad = 1e9) const;

 private:
  std::size_t interval(double t) const;
  std::vector<double> t_;
  std::vector<glm::dvec3> point_, curvature_;
};

double polyline_length(std::span<const glm::dvec2> line);
/// `pieces` + 1 points evenly along the line, ends included.
std::vector<glm::dvec2> resample(std::span<const glm::dvec2> line, int pieces);
/// Signed area, positive when counter-clockwise; the polygon is closed by itself.
double polygon_area(std::span<const glm::dvec2> polygon);
bool inside_polygon(std::span<const glm::dvec2> polygon, const glm::dvec2& p);
/// Two edges of the polygon that cross (numbers of their first points), or {-1, -1}.
std::pair<int, int> self_crossing(std::span<const glm::dvec2> polygon);

}  // namespace witherfield::leaf
