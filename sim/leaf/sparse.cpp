#include "sim/leaf/sparse.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {

int SparseMatrix::find(int row, int col) const {
  const auto first = column.begin() + row_start[std::size_t(row)], last = column.begin() + row_start[std::size_t(row) + 1];
  const auto at = std::lower_bound(first, last, col);
  return at != last && *at == col ? int(at - column.begin()) : -1;
}

SparseMatrix assemble(int rows, std::vector<Entry> entries) {
  // Two stable counting sorts (column, then row): linear time, and entries are summed in the order of the list.
  std::vector<Entry> sorted(entries.size());
  std::vector<int> start;
  const auto sort_by = [&](auto key) {
    start.assign(std::size_t(rows) + 1, 0);
    for (const Entry& e : entries) ++start[std::size_t(key(e)) + 1];
    for (int i = 0; i < rows; ++i) start[std::size_t(i) + 1] += start[std::size_t(i)];
    for (const Entry& e : entries) sorted[std::size_t(start[std::size_t(key(e))]++)] = e;
    entries.swap(sorted);
  };
  sort_by([](const Entry& e) { return e.column; });
  sort_by([](const Entry& e) { return e.row; });
  SparseMatrix m;
  m.row_start.assign(std::size_t(rows) + 1, 0);
  int row = -1;
  for (const Entry& e : entries) {
    if (e.row == row && m.column.back() == e.column) {
      m.value.back() += e.value;
      continue;
    }
    row = e.row;
    m.column.push_back(e.column);
    m.value.push_back(e.value);
    ++m.row_start[std::size_t(row) + 1];
  }
  for (int i = 0; i < rows; ++i) m.row_start[std::size_t(i) + 1] += m.row_start[std::size_t(i)];
  return m;
}

void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y, int width) {
  for (int i = 0; i < a.rows(); ++i) {
    double sum[8] = {};
    for (int k = a.row_start[std::size_t(i)]; k < a.row_start[std::size_t(i) + 1]; ++k) {
      const double v = a.value[std::size_t(k)];
      const double* from = &x[std::size_t(a.column[std::size_t(k)]) * std::size_t(width)];
      for (int c = 0; c < width; ++c) sum[c] += v * from[c];
    }
    std::copy(sum, sum + width, &y[std::size_t(i) * std::size_t(width)]);
  }
}

struct SparseCholesky::Impl {
  cholmod_common common{};
  cholmod_sparse* a = nullptr;  ///< lower triangle, by columns
  cholmod_factor* factor = nullptr;
  std::vector<int> slot;        ///< entry of the matrix -> place in `a`, -1 = upper triangle
  int factorisations = 0;
  // The factor by columns with interleaved right-hand sides is walked here: a few times faster than general solves.
  mutable std::vector<double> work;

  Impl(const SparseMatrix& m, Factor kind) {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = kind == Factor::blocked ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    fill(m);
    factor = cholmod_analyze(a, &common);
    if (!factor) throw SolverFailure("SparseCholesky: no order found for a matrix of " + std::to_string(m.rows()) + " rows");
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&a, &common);
    cholmod_finish(&common);
  }

  void fill(const SparseMatrix& m) {
    // Symmetric: row i of the matrix is column i; entries with column >= i are its lower triangle.
    const std::size_t n = std::size_t(m.rows());
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (int k = m.row_start[i]; k < m.row_start[i + 1]; ++k) count += m.column[std::size_t(k)] >= int(i);
    a = cholmod_allocate_sparse(n, n, count, 1, 1, -1, CHOLMOD_REAL, &common);
    if (!a) throw SolverFailure("SparseCholesky: no memory for " + std::to_string(count) + " entries");
    int* p = static_cast<int*>(a->p);
    int* rows = static_cast<int*>(a->i);
    slot.assign(m.value.size(), -1);
    int at = 0;
    for (std::size_t i = 0; i < n; ++i) {
      p[i] = at;
      for (int k = m.row_start[i]; k < m.row_start[i + 1]; ++k)
        if (m.column[std::size_t(k)] >= int(i)) {
          rows[at] = m.column[std::size_t(k)];
          slot[std::size_t(k)] = at++;
        }
    }
    p[n] = at;
  }

  void numbers(const SparseMatrix& m) {
    double* x = static_cast<double*>(a->x);
    for (std::size_t k = 0; k < m.value.size(); ++k)
      if (slot[k] >= 0) x[slot[k]] = m.value[k];
    cholmod_factorize(a, factor, &common);
    ++factorisations;
    if (common.status != CHOLMOD_OK || factor->minor < factor->n)
      throw SolverFailure("SparseCholesky: the matrix of " + std::to_string(factor->n) +
                          " rows is not positive definite (column " + std::to_string(factor->minor) + " of its order)");
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& a, Factor kind) : impl_(std::make_unique<Impl>(a, kind)) {
  impl_->numbers(a);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::refactor(const SparseMatrix& a) {
  if (a.value.size() != impl_->slot.size() || std::size_t(a.rows()) != impl_->factor->n)
    throw InvalidInput("SparseCholesky::refactor: the matrix has another pattern than the one that was analysed");
  impl_->numbers(a);
}

namespace {

/// Forward and back substitution, W right-hand sides side by side in x (already in the factor's order).
template <int W>
void substitute(const cholmod_factor& f, double* x) {
  const int* p = static_cast<const int*>(f.p);
  const int* nz = static_cast<const int*>(f.nz);
  const int* row = static_cast<const int*>(f.i);
  const double* value = static_cast<const double*>(f.x);
  const int n = int(f.n);
  for (int j = 0; j < n; ++j) {
    double* xj = x + std::size_t(j) * W;
    const int begin = p[j], end = begin + nz[j];
    double v[W];
    for (int c = 0; c < W; ++c) xj[c] = v[c] = xj[c] / value[begin];
    for (int k = begin + 1; k < end; ++k) {
      double* to = x + std::size_t(row[k]) * W;
      for (int c = 0; c < W; ++c) to[c] -= value[k] * v[c];
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    double* xj = x + std::size_t(j) * W;
    const int begin = p[j], end = begin + nz[j];
    double v[W];
    for (int c = 0; c < W; ++c) v[c] = xj[c];
    for (int k = begin + 1; k < end; ++k) {
      const double* from = x + std::size_t(row[k]) * W;
      for (int c = 0; c < W; ++c) v[c] -= value[k] * from[c];
    }
    for (int c = 0; c < W; ++c) xj[c] = v[c] / value[begin];
  }
}

}  // namespace

void SparseCholesky::solve(std::span<const double> b, std::span<double> x, int width) const {
  Impl& m = *impl_;
  const std::size_t n = m.factor->n;
  if (width < 1 || width > 4 || b.size() != n * std::size_t(width) || x.size() != b.size())
    throw InvalidInput("SparseCholesky::solve: arrays must hold " + std::to_string(n) + " x width values, width 1..4");
  if (m.factor->is_super) {
    cholmod_dense* rhs = cholmod_allocate_dense(n, std::size_t(width), n, CHOLMOD_REAL, &m.common);
    double* r = static_cast<double*>(rhs->x);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < std::size_t(width); ++c) r[c * n + i] = b[i * std::size_t(width) + c];
    cholmod_dense* result = cholmod_solve(CHOLMOD_A, m.factor, rhs, &m.common);
    const double* s = static_cast<const double*>(result->x);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < std::size_t(width); ++c) x[i * std::size_t(width) + c] = s[c * n + i];
    cholmod_free_dense(&rhs, &m.common);
    cholmod_free_dense(&result, &m.common);
    return;
  }
  const int* order = static_cast<const int*>(m.factor->Perm);
  const std::size_t stride = width == 3 ? 4 : std::size_t(width);  // three become four: one vector register
  m.work.resize(n * stride);
  for (std::size_t i = 0; i < n; ++i) {
    const double* from = &b[std::size_t(order[i]) * std::size_t(width)];
    double* to = &m.work[i * stride];
    for (int c = 0; c < width; ++c) to[c] = from[c];
    if (width == 3) to[3] = 0;
  }
  if (stride == 1) substitute<1>(*m.factor, m.work.data());
  else if (stride == 2) substitute<2>(*m.factor, m.work.data());
  else substitute<4>(*m.factor, m.work.data());
  for (std::size_t i = 0; i < n; ++i) {
    const double* from = &m.work[i * stride];
    double* to = &x[std::size_t(order[i]) * std::size_t(width)];
    for (int c = 0; c < width; ++c) to[c] = from[c];
  }
}

int SparseCholesky::size() const { return int(impl_->factor->n); }
std::size_t SparseCholesky::nonzeros() const {
  const cholmod_factor& f = *impl_->factor;
  if (f.is_super) return f.xsize;
  std::size_t sum = 0;
  for (std::size_t j = 0; j < f.n; ++j) sum += std::size_t(static_cast<const int*>(f.nz)[j]);
  return sum;
}
int SparseCholesky::factorisations() const { return impl_->factorisations; }

}  // namespace witherfield::leaf
