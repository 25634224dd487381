// Symmetric sparse matrix of 3 x 3 blocks over nodes, some of which are held (have no rows).
#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "sim/leaf/sparse.hpp"

namespace witherfield::leaf {

class BlockMatrix {
 public:
  /// @param pairs coupled nodes (either order, repeats allowed); every free node is coupled with itself.
  BlockMatrix(const std::vector<char>& held, std::vector<std::pair<int, int>> pairs);

  /// Where the block of two nodes is kept, to be looked up once: -1 when one of them is held.
  /// @pre the pair was given to the constructor.
  int slot(int a, int b) const;
  void set_zero();
  /// Adds `block` = d2E / (dx_a dx_b) at the slot of (a, b); its transpose belongs to (b, a).
  void add(int slot, int a, int b, const glm::dmat3& block) {
    if (slot >= 0) block_[std::size_t(slot)] += a >= b ? block : glm::transpose(block);
  }
  void add_diagonal(int node, const glm::dmat3& block) {
    const int r = row_[std::size_t(node)];
    if (r >= 0) block_[std::size_t(diagonal_[std::size_t(r)])] += block;
  }
  void add_to_diagonal(double shift);  ///< shift * identity
  double mean_diagonal() const;

  int rows() const { return int(diagonal_.size()); }  ///< free nodes
  int nodes() const { return int(row_.size()); }
  /// All entries with 3 rows per free node.
  const SparseMatrix& scalar();
  /// Values of free nodes <-> 3 numbers a row.
  void gather(std::span<const glm::dvec3> node_values, std::span<double> rows) const;
  void scatter(std::span<const double> rows, std::span<glm::dvec3> node_values) const;  ///< held nodes get 0
  /// y = A x over nodes (held ones count as 0).
  void multiply(std::span<const glm::dvec3> x, std::span<glm::dvec3> y) const;

 private:
  std::vector<int> row_;                   ///< node -> row, -1 held
  std::vector<int> node_;                  ///< row -> node
  std::vector<int> start_, column_;        ///< lower triangle of blocks by rows, columns ascending
  std::vector<int> diagonal_;              ///< slot of each row's own block
  std::vector<glm::dmat3> block_;          ///< [column][row] as glm has it
  SparseMatrix scalar_;
  std::vector<int> upper_first_, upper_stride_;  ///< per block: place of its transposed copy in scalar_.value
};

}  // namespace witherfield::leaf
