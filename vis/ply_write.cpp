// Surface -> binary little-endian PLY.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "sim/core/colour.hpp"
#include "sim/core/fields.hpp"
#include "vis/atomic_file.hpp"
#include "vis/mesh_readers.hpp"

namespace witherfield::vis {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are declared little-endian");

template <class T>
void append(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

std::string field_properties(const Surface& surface, bool on_faces) {
  std::string text;
  for (const SurfaceField& f : surface.fields) {
    const int components = field_spec(f.name).components;
    if (f.on_faces != on_faces) continue;
    if (components == 1) text += fmt::format("property float {}\n", f.name);
    for (int c = 0; components > 1 && c < components; ++c)
      text += fmt::format("property float {}_{}\n", f.name, "xyz"[c]);
  }
  return text;
}

std::string header(const Surface& surface, bool coloured) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment witherfield\ncomment {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n",
      kUnitComment, surface.position_m.size());
  if (!surface.uv.empty()) text += "property float u\nproperty float v\n";
  if (coloured) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += field_properties(surface, false);
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", surface.triangles.size());
  return text + field_properties(surface, true) + "end_header\n";
}

void append_fields(std::string& bytes, const Surface& surface, bool on_faces, std::size_t item) {
  for (const SurfaceField& f : surface.fields) {
    const auto components = std::size_t(field_spec(f.name).components);
    for (std::size_t c = 0; f.on_faces == on_faces && c < components; ++c)
      append(bytes, f.values[item * components + c]);
  }
}

}  // namespace

void write_ply(const std::filesystem::path& file, const Surface& surface) {
  surface.validate();
  const std::vector<glm::dvec3> normals = surface.normal.empty() ? vertex_normals(surface) : surface.normal;
  const bool coloured = surface.has_field("diffuse") && !surface.field("diffuse").on_faces;
  const float* diffuse = coloured ? surface.field("diffuse").values.data() : nullptr;
  std::string bytes = header(surface, coloured);
  bytes.reserve(bytes.size() + surface.position_m.size() * (40 + 8 * surface.fields.size()) +
                surface.triangles.size() * 13);
  for (std::size_t i = 0; i < surface.position_m.size(); ++i) {
    for (int c = 0; c < 3; ++c) append(bytes, float(surface.position_m[i][c] * 1e3));
    for (int c = 0; c < 3; ++c) append(bytes, float(normals[i][c]));
    if (!surface.uv.empty())
      for (int c = 0; c < 2; ++c) append(bytes, float(surface.uv[i][c]));
    if (coloured) {
      const glm::dvec3 levels = srgb_levels({diffuse[3 * i], diffuse[3 * i + 1], diffuse[3 * i + 2]});
      for (int c = 0; c < 3; ++c) append(bytes, static_cast<unsigned char>(std::lround(levels[c])));
    }
    append_fields(bytes, surface, false, i);
  }
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    append(bytes, static_cast<unsigned char>(3));
    for (const int v : surface.triangles[f]) append(bytes, std::int32_t(v));
    append_fields(bytes, surface, true, f);
  }
  write_whole_file(file, bytes);
}

}  // namespace witherfield::vis
