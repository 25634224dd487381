#include "sim/leaf/laplacian_edit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

std::vector<double> constraint_inverse(const Columns& columns, std::span<const int> vertex, std::span<const double> extra) {
  const Eigen::Index h = Eigen::Index(vertex.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(h + 1, h + 1);
  for (Eigen::Index i = 0; i < h; ++i)
    for (Eigen::Index j = 0; j < h; ++j)
      a(i, j) = columns[std::size_t(j)][std::size_t(vertex[std::size_t(i)])] + (i == j ? extra[std::size_t(i)] : 0.0);
  a.topLeftCorner(h, h) = 0.5 * (a.topLeftCorner(h, h) + a.topLeftCorner(h, h).transpose()).eval();  // rounding only
  // The border of ones gets the size of the rest, so that pivots compare.
  const double scale = a.cwiseAbs().maxCoeff();
  a.col(h).head(h).setConstant(scale);
  a.row(h).head(h).setConstant(scale);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(h + 1, h);
  right.topRows(h).setIdentity();
  Eigen::MatrixXd inverse = Eigen::PartialPivLU<Eigen::MatrixXd>(a).solve(right);
  inverse.row(h) *= scale;
  if (!inverse.allFinite())
    throw SolverFailure("leaf edit: the system of " + std::to_string(h) + " handles is singular");
  std::vector<double> rows(std::size_t((h + 1) * h));
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(rows.data(), h + 1, h) = inverse;
  return rows;
}

LaplacianEdit::LaplacianEdit(const HandleColumns& handles, std::span<const double> weight) : vertex_(handles.vertex) {
  const std::size_t h = vertex_.size(), n = handles.biharmonic.rows;
  std::vector<double> extra(h);
  for (std::size_t i = 0; i < h; ++i) extra[i] = 1 / (weight[i] * weight[i]);
  inverse_ = constraint_inverse(handles.biharmonic, vertex_, extra);
  // R = B lambda + 1 c^T, a block of rows at a time.
  response_ = {n, std::vector<double>(n * h)};
  const Eigen::Map<const Eigen::MatrixXd> b(handles.biharmonic.value.data(), Eigen::Index(n), Eigen::Index(h));
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> inverse(
      inverse_.data(), Eigen::Index(h) + 1, Eigen::Index(h));
  Eigen::Map<Eigen::MatrixXd> r(response_.value.data(), Eigen::Index(n), Eigen::Index(h));
  r.noalias() = b * inverse.topRows(Eigen::Index(h));
  r.rowwise() += inverse.row(Eigen::Index(h));
}

void LaplacianEdit::drag(std::span<const glm::dvec3> base_m, std::span<const glm::dvec3> target_m,
                         std::span<glm::dvec3> position_m) const {
  std::vector<glm::dvec3> move(vertex_.size());
  for (std::size_t i = 0; i < move.size(); ++i) move[i] = target_m[i] - base_m[std::size_t(vertex_[i])];
  add_columns(response_, move, base_m, position_m);
}

void LaplacianEdit::solve(const LaplaceSolver& solver, std::span<const glm::dvec3> base_m,
                          std::span<const glm::dvec3> target_m, std::span<glm::dvec3> position_m) const {
  const std::size_t h = vertex_.size(), n = base_m.size();
  std::vector<double> x(n * 3, 0.0);
  glm::dvec3 c(0.0);
  for (std::size_t i = 0; i <= h; ++i) {
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < h; ++j) sum += inverse_[i * h + j] * (target_m[j] - base_m[std::size_t(vertex_[j])]);
    if (i == h) c = sum;
    else
      for (int k = 0; k < 3; ++k) x[std::size_t(vertex_[i]) * 3 + std::size_t(k)] += sum[k];
  }
  solver.solve(x, x, 3);
  solver.solve(x, x, 3);
  for (std::size_t i = 0; i < n; ++i) position_m[i] = base_m[i] + glm::dvec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]) + c;
}

double linear_energy(const SparseMatrix& l, std::span<const glm::dvec3> base_m, std::span<const glm::dvec3> position_m,
                     std::span<const int> vertex, std::span<const double> weight, std::span<const glm::dvec3> target_m) {
  std::vector<double> d(base_m.size() * 3), ld(base_m.size() * 3);
  for (std::size_t i = 0; i < base_m.size(); ++i)
    for (int k = 0; k < 3; ++k) d[3 * i + std::size_t(k)] = position_m[i][k] - base_m[i][k];
  multiply(l, d, ld, 3);
  double energy = 0;
  for (const double v : ld) energy += v * v;
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    const glm::dvec3 miss = position_m[std::size_t(vertex[i])] - target_m[i];
    energy += weight[i] * weight[i] * glm::dot(miss, miss);
  }
  return energy;
}

}  // namespace witherfield::leaf
