#include "sim/leaf/block_matrix.hpp"

#include <algorithm>

#include "sim/core/parallel.hpp"

namespace witherfield::leaf {

BlockMatrix::BlockMatrix(const std::vector<char>& held, std::vector<std::pair<int, int>> pairs) {
  row_.assign(held.size(), -1);
  for (std::size_t n = 0; n < held.size(); ++n)
    if (!held[n]) {
      row_[n] = int(node_.size());
      node_.push_back(int(n));
    }
  std::vector<std::pair<int, int>> blocks;  // (row, column), column <= row
  blocks.reserve(pairs.size() + node_.size());
  for (const auto& [a, b] : pairs) {
    const int i = row_[std::size_t(a)], j = row_[std::size_t(b)];
    if (i >= 0 && j >= 0) blocks.emplace_back(std::max(i, j), std::min(i, j));
  }
  for (int i = 0; i < int(node_.size()); ++i) blocks.emplace_back(i, i);
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  const std::size_t n = node_.size();
  start_.assign(n + 1, 0);
  diagonal_.resize(n);
  for (const auto& [i, j] : blocks) {
    ++start_[std::size_t(i) + 1];
    if (i == j) diagonal_[std::size_t(i)] = int(column_.size());
    column_.push_back(j);
  }
  for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
  block_.assign(column_.size(), glm::dmat3(0.0));

  // The scalar pattern: each block row holds its lower blocks, then the transposed ones of later rows.
  std::vector<std::vector<std::pair<int, int>>> full(n);  // row -> (column, block), columns ascending
  for (std::size_t i = 0; i < n; ++i)
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      full[i].emplace_back(column_[std::size_t(k)], k);
      if (column_[std::size_t(k)] != int(i)) full[std::size_t(column_[std::size_t(k)])].emplace_back(int(i), k);
    }
  upper_first_.assign(block_.size(), 0);
  upper_stride_.assign(block_.size(), 0);
  scalar_.row_start.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    const int first = int(scalar_.column.size()), width = 3 * int(full[i].size());
    for (int r = 0; r < 3; ++r) {
      for (const auto& [j, k] : full[i])
        for (int c = 0; c < 3; ++c) scalar_.column.push_back(3 * j + c);
      scalar_.row_start.push_back(int(scalar_.column.size()));
    }
    for (std::size_t q = 0; q < full[i].size(); ++q)
      if (full[i][q].first > int(i)) {
        upper_first_[std::size_t(full[i][q].second)] = first + 3 * int(q);
        upper_stride_[std::size_t(full[i][q].second)] = width;
      }
  }
  scalar_.value.assign(scalar_.column.size(), 0.0);
}

int BlockMatrix::slot(int a, int b) const {
  int i = row_[std::size_t(a)], j = row_[std::size_t(b)];
  if (i < 0 || j < 0) return -1;
  if (i < j) std::swap(i, j);
  const auto first = column_.begin() + start_[std::size_t(i)], last = column_.begin() + start_[std::size_t(i) + 1];
  return int(std::lower_bound(first, last, j) - column_.begin());
}

void BlockMatrix::set_zero() { std::fill(block_.begin(), block_.end(), glm::dmat3(0.0)); }

void BlockMatrix::add_to_diagonal(double shift) {
  for (const int k : diagonal_) block_[std::size_t(k)] += glm::dmat3(shift);
}

double BlockMatrix::mean_diagonal() const {
  double sum = 0;
  for (const int k : diagonal_)
    for (int c = 0; c < 3; ++c) sum += block_[std::size_t(k)][c][c];
  return sum / double(3 * std::max<std::size_t>(diagonal_.size(), 1));
}

const SparseMatrix& BlockMatrix::scalar() {
  parallel_for(diagonal_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int k = start_[i]; k < start_[i + 1]; ++k) {
        const glm::dmat3& m = block_[std::size_t(k)];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            scalar_.value[std::size_t(scalar_.row_start[3 * i + std::size_t(r)] + 3 * (k - start_[i]) + c)] = m[c][r];
            if (column_[std::size_t(k)] != int(i))
              scalar_.value[std::size_t(upper_first_[std::size_t(k)] + c * upper_stride_[std::size_t(k)] + r)] = m[c][r];
          }
      }
  });
  return scalar_;
}

void BlockMatrix::gather(std::span<const glm::dvec3> node_values, std::span<double> rows) const {
  for (std::size_t i = 0; i < node_.size(); ++i)
    for (int c = 0; c < 3; ++c) rows[3 * i + std::size_t(c)] = node_values[std::size_t(node_[i])][c];
}

void BlockMatrix::scatter(std::span<const double> rows, std::span<glm::dvec3> node_values) const {
  std::fill(node_values.begin(), node_values.end(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < node_.size(); ++i)
    for (int c = 0; c < 3; ++c) node_values[std::size_t(node_[i])][c] = rows[3 * i + std::size_t(c)];
}

void BlockMatrix::multiply(std::span<const glm::dvec3> x, std::span<glm::dvec3> y) const {
  std::fill(y.begin(), y.end(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < node_.size(); ++i)
    for (int k = start_[i]; k < start_[i + 1]; ++k) {
      const std::size_t a = std::size_t(node_[i]), b = std::size_t(node_[std::size_t(column_[std::size_t(k)])]);
      y[a] += block_[std::size_t(k)] * x[b];
      if (a != b) y[b] += glm::transpose(block_[std::size_t(k)]) * x[a];
    }
}

}  // namespace witherfield::leaf
