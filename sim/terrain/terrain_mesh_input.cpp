#include "sim/terrain/terrain_mesh_input.hpp"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/terrain/mesh_scan.hpp"

namespace witherfield::terrain {
namespace {

// OpenMesh reports on global streams. While this lives they are silent, and what they would have said is
// kept.
class OpenMeshMessages {
 public:
  // The buffer is swapped instead of OpenMesh's connect() and disconnect(), which lose memory at each call.
  OpenMeshMessages() : lock_(mutex()), previous_(::omerr().rdbuf(text_.rdbuf())) {}
  ~OpenMeshMessages() { ::omerr().rdbuf(previous_); }
  OpenMeshMessages(const OpenMeshMessages&) = delete;
  OpenMeshMessages& operator=(const OpenMeshMessages&) = delete;
  std::string first_line() const {
    const std::string all = text_.str();
    return all.substr(0, all.find('\n'));
  }

 private:
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  std::lock_guard<std::mutex> lock_;
  std::ostringstream text_;
  std::streambuf* previous_;
};

void require_finite(const TriMesh& mesh, const std::string& file) {
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw InvalidInput(fmt::format("terrain.mesh: vertex {} of '{}' (from 0) is not finite: ({}, {}, {})",
                                     v.idx(), file, p[0], p[1], p[2]));
  }
}

void require_manifold(const TriMesh& mesh, const std::string& file) {
  // The reader gives a face that does not fit (a third face at an edge, or a face turned against its
  // neighbour) vertices of its own.
  std::size_t misfits = 0;
  int first = -1;
  for (const auto f : mesh.faces())
    if (mesh.status(f).fixed_nonmanifold() && misfits++ == 0) first = f.idx();
  if (misfits)
    throw InvalidInput(
        fmt::format("terrain.mesh: '{}' is not manifold: {} face{} (the first is {}, from 0) meet an edge "
                    "that already has "
                    "two faces or are turned against their neighbour",
                    file, misfits, misfits == 1 ? "" : "s", first));
}

}  // namespace

TriMesh read_terrain_mesh(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw IoFailure(fmt::format("terrain.mesh: file '{}' does not exist", file));
  if (std::filesystem::is_directory(file, ignored))
    throw IoFailure(fmt::format("terrain.mesh: '{}' is a folder, not a file", file));
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension != ".obj" && extension != ".ply")
    throw InvalidInput(fmt::format("terrain.mesh: '{}' is neither .obj nor .ply", file));
  const std::vector<glm::dvec3> vertices = extension == ".obj" ? scan_obj(file) : scan_ply(file);

  const OpenMeshMessages messages;
  TriMesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, file) || mesh.n_faces() == 0)
    throw IoFailure(fmt::format("terrain.mesh: cannot read '{}': {}", file, messages.first_line()));
  require_manifold(mesh, file);
  const std::string warning = messages.first_line();
  if (!warning.empty())
    throw InvalidInput(fmt::format("terrain.mesh: '{}' has faces that cannot be used: {}", file, warning));
  for (std::size_t k = 0; k < vertices.size(); ++k)
    mesh.set_point(mesh.vertex_handle(unsigned(k)), {vertices[k].x, vertices[k].y, vertices[k].z});
  require_finite(mesh, file);
  return mesh;
}

}  // namespace witherfield::terrain
