// PointSet -> .vtp: one vertex cell per point, millimetres.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

class PointArrays {
 public:
  PointArrays(std::size_t count, Compression compression) : count_(count), compression_(compression) {}

  /// value(i) is a float (or something that converts).
  template <class Value>
  void scalar(const std::string& name, Value&& value) {
    std::vector<float> data(count_);
    parallel_for(count_, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) data[i] = round_mantissa(static_cast<float>(value(i)));
    });
    add(name, "Float32", 1, data);
  }

  void vector(const std::string& name, const std::vector<glm::vec3>& values) {
    std::vector<float> data(count_ * 3);
    parallel_for(count_, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (int c = 0; c < 3; ++c) data[3 * i + std::size_t(c)] = round_mantissa(values[i][c]);
    });
    add(name, "Float32", 3, data);
  }

  /// Integers keep their type and every digit.
  template <class Integer>
  void label(const std::string& name, const char* type, const std::vector<Integer>& values) {
    add(name, type, 1, values);
  }

  XmlSection section{"PointData", {}};
  ValueRanges ranges;

 private:
  template <class T>
  void add(const std::string& name, const char* type, int components, const std::vector<T>& data) {
    section.arrays.push_back(
        {name, type, components, compress_bytes(std::as_bytes(std::span(data)), compression_)});
    ValueRange& range = ranges[name];
    if (data.empty()) return;
    const auto [lo, hi] = std::minmax_element(data.begin(), data.end());
    range = {double(*lo), double(*hi)};
  }

  std::size_t count_;
  Compression compression_;
};

void check_sizes(const PointSet& p) {
  const std::size_t n = p.size();
  for (const std::size_t size :
       {p.velocity_m_s.size(), p.mass_kg.size(), p.normal.size(), p.tangent.size(), p.blade_id.size(),
        p.tissue.size(), p.water.size(), p.chlorophyll_ug_cm2.size(), p.stress_vein_MPa.size(),
        p.stress_mesophyll_MPa.size(), p.strain_shrink.size(), p.specular.size(), p.diffuse.size()})
    if (size != n)
      throw InvalidInput(fmt::format("write_points_vtp: a field has {} values for {} points", size, n));
  if (n > std::size_t(std::numeric_limits<std::int32_t>::max()))
    throw InvalidInput(fmt::format("write_points_vtp: {} points, at most 2147483647 fit", n));
}

XmlSection positions_mm(const PointSet& points, Compression compression) {
  std::vector<float> data(points.size() * 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c)
      data[3 * i + std::size_t(c)] = static_cast<float>(points.position_m[i][c] * 1e3);
  return {"Points", {{"Points", "Float32", 3, compress_bytes(std::as_bytes(std::span(data)), compression)}}};
}

XmlSection vertices(std::size_t count, Compression compression) {
  std::vector<std::int32_t> connectivity(count), offsets(count);
  for (std::size_t i = 0; i < count; ++i) {
    connectivity[i] = static_cast<std::int32_t>(i);
    offsets[i] = static_cast<std::int32_t>(i + 1);
  }
  return {"Verts",
          {{"connectivity", "Int32", 1, compress_bytes(std::as_bytes(std::span(connectivity)), compression)},
           {"offsets", "Int32", 1, compress_bytes(std::as_bytes(std::span(offsets)), compression)}}};
}

}  // namespace

ValueRanges write_points_vtp(const std::filesystem::path& file, const PointSet& points, const Stamp& stamp,
                             Compression compression) {
  check_sizes(points);
  PointArrays arrays(points.size(), compression);
  // What the point stands for: its weight over the points per unit of density.
  const double per_density = points.point_mass_kg * points.proportion;
  arrays.scalar("density",
                [&](std::size_t i) { return per_density > 0 ? points.mass_kg[i] / per_density : 0.0; });
  arrays.scalar("water", [&](std::size_t i) { return points.water[i]; });
  arrays.scalar("chlorophyll_ug_cm2", [&](std::size_t i) { return points.chlorophyll_ug_cm2[i]; });
  arrays.scalar("stress_vein_MPa", [&](std::size_t i) { return points.stress_vein_MPa[i]; });
  arrays.scalar("stress_mesophyll_MPa", [&](std::size_t i) { return points.stress_mesophyll_MPa[i]; });
  arrays.scalar("strain_shrink", [&](std::size_t i) { return points.strain_shrink[i]; });
  arrays.label("tissue", "UInt8", points.tissue);
  arrays.label("blade_id", "Int32", points.blade_id);
  arrays.vector("normal", points.normal);
  arrays.vector("tangent", points.tangent);
  arrays.vector("diffuse", points.diffuse);
  arrays.scalar("specular", [&](std::size_t i) { return points.specular[i]; });
  arrays.scalar("mass_kg", [&](std::size_t i) { return points.mass_kg[i]; });
  arrays.vector("velocity_m_s", points.velocity_m_s);
  arrays.scalar("radius_m", [&](std::size_t) { return points.radius_m; });

  XmlDocument document;
  document.type = "PolyData";
  document.piece_attributes = fmt::format(
      R"( NumberOfPoints="{0}" NumberOfVerts="{0}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0")",
      points.size());
  document.compression = compression;
  document.sections.push_back(std::move(arrays.section));
  document.sections.push_back(positions_mm(points, compression));
  document.sections.push_back(vertices(points.size(), compression));
  add_stamp(document, stamp);
  add_units(document, "mm");
  write_xml_document(file, document);
  return std::move(arrays.ranges);
}

}  // namespace witherfield::vis
