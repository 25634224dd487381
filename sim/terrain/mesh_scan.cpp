#include "sim/terrain/mesh_scan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "sim/core/errors.hpp"

namespace witherfield::terrain {
namespace {

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
  Words words;
  constexpr const char* blank = " \t\r";
  for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blank, end);
  }
  return words;
}

template <class Number>
std::optional<Number> parse(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// Reads lines and knows where it is.
class Lines {
 public:
  explicit Lines(const std::string& file) : file_(file), in_(file, std::ios::binary) {
    if (!in_) throw IoFailure(fmt::format("terrain.mesh: cannot open '{}'", file));
  }
  bool next() {
    if (!std::getline(in_, text_)) return false;
    ++number_;
    return true;
  }
  const std::string& text() const { return text_; }
  [[noreturn]] void malformed(const std::string& what) const {
    throw IoFailure(fmt::format("terrain.mesh: {}:{}: {}", file_, number_, what));
  }
  [[noreturn]] void invalid(const std::string& what) const {
    throw InvalidInput(fmt::format("terrain.mesh: {}:{}: {}", file_, number_, what));
  }
  void require_coordinate(std::string_view word) const {
    const auto value = parse<double>(word);
    if (!value) malformed(fmt::format("'{}' is not a number", word));
    if (!std::isfinite(*value)) invalid(fmt::format("a coordinate is '{}'; it must be finite", word));
  }

 private:
  std::string file_, text_;
  std::ifstream in_;
  std::int64_t number_ = 0;
};

// --- OBJ

struct ObjFace {
  std::int64_t line = 0, highest = 0;  // largest vertex number that it names
};

// One corner of a face: v, v/vt, v//vn or v/vt/vn; v counts from 1, or backwards from the last vertex if negative.
std::int64_t obj_vertex(const Lines& lines, std::string_view corner, std::int64_t vertices_so_far) {
  const auto index = parse<std::int64_t>(corner.substr(0, corner.find('/')));
  if (!index) lines.malformed(fmt::format("'{}' is not a vertex number", corner));
  const std::int64_t vertex = *index < 0 ? vertices_so_far + 1 + *index : *index;
  if (vertex < 1) lines.invalid(fmt::format("the face names vertex {}, which does not exist", *index));
  return vertex;
}

// --- PLY

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  Words::size_type scalars = 0;  // properties that are one number
  bool list = false;             // has a list
  int x = -1, y = -1, z = -1;    // columns of the coordinates
};

struct PlyHeader {
  bool ascii = false;
  std::vector<PlyElement> elements;
};

void read_ply_property(const Lines& lines, const Words& words, PlyHeader& header) {
  if (header.elements.empty() || words.size() < 3) lines.malformed("a property without an element or a name");
  PlyElement& element = header.elements.back();
  if (words[1] == "list") {
    element.list = true;
    return;
  }
  const int column = int(element.scalars++);
  if (words[2] == "x") element.x = column;
  if (words[2] == "y") element.y = column;
  if (words[2] == "z") element.z = column;
}

PlyHeader read_ply_header(Lines& lines, const std::string& file) {
  if (!lines.next() || split(lines.text()) != Words{"ply"}) lines.malformed("a PLY file starts with the line 'ply'");
  PlyHeader header;
  while (lines.next()) {
    const Words words = split(lines.text());
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() >= 2) {
      header.ascii = words[1] == "ascii";
    } else if (words[0] == "element" && words.size() >= 3) {
      const auto count = parse<std::int64_t>(words[2]);
      // Every vertex and face takes more than one byte: a larger count is no count, and must not be allocated for.
      if (!count || *count < 0 || *count > std::int64_t(std::filesystem::file_size(file)))
        lines.malformed(fmt::format("'{}' elements cannot be in this file", words[2]));
      header.elements.push_back({std::string(words[1]), *count, 0, false, -1, -1, -1});
    } else if (words[0] == "property") {
      read_ply_property(lines, words, header);
    } else {
      lines.malformed(fmt::format("unknown header line '{}'; is the file cut off?", words[0]));
    }
  }
  lines.malformed("the header does not end; the file is cut off");
}

void scan_ply_vertex(const Lines& lines, const Words& words, const PlyElement& e) {
  if (words.size() < e.scalars) lines.malformed("the vertex is cut off");
  for (const int column : {e.x, e.y, e.z}) lines.require_coordinate(words[std::size_t(column)]);
}

void scan_ply_face(const Lines& lines, const Words& words, std::int64_t vertices) {
  const auto corners = words.empty() ? std::nullopt : parse<std::int64_t>(words[0]);
  if (!corners || *corners < 0 || std::int64_t(words.size()) < 1 + *corners) lines.malformed("the face is cut off");
  for (std::size_t k = 1; k <= std::size_t(*corners); ++k) {
    const auto vertex = parse<std::int64_t>(words[k]);
    if (!vertex) lines.malformed(fmt::format("'{}' is not a vertex number", words[k]));
    if (*vertex < 0 || *vertex >= vertices)
      lines.invalid(fmt::format("the face names vertex {}; vertices are 0 to {}", *vertex, vertices - 1));
  }
}

}  // namespace

void scan_obj(const std::string& file) {
  Lines lines(file);
  std::int64_t vertices = 0, number = 0;
  ObjFace worst;  // a face may come before its vertices: checked at the end
  while (lines.next()) {
    ++number;
    const Words words = split(lines.text());
    if (words.empty()) continue;
    if (words[0] == "v") {
      if (words.size() < 4) lines.malformed("the vertex is cut off");
      for (std::size_t k = 1; k <= 3; ++k) lines.require_coordinate(words[k]);
      ++vertices;
    } else if (words[0] == "f") {
      if (words.size() < 4) lines.malformed("the face has fewer than 3 corners; is the file cut off?");
      for (std::size_t k = 1; k < words.size(); ++k) {
        const std::int64_t vertex = obj_vertex(lines, words[k], vertices);
        if (vertex > worst.highest) worst = {number, vertex};
      }
    }
  }
  if (vertices == 0 || worst.highest == 0)
    throw IoFailure(fmt::format("terrain.mesh: '{}' holds no vertices or no faces", file));
  if (worst.highest > vertices)
    throw InvalidInput(fmt::format("terrain.mesh: {}:{}: the face names vertex {}; the file has {} vertices", file, worst.line,
                                   worst.highest, vertices));
}

void scan_ply(const std::string& file) {
  Lines lines(file);
  const PlyHeader header = read_ply_header(lines, file);
  std::int64_t vertices = 0, faces = 0;
  for (const PlyElement& e : header.elements) {
    if (e.name == "face") faces = e.count;
    if (e.name != "vertex") continue;
    vertices = e.count;
    if (e.x < 0 || e.y < 0 || e.z < 0) lines.malformed("the vertices have no x, y, z");
  }
  if (vertices == 0 || faces == 0) lines.malformed("the file holds no vertices or no faces");
  if (!header.ascii) return;
  for (const PlyElement& e : header.elements)
    for (std::int64_t k = 0; k < e.count; ++k) {
      if (!lines.next()) lines.malformed(fmt::format("the file ends after {} of {} elements '{}'", k, e.count, e.name));
      const Words words = split(lines.text());
      if (e.name == "vertex") scan_ply_vertex(lines, words, e);
      if (e.name == "face") scan_ply_face(lines, words, vertices);
    }
}

}  // namespace witherfield::terrain
