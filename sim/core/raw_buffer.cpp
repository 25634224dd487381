#include "sim/core/raw_buffer.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>

namespace witherfield {

void RawBuffer::Free::operator()(float* p) const { std::free(p); }

void RawBuffer::require(std::size_t n) {
  size_ = n;
  if (n <= capacity_) return;
  constexpr std::size_t huge = std::size_t(2) << 20;
  const std::size_t bytes = (n * sizeof(float) + huge - 1) / huge * huge;
  data_.reset();  // the old contents are not kept: give the memory back first
  capacity_ = 0;
  data_.reset(static_cast<float*>(std::aligned_alloc(huge, bytes)));
  if (!data_) throw std::bad_alloc();
  capacity_ = bytes / sizeof(float);
  madvise(data_.get(), bytes, MADV_HUGEPAGE);  // a wish; without it the pages are small
}

RawBuffer::RawBuffer(const RawBuffer& other) { *this = other; }

RawBuffer& RawBuffer::operator=(const RawBuffer& other) {
  if (this == &other) return *this;
  require(other.size_);
  if (size_ > 0) std::memcpy(data_.get(), other.data_.get(), size_ * sizeof(float));
  return *this;
}

}  // namespace witherfield
