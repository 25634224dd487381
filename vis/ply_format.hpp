// What the header of a PLY file says (Turk 1994, "The PLY polygon file format").
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield::vis {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };
std::size_t ply_bytes(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool list = false;
  PlyType count_type = PlyType::u8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian } format = Format::ascii;
  std::string length_unit;  ///< "mm" when a comment says so
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;   ///< of the header: the data begin there
  std::int64_t lines = 0;  ///< of the header
};

/// @throws InvalidInput naming the line.
PlyHeader parse_ply_header(const std::filesystem::path& file, std::string_view content);

}  // namespace witherfield::vis
