#include <fmt/format.h>

#include "sim/core/errors.hpp"
#include "sim/terrain/mesh_scan.hpp"
#include "sim/terrain/text_lines.hpp"

namespace witherfield::terrain {
namespace {

struct WorstFace {
  std::int64_t line = 0, highest = 0;  // largest vertex number named so far, and where
};

// One corner of a face: v, v/vt, v//vn or v/vt/vn; v counts from 1, or backwards from the last vertex if
// negative.
std::int64_t vertex_of(const TextLines& lines, std::string_view corner, std::int64_t vertices_so_far) {
  const auto index = parse<std::int64_t>(corner.substr(0, corner.find('/')));
  if (!index) lines.malformed(fmt::format("'{}' is not a vertex number", corner));
  const std::int64_t vertex = *index < 0 ? vertices_so_far + 1 + *index : *index;
  if (vertex < 1) lines.invalid(fmt::format("the face names vertex {}, which does not exist", *index));
  return vertex;
}

void scan_face(const TextLines& lines, const Words& words, std::int64_t vertices_so_far, WorstFace& worst) {
  if (words.size() < 4) lines.malformed("the face has fewer than 3 corners; is the file cut off?");
  std::vector<std::int64_t> corners;
  for (std::size_t k = 1; k < words.size(); ++k) {
    corners.push_back(vertex_of(lines, words[k], vertices_so_far));
    if (corners.back() > worst.highest) worst = {lines.number(), corners.back()};
  }
  lines.require_distinct(std::move(corners));
}

}  // namespace

std::vector<glm::dvec3> scan_obj(const std::string& file) {
  TextLines lines(file);
  std::vector<glm::dvec3> vertices;
  WorstFace worst;  // a face may come before its vertices: checked at the end
  while (lines.next()) {
    const Words words = split(lines.text());
    if (words.empty()) continue;
    if (words[0] == "v") {
      if (words.size() < 4) lines.malformed("the vertex is cut off");
      vertices.emplace_back(lines.coordinate(words[1]), lines.coordinate(words[2]),
                            lines.coordinate(words[3]));
    } else if (words[0] == "f") {
      scan_face(lines, words, std::int64_t(vertices.size()), worst);
    }
  }
  if (vertices.empty() || worst.highest == 0)
    throw IoFailure(fmt::format("terrain.mesh: '{}' holds no vertices or no faces", file));
  if (worst.highest > std::int64_t(vertices.size()))
    throw InvalidInput(fmt::format("terrain.mesh: {}:{}: the face names vertex {}; the file has {} vertices",
                                   file, worst.line, worst.highest, vertices.size()));
  return vertices;
}

}  // namespace witherfield::terrain
