// LZ4 blocks of arrays that are nearly all zeros, made without ever laying the zeros out: the general encoder
// spends its time on sweeping over them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace witherfield::vis {

/// The words of an array that are not zero (or may be), by ascending place.
struct SparseWords {
  std::vector<std::uint32_t> at;     ///< place in the array, in words
  std::vector<std::uint32_t> value;  ///< bit patterns, one per place
};

/// Writes to `out` an LZ4 block (block format 1.6, y.collet, "LZ4 Block Format Description") that any decoder
/// unpacks to `count` words in this machine's byte order.
/// @pre at is strictly ascending and below count; count < 2^29.
void encode_sparse_lz4(const SparseWords& words, std::size_t count, std::vector<char>& out);

}  // namespace witherfield::vis
