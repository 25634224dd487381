#include "vis/block_codec.hpp"

#include <lz4.h>
#include <zlib.h>

#include <cstring>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::vis {
namespace {

// zlib's level 5: twice as small as LZ4 at some ten times the time; higher levels gain next to nothing here.
constexpr int kZlibLevel = 5;

std::vector<char> lz4(std::span<const std::byte> in, std::vector<char>& scratch) {
  scratch.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(in.size()))));
  const int bytes = LZ4_compress_fast(reinterpret_cast<const char*>(in.data()), scratch.data(),
                                      static_cast<int>(in.size()), static_cast<int>(scratch.size()), 1);
  if (bytes <= 0)
    throw IoFailure("LZ4 could not compress a block of " + std::to_string(in.size()) + " bytes");
  return {scratch.begin(), scratch.begin() + bytes};
}

std::vector<char> deflate(std::span<const std::byte> in, std::vector<char>& scratch) {
  uLongf bytes = compressBound(in.size());
  scratch.resize(bytes);
  if (compress2(reinterpret_cast<Bytef*>(scratch.data()), &bytes, reinterpret_cast<const Bytef*>(in.data()),
                in.size(), kZlibLevel) != Z_OK)
    throw IoFailure("zlib could not compress a block of " + std::to_string(in.size()) + " bytes");
  return {scratch.begin(), scratch.begin() + static_cast<std::ptrdiff_t>(bytes)};
}

Block compress(std::span<const std::byte> in, Compression compression, std::vector<char>& scratch) {
  return std::make_shared<const std::vector<char>>(compression == Compression::lz4 ? lz4(in, scratch)
                                                                                   : deflate(in, scratch));
}

}  // namespace

std::vector<std::uint64_t> CompressedBytes::header() const {
  std::vector<std::uint64_t> h{blocks.size(), block_bytes, last_bytes == block_bytes ? 0 : last_bytes};
  for (const Block& b : blocks) h.push_back(b->size());
  return h;
}

std::uint64_t CompressedBytes::stored_bytes() const {
  std::uint64_t bytes = (3 + blocks.size()) * sizeof(std::uint64_t);
  for (const Block& b : blocks) bytes += b->size();
  return bytes;
}

CompressedBytes compress_blocks(std::uint64_t total_bytes, std::uint64_t block_bytes, Compression compression,
                                const BlockFill& fill) {
  CompressedBytes out;
  out.block_bytes = block_bytes;
  const std::size_t count = static_cast<std::size_t>((total_bytes + block_bytes - 1) / block_bytes);
  if (count == 0) return out;
  out.last_bytes = total_bytes - (count - 1) * block_bytes;
  out.blocks.resize(count);

  std::vector<char> scratch;
  const std::vector<std::byte> zeros(block_bytes);
  const Block zero_block = compress(zeros, compression, scratch);
  const Block last_zero_block = out.last_bytes == block_bytes
                                    ? zero_block
                                    : compress(std::span(zeros).first(out.last_bytes), compression, scratch);

  parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
    thread_local std::vector<std::byte> buffer;
    thread_local std::vector<char> thread_scratch;
    buffer.resize(block_bytes);
    for (std::size_t b = begin; b < end; ++b) {
      const bool last = b + 1 == count;
      const auto bytes = std::span(buffer).first(last ? out.last_bytes : block_bytes);
      out.blocks[b] = fill(b, bytes) ? compress(bytes, compression, thread_scratch)
                                     : (last ? last_zero_block : zero_block);
    }
  });
  return out;
}

CompressedBytes compress_sparse_blocks(std::uint64_t total_words, std::uint64_t block_words, Compression compression,
                                       const SparseFill& fill) {
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  if (compression != Compression::lz4)
    return compress_blocks(total_words * kWord, block_words * kWord, compression,
                           [&](std::size_t block, std::span<std::byte> out) {
                             SparseWords words;
                             fill(block, words);
                             if (words.at.empty()) return false;
                             std::memset(out.data(), 0, out.size());
                             for (std::size_t i = 0; i < words.at.size(); ++i)
                               std::memcpy(out.data() + words.at[i] * kWord, &words.value[i], kWord);
                             return true;
                           });
  CompressedBytes out;
  out.block_bytes = block_words * kWord;
  const std::size_t count = static_cast<std::size_t>((total_words + block_words - 1) / block_words);
  if (count == 0) return out;
  const std::uint64_t last_words = total_words - (count - 1) * block_words;
  out.last_bytes = last_words * kWord;
  out.blocks.resize(count);
  const auto encode = [](const SparseWords& words, std::uint64_t size, std::vector<char>& scratch) {
    encode_sparse_lz4(words, size, scratch);
    return std::make_shared<const std::vector<char>>(scratch);
  };
  std::vector<char> scratch;
  const Block zero_block = encode({}, block_words, scratch), last_zero_block = encode({}, last_words, scratch);
  parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
    thread_local SparseWords words;
    thread_local std::vector<char> thread_scratch;
    for (std::size_t b = begin; b < end; ++b) {
      const bool last = b + 1 == count;
      words.at.clear();
      words.value.clear();
      fill(b, words);
      out.blocks[b] = words.at.empty() ? (last ? last_zero_block : zero_block)
                                       : encode(words, last ? last_words : block_words, thread_scratch);
    }
  });
  return out;
}

CompressedBytes compress_bytes(std::span<const std::byte> bytes, Compression compression) {
  constexpr std::uint64_t kBlock = 256 * 1024;
  return compress_blocks(bytes.size(), kBlock, compression, [&](std::size_t block, std::span<std::byte> out) {
    std::memcpy(out.data(), bytes.data() + block * kBlock, out.size());
    return true;
  });
}

}  // namespace witherfield::vis
