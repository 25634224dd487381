// Sparse symmetric matrices as plain arrays, and their Cholesky factorisation (CHOLMOD behind it).
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace witherfield::leaf {

/// Compressed rows, all entries stored (both triangles of a symmetric matrix), columns ascending in each row.
struct SparseMatrix {
  std::vector<int> row_start;  ///< rows + 1
  std::vector<int> column;
  std::vector<double> value;

  int rows() const { return int(row_start.size()) - 1; }
  /// Index into `value` of entry (row, column), or -1. Binary search in the row.
  int find(int row, int column) const;
};

/// One entry to be summed into a matrix.
struct Entry {
  int row, column;
  double value;
};

/// Sums the entries (in a fixed order: the same bits for the same list). Rows without an entry stay empty.
SparseMatrix assemble(int rows, std::vector<Entry> entries);

/// y = A x for `width` interleaved vectors: x[i * width + c].
void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y, int width = 1);

/// How the factor is stored. `sparse`: column by column, one thread, no BLAS: the same bits everywhere; best up to a few
/// million non-zeros. `blocked`: supernodes with BLAS; several times faster when rows are dense (elasticity in space),
/// but its last bits depend on the BLAS that is installed.
enum class Factor { sparse, blocked };

/// L L^T of a symmetric positive definite matrix with a fill-reducing order. Factor once, solve often.
class SparseCholesky {
 public:
  /// @throws SolverFailure naming the column at which the matrix is not positive definite.
  explicit SparseCholesky(const SparseMatrix& a, Factor factor = Factor::sparse);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// New values on the same pattern: keeps the order. @throws SolverFailure as above, InvalidInput when the pattern differs.
  void refactor(const SparseMatrix& a);

  /// x = A^-1 b for `width` interleaved vectors: b[i * width + c], width 1..4; b and x may be the same array.
  void solve(std::span<const double> b, std::span<double> x, int width = 1) const;

  int size() const;
  std::size_t nonzeros() const;  ///< of the factor
  int factorisations() const;    ///< how often numbers were factored

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::leaf
