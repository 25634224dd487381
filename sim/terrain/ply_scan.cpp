#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "sim/core/errors.hpp"
#include "sim/terrain/mesh_scan.hpp"
#include "sim/terrain/text_lines.hpp"

namespace witherfield::terrain {
namespace {

struct Property {
  std::string name, type;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> scalars;  // properties that are one number
  bool list = false;              // has a list
  int column(std::string_view property) const {
    for (std::size_t k = 0; k < scalars.size(); ++k)
      if (scalars[k].name == property) return int(k);
    return -1;
  }
};

struct Header {
  std::string format;
  std::vector<Element> elements;
  const Element* find(std::string_view name) const {
    for (const Element& e : elements)
      if (e.name == name) return &e;
    return nullptr;
  }
};

void read_property(const TextLines& lines, const Words& words, Header& header) {
  if (header.elements.empty() || words.size() < 3) lines.malformed("a property without an element or a name");
  if (words[1] == "list")
    header.elements.back().list = true;
  else
    header.elements.back().scalars.push_back({std::string(words[2]), std::string(words[1])});
}

void read_element(const TextLines& lines, const Words& words, const std::string& file, Header& header) {
  const auto count = parse<std::int64_t>(words[2]);
  // Every vertex and face takes more than one byte: a larger count is no count, and must not be allocated
  // for.
  if (!count || *count < 0 || *count > std::int64_t(std::filesystem::file_size(file)))
    lines.malformed(fmt::format("'{}' elements cannot be in this file", words[2]));
  header.elements.push_back({std::string(words[1]), *count, {}, false});
}

Header read_header(TextLines& lines, const std::string& file) {
  if (!lines.next() || split(lines.text()) != Words{"ply"})
    lines.malformed("a PLY file starts with the line 'ply'");
  Header header;
  while (lines.next()) {
    const Words words = split(lines.text());
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() >= 2)
      header.format = words[1];
    else if (words[0] == "element" && words.size() >= 3)
      read_element(lines, words, file, header);
    else if (words[0] == "property")
      read_property(lines, words, header);
    else
      lines.malformed(fmt::format("unknown header line '{}'; is the file cut off?", words[0]));
  }
  lines.malformed("the header does not end; the file is cut off");
}

// --- text

void scan_face(const TextLines& lines, const Words& words, std::int64_t vertices) {
  const auto corners = words.empty() ? std::nullopt : parse<std::int64_t>(words[0]);
  if (!corners || *corners < 0 || std::int64_t(words.size()) < 1 + *corners)
    lines.malformed("the face is cut off");
  std::vector<std::int64_t> named;
  for (std::size_t k = 1; k <= std::size_t(*corners); ++k) {
    const auto vertex = parse<std::int64_t>(words[k]);
    if (!vertex) lines.malformed(fmt::format("'{}' is not a vertex number", words[k]));
    if (*vertex < 0 || *vertex >= vertices)
      lines.invalid(fmt::format("the face names vertex {}; vertices are 0 to {}", *vertex, vertices - 1));
    named.push_back(*vertex);
  }
  lines.require_distinct(std::move(named));
}

std::vector<glm::dvec3> scan_text(TextLines& lines, const Header& header, const std::array<int, 3>& xyz) {
  std::vector<glm::dvec3> vertices;
  for (const Element& e : header.elements)
    for (std::int64_t k = 0; k < e.count; ++k) {
      if (!lines.next())
        lines.malformed(fmt::format("the file ends after {} of {} elements '{}'", k, e.count, e.name));
      const Words words = split(lines.text());
      if (e.name == "vertex") {
        if (words.size() < e.scalars.size()) lines.malformed("the vertex is cut off");
        glm::dvec3 p;
        for (int c = 0; c < 3; ++c) p[c] = lines.coordinate(words[std::size_t(xyz[std::size_t(c)])]);
        vertices.push_back(p);
      } else if (e.name == "face") {
        scan_face(lines, words, header.find("vertex")->count);
      }
    }
  return vertices;
}

// --- binary

std::size_t bytes_of(std::string_view type) {
  for (const char* name : {"char", "uchar", "int8", "uint8"})
    if (type == name) return 1;
  for (const char* name : {"short", "ushort", "int16", "uint16"})
    if (type == name) return 2;
  return type == "double" || type == "float64" ? 8 : 4;
}

template <class Number>
double number_at(std::array<char, 8> bytes, bool swap) {
  if (swap) std::reverse(bytes.begin(), bytes.begin() + sizeof(Number));
  Number value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return double(value);
}

// Vertices of a binary file; none when they are not plain floats or doubles at its start (then OpenMesh's
// values stand).
std::vector<glm::dvec3> binary_vertices(TextLines& lines, const Header& header,
                                        const std::array<int, 3>& xyz) {
  const Element& e = header.elements.front();
  if (e.name != "vertex" || e.list) return {};
  std::vector<std::size_t> offset{0};
  for (const Property& p : e.scalars) offset.push_back(offset.back() + bytes_of(p.type));
  std::vector<char> record(offset.back());
  const bool swap = (header.format == "binary_big_endian") != (std::endian::native == std::endian::big);
  std::vector<glm::dvec3> vertices;
  for (std::int64_t k = 0; k < e.count; ++k) {
    if (!lines.stream().read(record.data(), std::streamsize(record.size())))
      lines.malformed(fmt::format("the file ends after {} of {} vertices", k, e.count));
    glm::dvec3 p;
    for (int c = 0; c < 3; ++c) {
      const std::size_t column = std::size_t(xyz[std::size_t(c)]);
      const std::string& type = e.scalars[column].type;
      std::array<char, 8> bytes{};
      std::copy_n(record.data() + offset[column], offset[column + 1] - offset[column], bytes.begin());
      if (type == "double" || type == "float64")
        p[c] = number_at<double>(bytes, swap);
      else if (type == "float" || type == "float32")
        p[c] = number_at<float>(bytes, swap);
      else
        return {};
      if (!std::isfinite(p[c])) lines.invalid(fmt::format("vertex {} (from 0) is not finite", k));
    }
    vertices.push_back(p);
  }
  return vertices;
}

}  // namespace

std::vector<glm::dvec3> scan_ply(const std::string& file) {
  TextLines lines(file);
  const Header header = read_header(lines, file);
  const Element *vertex = header.find("vertex"), *face = header.find("face");
  if (!vertex || !face || vertex->count == 0 || face->count == 0)
    lines.malformed("the file holds no vertices or no faces");
  const std::array<int, 3> xyz{vertex->column("x"), vertex->column("y"), vertex->column("z")};
  if (std::min({xyz[0], xyz[1], xyz[2]}) < 0) lines.malformed("the vertices have no x, y, z");
  return header.format == "ascii" ? scan_text(lines, header, xyz) : binary_vertices(lines, header, xyz);
}

}  // namespace witherfield::terrain
