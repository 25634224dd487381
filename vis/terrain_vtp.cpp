// Terrain triangles -> .vtp, metres, with the texel instance of each triangle.
#include <fmt/format.h>

#include <cmath>

#include "sim/core/errors.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

template <class T>
XmlArray array(const char* name, const char* type, int components, const std::vector<T>& data) {
  return {name, type, components, compress_bytes(std::as_bytes(std::span(data)), Compression::lz4)};
}

/// The instance in whose cell the point lies, or null outside the placement.
const TexelInstance* instance_at(const Placement& placement, double x_m, double y_m) {
  if (placement.instances.empty() || !(placement.tile_m > 0)) return nullptr;
  const TexelInstance& first = placement.instances.front();
  const double i = std::floor((x_m - first.origin_m.x) / placement.tile_m) + first.cell_i;
  const double j = std::floor((y_m - first.origin_m.y) / placement.tile_m) + first.cell_j;
  if (!(i >= 0 && j >= 0 && i < placement.cells_x && j < placement.cells_y)) return nullptr;
  const auto index =
      static_cast<std::size_t>(j) * static_cast<std::size_t>(placement.cells_x) + static_cast<std::size_t>(i);
  return index < placement.instances.size() ? &placement.instances[index] : nullptr;
}

struct CellData {
  std::vector<std::int32_t> texel_id, rotation, lod;
};

CellData cell_data(const TriMesh& mesh, const Placement& placement) {
  CellData cells;
  for (const auto face : mesh.faces()) {
    const TriMesh::Point c = mesh.calc_face_centroid(face);
    const TexelInstance* t = instance_at(placement, c[0], c[1]);
    cells.texel_id.push_back(t ? t->variant : -1);
    cells.rotation.push_back(!t ? 0 : t->mirrored ? -1 - t->quarter_turns : t->quarter_turns);
    cells.lod.push_back(t ? t->lod : -1);
  }
  return cells;
}

}  // namespace

void write_terrain_vtp(const std::filesystem::path& file, const TriMesh& mesh,
                       const std::vector<double>& true_elevation_m, const Placement& placement) {
  if (true_elevation_m.size() != mesh.n_vertices())
    throw InvalidInput(fmt::format("write_terrain_vtp: {} elevations for {} vertices",
                                   true_elevation_m.size(), mesh.n_vertices()));
  std::vector<float> positions;
  for (const auto v : mesh.vertices())
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(mesh.point(v)[c]));
  std::vector<std::int32_t> connectivity, offsets;
  for (const auto face : mesh.faces()) {
    for (const auto v : mesh.fv_range(face)) connectivity.push_back(v.idx());
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  const std::vector<float> elevation(true_elevation_m.begin(), true_elevation_m.end());
  const CellData cells = cell_data(mesh, placement);

  XmlDocument document;
  document.type = "PolyData";
  document.piece_attributes = fmt::format(
      R"( NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}")",
      mesh.n_vertices(), mesh.n_faces());
  document.sections.push_back({"PointData", {}});
  document.sections.back().arrays.push_back(array("elevation_m", "Float32", 1, elevation));
  document.sections.push_back({"CellData", {}});
  document.sections.back().arrays.push_back(array("texel_id", "Int32", 1, cells.texel_id));
  document.sections.back().arrays.push_back(array("rotation", "Int32", 1, cells.rotation));
  document.sections.back().arrays.push_back(array("lod", "Int32", 1, cells.lod));
  document.sections.push_back({"Points", {}});
  document.sections.back().arrays.push_back(array("Points", "Float32", 3, positions));
  document.sections.push_back({"Polys", {}});
  document.sections.back().arrays.push_back(array("connectivity", "Int32", 1, connectivity));
  document.sections.back().arrays.push_back(array("offsets", "Int32", 1, offsets));
  add_units(document, "m");
  write_xml_document(file, document);
}

}  // namespace witherfield::vis
