// What a floor carries: named channels on a regular grid in the plane. Simulators fill it, writers encode it.
//
// Geometry: cell (i, j) has its centre at origin_m + (i + 1/2, j + 1/2) * spacing_m, x to the right, y up (seen from
// above), height along z. The linear index of a cell is j * nx + i.
#pragma once
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield {

/// Values of one declared field (sim/core/fields.hpp), tuple by tuple: component c of cell n at [n * components + c].
struct FloorChannel {
  std::string name;
  std::vector<float> values;
};

struct FloorField {
  int nx = 0, ny = 0;
  glm::dvec2 origin_m{0.0};  ///< lower left corner of cell (0, 0)
  double spacing_m = 0;      ///< edge of a square cell
  std::vector<FloorChannel> channels;

  FloorField() = default;
  /// A grid without channels. @throws InvalidInput unless nx, ny >= 1 and spacing_m > 0.
  FloorField(int nx, int ny, glm::dvec2 origin_m, double spacing_m);

  std::size_t cells() const { return std::size_t(nx) * std::size_t(ny); }
  glm::dvec2 centre_m(int i, int j) const { return origin_m + spacing_m * glm::dvec2(i + 0.5, j + 0.5); }
  bool same_grid(const FloorField& other) const;

  bool has(std::string_view name) const;
  /// @throws InvalidInput naming the missing channel.
  const std::vector<float>& at(std::string_view name) const;
  std::vector<float>& at(std::string_view name);
  /// Adds the channel, zero-filled, or gives the one that is there. @throws InvalidInput when it is not declared.
  std::vector<float>& make(std::string_view name);

  /// @throws InvalidInput when a channel is not declared, stands twice, has the wrong length or a value that is not
  /// finite; the message names the channel and the cell.
  void validate() const;
};

/// Adds `part` to `sum`, channel by channel: for additive fields (footfalls, dose_N_s_m2, slide_m) only. Channels that
/// one of the two lacks count as zero. @throws InvalidInput when the grids differ.
void add(FloorField& sum, const FloorField& part);

}  // namespace witherfield
