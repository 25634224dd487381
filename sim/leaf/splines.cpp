#include "sim/leaf/splines.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

CubicSpline::CubicSpline(std::vector<glm::dvec3> points) : point_(std::move(points)) {
  const std::size_t n = point_.size();
  if (n < 2) throw InvalidInput("CubicSpline: " + std::to_string(n) + " points, at least 2 are needed");
  t_.assign(1, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double step = std::sqrt(glm::distance(point_[i], point_[i + 1]));
    if (!(step > 0) || !std::isfinite(step))
      throw InvalidInput("CubicSpline: points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                         " coincide or are not finite");
    t_.push_back(t_.back() + step);
  }
  // Tridiagonal system for the second derivatives (Thomas), zero at both ends.
  curvature_.assign(n, glm::dvec3(0.0));
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = t_[i] - t_[i - 1], h1 = t_[i + 1] - t_[i];
    const glm::dvec3 right = 6.0 * ((point_[i + 1] - point_[i]) / h1 - (point_[i] - point_[i - 1]) / h0);
    const double pivot = 2 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    curvature_[i] = (right - h0 * curvature_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i > 0; --i) curvature_[i] -= upper[i] * curvature_[i + 1];
}

std::size_t CubicSpline::interval(double t) const {
  const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  return std::size_t(above - t_.begin()) - 1;
}

glm::dvec3 CubicSpline::operator()(double t) const {
  const std::size_t i = interval(t);
  const double h = t_[i + 1] - t_[i], a = (t_[i + 1] - t) / h, b = 1 - a;
  return a * point_[i] + b * point_[i + 1] +
         (h * h / 6) * ((a * a * a - a) * curvature_[i] + (b * b * b - b) * curvature_[i + 1]);
}

glm::dvec3 CubicSpline::second_derivative(double t) const {
  const std::size_t i = interval(t);
  const double b = (t - t_[i]) / (t_[i + 1] - t_[i]);
  return (1 - b) * curvature_[i] + b * curvature_[i + 1];
}

namespace {
constexpr int kChords = 24;  // of each interval, for lengths along the curve
}

double CubicSpline::length_m() const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < t_.size(); ++i) {
    glm::dvec3 last = point_[i];
    for (int k = 1; k <= kChords; ++k) {
      const glm::dvec3 next = (*this)(t_[i] + (t_[i + 1] - t_[i]) * k / kChords);
      sum += glm::distance(last, next);
      last = next;
    }
  }
  return sum;
}

std::vector<glm::dvec3> CubicSpline::sample(double spacing_m, int least, double max_turn_rad) const {
  // Points wanted up to each chord's end: its length over the spacing there.
  std::vector<double> t{begin()}, wanted{0.0};
  glm::dvec3 last = point_[0], direction(0.0);
  for (std::size_t i = 0; i + 1 < t_.size(); ++i)
    for (int k = 1; k <= kChords; ++k) {
      t.push_back(k == kChords ? t_[i + 1] : t_[i] + (t_[i + 1] - t_[i]) * k / kChords);
      const glm::dvec3 next = (*this)(t.back()), chord = next - last;
      const double length = glm::length(chord);
      const glm::dvec3 now = length > 0 ? chord / length : direction;
      const double turn = t.size() > 2 ? std::acos(std::clamp(glm::dot(direction, now), -1.0, 1.0)) : 0.0;
      const double by_length = length / spacing_m;
      wanted.push_back(wanted.back() + std::clamp(turn / max_turn_rad, by_length, 4 * by_length));
      last = next, direction = now;
    }
  const int pieces = std::max(least, int(std::lround(wanted.back())));
  std::vector<glm::dvec3> out{point_.front()};
  std::size_t j = 0;
  for (int k = 1; k < pieces; ++k) {
    const double s = wanted.back() * k / pieces;
    while (wanted[j + 1] < s) ++j;
    out.push_back((*this)(t[j] + (t[j + 1] - t[j]) * (s - wanted[j]) / (wanted[j + 1] - wanted[j])));
  }
  out.push_back(point_.back());
  return out;
}

double polyline_length(std::span<const glm::dvec2> line) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += glm::distance(line[i], line[i + 1]);
  return sum;
}

std::vector<glm::dvec2> resample(std::span<const glm::dvec2> line, int pieces) {
  const double length = polyline_length(line);
  std::vector<glm::dvec2> out{line.front()};
  std::size_t j = 0;
  double passed = 0;
  for (int k = 1; k < pieces; ++k) {
    const double s = length * k / pieces;
    while (j + 2 < line.size() && passed + glm::distance(line[j], line[j + 1]) < s) {
      passed += glm::distance(line[j], line[j + 1]);
      ++j;
    }
    const double piece = glm::distance(line[j], line[j + 1]);
    out.push_back(line[j] + (line[j + 1] - line[j]) * (piece > 0 ? std::min(1.0, (s - passed) / piece) : 0.0));
  }
  out.push_back(line.back());
  return out;
}

double polygon_area(std::span<const glm::dvec2> p) {
  double sum = 0;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) sum += p[j].x * p[i].y - p[i].x * p[j].y;
  return 0.5 * sum;
}

bool inside_polygon(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const glm::dvec2 &a = polygon[i], &b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

std::pair<int, int> self_crossing(std::span<const glm::dvec2> p) {
  // Edges sorted by their left end; only those whose x ranges overlap are compared.
  const std::size_t n = p.size();
  const auto side = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  const auto left = [&](std::size_t i) { return std::min(p[i].x, p[(i + 1) % n].x); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  for (std::size_t a = 0; a < n; ++a) {
    const std::size_t i = order[a];
    const double right = std::max(p[i].x, p[(i + 1) % n].x);
    for (std::size_t b = a + 1; b < n && left(order[b]) <= right; ++b) {
      const std::size_t j = order[b];
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      const glm::dvec2 &p0 = p[i], &p1 = p[(i + 1) % n], &q0 = p[j], &q1 = p[(j + 1) % n];
      if (side(p0, p1, q0) * side(p0, p1, q1) <= 0 && side(q0, q1, p0) * side(q0, q1, p1) <= 0 &&
          std::max(q0.y, q1.y) >= std::min(p0.y, p1.y) && std::min(q0.y, q1.y) <= std::max(p0.y, p1.y))
        return {int(std::min(i, j)), int(std::max(i, j))};
    }
  }
  return {-1, -1};
}

}  // namespace witherfield::leaf
