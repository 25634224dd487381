#include "vis/colouring.hpp"

#include <fmt/format.h>
#include <vtkDataArray.h>

#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"

namespace witherfield::vis {
namespace {

using Range = std::pair<double, double>;

const FieldSpec* declared(const std::string& name) {
  for (const FieldSpec& f : all_fields())
    if (f.name == name) return &f;
  return nullptr;
}

/// What run.json says about the field, if there is one and it says anything.
std::optional<Range> range_of_run(const std::filesystem::path& file, const std::string& field) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  for (const std::filesystem::path& candidate : {folder / "run.json", folder.parent_path() / "run.json"}) {
    std::ifstream in(candidate);
    if (!in) continue;
    try {
      const nlohmann::json run = nlohmann::json::parse(in);
      if (!run.contains("value_ranges") || !run["value_ranges"].contains(field)) return {};
      const nlohmann::json& r = run["value_ranges"][field];
      return Range{r.at(0).get<double>(), r.at(1).get<double>()};
    } catch (const nlohmann::json::exception& e) {
      throw IoFailure(fmt::format("cannot read '{}': {}", candidate.string(), e.what()));
    }
  }
  return {};
}

double length(const vtkDataArray& array, vtkIdType i) {
  double sum = 0;
  for (int c = 0; c < array.GetNumberOfComponents(); ++c) {
    const double x = const_cast<vtkDataArray&>(array).GetComponent(i, c);
    sum += x * x;
  }
  return std::sqrt(sum);
}

Range range_of_values(vtkDataArray& array, vtkDataArray* density) {
  Range r{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const bool scalar = array.GetNumberOfComponents() == 1;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    if (density && !(density->GetComponent(i, 0) > 0)) continue;
    const double x = scalar ? array.GetComponent(i, 0) : length(array, i);
    if (!std::isfinite(x)) continue;
    r = {std::min(r.first, x), std::max(r.second, x)};
  }
  if (r.first > r.second) return {0, 1};
  return scalar ? r : Range{0, r.second};
}

/// A field that has the same value everywhere still needs a scale: the field's natural one, or the value's
/// surroundings.
Range widened(Range r, const FieldSpec* spec) {
  const double size = std::max(std::abs(r.first), std::abs(r.second));
  if (r.second - r.first > 1e-6 * size) return r;
  if (spec && spec->hi - spec->lo <= 150)
    return {std::min(r.first, std::max(spec->lo, 0.0)), std::max(r.second, spec->hi)};
  const double half = size > 0 ? size / 2 : 0.5;
  return {r.first - half, r.second + half};
}

}  // namespace

glm::dvec3 Colouring::at(const double* tuple, int components) const {
  if (kind == Kind::scalar) {
    if (components == 1) return map.at(tuple[0]);
    double sum = 0;
    for (int c = 0; c < components; ++c) sum += tuple[c] * tuple[c];
    return map.at(std::sqrt(sum));
  }
  const glm::dvec3 v{tuple[0], tuple[1], tuple[2]};
  if (kind == Kind::rgb) return srgb_levels(v) / 255.0;
  return glm::clamp(glm::abs(v), 0.0, 1.0);
}

Colouring colouring_of(const std::filesystem::path& file, const Dataset& dataset, vtkDataArray& array,
                       vtkDataArray* density, const std::optional<Range>& range) {
  if (range && !(std::isfinite(range->first) && std::isfinite(range->second) && range->first < range->second))
    throw InvalidInput(
        fmt::format("colour range [{}, {}] must be finite and ascending", range->first, range->second));
  const std::string name = array.GetName();
  const FieldSpec* spec = declared(name);
  Colouring out;
  out.title = spec ? std::string(spec->title) : name;
  if (const auto at = dataset.units.find(name); at != dataset.units.end())
    out.unit = at->second;
  else if (spec)
    out.unit = std::string(spec->unit);

  const bool vector = array.GetNumberOfComponents() == 3;
  if (vector && name == "diffuse") {
    out.kind = Colouring::Kind::rgb;
    out.title = "Diffuse reflectance, in its own colours";
  }
  if (vector && (name == "normal" || name == "tangent")) out.kind = Colouring::Kind::direction;
  if (out.kind != Colouring::Kind::scalar) return out;
  if (array.GetNumberOfComponents() > 1) out.title += " (magnitude)";
  if (name == "tissue") out.title = "Tissue";  // the legend names the values itself
  std::optional<Range> r = range;
  if (!r && array.GetNumberOfComponents() == 1)
    r = range_of_run(file, name);  // run.json knows components only
  if (!r) r = range_of_values(array, density);
  if (!range) r = widened(*r, spec);
  out.map = colour_map(name, r->first, r->second);
  if (out.is_label()) out.unit.clear();
  return out;
}

}  // namespace witherfield::vis
