// Wavefront OBJ: the polygonal part (v, vt, vn, f); other statements of the format are stepped over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vis/atomic_file.hpp"
#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"

namespace witherfield::vis {
namespace {

constexpr std::array<std::string_view, 35> kStatementsWithoutUse{
    "vp",     "l",      "p",     "o",          "g",         "s",     "mg",       "usemtl",  "mtllib",
    "usemap", "maplib", "lod",   "call",       "bevel",     "curv",  "curv2",    "surf",    "parm",
    "trim",   "hole",   "scrv",  "sp",         "end",       "con",   "deg",      "bmat",    "cstype",
    "step",   "csh",    "ctech", "shadow_obj", "trace_obj", "stech", "c_interp", "d_interp"};

/// What each vertex says through the corners of faces: kept while every vertex has a single value.
template <class Value>
class PerVertex {
 public:
  std::vector<Value> values;  ///< as listed in the file

  void use(int vertex, std::int64_t value) {
    if (value < 0 || !single_) {
      single_ = false;
      return;
    }
    const auto v = std::size_t(vertex);
    if (v >= of_vertex_.size()) of_vertex_.resize(std::max(v + 1, 2 * of_vertex_.size()), -1);
    if (of_vertex_[v] < 0)
      of_vertex_[v] = value;
    else if (of_vertex_[v] != value && values[std::size_t(of_vertex_[v])] != values[std::size_t(value)])
      single_ = false;
  }
  /// Empty when a vertex has several, or when there are none.
  std::vector<Value> of_vertices(std::size_t vertices) const {
    if (!single_ || values.empty()) return {};
    std::vector<Value> out(vertices, Value(0.0));
    for (std::size_t v = 0; v < std::min(vertices, of_vertex_.size()); ++v)
      if (of_vertex_[v] >= 0) out[v] = values[std::size_t(of_vertex_[v])];
    return out;
  }

 private:
  std::vector<std::int64_t> of_vertex_;
  bool single_ = true;
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, std::string_view text) : scan_(file, text), file_(file) {
    // The unit stands in the comments that open the file.
    while (text.starts_with('#')) {
      const auto end = text.find('\n');
      if (text.substr(0, end).find(kUnitComment) != std::string_view::npos) mesh_.length_unit = "mm";
      text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
  }

  MeshFile read() {
    while (scan_.next_line()) statement(scan_.word());
    for (const auto& [index, line] : forward_)
      if (index >= std::int64_t(surface_.position_m.size())) fail_range(index + 1, line);
    if (surface_.position_m.empty()) fail_reading(file_, "not an OBJ file: it holds no vertices");
    surface_.uv = uv_.of_vertices(surface_.position_m.size());
    surface_.normal = normal_.of_vertices(surface_.position_m.size());
    for (glm::dvec3& n : surface_.normal) n = unit_normal(n);
    return std::move(mesh_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "v") {
      const int shift = mesh_.length_unit == "mm" ? -3 : 0;
      surface_.position_m.push_back(vector("coordinate", shift));
    } else if (keyword == "vn") {
      normal_.values.push_back(vector("normal", 0));
    } else if (keyword == "vt") {
      const double u = scan_.number("texture coordinate");
      uv_.values.push_back({u, scan_.rest_of_line().find_first_not_of(" \t\r") == std::string_view::npos
                                   ? 0.0
                                   : scan_.number("texture coordinate")});
    } else if (keyword == "f") {
      face();
    } else if (std::find(kStatementsWithoutUse.begin(), kStatementsWithoutUse.end(), keyword) ==
               kStatementsWithoutUse.end()) {
      scan_.fail(fmt::format("'{}' is no statement of an OBJ file", printable(keyword)));
    }
  }

  glm::dvec3 vector(const char* what, int shift) {
    const double x = scan_.number(what, shift), y = scan_.number(what, shift), z = scan_.number(what, shift);
    return {x, y, z};
  }

  /// From the file's counting (1.. or, from the end, -1..) to ours; -1 for what is absent.
  std::int64_t index(std::string_view word, std::size_t count, const char* what) {
    if (word.empty()) return -1;
    std::int64_t i = 0;
    if (!parse_integer(word, i) || i == 0)
      scan_.fail(fmt::format("{} index '{}' must be a whole number, not 0", what, printable(word)));
    if (i < -std::int64_t(count))
      scan_.fail(fmt::format("{} index {} is out of range, there are {} so far", what, i, count));
    return i > 0 ? i - 1 : std::int64_t(count) + i;
  }

  void face() {
    corners_.clear();
    for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word()) {
      const auto slash = word.find('/');
      std::string_view second = slash == std::string_view::npos ? "" : word.substr(slash + 1), third;
      if (const auto s = second.find('/'); s != std::string_view::npos) {
        third = second.substr(s + 1);
        second = second.substr(0, s);
      }
      const std::size_t n = surface_.position_m.size();
      if (word.substr(0, slash).empty()) scan_.fail("a corner without a vertex index");
      const std::int64_t v = index(word.substr(0, slash), n, "vertex");
      if (v > std::numeric_limits<int>::max() - 1) fail_range(v + 1, scan_.line());
      if (v >= std::int64_t(n)) forward_.emplace_back(v, scan_.line());
      const std::int64_t vt = listed(second, uv_.values.size(), "texture"),
                         vn = listed(third, normal_.values.size(), "normal");
      corners_.push_back(int(v));
      const bool known = v < std::int64_t(n);
      uv_.use(known ? int(v) : 0, known ? vt : -1);
      normal_.use(known ? int(v) : 0, known ? vn : -1);
    }
    if (corners_.size() < 3)
      scan_.fail(fmt::format("a face has {} corners, it needs at least 3", corners_.size()));
    add_fan(surface_, corners_);
  }

  std::int64_t listed(std::string_view word, std::size_t count, const char* what) {
    const std::int64_t i = index(word, count, what);
    if (i >= std::int64_t(count))
      scan_.fail(fmt::format("{} index {} is out of range, there are {} so far", what, i + 1, count));
    return i;
  }

  [[noreturn]] void fail_range(std::int64_t index, std::int64_t line) {
    fail_reading(file_, fmt::format("line {}: vertex index {} is out of range, there are {}", line, index,
                                    surface_.position_m.size()));
  }

  TextScanner scan_;
  std::filesystem::path file_;
  MeshFile mesh_;
  Surface& surface_ = mesh_.surface;
  PerVertex<glm::dvec2> uv_;
  PerVertex<glm::dvec3> normal_;
  std::vector<int> corners_;
  std::vector<std::pair<std::int64_t, std::int64_t>> forward_;  // vertex named before it is listed, line
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  return ObjReader(file, text).read();
}

void write_obj(const std::filesystem::path& file, const Surface& surface) {
  surface.validate();
  const std::vector<glm::dvec3> normals = surface.normal.empty() ? vertex_normals(surface) : surface.normal;
  std::string text = "# witherfield\n# ";
  text.append(kUnitComment).append("\n");
  text.reserve(surface.position_m.size() * 120 + surface.triangles.size() * 40);
  for (const glm::dvec3& p : surface.position_m) {
    text += 'v';
    for (int c = 0; c < 3; ++c) append_number(text += ' ', p[c], 3);
    text += '\n';
  }
  for (const glm::dvec2& t : surface.uv) {
    append_number(text += "vt ", t.x);
    append_number(text += ' ', t.y);
    text += '\n';
  }
  for (const glm::dvec3& n : normals) {
    text += "vn";
    for (int c = 0; c < 3; ++c) append_number(text += ' ', float(n[c]));
    text += '\n';
  }
  for (const auto& t : surface.triangles) {
    text += 'f';
    for (const int v : t) {
      const std::string index = std::to_string(v + 1);
      text.append(" ").append(index).append("/");
      if (!surface.uv.empty()) text += index;
      text.append("/").append(index);
    }
    text += '\n';
  }
  write_whole_file(file, text);
}

}  // namespace witherfield::vis
