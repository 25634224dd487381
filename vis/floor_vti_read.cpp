// .vti -> FloorField.
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "vis/dataset.hpp"
#include "vis/floor_read.hpp"

namespace witherfield::vis {

FloorField read_floor_vti(const std::filesystem::path& file, const std::vector<std::string>& channels) {
  const Dataset set = read_dataset(file, channels);
  auto* image = vtkImageData::SafeDownCast(set.data.get());
  if (!image) throw IoFailure(fmt::format("'{}' is not an image", file.string()));
  int points[3];
  double origin[3], spacing[3];
  image->GetDimensions(points);
  image->GetOrigin(origin);
  image->GetSpacing(spacing);
  FloorField floor(points[0] - 1, points[1] - 1, {origin[0], origin[1]}, spacing[0]);
  for (const std::string& name : channels) {
    vtkDataArray* array = image->GetCellData()->GetArray(name.c_str());
    const int components = field_spec(name).components;
    if (!array || array->GetNumberOfComponents() != components ||
        array->GetNumberOfTuples() != vtkIdType(floor.cells()))
      throw IoFailure(fmt::format("'{}' has no array {} of {} components per cell", file.string(), name, components));
    std::vector<float>& values = floor.make(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = float(array->GetComponent(vtkIdType(i / std::size_t(components)), int(i % std::size_t(components))));
  }
  return floor;
}

}  // namespace witherfield::vis
