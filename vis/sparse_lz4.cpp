#include "vis/sparse_lz4.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace witherfield::vis {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kFarthest = 65535 / kWord;  // a match looks back at most 65,535 bytes
// The format's end: a match starts at least 12 bytes before it, and the last 5 bytes are literals.
constexpr std::uint32_t kNoMatchStart = 12 / kWord, kLastLiterals = 2;
constexpr std::size_t kMostZeros = 8;  // literal zeros beyond one per value: those of the end

/// Sequences of the format: literals, then a copy of what stands `back` words before.
class Sequences {
 public:
  Sequences(std::vector<char>& out, std::size_t words, std::size_t count) : out_(out) {
    // Every word costs at most itself, a copy of zeros (5 bytes with its literal zero) and its lengths' share.
    out_.resize(words * 4 * kWord + count * kWord / 250 + 64);
    at_ = out_.data();
    thread_local std::vector<std::uint32_t> buffer;  // a vector that grows word by word costs more than all the rest
    if (buffer.size() < 2 * words + kMostZeros) buffer.resize(2 * words + kMostZeros);
    first_ = last_ = buffer.data();
  }
  void literal(std::uint32_t word) { *last_++ = word; }
  void copy(std::uint32_t back, std::uint32_t words) {
    const std::uint32_t length = words * kWord - 4, offset = back * kWord;
    char* token = begin();
    *token = static_cast<char>(*token | static_cast<char>(std::min(length, 15u)));
    *at_++ = static_cast<char>(offset & 0xFF);
    *at_++ = static_cast<char>(offset >> 8);
    more(length);
  }
  void finish() {
    begin();
    out_.resize(static_cast<std::size_t>(at_ - out_.data()));
  }

 private:
  /// Token and literals; returns where the token stands.
  char* begin() {
    char* token = at_++;
    const auto bytes = static_cast<std::uint32_t>(last_ - first_) * kWord;
    *token = static_cast<char>(std::min(bytes, 15u) << 4);
    more(bytes);
    std::memcpy(at_, first_, bytes);
    at_ += bytes;
    last_ = first_;
    return token;
  }
  /// What of a length does not fit the token's four bits.
  void more(std::uint32_t length) {
    if (length < 15) return;
    for (length -= 15; length >= 255; length -= 255) *at_++ = static_cast<char>(255);
    *at_++ = static_cast<char>(length);
  }

  std::vector<char>& out_;
  char* at_;
  std::uint32_t *first_, *last_;  // literals not yet written
};

class Encoder {
 public:
  Encoder(const SparseWords& words, std::uint32_t count, std::vector<char>& out)
      : at_(words.at), value_(words.value), count_(count), sequences_(out, words.at.size(), count) {
    seen_.fill(kNever);
  }

  void run() {
    while (pos_ < count_) {
      if (next_place(next_) > pos_)
        zeros(next_place(next_));
      else if (!repeat()) {
        seen_[slot(value_[next_])] = static_cast<std::uint32_t>(next_);
        sequences_.literal(value_[next_++]);
        after_zero_ = false;
        ++pos_;
      }
    }
    sequences_.finish();
  }

 private:
  static constexpr std::uint32_t kNever = ~std::uint32_t{0};
  static std::size_t slot(std::uint32_t value) { return (value * 2654435761u) >> 22; }
  std::uint32_t next_place(std::size_t i) const { return i < at_.size() ? at_[i] : count_; }
  bool may_copy() const { return pos_ + kNoMatchStart <= count_; }

  /// Zeros up to `end`: copied from the word before, or from the last wide gap, or from one literal zero.
  void zeros(std::uint32_t end) {
    const std::uint32_t begin = pos_, stop = std::min(end, std::max(count_, kLastLiterals) - kLastLiterals);
    if (may_copy() && stop > begin) {
      const std::uint32_t length = stop - begin;
      if (after_zero_) {
        sequences_.copy(1, length);
      } else if (length <= gap_length_ && begin - gap_ <= kFarthest) {
        sequences_.copy(begin - gap_, length);
      } else {
        sequences_.literal(0);
        if (length > 1) sequences_.copy(1, length - 1);
      }
      pos_ = stop;
      if (length >= gap_length_ || begin - gap_ > kFarthest / 2) {
        gap_ = begin;
        gap_length_ = length;
      }
    }
    for (; pos_ < end; ++pos_) sequences_.literal(0);
    after_zero_ = true;
  }

  /// Copies what comes from where the next value stood before, as far as what follows it is alike, gaps and all. (Even
  /// a single word is a byte shorter as a copy.)
  bool repeat() {
    const std::uint32_t before = seen_[slot(value_[next_])];
    if (before == kNever || value_[before] != value_[next_] || !may_copy()) return false;
    const std::uint32_t back = pos_ - at_[before];
    if (back > kFarthest) return false;
    std::size_t i = next_ + 1, j = before + 1;
    while (i < at_.size() && at_[i] - at_[j] == back && value_[i] == value_[j]) ++i, ++j;
    // Zeros after it are alike up to the nearer of the next two values. (j < i, so at_[j] is there.)
    const std::uint32_t end = std::min({next_place(i), at_[j] + back, count_ - kLastLiterals});
    if (end <= pos_) return false;
    seen_[slot(value_[next_])] = static_cast<std::uint32_t>(next_);
    sequences_.copy(back, end - pos_);
    pos_ = end;
    while (next_ < at_.size() && at_[next_] < pos_) ++next_;
    after_zero_ = at_[next_ - 1] + 1 != pos_;
    return true;
  }

  const std::vector<std::uint32_t>&at_, &value_;
  const std::uint32_t count_;
  Sequences sequences_;
  std::array<std::uint32_t, 1024> seen_{};  // by a hash of the value: where in the list it stood last
  std::uint32_t pos_ = 0;                   // words done
  std::size_t next_ = 0;                    // first value not yet done
  bool after_zero_ = false;                 // the last word done is a zero
  std::uint32_t gap_ = 0, gap_length_ = 0;  // a wide gap of zeros not far back
};

}  // namespace

void encode_sparse_lz4(const SparseWords& words, std::size_t count, std::vector<char>& out) {
  Encoder(words, static_cast<std::uint32_t>(count), out).run();
}

}  // namespace witherfield::vis
