// PointTable -> .vtp (vertices, or lines) and .csv.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/atomic_file.hpp"
#include "vis/table.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

void check(const PointTable& t) {
  if (t.position_m.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
    throw InvalidInput(fmt::format("a point table of {} points; at most 2147483647 fit", t.position_m.size()));
  for (const PointTable::Column& c : t.columns)
    if (field_spec(c.name).components != 1 || c.values.size() != t.position_m.size())
      throw InvalidInput(fmt::format("point table: column '{}' has {} values for {} points", c.name,
                                     c.values.size(), t.position_m.size()));
  if (!std::is_sorted(t.line_ends.begin(), t.line_ends.end()) ||
      (!t.line_ends.empty() && t.line_ends.back() != t.position_m.size()))
    throw InvalidInput("point table: line_ends must ascend to the number of points");
}

template <class T>
XmlArray array_of(const std::string& name, const char* type, const std::vector<double>& values, int components,
                  Compression compression) {
  std::vector<T> data(values.size());
  std::transform(values.begin(), values.end(), data.begin(), [](double v) { return T(v); });
  return {name, type, components, compress_bytes(std::as_bytes(std::span(data)), compression)};
}

XmlArray column_array(const PointTable::Column& c, Compression compression) {
  switch (c.digits) {
    case PointTable::Digits::full:
      return array_of<double>(c.name, "Float64", c.values, 1, compression);
    case PointTable::Digits::whole:
      return array_of<std::int32_t>(c.name, "Int32", c.values, 1, compression);
    case PointTable::Digits::single:
      break;
  }
  return array_of<float>(c.name, "Float32", c.values, 1, compression);
}

/// Vertices, one a point; or the lines.
XmlSection cells(const PointTable& t, Compression compression) {
  const bool lines = !t.line_ends.empty();
  std::vector<std::int32_t> connectivity(t.position_m.size()), offsets(lines ? t.line_ends.size() : connectivity.size());
  for (std::size_t i = 0; i < connectivity.size(); ++i) connectivity[i] = std::int32_t(i);
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = std::int32_t(lines ? t.line_ends[i] : i + 1);
  return {lines ? "Lines" : "Verts",
          {{"connectivity", "Int32", 1, compress_bytes(std::as_bytes(std::span(connectivity)), compression)},
           {"offsets", "Int32", 1, compress_bytes(std::as_bytes(std::span(offsets)), compression)}}};
}

}  // namespace

void write_table_vtp(const std::filesystem::path& file, const PointTable& table, Compression compression) {
  check(table);
  XmlDocument document;
  document.type = "PolyData";
  const bool lines = !table.line_ends.empty();
  document.piece_attributes = fmt::format(
      R"( NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfStrips="0" NumberOfPolys="0")",
      table.position_m.size(), lines ? 0 : table.position_m.size(), table.line_ends.size());
  document.compression = compression;
  document.sections.push_back({"PointData", {}});
  for (const PointTable::Column& c : table.columns)
    document.sections.back().arrays.push_back(column_array(c, compression));
  std::vector<double> xyz;
  xyz.reserve(3 * table.position_m.size());
  for (const glm::dvec3& p : table.position_m) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  document.sections.push_back({"Points", {array_of<float>("Points", "Float32", xyz, 3, compression)}});
  document.sections.push_back(cells(table, compression));
  add_units(document, "m");
  write_xml_document(file, document);
}

void write_table_csv(const std::filesystem::path& file, const PointTable& table) {
  check(table);
  AtomicFile out(file);
  std::string text = "x_m,y_m,z_m";
  for (const PointTable::Column& c : table.columns) text += "," + c.name;
  text += "\n";
  for (std::size_t i = 0; i < table.position_m.size(); ++i) {
    const glm::dvec3& p = table.position_m[i];
    text += fmt::format("{:.6g},{:.6g},{:.6g}", p.x, p.y, p.z);
    for (const PointTable::Column& c : table.columns)
      text += c.digits == PointTable::Digits::single ? fmt::format(",{:.7g}", c.values[i])
                                                     : fmt::format(",{:.15g}", c.values[i]);
    text += "\n";
    if (text.size() > 1 << 20) out.write(text), text.clear();
  }
  out.write(text);
  out.commit();
}

}  // namespace witherfield::vis
