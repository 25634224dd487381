// Libraries that can subdivide a triangle mesh by Loop's rules, each behind the same three calls.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace witherfield::bench {

struct LoopInput {
  std::vector<std::array<float, 3>> position;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> creases;  ///< only OpenSubdiv takes them
  std::vector<int> corners;                 ///< likewise
  int steps = 0;
};

/// To tell whether two results are the same surface whatever the order of their vertices.
struct LoopSums {
  std::size_t vertices = 0, faces = 0;
  double area = 0, square = 0;  ///< sum over faces; mean of |x|^2 over vertices
};

class LoopPeer {
 public:
  virtual ~LoopPeer() = default;
  virtual void
  prepare() = 0;  ///< not timed: gives the last result's memory back, the control mesh in its own type
  virtual void refine() = 0;  ///< timed: topology and positions
  virtual LoopSums sums() const = 0;
};

std::unique_ptr<LoopPeer> cgal_loop_float(const LoopInput& input);
std::unique_ptr<LoopPeer> cgal_loop_double(const LoopInput& input);
std::unique_ptr<LoopPeer> openmesh_loop_float(const LoopInput& input);
std::unique_ptr<LoopPeer> openmesh_loop_double(const LoopInput& input);
std::unique_ptr<LoopPeer> opensubdiv_loop(const LoopInput& input);
std::unique_ptr<LoopPeer> vtk_loop(const LoopInput& input);

/// OpenSubdiv's way to evaluate the same topology again and again: a table of stencils of the last level.
class OpenSubdivStencils {
 public:
  explicit OpenSubdivStencils(const LoopInput& input);
  ~OpenSubdivStencils();
  /// Osd::CpuEvaluator (one thread). The result stays inside.
  void evaluate(const std::vector<std::array<float, 3>>& control);
  double mean_square() const;
  double megabytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Sums over plain arrays.
template <class Position, class Triangle>
LoopSums sums_of(std::size_t vertices, std::size_t faces, const Position& position,
                 const Triangle& triangle) {
  LoopSums s{vertices, faces, 0, 0};
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::array<double, 3> p = position(v);
    s.square += (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / double(vertices);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const std::array<std::size_t, 3> t = triangle(f);
    const std::array<double, 3> a = position(t[0]), b = position(t[1]), c = position(t[2]);
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                 w[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double n[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    s.area += 0.5 * __builtin_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  return s;
}

}  // namespace witherfield::bench
