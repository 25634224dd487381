#include "sim/leaf/arap.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/parallel.hpp"
#include "sim/leaf/laplacian_edit.hpp"

namespace witherfield::leaf {
namespace {

// Of the exact curvature of the first term of E at rest, and of the last step that is taken again. Both together converge
// for stretches up to 1.8 and need the fewest iterations on leaves and sheets of 2,600 to 100,000 vertices.
constexpr double kCurvatureShare = 0.6, kMomentum = 0.5;
constexpr std::size_t kGrain = 1024;

void add_outer(Mat3& s, const glm::dvec3& p, const glm::dvec3& q) {
  s.m[0] += p.x * q.x, s.m[1] += p.x * q.y, s.m[2] += p.x * q.z;
  s.m[3] += p.y * q.x, s.m[4] += p.y * q.y, s.m[5] += p.y * q.z;
  s.m[6] += p.z * q.x, s.m[7] += p.z * q.y, s.m[8] += p.z * q.z;
}

/// Rodrigues' formula.
Mat3 exponential(const glm::dvec3& w) {
  const double t2 = glm::dot(w, w), t = std::sqrt(t2);
  const double a = t < 1e-4 ? 1 - t2 / 6 : std::sin(t) / t, b = t < 1e-4 ? 0.5 - t2 / 24 : (1 - std::cos(t)) / t2;
  return {{1 - b * (w.y * w.y + w.z * w.z), b * w.x * w.y - a * w.z, b * w.x * w.z + a * w.y,  //
           b * w.x * w.y + a * w.z, 1 - b * (w.x * w.x + w.z * w.z), b * w.y * w.z - a * w.x,  //
           b * w.x * w.z - a * w.y, b * w.y * w.z + a * w.x, 1 - b * (w.x * w.x + w.y * w.y)}};
}

/// Products of rotations drift from orthogonality by rounding: one Newton step of Gram-Schmidt type takes that away.
Mat3 orthonormal(const Mat3& r) {
  glm::dvec3 x(r.m[0], r.m[1], r.m[2]), y(r.m[3], r.m[4], r.m[5]);
  x *= 1.5 - 0.5 * glm::dot(x, x);
  y -= glm::dot(x, y) * x;
  y *= 1.5 - 0.5 * glm::dot(y, y);
  const glm::dvec3 z = glm::cross(x, y);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
}

std::size_t at(int i) { return std::size_t(i); }

}  // namespace

ArapEdit::ArapEdit(const LaplaceSolver& solver, std::span<const glm::dvec3> rest_m, double area_m2, double alpha)
    : solver_(&solver), stiffness_(0.5 * alpha * area_m2), turns_(turn_matrix(rest_m)) {
  const std::size_t n = rest_m.size();
  turning_.rotation.resize(n);
  turning_.omega.resize(n);
  right_.resize(n * 3);
  next_.resize(n);
  set_rest(rest_m);
}

/// Neighbours and weights; H = share * sum w |p|^2 on the diagonal + graph operator of the smoothing.
SparseCholesky ArapEdit::turn_matrix(std::span<const glm::dvec3> rest_m) {
  const SparseMatrix& l = solver_->matrix();
  const std::size_t n = at(l.rows());
  start_.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = at(l.row_start[i]); k < at(l.row_start[i + 1]); ++k)
      if (l.column[k] != int(i)) {
        neighbour_.push_back(l.column[k]);
        weight_.push_back(-0.5 * l.value[k]);
      }
    start_[i + 1] = int(neighbour_.size());
  }
  const auto count = [&](std::size_t i) { return double(start_[i + 1] - start_[i]); };
  smooth_.resize(neighbour_.size());
  stretch_rest_.assign(n, 0.0);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, size = 0;
    for (std::size_t k = at(start_[i]); k < at(start_[i + 1]); ++k) {
      const std::size_t j = at(neighbour_[k]);
      const glm::dvec3 p = rest_m[i] - rest_m[j];
      smooth_[k] = stiffness_ * (1 / count(i) + 1 / count(j));
      stretch_rest_[i] += weight_[k] * glm::dot(p, p);
      size += std::abs(weight_[k]) * glm::dot(p, p);
      sum += 2 * smooth_[k];
      entries.push_back({int(i), int(j), -2 * smooth_[k]});
    }
    // Obtuse triangles may make single weights negative; the sum is kept away from zero.
    stretch_rest_[i] = std::max(stretch_rest_[i], 0.1 * size);
    entries.push_back({int(i), int(i), sum + kCurvatureShare * stretch_rest_[i]});
  }
  return SparseCholesky(assemble(int(n), std::move(entries)));
}

void ArapEdit::set_rest(std::span<const glm::dvec3> rest_m) {
  rest_.assign(rest_m.begin(), rest_m.end());
  edge_.resize(neighbour_.size());
  half_delta_.assign(rest_.size(), glm::dvec3(0.0));
  glm::dvec3 low = rest_[0], high = rest_[0];
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    low = glm::min(low, rest_[i]), high = glm::max(high, rest_[i]);
    for (std::size_t k = at(start_[i]); k < at(start_[i + 1]); ++k) {
      edge_[k] = weight_[k] * (rest_[i] - rest_[at(neighbour_[k])]);
      half_delta_[i] += edge_[k];
    }
  }
  size_m_ = glm::length(high - low);
  std::fill(turning_.rotation.begin(), turning_.rotation.end(), Mat3{});
}

void ArapEdit::set_handles(const HandleColumns& handles) {
  vertex_ = handles.vertex;
  harmonic_ = handles.harmonic;
  inverse_ = constraint_inverse(harmonic_, vertex_, std::vector<double>(vertex_.size(), 0.0));
}

void ArapEdit::turn(const Mat3& rotation) {
  for (Mat3& r : turning_.rotation) r = rotation * r;
}

/// Gradient of -trace(R_i (S_i + sum of smooth R_j^T)) for a small turn of R_i, S_i = sum of w p q^T; then H omega = gradient.
void ArapEdit::step_rotations(std::span<const glm::dvec3> x, Turning& t) const {
  std::vector<double> g(x.size() * 3);
  parallel_for(x.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Mat3 s = Mat3::zero(), around = Mat3::zero();
      for (std::size_t k = at(start_[i]); k < at(start_[i + 1]); ++k) {
        const std::size_t j = at(neighbour_[k]);
        add_outer(s, edge_[k], x[i] - x[j]);
        for (int a = 0; a < 9; ++a) around.m[a] += smooth_[k] * t.rotation[j].m[a];
      }
      const Mat3& r = t.rotation[i];
      const Mat3 fit = r * s;
      // Stretched neighbourhoods have a larger curvature than H holds: their part is scaled down to it.
      const double scale = std::min(1.0, stretch_rest_[i] / std::max(fit.m[0] + fit.m[4] + fit.m[8], 1e-300));
      const auto smooth = [&](int a, int b) {  // (R_i sum R_j^T)_ab
        return r.m[3 * a] * around.m[3 * b] + r.m[3 * a + 1] * around.m[3 * b + 1] + r.m[3 * a + 2] * around.m[3 * b + 2];
      };
      const double fit_scale = fit.m[0] + fit.m[4] + fit.m[8] > 0 ? scale : 1.0;
      g[3 * i] = fit_scale * (fit.m[5] - fit.m[7]) + smooth(1, 2) - smooth(2, 1);
      g[3 * i + 1] = fit_scale * (fit.m[6] - fit.m[2]) + smooth(2, 0) - smooth(0, 2);
      g[3 * i + 2] = fit_scale * (fit.m[1] - fit.m[3]) + smooth(0, 1) - smooth(1, 0);
    }
  });
  turns_.solve(g, g, 3);
  parallel_for(x.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      t.omega[i] = glm::dvec3(g[3 * i], g[3 * i + 1], g[3 * i + 2]) + kMomentum * t.omega[i];
      t.rotation[i] = orthonormal(exponential(t.omega[i]) * t.rotation[i]);
    }
  });
}

/// b_i = sum over j of w_ij (R_i + R_j) (p_i - p_j)
void ArapEdit::right_side() {
  parallel_for(rest_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      glm::dvec3 b = turning_.rotation[i] * half_delta_[i];
      for (std::size_t k = at(start_[i]); k < at(start_[i + 1]); ++k)
        b += turning_.rotation[at(neighbour_[k])] * edge_[k];
      right_[3 * i] = b.x, right_[3 * i + 1] = b.y, right_[3 * i + 2] = b.z;
    }
  });
}

/// Returns the longest move of a vertex.
double ArapEdit::solve_positions(std::span<const glm::dvec3> target_m, std::span<glm::dvec3> x) {
  solver_->solve(right_, right_, 3);
  const std::size_t h = vertex_.size();
  std::vector<glm::dvec3> lambda(h + 1, glm::dvec3(0.0)), miss(h);  // the last one is c
  for (std::size_t j = 0; j < h; ++j) {
    const double* free = &right_[at(vertex_[j]) * 3];
    miss[j] = target_m[j] - glm::dvec3(free[0], free[1], free[2]);
  }
  for (std::size_t i = 0; i <= h; ++i)
    for (std::size_t j = 0; j < h; ++j) lambda[i] += inverse_[i * h + j] * miss[j];
  for (std::size_t i = 0; i < x.size(); ++i)
    next_[i] = glm::dvec3(right_[3 * i], right_[3 * i + 1], right_[3 * i + 2]) + lambda[h];
  add_columns(harmonic_, lambda, next_, next_);
  double longest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 d = next_[i] - x[i];
    longest = std::max(longest, glm::dot(d, d));
    x[i] = next_[i];
  }
  for (std::size_t j = 0; j < h; ++j) x[at(vertex_[j])] = target_m[j];
  return std::sqrt(longest);
}

int ArapEdit::drag(std::span<const glm::dvec3> target_m, std::span<glm::dvec3> position_m, const Limits& limits) {
  std::fill(turning_.omega.begin(), turning_.omega.end(), glm::dvec3(0.0));
  for (int iteration = 1;; ++iteration) {
    step_rotations(position_m, turning_);
    right_side();
    if (solve_positions(target_m, position_m) <= limits.tolerance * size_m_ || iteration >= limits.max_iterations)
      return iteration;
  }
}

double ArapEdit::energy_with(std::span<const glm::dvec3> x, const std::vector<Mat3>& rotation) const {
  double energy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double smooth = stiffness_ / double(start_[i + 1] - start_[i]);
    for (std::size_t k = at(start_[i]); k < at(start_[i + 1]); ++k) {
      const std::size_t j = at(neighbour_[k]);
      const glm::dvec3 miss = x[i] - x[j] - rotation[i] * (rest_[i] - rest_[j]);
      double turn = 0;
      for (int a = 0; a < 9; ++a) {
        const double d = rotation[i].m[a] - rotation[j].m[a];
        turn += d * d;
      }
      energy += weight_[k] * glm::dot(miss, miss) + smooth * turn;
    }
  }
  return energy;
}

double ArapEdit::energy(std::span<const glm::dvec3> position_m) const {
  // From the best rigid motion, so that the same shape has the same energy whatever was done before.
  double residual = 0;
  const RigidMotion whole = fit_rigid(rest_, position_m, residual);
  Turning t{std::vector<Mat3>(rest_.size(), whole.rotation), std::vector<glm::dvec3>(rest_.size(), glm::dvec3(0.0))};
  double least = energy_with(position_m, t.rotation);
  for (int sweep = 1; sweep <= 400; ++sweep) {
    step_rotations(position_m, t);
    if (sweep % 10 != 0) continue;
    const double next = energy_with(position_m, t.rotation);
    if (least - next <= 1e-10 * least) return std::min(least, next);
    least = next;
  }
  return least;
}

}  // namespace witherfield::leaf
