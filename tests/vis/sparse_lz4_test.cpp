// Sparse LZ4 blocks, unpacked by the LZ4 library itself.
#include <gtest/gtest.h>
#include <lz4.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "sim/core/random.hpp"
#include "vis/block_codec.hpp"
#include "vis/sparse_lz4.hpp"

namespace witherfield::vis {
namespace {

std::vector<std::uint32_t> laid_out(const SparseWords& words, std::size_t count) {
  std::vector<std::uint32_t> dense(count, 0);
  for (std::size_t i = 0; i < words.at.size(); ++i) dense[words.at[i]] = words.value[i];
  return dense;
}

/// Encodes, unpacks with the library (which refuses blocks that break the rules of the format's end), compares.
std::size_t expect_round_trip(const SparseWords& words, std::size_t count) {
  std::vector<char> block;
  encode_sparse_lz4(words, count, block);
  std::vector<std::uint32_t> unpacked(count + 1, 0xDEADBEEF);
  const int bytes = LZ4_decompress_safe(block.data(), reinterpret_cast<char*>(unpacked.data()), int(block.size()),
                                        int(count * 4));
  EXPECT_EQ(bytes, int(count * 4));
  EXPECT_EQ(unpacked[count], 0xDEADBEEF);
  unpacked.pop_back();
  EXPECT_EQ(unpacked, laid_out(words, count));
  return block.size();
}

/// Runs of values, some of which repeat, with gaps in between.
SparseWords strewn(std::uint64_t seed, std::size_t count, double filled, int values) {
  Random r(seed, Stream::test, count);
  SparseWords words;
  bool inside = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (r.uniform() < (inside ? 0.3 * (1 - filled) : 0.3 * filled)) inside = !inside;
    if (!inside) continue;
    words.at.push_back(std::uint32_t(i));
    words.value.push_back(values > 0 ? std::uint32_t(r.bits() % std::uint64_t(values)) : std::uint32_t(r.bits()));
  }
  return words;
}

TEST(SparseLz4, EverySmallArrayUnpacks) {
  for (std::size_t count = 1; count <= 14; ++count)  // every pattern of filled words, around the rules of the end
    for (unsigned pattern = 0; pattern < (1u << count); ++pattern) {
      SparseWords words;
      for (std::uint32_t i = 0; i < count; ++i)
        if (pattern >> i & 1) {
          words.at.push_back(i);
          words.value.push_back(7 + i % 2);
        }
      ASSERT_NO_FATAL_FAILURE(expect_round_trip(words, count));
      if (HasFailure()) FAIL() << count << " words, pattern " << pattern;
    }
}

TEST(SparseLz4, StrewnArraysUnpack) {
  for (const std::size_t count : {100u, 1000u, 16383u, 16384u, 16385u, 65536u, 200000u})
    for (const double filled : {0.0, 0.001, 0.02, 0.5, 1.0})
      for (const int values : {0, 1, 2, 50}) {
        expect_round_trip(strewn(std::uint64_t(values), count, filled, values), count);
        if (HasFailure()) FAIL() << count << " words, " << filled << " filled, " << values << " values";
      }
}

TEST(SparseLz4, CopiesReachBackNoFartherThanTheFormatAllows) {
  for (const std::uint32_t apart : {16382u, 16383u, 16384u, 16385u, 40000u}) {
    SparseWords words{{10, 11, 12, 10 + apart, 11 + apart, 12 + apart}, {5, 6, 7, 5, 6, 7}};
    expect_round_trip(words, 50000 + 64);
  }
}

TEST(SparseLz4, GrassTakesNotManyMoreBytesThanWithTheLibrary) {
  // Like rows of a texel: a few blades, each some voxels wide, that move by a voxel from row to row.
  Random r(1, Stream::test, 0);
  std::map<std::uint32_t, std::uint32_t> filled;
  for (int blade = 0; blade < 12; ++blade) {
    double x = r.uniform(10, 240);
    for (std::uint32_t row = 0; row < 250; ++row, x += r.uniform(-0.3, 0.3))
      for (int i = 0; i < 4; ++i) {
        const float value = round_mantissa(float(0.5 + 0.1 * r.uniform()));
        std::memcpy(&filled[row * 256 + std::uint32_t(std::clamp(int(x) + i, 0, 255))], &value, 4);
      }
  }
  SparseWords words;
  for (const auto& [at, value] : filled) words.at.push_back(at), words.value.push_back(value);
  const std::size_t count = 256 * 256, bytes = expect_round_trip(words, count);
  const auto dense = laid_out(words, count);
  std::vector<char> block(std::size_t(LZ4_compressBound(int(count * 4))));
  const int library = LZ4_compress_default(reinterpret_cast<const char*>(dense.data()), block.data(), int(count * 4),
                                           int(block.size()));
  EXPECT_LT(double(bytes), 1.4 * library);  // the library also finds copies that begin within a word
}

TEST(SparseLz4, BlocksOfBothCompressionsHoldTheSame) {
  const std::size_t total = 5000, size = 1024;
  const SparseWords all = strewn(9, total, 0.1, 30);
  const auto fill = [&](std::size_t block, SparseWords& out) {
    if (block == 2) return;  // a block of zeros
    for (std::size_t i = 0; i < all.at.size(); ++i)
      if (all.at[i] / size == block) {
        out.at.push_back(std::uint32_t(all.at[i] - block * size));
        out.value.push_back(all.value[i]);
      }
  };
  const CompressedBytes lz4 = compress_sparse_blocks(total, size, Compression::lz4, fill);
  const CompressedBytes zlib = compress_sparse_blocks(total, size, Compression::zlib, fill);
  ASSERT_EQ(lz4.blocks.size(), 5u);
  ASSERT_EQ(zlib.blocks.size(), 5u);
  EXPECT_EQ(lz4.last_bytes, (total - 4 * size) * 4);
  EXPECT_EQ(lz4.last_bytes, zlib.last_bytes);
  for (std::size_t b = 0; b < 5; ++b) {
    SparseWords words;
    fill(b, words);
    const std::size_t count = b < 4 ? size : total - 4 * size;
    std::vector<std::uint32_t> unpacked(count);
    ASSERT_EQ(LZ4_decompress_safe(lz4.blocks[b]->data(), reinterpret_cast<char*>(unpacked.data()),
                                  int(lz4.blocks[b]->size()), int(count * 4)),
              int(count * 4));
    EXPECT_EQ(unpacked, laid_out(words, count));
  }
}

}  // namespace
}  // namespace witherfield::vis
