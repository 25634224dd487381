// Memory for floats that nobody reads before writing: not zeroed, in huge pages where the system has them. Page faults
// cost more than the arithmetic on a sparse texel.
#pragma once
#include <cstddef>
#include <memory>

namespace witherfield {

class RawBuffer {
 public:
  RawBuffer() = default;
  RawBuffer(const RawBuffer& other);  ///< copies the contents
  RawBuffer& operator=(const RawBuffer& other);
  RawBuffer(RawBuffer&& other) noexcept : data_(std::move(other.data_)), size_(other.size_), capacity_(other.capacity_) {
    other.size_ = other.capacity_ = 0;
  }
  RawBuffer& operator=(RawBuffer&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = other.size_;
    capacity_ = other.capacity_;
    other.size_ = other.capacity_ = 0;
    return *this;
  }

  /// Room for n floats; contents are undefined afterwards. Keeps its memory when it suffices.
  void require(std::size_t n);
  float* data() { return data_.get(); }
  const float* data() const { return data_.get(); }
  std::size_t size() const { return size_; }  ///< floats in use

 private:
  struct Free { void operator()(float* p) const; };
  std::unique_ptr<float[], Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace witherfield
