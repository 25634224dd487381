#include "sim/core/floor_field.hpp"

#include <utility>
#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"

namespace witherfield {

FloorField::FloorField(int nx_, int ny_, glm::dvec2 origin, double spacing)
    : nx(nx_), ny(ny_), origin_m(origin), spacing_m(spacing) {
  if (nx < 1 || ny < 1)
    throw InvalidInput("FloorField: " + std::to_string(nx) + " x " + std::to_string(ny) +
                       " cells; at least 1 x 1 is needed");
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw InvalidInput("FloorField: spacing_m = " + std::to_string(spacing) + " must be > 0 m");
}

bool FloorField::same_grid(const FloorField& o) const {
  return nx == o.nx && ny == o.ny && origin_m == o.origin_m && spacing_m == o.spacing_m;
}

bool FloorField::has(std::string_view name) const {
  return std::any_of(channels.begin(), channels.end(), [&](const FloorChannel& c) { return c.name == name; });
}

const std::vector<float>& FloorField::at(std::string_view name) const {
  for (const FloorChannel& c : channels)
    if (c.name == name) return c.values;
  throw InvalidInput("FloorField: no channel '" + std::string(name) + "'");
}

std::vector<float>& FloorField::at(std::string_view name) {
  return const_cast<std::vector<float>&>(std::as_const(*this).at(name));
}

std::vector<float>& FloorField::make(std::string_view name) {
  if (has(name)) return at(name);
  const std::size_t components = std::size_t(field_spec(name).components);
  return channels.emplace_back(std::string(name), std::vector<float>(cells() * components)).values;
}

void FloorField::validate() const {
  for (std::size_t n = 0; n < channels.size(); ++n) {
    const FloorChannel& c = channels[n];
    const std::size_t wanted = cells() * std::size_t(field_spec(c.name).components);
    if (c.values.size() != wanted)
      throw InvalidInput("FloorField: channel '" + c.name + "' has " + std::to_string(c.values.size()) +
                         " values, " + std::to_string(wanted) + " are needed");
    for (std::size_t m = n + 1; m < channels.size(); ++m)
      if (channels[m].name == c.name) throw InvalidInput("FloorField: channel '" + c.name + "' stands twice");
    const auto bad = std::find_if(c.values.begin(), c.values.end(), [](float v) { return !std::isfinite(v); });
    if (bad != c.values.end())
      throw InvalidInput("FloorField: channel '" + c.name + "' is not finite in value " +
                         std::to_string(bad - c.values.begin()));
  }
}

void add(FloorField& sum, const FloorField& part) {
  if (!sum.same_grid(part)) throw InvalidInput("add: the two floors have different grids");
  for (const FloorChannel& c : part.channels) {
    std::vector<float>& to = sum.make(c.name);
    for (std::size_t n = 0; n < to.size(); ++n) to[n] += c.values[n];
  }
}

}  // namespace witherfield
