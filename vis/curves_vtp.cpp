// Points and curves -> .vtp: vertices and polylines.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "sim/core/errors.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

template <class T>
XmlArray array_of(std::string name, int components, const std::vector<T>& data, Compression compression) {
  const char* type = std::is_same_v<T, float> ? "Float32" : "Int32";
  return {std::move(name), type, components, compress_bytes(std::as_bytes(std::span(data)), compression)};
}

}  // namespace

void write_curves_vtp(const std::filesystem::path& file, const std::vector<glm::dvec3>& points_m,
                      const std::vector<std::vector<int>>& curves, const Stamp& stamp,
                      Compression compression) {
  std::vector<float> place;
  for (const glm::dvec3& p : points_m)
    for (int c = 0; c < 3; ++c) place.push_back(float(1e3 * p[c]));
  std::vector<std::int32_t> vertex(points_m.size()), vertex_end(points_m.size()), corner, corner_end;
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(vertex_end.begin(), vertex_end.end(), 1);
  for (const std::vector<int>& curve : curves) {
    for (const int v : curve) {
      if (v < 0 || std::size_t(v) >= points_m.size())
        throw InvalidInput(fmt::format("write_curves_vtp: point {} of {} points", v, points_m.size()));
      corner.push_back(v);
    }
    corner_end.push_back(std::int32_t(corner.size()));
  }
  XmlDocument document;
  document.type = "PolyData";
  document.compression = compression;
  document.piece_attributes = fmt::format(
      R"( NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="0")",
      points_m.size(), vertex.size(), curves.size());
  document.sections = {{"Points", {array_of("Points", 3, place, compression)}},
                       {"Verts",
                        {array_of("connectivity", 1, vertex, compression),
                         array_of("offsets", 1, vertex_end, compression)}},
                       {"Lines",
                        {array_of("connectivity", 1, corner, compression),
                         array_of("offsets", 1, corner_end, compression)}}};
  add_stamp(document, stamp);
  add_units(document, "mm");
  write_xml_document(file, document);
}

}  // namespace witherfield::vis
