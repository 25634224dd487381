// From the values of one array to colours, and how the legend explains them.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "vis/colour_map.hpp"
#include "vis/dataset.hpp"

class vtkDataArray;

namespace witherfield::vis {

struct Colouring {
  enum class Kind {
    scalar,    ///< through `map`; of a vector its length
    rgb,       ///< the array is a linear sRGB colour
    direction  ///< |x|, |y|, |z| as red, green, blue: opposite directions look alike
  };
  Kind kind = Kind::scalar;
  ColourMap map;
  std::string title, unit;

  /// Labels are drawn from the nearest voxel, never interpolated.
  bool is_label() const { return map.cyclic_labels || !map.categories.empty(); }
  /// Encoded sRGB of a tuple with `components` values.
  glm::dvec3 at(const double* tuple, int components) const;
};

/// Scale: `range` if given; else the run's ("value_ranges" in run.json beside `file` or one folder up); else
/// the array's own where `density` (may be null) is > 0. Degenerate ranges are widened.
/// @throws InvalidInput when range is not ascending or not finite; IoFailure when run.json is damaged.
Colouring colouring_of(const std::filesystem::path& file, const Dataset& dataset, vtkDataArray& array,
                       vtkDataArray* density, const std::optional<std::pair<double, double>>& range);

}  // namespace witherfield::vis
