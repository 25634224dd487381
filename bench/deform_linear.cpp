// The paper's normal equations by Eigen and by CHOLMOD.
#include <cholmod.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

#include "bench/deform_peers.hpp"
#include "sim/leaf/cotangent.hpp"

namespace witherfield::bench {

using leaf::SparseMatrix;

SparseMatrix normal_matrix(const DeformInput& input) {
  const SparseMatrix l = leaf::cotangent_laplacian(input.position, input.triangles);
  std::vector<leaf::Entry> entries;
  for (int i = 0; i < l.rows(); ++i)  // L is symmetric: L^T L = sum over rows of their outer products
    for (int a = l.row_start[std::size_t(i)]; a < l.row_start[std::size_t(i) + 1]; ++a)
      for (int b = l.row_start[std::size_t(i)]; b < l.row_start[std::size_t(i) + 1]; ++b)
        entries.push_back({l.column[std::size_t(a)], l.column[std::size_t(b)], l.value[std::size_t(a)] * l.value[std::size_t(b)]});
  for (const int h : input.handle) entries.push_back({h, h, input.weight * input.weight});
  return leaf::assemble(l.rows(), std::move(entries));
}

namespace {

/// What both share: the fixed part of the right-hand side, column by column.
class LinearPeer : public DeformPeer {
 public:
  explicit LinearPeer(const DeformInput& input) : input_(input), n_(input.position.size()), matrix_(normal_matrix(input)) {
    std::vector<double> v(n_), product(n_);
    fixed_.resize(3 * n_);
    for (int c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < n_; ++i) v[i] = input.position[i][c];
      leaf::multiply(matrix_, v, product);
      for (const int h : input.handle) product[std::size_t(h)] -= square() * v[std::size_t(h)];
      std::copy(product.begin(), product.end(), fixed_.begin() + std::ptrdiff_t(std::size_t(c) * n_));
    }
  }

 protected:
  double square() const { return input_.weight * input_.weight; }
  void right_side(std::span<const glm::dvec3> target, double* b) const {
    std::copy(fixed_.begin(), fixed_.end(), b);
    for (int c = 0; c < 3; ++c)
      for (std::size_t h = 0; h < target.size(); ++h) b[std::size_t(c) * n_ + std::size_t(input_.handle[h])] += square() * target[h][c];
  }
  std::vector<glm::dvec3> from_columns(const double* x) const {
    std::vector<glm::dvec3> p(n_);
    for (std::size_t i = 0; i < n_; ++i) p[i] = {x[i], x[n_ + i], x[2 * n_ + i]};
    return p;
  }

  DeformInput input_;
  std::size_t n_;
  SparseMatrix matrix_;
  std::vector<double> fixed_;
};

class EigenLlt : public LinearPeer {
 public:
  explicit EigenLlt(const DeformInput& input) : LinearPeer(input) {
    a_.resize(Eigen::Index(n_), Eigen::Index(n_));
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < matrix_.rows(); ++i)
      for (int k = matrix_.row_start[std::size_t(i)]; k < matrix_.row_start[std::size_t(i) + 1]; ++k)
        entries.emplace_back(i, matrix_.column[std::size_t(k)], matrix_.value[std::size_t(k)]);
    a_.setFromTriplets(entries.begin(), entries.end());
    b_.resize(Eigen::Index(n_), 3);
  }
  void prepare() override { solver_.compute(a_); }
  void drag(std::span<const glm::dvec3> target) override {
    right_side(target, b_.data());
    x_ = solver_.solve(b_);
  }
  std::vector<glm::dvec3> positions() const override { return from_columns(x_.data()); }

 private:
  Eigen::SparseMatrix<double> a_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver_;
  Eigen::MatrixXd b_, x_;
};

class Cholmod : public LinearPeer {
 public:
  Cholmod(const DeformInput& input, int kind) : LinearPeer(input) {
    cholmod_start(&common_);
    common_.supernodal = kind;
    common_.final_ll = 1;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    std::size_t count = 0;
    for (int i = 0; i < matrix_.rows(); ++i)
      for (int k = matrix_.row_start[std::size_t(i)]; k < matrix_.row_start[std::size_t(i) + 1]; ++k) count += matrix_.column[std::size_t(k)] >= i;
    a_ = cholmod_allocate_sparse(n_, n_, count, 1, 1, -1, CHOLMOD_REAL, &common_);
    int *p = static_cast<int*>(a_->p), *row = static_cast<int*>(a_->i), at = 0;
    double* value = static_cast<double*>(a_->x);
    for (int i = 0; i < matrix_.rows(); ++i) {
      p[i] = at;
      for (int k = matrix_.row_start[std::size_t(i)]; k < matrix_.row_start[std::size_t(i) + 1]; ++k)
        if (matrix_.column[std::size_t(k)] >= i) {
          row[at] = matrix_.column[std::size_t(k)];
          value[at++] = matrix_.value[std::size_t(k)];
        }
    }
    p[matrix_.rows()] = at;
    b_ = cholmod_allocate_dense(n_, 3, n_, CHOLMOD_REAL, &common_);
  }
  ~Cholmod() override {
    cholmod_free_sparse(&a_, &common_);
    for (cholmod_dense** d : {&b_, &x_, &y_, &e_}) cholmod_free_dense(d, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  void prepare() override {
    cholmod_free_factor(&factor_, &common_);
    factor_ = cholmod_analyze(a_, &common_);
    cholmod_factorize(a_, factor_, &common_);
    if (common_.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD could not factor the normal equations");
  }
  void drag(std::span<const glm::dvec3> target) override {
    right_side(target, static_cast<double*>(b_->x));
    cholmod_solve2(CHOLMOD_A, factor_, b_, nullptr, &x_, nullptr, &y_, &e_, &common_);  // keeps its workspace
  }
  std::vector<glm::dvec3> positions() const override { return from_columns(static_cast<const double*>(x_->x)); }

 private:
  cholmod_common common_{};
  cholmod_sparse* a_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *b_ = nullptr, *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
};

}  // namespace

std::unique_ptr<DeformPeer> eigen_llt(const DeformInput& input) { return std::make_unique<EigenLlt>(input); }
std::unique_ptr<DeformPeer> cholmod_simplicial(const DeformInput& input) {
  return std::make_unique<Cholmod>(input, CHOLMOD_SIMPLICIAL);
}
std::unique_ptr<DeformPeer> cholmod_supernodal(const DeformInput& input) {
  return std::make_unique<Cholmod>(input, CHOLMOD_SUPERNODAL);
}

}  // namespace witherfield::bench
