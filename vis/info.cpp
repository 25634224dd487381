#include "vis/info.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/dataset.hpp"
#include "vis/vtk_messages.hpp"

namespace witherfield::vis {
namespace {

std::string unit_of(const Dataset& data, const std::string& name) {
  if (const auto at = data.units.find(name); at != data.units.end()) return at->second;
  for (const FieldSpec& f : all_fields())
    if (f.name == name) return std::string(f.unit);
  return "";
}

/// Calls `visit` with every value of the tuples where density > 0 (all tuples without a density).
template <class Visit>
void for_values(vtkDataArray& array, vtkDataArray* density, Visit&& visit) {
  const auto components = static_cast<std::size_t>(array.GetNumberOfComponents());
  const auto tuples = static_cast<std::size_t>(array.GetNumberOfTuples());
  auto *floats = vtkFloatArray::FastDownCast(&array), *mask = vtkFloatArray::FastDownCast(density);
  for (std::size_t i = 0; i < tuples; ++i) {
    const auto tuple = static_cast<vtkIdType>(i);
    if (density && !((mask ? mask->GetPointer(0)[i] : density->GetComponent(tuple, 0)) > 0)) continue;
    for (std::size_t c = 0; c < components; ++c)
      visit(floats ? double(floats->GetPointer(0)[i * components + c])
                   : array.GetComponent(tuple, static_cast<int>(c)));
  }
}

/// Range over all components; of an image's arrays only where density > 0 (the rest is air), if there is a
/// density.
ArrayInfo array_info(vtkDataArray& array, vtkDataArray* density) {
  ArrayInfo info{array.GetName(), "", array.GetNumberOfComponents(), 0, 0};
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for_values(array, density, [&](double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  });
  if (lo <= hi) {
    info.lo = lo + 0.0;  // no minus zero
    info.hi = hi + 0.0;
  }
  return info;
}

FileInfo dataset_info(const std::filesystem::path& file) {
  const DatasetNames names = dataset_names(file);
  FileInfo info;
  const bool masked =
      names.image && std::count(names.point_arrays.begin(), names.point_arrays.end(), "density");
  Dataset base =
      read_dataset(file, masked ? std::vector<std::string>{"density"} : std::vector<std::string>{});
  info.type = "image";
  if (auto* mesh = vtkPolyData::SafeDownCast(base.data.get()))
    info.type = mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() > 0 ? "mesh" : "points";
  if (auto* image = vtkImageData::SafeDownCast(base.data.get())) {
    image->GetDimensions(info.dimensions);
    image->GetSpacing(info.spacing);
  }
  info.length_unit = base.length_unit;
  info.points = base.data->GetNumberOfPoints();
  info.cells = base.data->GetNumberOfCells();
  base.data->GetBounds(info.bounds);
  info.time_days = base.time_days;
  info.wd = base.wd;
  info.has_time = base.has_time;
  // One array in memory at a time: a texel's arrays together are as large as the dense grid.
  vtkDataArray* density = masked ? base.data->GetPointData()->GetArray("density") : nullptr;
  const auto add = [&](const std::string& name, bool of_points) {
    const Dataset one = read_dataset(file, {name});
    vtkDataSetAttributes* attributes =
        of_points ? static_cast<vtkDataSetAttributes*>(one.data->GetPointData()) : one.data->GetCellData();
    vtkDataArray* array = attributes->GetArray(name.c_str());
    if (!array) return;
    info.arrays.push_back(array_info(*array, of_points ? density : nullptr));
    info.arrays.back().unit = unit_of(base, name);
  };
  for (const std::string& name : names.point_arrays) add(name, true);
  for (const std::string& name : names.cell_arrays) add(name, false);
  return info;
}

double number(const char* text, const std::filesystem::path& file) {
  double x = 0;
  const auto end = text + std::strlen(text);
  if (std::from_chars(text, end, x).ptr != end || text == end)
    throw IoFailure(fmt::format("cannot read '{}': timestep '{}' is not a number", file.string(), text));
  return x;
}

FileInfo series_info(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw IoFailure(fmt::format("cannot read '{}': no such file", file.string()));
  vtkNew<vtkXMLDataParser> parser;
  parser->SetFileName(file.c_str());
  bool ok = false;
  {
    const VtkMessages messages;
    ok = parser->Parse() && !messages.has_error();
  }
  vtkXMLDataElement* root = ok ? parser->GetRootElement() : nullptr;
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
    throw IoFailure(fmt::format("cannot read '{}': not a ParaView data file (.pvd)", file.string()));
  FileInfo info;
  info.type = "series";
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const char *name = entry->GetAttribute("file"), *time = entry->GetAttribute("timestep");
    if (std::strcmp(entry->GetName(), "DataSet") != 0 || !name) continue;
    info.series.emplace_back(time ? number(time, file) : 0.0, name);
  }
  return info;
}

}  // namespace

FileInfo file_info(const std::filesystem::path& file) {
  return file.extension() == ".pvd" ? series_info(file) : dataset_info(file);
}

}  // namespace witherfield::vis
