#include <fmt/format.h>

#include <array>
#include <utility>

#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"
#include "vis/ply_format.hpp"

namespace witherfield::vis {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::i8},
                                                                       {"uchar", PlyType::u8},
                                                                       {"short", PlyType::i16},
                                                                       {"ushort", PlyType::u16},
                                                                       {"int", PlyType::i32},
                                                                       {"uint", PlyType::u32},
                                                                       {"float", PlyType::f32},
                                                                       {"double", PlyType::f64},
                                                                       {"int8", PlyType::i8},
                                                                       {"uint8", PlyType::u8},
                                                                       {"int16", PlyType::i16},
                                                                       {"uint16", PlyType::u16},
                                                                       {"int32", PlyType::i32},
                                                                       {"uint32", PlyType::u32},
                                                                       {"float32", PlyType::f32},
                                                                       {"float64", PlyType::f64}}};

PlyType type_of(const TextScanner& scan, std::string_view word) {
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  scan.fail(fmt::format("'{}' is no type of a PLY file", printable(word)));
}

PlyHeader::Format format_of(TextScanner& scan) {
  const std::string_view word = scan.word();
  if (word == "ascii") return PlyHeader::Format::ascii;
  if (word == "binary_little_endian") return PlyHeader::Format::little_endian;
  if (word == "binary_big_endian") return PlyHeader::Format::big_endian;
  scan.fail(
      fmt::format("format '{}' must be ascii, binary_little_endian or binary_big_endian", printable(word)));
}

PlyProperty property_of(TextScanner& scan) {
  PlyProperty property;
  std::string_view word = scan.word();
  property.list = word == "list";
  if (property.list) {
    property.count_type = type_of(scan, scan.word());
    if (property.count_type == PlyType::f32 || property.count_type == PlyType::f64)
      scan.fail("the length of a list must be a whole number");
    word = scan.word();
  }
  property.type = type_of(scan, word);
  property.name = scan.word();
  if (property.name.empty()) scan.fail("a property without a name");
  return property;
}

}  // namespace

std::size_t ply_bytes(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[std::size_t(type)];
}

PlyHeader parse_ply_header(const std::filesystem::path& file, std::string_view content) {
  if (!content.starts_with("ply\n") && !content.starts_with("ply\r"))
    fail_reading(file, "not a PLY file: it does not begin with the line 'ply'");
  const auto marker = content.find("end_header");
  const auto newline = marker == std::string_view::npos ? marker : content.find('\n', marker);
  if (newline == std::string_view::npos) fail_reading(file, "the header has no line 'end_header': truncated");
  PlyHeader header;
  header.bytes = newline + 1;
  TextScanner scan(file, content.substr(0, header.bytes));
  bool has_format = false;
  while (scan.next_line(0)) {
    const std::string_view keyword = scan.word();
    if (keyword == "comment" || keyword == "obj_info") {
      if (scan.rest_of_line().find(kUnitComment) != std::string_view::npos) header.length_unit = "mm";
    } else if (keyword == "format") {
      header.format = format_of(scan);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = scan.word();
      element.count = scan.integer("the number of elements");
      if (element.count < 0)
        scan.fail(fmt::format("{} elements; there cannot be fewer than 0", element.count));
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) scan.fail("a property before the first element");
      header.elements.back().properties.push_back(property_of(scan));
    } else if (keyword != "ply" && keyword != "end_header") {
      scan.fail(fmt::format("'{}' does not belong into the header of a PLY file", printable(keyword)));
    }
    header.lines = scan.line();
  }
  if (!has_format) fail_reading(file, "the header has no line 'format'");
  return header;
}

}  // namespace witherfield::vis
