#include "sim/leaf/laplace_solver.hpp"

#include <algorithm>
#include <array>

namespace witherfield::leaf {
namespace {

/// Any vertex will do; one of middling index keeps the fill-reducing order undisturbed. mu of the size of the diagonal.
SparseMatrix grounded(const SparseMatrix& l) {
  SparseMatrix m = l;
  const int pin = l.rows() / 2, at = m.find(pin, pin);
  if (at >= 0) m.value[std::size_t(at)] *= 2;
  return m;
}

void take_out_mean(std::span<double> x, int width) {
  const std::size_t n = x.size() / std::size_t(width);
  for (int c = 0; c < width; ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += x[i * std::size_t(width) + std::size_t(c)];
    const double mean = sum / double(n);
    for (std::size_t i = 0; i < n; ++i) x[i * std::size_t(width) + std::size_t(c)] -= mean;
  }
}

}  // namespace

LaplaceSolver::LaplaceSolver(SparseMatrix l) : l_(std::move(l)), factor_(grounded(l_)) {}

void LaplaceSolver::solve(std::span<const double> b, std::span<double> x, int width) const {
  if (x.data() != b.data()) std::copy(b.begin(), b.end(), x.begin());
  take_out_mean(x, width);
  factor_.solve(x, x, width);
  take_out_mean(x, width);
}

HandleColumns handle_columns(const LaplaceSolver& solver, std::vector<int> vertices) {
  const std::size_t n = std::size_t(solver.matrix().rows()), count = vertices.size();
  HandleColumns h{std::move(vertices), {n, {}}, {n, {}}};
  h.harmonic.value.resize(n * count);
  h.biharmonic.value.resize(n * count);
  std::vector<double> block(n * 4);
  for (std::size_t first = 0; first < count; first += 4) {  // four right-hand sides walk through the factor together
    const std::size_t width = std::min<std::size_t>(4, count - first);
    const std::span<double> x(block.data(), n * width);
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t c = 0; c < width; ++c) x[std::size_t(h.vertex[first + c]) * width + c] = 1;
    for (Columns* to : {&h.harmonic, &h.biharmonic}) {
      solver.solve(x, x, int(width));
      for (std::size_t c = 0; c < width; ++c)
        for (std::size_t i = 0; i < n; ++i) to->value[(first + c) * n + i] = x[i * width + c];
    }
  }
  return h;
}

void add_columns(const Columns& columns, std::span<const glm::dvec3> coefficient, std::span<const glm::dvec3> base,
                 std::span<glm::dvec3> out) {
  constexpr std::size_t kBlock = 256;  // stays in the first-level cache
  double x[kBlock], y[kBlock], z[kBlock];
  for (std::size_t first = 0; first < columns.rows; first += kBlock) {
    const std::size_t count = std::min(kBlock, columns.rows - first);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3& p = base[first + i];
      x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    for (std::size_t h = 0; h < columns.count(); ++h) {
      const glm::dvec3 c = coefficient[h];
      if (c == glm::dvec3(0.0)) continue;
      const double* column = columns.value.data() + h * columns.rows + first;
      for (std::size_t i = 0; i < count; ++i) {
        x[i] += column[i] * c.x;
        y[i] += column[i] * c.y;
        z[i] += column[i] * c.z;
      }
    }
    for (std::size_t i = 0; i < count; ++i) out[first + i] = {x[i], y[i], z[i]};
  }
}

}  // namespace witherfield::leaf
