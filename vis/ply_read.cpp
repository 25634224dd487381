// PLY: vertices and faces; elements and properties that mean nothing to us are stepped over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/core/colour.hpp"
#include "sim/core/fields.hpp"
#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"
#include "vis/ply_format.hpp"
#include "vis/ply_source.hpp"

namespace witherfield::vis {
namespace {

/// Where the values of one property go: component `component` of values[target].
struct Slot {
  int target = -1;  ///< -1: nowhere
  int component = 0;
  double scale = 1;
};

enum Target { kPosition, kNormal, kUv, kColour, kFirstField };

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& file)
      : file_(file),
        content_(read_whole_file(file)),
        header_(parse_ply_header(file, content_)),
        source_(file, content_, header_) {}

  MeshFile read() {
    const auto has = [&](const char* name) {
      return std::any_of(header_.elements.begin(), header_.elements.end(),
                         [&](const PlyElement& e) { return e.name == name; });
    };
    if (!has("vertex") || !has("face")) fail_reading(file_, "the header lists no vertices or no faces");
    for (const PlyElement& e : header_.elements) {
      check_room(e);
      if (e.name == "vertex")
        read_vertices(e);
      else if (e.name == "face")
        read_faces(e);
      else
        skip(e);
    }
    for (const auto& [corner, face] : face_of_largest_)
      if (corner >= std::int64_t(surface_.position_m.size()))
        fail_reading(file_, fmt::format("face {}: vertex index {} is out of range, there are {}", face,
                                        corner, surface_.position_m.size()));
    mesh_.length_unit = header_.length_unit;
    return std::move(mesh_);
  }

 private:
  /// A damaged count must not ask for more memory than the file could fill.
  void check_room(const PlyElement& e) {
    std::size_t least = 0;  // a character and a blank, or the bytes of a value
    for (const PlyProperty& p : e.properties)
      least += header_.format == PlyHeader::Format::ascii ? 2 : ply_bytes(p.list ? p.count_type : p.type);
    if (e.count > std::numeric_limits<int>::max() || (e.count > 0 && least == 0) ||
        std::size_t(e.count) > (content_.size() - header_.bytes + 1) / std::max<std::size_t>(least, 1))
      fail_reading(
          file_,
          fmt::format("the header announces {} elements '{}', more than the file has room for: truncated",
                      e.count, printable(e.name)));
  }

  Slot slot_of_field(const std::string& name, bool on_faces) {
    for (const FieldSpec& f : all_fields()) {
      int component = 0;
      if (name != f.name) {  // name_x, name_y, name_z
        if (f.components == 1 || name.size() != f.name.size() + 2 || !name.starts_with(f.name) ||
            name[f.name.size()] != '_')
          continue;
        component = name.back() - 'x';
        if (component < 0 || component >= f.components) continue;
      } else if (f.components != 1) {
        continue;
      }
      surface_.make_field(f.name, on_faces);
      for (std::size_t k = 0; k < surface_.fields.size(); ++k)
        if (surface_.fields[k].name == f.name && surface_.fields[k].on_faces == on_faces)
          return {int(kFirstField + k), component, 1};
    }
    return {};
  }

  Slot vertex_slot(const PlyProperty& p) {
    static constexpr std::array<std::array<std::string_view, 3>, 6> kNames{{{"x", "y", "z"},
                                                                            {"nx", "ny", "nz"},
                                                                            {"u", "v", ""},
                                                                            {"s", "t", ""},
                                                                            {"texture_u", "texture_v", ""},
                                                                            {"red", "green", "blue"}}};
    static constexpr std::array<int, 6> kTargets{kPosition, kNormal, kUv, kUv, kUv, kColour};
    if (p.list) return {};
    for (std::size_t k = 0; k < kNames.size(); ++k)
      for (int c = 0; c < 3; ++c)
        if (p.name == kNames[k][std::size_t(c)]) {
          const double scale = p.type == PlyType::u8 ? 1 / 255.0 : p.type == PlyType::u16 ? 1 / 65535.0 : 1;
          seen_[std::size_t(kTargets[k])] |= 1u << c;
          return {kTargets[k], c, kTargets[k] == kColour ? scale : 1};
        }
    return slot_of_field(p.name, false);
  }

  void read_vertices(const PlyElement& e) {
    if (!surface_.position_m.empty()) fail_reading(file_, "the header lists vertices twice");
    surface_.position_m.resize(std::size_t(e.count));
    std::vector<Slot> slots;
    for (const PlyProperty& p : e.properties) slots.push_back(vertex_slot(p));
    if (seen_[kPosition] != 7) fail_reading(file_, "the vertices have no x, y and z");
    if (seen_[kNormal] == 7) surface_.normal.resize(std::size_t(e.count));
    if (seen_[kUv] == 3) surface_.uv.resize(std::size_t(e.count));
    const bool coloured = seen_[kColour] == 7 && !surface_.has_field("diffuse");
    SurfaceField* diffuse = coloured ? &surface_.make_field("diffuse") : nullptr;
    const double unit = header_.length_unit == "mm" ? 1e3 : 1;
    for (std::int64_t i = 0; i < e.count; ++i) {
      source_.begin_element("vertex", i);
      std::array<std::array<double, 3>, kFirstField> v{};
      for (std::size_t p = 0; p < slots.size(); ++p) {
        if (slots[p].target < 0) {
          skip(e.properties[p]);
          continue;
        }
        const double x = finite_value(e.properties[p]);
        if (slots[p].target < kFirstField)
          v[std::size_t(slots[p].target)][std::size_t(slots[p].component)] = x * slots[p].scale;
        else
          put(slots[p], i, x);
      }
      const auto at = std::size_t(i);
      surface_.position_m[at] = glm::dvec3(v[kPosition][0], v[kPosition][1], v[kPosition][2]) / unit;
      if (!surface_.normal.empty())
        surface_.normal[at] = unit_normal({v[kNormal][0], v[kNormal][1], v[kNormal][2]});
      if (!surface_.uv.empty()) surface_.uv[at] = {v[kUv][0], v[kUv][1]};
      for (std::size_t c = 0; diffuse && c < 3; ++c)
        diffuse->values[3 * at + c] = float(srgb_decode(std::clamp(v[kColour][c], 0.0, 1.0)));
    }
  }

  void put(const Slot& slot, std::int64_t item, double value) {
    SurfaceField& field = surface_.fields[std::size_t(slot.target - kFirstField)];
    field.values[std::size_t(item) * std::size_t(field_spec(field.name).components) +
                 std::size_t(slot.component)] = float(value);
  }

  void read_faces(const PlyElement& e) {
    std::vector<Slot> slots;
    std::vector<double> values(e.properties.size());
    bool has_corners = false;
    for (const PlyProperty& p : e.properties) {
      has_corners = has_corners || is_corners(p);
      slots.push_back(p.list || surface_.has_field(p.name) ? Slot{} : slot_of_field(p.name, true));
    }
    if (!has_corners) fail_reading(file_, "the faces have no list vertex_indices");
    surface_.triangles.reserve(std::size_t(e.count));
    for (std::int64_t i = 0; i < e.count; ++i) {
      source_.begin_element("face", i);
      for (std::size_t p = 0; p < slots.size(); ++p) {
        if (is_corners(e.properties[p]))
          read_corners(e.properties[p], i);
        else if (slots[p].target < 0)
          skip(e.properties[p]);
        else
          values[p] = finite_value(e.properties[p]);
      }
      const std::size_t first = surface_.triangles.size();
      add_fan(surface_, corners_);
      for (std::size_t p = 0; p < slots.size(); ++p) {
        if (slots[p].target < 0) continue;
        SurfaceField& field = surface_.fields[std::size_t(slots[p].target - kFirstField)];
        field.values.resize(surface_.triangles.size() * std::size_t(field_spec(field.name).components));
        for (std::size_t t = first; t < surface_.triangles.size(); ++t)
          put(slots[p], std::int64_t(t), values[p]);
      }
    }
  }

  static bool is_corners(const PlyProperty& p) {
    return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  void read_corners(const PlyProperty& p, std::int64_t face) {
    const double count = source_.value(p.count_type);
    if (!(count >= 3 && count <= 1e6))
      source_.fail(fmt::format("it has {} corners, it needs at least 3", count));
    corners_.clear();
    for (double k = 0; k < count; ++k) {
      const double x = source_.value(p.type);
      if (!(x >= 0 && x < std::numeric_limits<int>::max()) || x != std::floor(x))
        source_.fail(fmt::format("vertex index {} is out of range", x));
      corners_.push_back(int(x));
      // The vertices may stand after the faces: judged at the end.
      if (face_of_largest_.empty() || x > double(face_of_largest_.back().first))
        face_of_largest_.emplace_back(std::int64_t(x), face);
    }
  }

  double finite_value(const PlyProperty& p) {
    const double x = source_.value(p.type);
    if (!std::isfinite(x)) source_.fail(fmt::format("{} = {} is not finite", printable(p.name), x));
    return x;
  }

  void skip(const PlyProperty& p) {
    double values = 1;
    if (p.list) values = source_.value(p.count_type);
    for (double k = 0; k < values; ++k) source_.value(p.type);
  }
  void skip(const PlyElement& e) {
    for (std::int64_t i = 0; i < e.count; ++i) {
      source_.begin_element("element", i);
      for (const PlyProperty& p : e.properties) skip(p);
    }
  }

  std::filesystem::path file_;
  std::string content_;
  PlyHeader header_;
  PlySource source_;
  MeshFile mesh_;
  Surface& surface_ = mesh_.surface;
  std::array<unsigned, kFirstField> seen_{};
  std::vector<int> corners_;
  // Ascending corners and the face where each stood first: the first one out of range is among them.
  std::vector<std::pair<std::int64_t, std::int64_t>> face_of_largest_;
};

}  // namespace

MeshFile read_ply(const std::filesystem::path& file) {
  return PlyReader(file).read();
}

}  // namespace witherfield::vis
