#include "sim/terrain/grid_surface.hpp"

#include <algorithm>
#include <cmath>

#include "sim/terrain/bezier_range.hpp"

namespace witherfield::terrain {
namespace {

using Weights = std::array<double, 4>;

// Catmull & Rom 1974 (tension 1/2): weights of the samples at -1, 0, 1, 2 for a position u between samples 0
// and 1.
Weights catmull_rom(double u) {
  return {0.5 * u * (-1 + u * (2 - u)), 0.5 * (2 + u * u * (-5 + 3 * u)), 0.5 * u * (1 + u * (4 - 3 * u)),
          0.5 * u * u * (u - 1)};
}

Weights catmull_rom_slope(double u) {
  return {0.5 * (-1 + u * (4 - 3 * u)), 0.5 * u * (-10 + 9 * u), 0.5 * (1 + u * (8 - 9 * u)),
          0.5 * u * (3 * u - 2)};
}

// The same cubic as Bezier control values: b0 = p1, b1 = p1 + (p2 - p0) / 6, b2 = p2 - (p3 - p1) / 6, b3 =
// p2.
std::array<double, 4> to_bezier(const std::array<double, 4>& p) {
  return {p[1], p[1] + (p[2] - p[0]) / 6, p[2] - (p[3] - p[1]) / 6, p[2]};
}

SurfaceExtent extent_of(const DemGrid& g) {
  return {g.width_m, g.depth_m, std::sqrt(g.dx_m * g.dy_m), 0, 0};
}

}  // namespace

GridSurface::GridSurface(const DemGrid& g)
    : Surface(extent_of(g)),
      nx_(g.nx),
      ny_(g.ny),
      dx_m_(g.dx_m),
      dy_m_(g.dy_m),
      start_x_(g.start_x),
      start_y_(g.start_y),
      z_(std::size_t(g.nx + 2) * std::size_t(g.ny + 2)) {
  const std::size_t stride = std::size_t(nx_) + 2;
  for (int j = 0; j < ny_; ++j)
    std::copy_n(&g.z_m[std::size_t(j) * std::size_t(nx_)], nx_, &z_[(std::size_t(j) + 1) * stride + 1]);
  // Ghost samples continue the edge linearly, so that a plane stays a plane up to the edge.
  for (std::size_t j = 1; j <= std::size_t(ny_); ++j) {
    double* row = &z_[j * stride];
    row[0] = 2 * row[1] - row[2];
    row[stride - 1] = 2 * row[stride - 2] - row[stride - 3];
  }
  const std::size_t top = std::size_t(ny_) + 1;
  for (std::size_t i = 0; i < stride; ++i) {
    z_[i] = 2 * z_[stride + i] - z_[2 * stride + i];
    z_[top * stride + i] = 2 * z_[(top - 1) * stride + i] - z_[(top - 2) * stride + i];
  }
  const auto [lo, hi] = range();
  extent_.lowest_m = lo;
  extent_.highest_m = hi;
}

double GridSurface::sample(int i, int j) const {
  return z_[std::size_t(j + 1) * (std::size_t(nx_) + 2) + std::size_t(i + 1)];
}

GridSurface::Place GridSurface::locate(double x_m, double y_m) const {
  const double fx = start_x_ + std::clamp(x_m, 0.0, extent_.width_m) / dx_m_;
  const double fy = start_y_ + std::clamp(y_m, 0.0, extent_.depth_m) / dy_m_;
  const int i = std::clamp(int(std::floor(fx)), 0, nx_ - 2), j = std::clamp(int(std::floor(fy)), 0, ny_ - 2);
  return {i, j, std::clamp(fx - i, 0.0, 1.0), std::clamp(fy - j, 0.0, 1.0)};
}

double GridSurface::elevation_m(double x_m, double y_m) const {
  const Place at = locate(x_m, y_m);
  const Weights wx = catmull_rom(at.u), wy = catmull_rom(at.v);
  double z = 0;
  for (int b = 0; b < 4; ++b) {
    double row = 0;
    for (int a = 0; a < 4; ++a) row += wx[std::size_t(a)] * sample(at.i + a - 1, at.j + b - 1);
    z += wy[std::size_t(b)] * row;
  }
  return z;
}

glm::dvec2 GridSurface::gradient(double x_m, double y_m) const {
  const Place at = locate(x_m, y_m);
  const Weights wx = catmull_rom(at.u), wy = catmull_rom(at.v);
  const Weights dx = catmull_rom_slope(at.u), dy = catmull_rom_slope(at.v);
  glm::dvec2 g{0.0};
  for (int b = 0; b < 4; ++b) {
    double value = 0, slope = 0;
    for (int a = 0; a < 4; ++a) {
      const double z = sample(at.i + a - 1, at.j + b - 1);
      value += wx[std::size_t(a)] * z;
      slope += dx[std::size_t(a)] * z;
    }
    g.x += wy[std::size_t(b)] * slope;
    g.y += dy[std::size_t(b)] * value;
  }
  return {g.x / dx_m_, g.y / dy_m_};
}

// The interpolant may pass the samples a little (Catmull-Rom overshoots), hence the search on the surface
// itself.
std::array<double, 2> GridSurface::range() const {
  const double x1 = start_x_ + extent_.width_m / dx_m_, y1 = start_y_ + extent_.depth_m / dy_m_;
  const int i0 = std::clamp(int(std::floor(start_x_)), 0, nx_ - 2);
  const int j0 = std::clamp(int(std::floor(start_y_)), 0, ny_ - 2);
  const int i1 = std::clamp(int(std::ceil(x1)), i0 + 1, nx_ - 1);
  const int j1 = std::clamp(int(std::ceil(y1)), j0 + 1, ny_ - 1);
  BezierRange search = [&] {  // starts from the rectangle's corners and the samples inside it
    double lo = elevation_m(0, 0), hi = lo;
    for (const double x : {0.0, extent_.width_m})
      for (const double y : {0.0, extent_.depth_m}) {
        lo = std::min(lo, elevation_m(x, y));
        hi = std::max(hi, elevation_m(x, y));
      }
    for (int j = j0 + 1; j < j1; ++j)
      for (int i = i0 + 1; i < i1; ++i) {
        lo = std::min(lo, sample(i, j));
        hi = std::max(hi, sample(i, j));
      }
    return BezierRange(lo, hi);
  }();
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      BezierPatch patch;
      for (int b = 0; b < 4; ++b) {
        std::array<double, 4> p;
        for (int a = 0; a < 4; ++a) p[std::size_t(a)] = sample(i + a - 1, j + b - 1);
        patch[std::size_t(b)] = to_bezier(p);
      }
      for (std::size_t a = 0; a < 4; ++a) {
        const auto column = to_bezier({patch[0][a], patch[1][a], patch[2][a], patch[3][a]});
        for (std::size_t b = 0; b < 4; ++b) patch[b][a] = column[b];
      }
      search.add(restrict_patch(patch, std::clamp(start_x_ - i, 0.0, 1.0), std::clamp(x1 - i, 0.0, 1.0),
                                std::clamp(start_y_ - j, 0.0, 1.0), std::clamp(y1 - j, 0.0, 1.0)));
    }
  return {search.lowest(), search.highest()};
}

}  // namespace witherfield::terrain
