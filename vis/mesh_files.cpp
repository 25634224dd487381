#include "vis/mesh_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/errors.hpp"
#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"

namespace witherfield::vis {
namespace {

using Reader = MeshFile (*)(const std::filesystem::path&);

Reader reader_of(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (kind == ".obj") return read_obj;
  if (kind == ".ply") return read_ply;
  if (kind == ".off") return read_off;
  if (kind == ".stl") return read_stl;
  if (kind == ".vtp") return read_surface_vtp;
  fail_reading(file, "its name must end in .obj, .ply, .off, .stl or .vtp");
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& file) {
  MeshFile mesh = reader_of(file)(file);
  if (mesh.surface.triangles.empty()) fail_reading(file, "it holds no faces");
  const bool bad_normal = std::any_of(mesh.surface.normal.begin(), mesh.surface.normal.end(),
                                      [](const glm::dvec3& n) { return n == glm::dvec3(0.0); });
  if (bad_normal) mesh.surface.normal.clear();  // to be computed
  return mesh;
}

Surface read_mesh(const std::filesystem::path& file) {
  return read_mesh_file(file).surface;
}

}  // namespace witherfield::vis
