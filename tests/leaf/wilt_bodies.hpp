// Bodies that wilt, named after the case; the analytic elastica.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

#include "sim/leaf/wilt_body.hpp"
#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf::test {

/// A flat strip of `length` x `width`: (nx + 1) x (ny + 1) vertices, alternating diagonals, the first column at x = 0.
inline WiltBody strip(double length, double width, int nx, int ny) {
  WiltBody b;
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) b.rest.position_m.emplace_back(length * i / nx, width * (double(j) / ny - 0.5), 0.0);
  const auto at = [&](int i, int j) { return i * (ny + 1) + j; };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const int a = at(i, j), p = at(i + 1, j), q = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2) {
        b.rest.triangles.push_back({a, p, q});
        b.rest.triangles.push_back({a, q, d});
      } else {
        b.rest.triangles.push_back({a, p, d});
        b.rest.triangles.push_back({p, q, d});
      }
    }
  b.rest_carries_weight = false;
  return b;
}

/// The first two columns are held: place and slope. The hinges in between stand for half an element on either side, so that the
/// strip is clamped half an element before the second column.
inline WiltBody cantilever(double length, double width, int nx, int ny) {
  WiltBody b = strip(length, width, nx, ny);
  for (int v = 0; v < 2 * (ny + 1); ++v) b.clamp.push_back(v);
  return b;
}

struct Tip {
  double x = 0, drop = 0;  ///< over the length
};

/// Heavy elastica, clamped horizontally: theta'' = -gamma (1 - s) cos(theta), theta(0) = 0, theta'(1) = 0, theta downwards,
/// gamma = weight per length * length^3 / EI. Shooting with Runge-Kutta steps.
inline Tip heavy_elastica(double gamma) {
  constexpr int kSteps = 2000;
  constexpr double h = 1.0 / kSteps;
  Tip tip;
  const auto shoot = [&](double bend) {
    double theta = 0, k = bend, x = 0, drop = 0;
    const auto f = [&](double s, double t) { return -gamma * (1 - s) * std::cos(t); };
    for (int i = 0; i < kSteps; ++i) {
      const double s = i * h;
      const double k1 = k, l1 = f(s, theta);
      const double k2 = k + h / 2 * l1, l2 = f(s + h / 2, theta + h / 2 * k1);
      const double k3 = k + h / 2 * l2, l3 = f(s + h / 2, theta + h / 2 * k2);
      const double k4 = k + h * l3, l4 = f(s + h, theta + h * k3);
      const double middle = theta + h / 2 * k1 + h * h / 8 * l1, next = theta + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      x += h / 6 * (std::cos(theta) + 4 * std::cos(middle) + std::cos(next));
      drop += h / 6 * (std::sin(theta) + 4 * std::sin(middle) + std::sin(next));
      theta = next;
      k += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    tip = {x, drop};
    return k;
  };
  double lo = 0, hi = gamma;  // theta'(1) rises with theta'(0)
  for (int i = 0; i < 80; ++i) (shoot((lo + hi) / 2) < 0 ? lo : hi) = (lo + hi) / 2;
  return tip;
}

}  // namespace witherfield::leaf::test
