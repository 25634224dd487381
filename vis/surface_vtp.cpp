// Surface -> .vtp, and triangles of any .vtp -> Surface (through VTK's reader).
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/dataset.hpp"
#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {
namespace {

// Whole numbers that name things: kept exactly.
bool is_label(std::string_view field) {
  constexpr std::array<std::string_view, 8> kLabels{"tissue", "blade_id", "texel_id",  "rotation",
                                                    "lod",    "organ_id", "kernel_id", "sharpness"};
  return std::find(kLabels.begin(), kLabels.end(), field) != kLabels.end();
}

class Arrays {
 public:
  Arrays(XmlDocument& document, ValueRanges& ranges) : document_(document), ranges_(ranges) {}

  template <class T>
  void add(std::size_t section, const std::string& name, int components, const std::vector<T>& data) {
    const char* type = std::is_same_v<T, float> ? "Float32" : "Int32";
    document_.sections[section].arrays.push_back(
        {name, type, components, compress_bytes(std::as_bytes(std::span(data)), document_.compression)});
  }
  template <class T>
  void add_ranged(std::size_t section, const std::string& name, int components, const std::vector<T>& data) {
    add(section, name, components, data);
    ValueRange& range = ranges_[name];
    if (data.empty()) return;
    const auto [lo, hi] = std::minmax_element(data.begin(), data.end());
    range = {double(*lo), double(*hi)};
  }

 private:
  XmlDocument& document_;
  ValueRanges& ranges_;
};

void add_field(Arrays& arrays, const SurfaceField& f) {
  const std::size_t section = f.on_faces ? 1 : 0;
  const int components = field_spec(f.name).components;
  if (is_label(f.name)) {
    std::vector<std::int32_t> labels(f.values.size());
    std::transform(f.values.begin(), f.values.end(), labels.begin(),
                   [](float x) { return std::int32_t(std::lround(x)); });
    arrays.add_ranged(section, f.name, components, labels);
  } else {
    std::vector<float> values(f.values.size());
    std::transform(f.values.begin(), f.values.end(), values.begin(), round_mantissa);
    arrays.add_ranged(section, f.name, components, values);
  }
}

template <int N, class Vector>
std::vector<float> floats(const std::vector<Vector>& vectors, double scale) {
  std::vector<float> out;
  out.reserve(vectors.size() * N);
  for (const Vector& v : vectors)
    for (int c = 0; c < N; ++c) out.push_back(float(v[c] * scale));
  return out;
}

// ---- reading

void check_cells(const std::filesystem::path& file, vtkCellArray& cells, vtkIdType points) {
  vtkDataArray &offsets = *cells.GetOffsetsArray(), &corners = *cells.GetConnectivityArray();
  double before = 0;
  for (vtkIdType i = 0; i < offsets.GetNumberOfTuples(); ++i) {
    const double at = offsets.GetTuple1(i);
    if ((i == 0 && at != 0) || at < before || at > double(corners.GetNumberOfTuples()))
      fail_reading(file, fmt::format("offset {} of its cells is {}: damaged", i, at));
    before = at;
  }
  for (vtkIdType i = 0; i < corners.GetNumberOfTuples(); ++i)
    if (const double v = corners.GetTuple1(i); !(v >= 0 && v < double(points)))
      fail_reading(file, fmt::format("corner {} of its cells names point {}, there are {}", i, v, points));
}

/// Triangles of polygons and strips; `cell_of` gets the cell of each.
void add_cells(vtkCellArray& cells, bool strips, vtkIdType first_cell, Surface& surface,
               std::vector<vtkIdType>& cell_of) {
  vtkNew<vtkIdList> ids;
  std::vector<int> corners;
  for (vtkIdType c = 0; c < cells.GetNumberOfCells(); ++c) {
    cells.GetCellAtId(c, ids);
    corners.clear();
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) corners.push_back(int(ids->GetId(k)));
    if (!strips) add_fan(surface, corners);
    for (std::size_t k = 2; strips && k < corners.size(); ++k)
      surface.triangles.push_back(
          {corners[k - 2 + k % 2], corners[k - 1 - k % 2], corners[k]});  // every other one is turned
    cell_of.resize(surface.triangles.size(), first_cell + c);
  }
}

void read_positions(const std::filesystem::path& file, vtkPolyData& mesh, double per_metre,
                    Surface& surface) {
  surface.position_m.resize(std::size_t(mesh.GetNumberOfPoints()));
  for (std::size_t i = 0; i < surface.position_m.size(); ++i) {
    double p[3];
    mesh.GetPoint(vtkIdType(i), p);
    if (!std::isfinite(p[0] + p[1] + p[2]))
      fail_reading(file, fmt::format("point {} is ({}, {}, {}): not finite", i, p[0], p[1], p[2]));
    surface.position_m[i] = glm::dvec3(p[0], p[1], p[2]) / per_metre;
  }
}

vtkDataArray* array_of(vtkDataSetAttributes& attributes, vtkDataArray* active, const char* name,
                       int components) {
  vtkDataArray* array = attributes.GetArray(name) ? attributes.GetArray(name) : active;
  return array && array->GetNumberOfComponents() >= components ? array : nullptr;
}

void read_fields(vtkDataSetAttributes& attributes, bool on_faces, const std::vector<vtkIdType>& cell_of,
                 Surface& surface) {
  for (const FieldSpec& spec : all_fields()) {
    vtkDataArray* array = attributes.GetArray(std::string(spec.name).c_str());
    if (!array || array->GetNumberOfComponents() != spec.components || surface.has_field(spec.name)) continue;
    if (!on_faces && (spec.name == "normal" || spec.name == "uv")) continue;  // the surface's own
    SurfaceField& field = surface.make_field(spec.name, on_faces);
    const auto components = std::size_t(spec.components);
    for (std::size_t k = 0; k < field.values.size(); ++k) {
      const std::size_t item = k / components;
      field.values[k] =
          float(array->GetComponent(on_faces ? cell_of[item] : vtkIdType(item), int(k % components)));
    }
  }
}

std::vector<std::string> wanted_arrays() {
  std::vector<std::string> names{"Normals", "TCoords", "TextureCoordinates", "Texture Coordinates"};
  for (const FieldSpec& f : all_fields()) names.emplace_back(f.name);
  return names;
}

Dataset read_poly_data(const std::filesystem::path& file) {
  read_whole_file(file);  // absent, unreadable or empty: said in the same words as for the other kinds
  try {
    return read_dataset(file, wanted_arrays());
  } catch (const IoFailure& e) {
    throw InvalidInput(e.what());  // the file is there: its content is at fault
  }
}

}  // namespace

ValueRanges write_surface_vtp(const std::filesystem::path& file, const Surface& surface, const Stamp& stamp,
                              std::string_view length_unit, Compression compression) {
  surface.validate();
  if (length_unit != "mm" && length_unit != "m")
    throw InvalidInput(fmt::format("write_surface_vtp: length unit '{}' must be mm or m", length_unit));
  ValueRanges ranges;
  XmlDocument document;
  document.type = "PolyData";
  document.compression = compression;
  document.piece_attributes = fmt::format(
      R"( NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}")",
      surface.position_m.size(), surface.triangles.size());
  document.sections = {
      {"PointData", {}, surface.uv.empty() ? R"( Normals="normal")" : R"( Normals="normal" TCoords="uv")"},
      {"CellData", {}, ""},
      {"Points", {}, ""},
      {"Polys", {}, ""}};
  Arrays arrays(document, ranges);
  const std::vector<glm::dvec3> normals = surface.normal.empty() ? vertex_normals(surface) : surface.normal;
  std::vector<float> normal = floats<3>(normals, 1);
  std::transform(normal.begin(), normal.end(), normal.begin(), round_mantissa);
  arrays.add_ranged(0, "normal", 3, normal);
  if (!surface.uv.empty()) arrays.add_ranged(0, "uv", 2, floats<2>(surface.uv, 1));
  for (const SurfaceField& f : surface.fields)
    if (f.on_faces || (f.name != "normal" && f.name != "uv")) add_field(arrays, f);
  arrays.add(2, "Points", 3, floats<3>(surface.position_m, length_unit == "mm" ? 1e3 : 1.0));
  std::vector<std::int32_t> connectivity, offsets;
  connectivity.reserve(surface.triangles.size() * 3);
  for (const auto& t : surface.triangles) {
    connectivity.insert(connectivity.end(), t.begin(), t.end());
    offsets.push_back(std::int32_t(connectivity.size()));
  }
  arrays.add(3, "connectivity", 1, connectivity);
  arrays.add(3, "offsets", 1, offsets);
  add_stamp(document, stamp);
  add_units(document, std::string(length_unit));
  write_xml_document(file, document);
  return ranges;
}

MeshFile read_surface_vtp(const std::filesystem::path& file) {
  const Dataset dataset = read_poly_data(file);
  auto* mesh = vtkPolyData::SafeDownCast(dataset.data.get());
  if (!mesh) fail_reading(file, "it holds no polygons");
  if (mesh->GetNumberOfPoints() > std::numeric_limits<int>::max())
    fail_reading(file, fmt::format("{} points, at most 2147483647 fit", mesh->GetNumberOfPoints()));
  MeshFile out;
  if (dataset.length_unit == "mm" || dataset.length_unit == "m") out.length_unit = dataset.length_unit;
  Surface& s = out.surface;
  read_positions(file, *mesh, out.length_unit == "mm" ? 1e3 : 1.0, s);
  std::vector<vtkIdType> cell_of;
  const vtkIdType first = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  for (const bool strips : {false, true}) {
    vtkCellArray& cells = strips ? *mesh->GetStrips() : *mesh->GetPolys();
    check_cells(file, cells, mesh->GetNumberOfPoints());
    add_cells(cells, strips, first + (strips ? mesh->GetNumberOfPolys() : 0), s, cell_of);
  }
  vtkPointData& points = *mesh->GetPointData();
  if (vtkDataArray* n = array_of(points, points.GetNormals(), "normal", 3))
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
      s.normal.push_back(unit_normal({n->GetComponent(i, 0), n->GetComponent(i, 1), n->GetComponent(i, 2)}));
  if (vtkDataArray* t = array_of(points, points.GetTCoords(), "uv", 2))
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
      s.uv.push_back({t->GetComponent(i, 0), t->GetComponent(i, 1)});
  read_fields(points, false, cell_of, s);
  read_fields(*mesh->GetCellData(), true, cell_of, s);
  return out;
}

}  // namespace witherfield::vis
