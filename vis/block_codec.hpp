// The compressed blocks of VTK's XML formats: an array's bytes are cut into blocks of equal size (the last
// may be shorter), each compressed on its own. Blocks of zeros are all alike and are compressed once.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "vis/sparse_lz4.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {

using Block = std::shared_ptr<const std::vector<char>>;

struct CompressedBytes {
  std::uint64_t block_bytes = 0;  ///< uncompressed size of every block but the last
  std::uint64_t last_bytes = 0;   ///< uncompressed size of the last block
  std::vector<Block> blocks;

  /// The header that VTK puts before the blocks: number, block size, size of a partial last block (0 = none),
  /// then the compressed size of each.
  std::vector<std::uint64_t> header() const;
  /// Header and blocks together.
  std::uint64_t stored_bytes() const;
};

/// Writes the bytes of block `index` to `out` (which holds anything). Returns false, and may leave `out` as
/// it is, when the block is all zeros. Called from several threads at once.
using BlockFill = std::function<bool(std::size_t index, std::span<std::byte> out)>;

/// @pre block_bytes > 0. Same bytes for any thread count.
CompressedBytes compress_blocks(std::uint64_t total_bytes, std::uint64_t block_bytes, Compression compression,
                                const BlockFill& fill);

/// Gives the words of block `index` that may be other than zero, ascending; `out` comes empty. Called from several
/// threads at once.
using SparseFill = std::function<void(std::size_t index, SparseWords& out)>;

/// The same for an array of 32-bit words of which few are not zero: LZ4 never sees the zeros. @pre block_words > 0.
CompressedBytes compress_sparse_blocks(std::uint64_t total_words, std::uint64_t block_words, Compression compression,
                                       const SparseFill& fill);

/// Bytes that lie in memory already.
CompressedBytes compress_bytes(std::span<const std::byte> bytes, Compression compression);

/// x rounded to nearest even with 10 bits of mantissa kept: relative error at most 2^-11. Infinities and NaN
/// stay.
inline float round_mantissa(float x) {
  constexpr std::uint32_t kDropped = 23 - 10, kHalf = 1u << (kDropped - 1), kMask = (1u << kDropped) - 1;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  if ((bits & 0x7F800000u) == 0x7F800000u) return x;
  const std::uint32_t odd = (bits >> kDropped) & 1u;
  return std::bit_cast<float>((bits + kHalf - 1 + odd) & ~kMask);
}

}  // namespace witherfield::vis
