// Reading .vti and .vtp files with VTK: only the arrays that are asked for, errors as exceptions.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataSet;

namespace witherfield::vis {

struct Dataset {
  std::shared_ptr<vtkDataSet> data;
  std::string length_unit;                   ///< FieldData length_unit; "" when there is none
  std::map<std::string, std::string> units;  ///< FieldData units
  double time_days = 0, wd = 0;
  bool has_time = false, has_wd = false;
};

/// What is there, without reading any array.
struct DatasetNames {
  bool image = false;
  std::vector<std::string> point_arrays, cell_arrays;
};
/// @throws IoFailure when the file is missing, of another type, or damaged.
DatasetNames dataset_names(const std::filesystem::path& file);

/// Geometry, FieldData and the arrays named (of points and of cells). @throws IoFailure.
Dataset read_dataset(const std::filesystem::path& file, const std::vector<std::string>& arrays);

}  // namespace witherfield::vis
