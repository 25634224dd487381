// The data of a PLY file, value by value.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "vis/mesh_text.hpp"
#include "vis/ply_format.hpp"

namespace witherfield::vis {

/// Values one after the other, as numbers, from text or from bytes.
class PlySource {
 public:
  PlySource(const std::filesystem::path& file, std::string_view content, const PlyHeader& header)
      : file_(file),
        text_(header.format == PlyHeader::Format::ascii),
        swap_((header.format == PlyHeader::Format::little_endian) !=
              (std::endian::native == std::endian::little)),
        scan_(file, text_ ? content.substr(header.bytes) : std::string_view(), header.lines + 1),
        content_(content),
        at_(header.bytes) {}

  void begin_element(const char* kind, std::int64_t index) {
    kind_ = kind;
    index_ = index;
    if (text_) scan_.need_line(fmt::format("{} {}", kind, index), 0);
  }

  double value(PlyType type) {
    if (text_) return text_value();
    switch (type) {
      case PlyType::i8:
        return bytes<std::int8_t>();
      case PlyType::u8:
        return bytes<std::uint8_t>();
      case PlyType::i16:
        return bytes<std::int16_t>();
      case PlyType::u16:
        return bytes<std::uint16_t>();
      case PlyType::i32:
        return bytes<std::int32_t>();
      case PlyType::u32:
        return bytes<std::uint32_t>();
      case PlyType::f32:
        return bytes<float>();
      case PlyType::f64:
        return bytes<double>();
    }
    return 0;
  }

  [[noreturn]] void fail(const std::string& what) const {
    if (text_) scan_.fail(fmt::format("{} {}: {}", kind_, index_, what));
    fail_reading(file_, fmt::format("byte {}: {} {}: {}", at_, kind_, index_, what));
  }

 private:
  template <class T>
  double bytes() {
    if (content_.size() - at_ < sizeof(T))
      fail_reading(file_, fmt::format("the file ends at byte {} within {} {}: truncated", content_.size(),
                                      kind_, index_));
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), content_.data() + at_, sizeof(T));
    if (swap_) std::reverse(raw.begin(), raw.end());
    at_ += sizeof(T);
    return double(std::bit_cast<T>(raw));
  }

  double text_value() {
    const std::string_view word = scan_.word();
    double value = 0;
    if (word.empty()) fail("the line ends too early");
    if (!parse_number(word, value)) fail(fmt::format("'{}' is not a number", printable(word)));
    return value;
  }

  std::filesystem::path file_;
  bool text_, swap_;
  TextScanner scan_;
  std::string_view content_;
  std::size_t at_;
  const char* kind_ = "";
  std::int64_t index_ = 0;
};

}  // namespace witherfield::vis
