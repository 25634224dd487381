// L^+ (the pseudo-inverse of the cotangent operator of one connected piece) and what handles need of it.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/leaf/sparse.hpp"

namespace witherfield::leaf {

/// Solves with a singular L whose null space is the constants, by one factorisation of L + mu e_p e_p^T: when b sums to
/// zero, its solution has x_p = 0 and solves L x = b exactly.
class LaplaceSolver {
 public:
  /// @pre `l` is symmetric, positive semi-definite, L 1 = 0, one connected piece. @throws SolverFailure otherwise.
  explicit LaplaceSolver(SparseMatrix l);
  /// x = L^+ b: the constant part of b is taken out, x has mean zero. `width` interleaved vectors, 1..4.
  void solve(std::span<const double> b, std::span<double> x, int width = 1) const;
  const SparseMatrix& matrix() const { return l_; }
  int factorisations() const { return factor_.factorisations(); }

 private:
  SparseMatrix l_;
  SparseCholesky factor_;
};

/// Columns of a tall matrix, one after the other: column h, row i at [h * rows + i].
struct Columns {
  std::size_t rows = 0;
  std::vector<double> value;
  std::size_t count() const { return rows ? value.size() / rows : 0; }
  std::span<const double> operator[](std::size_t h) const { return {value.data() + h * rows, rows}; }
};

/// For a set of handles (P picks their vertices): G = L^+ P^T (harmonic) and B = L^+ L^+ P^T (biharmonic).
/// Two back substitutions a handle, no factorisation.
struct HandleColumns {
  std::vector<int> vertex;
  Columns harmonic, biharmonic;
};
HandleColumns handle_columns(const LaplaceSolver& solver, std::vector<int> vertices);

/// out = base + sum over h of columns[h] * coefficient[h], three coordinates at once; columns with a zero coefficient are
/// not read. `base` and `out` may be the same array.
void add_columns(const Columns& columns, std::span<const glm::dvec3> coefficient, std::span<const glm::dvec3> base,
                 std::span<glm::dvec3> out);

}  // namespace witherfield::leaf
