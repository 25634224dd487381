// A texel: a 3-D array of voxels of which few hold grass (1 to 3 % of 256^3). Storage is sparse: bricks of
// 4 x 4 x 4 voxels, allocated only where there is something; nothing ever sweeps the empty space.
//
// Geometry: voxel (i, j, k) has its centre at origin_m + (i + 1/2, j + 1/2, k + 1/2) * spacing_m, z up,
// z = 0 is the ground. The dense linear index of a voxel is (k * ny + j) * nx + i.
// Source of the idea "texel = density, frame, reflection per voxel": Kajiya & Kay 1989; Jiao et al. 2010, sec. 2.1.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/raw_buffer.hpp"

namespace witherfield {

struct GridShape {
  int nx = 0, ny = 0, nz = 0;    ///< voxels; each a multiple of 4
  glm::dvec3 origin_m{0.0};      ///< lower corner of voxel (0,0,0)
  double spacing_m = 1.0;        ///< edge of a cubic voxel
  int margin = 0;                ///< voxels on each side in x and y that lie outside the tile
  std::int64_t voxels() const { return std::int64_t(nx) * ny * nz; }
  /// Edge of the tile (the part that repeats over a terrain) in metres.
  double tile_m() const { return (nx - 2 * margin) * spacing_m; }
  bool operator==(const GridShape&) const = default;
};

/// Channels of a texel, in storage order. Three-component fields occupy three consecutive channels.
/// density is the one-sided area of blade surface in the voxel divided by the area of a voxel face (dimensionless).
/// All other channels are means over what is in the voxel and are meaningful only where density > 0.
enum class TexelChannel : int {
  density, water, chlorophyll_ug_cm2, stress_vein_MPa, stress_mesophyll_MPa, strain_shrink,
  tissue,       ///< 0 air, 1 vein, 2 mesophyll (that of the larger share)
  blade_id,     ///< index of the blade with the largest share
  arc,          ///< 0 root .. 1 tip, along the dominant blade (internal: not written to files)
  specular,
  normal_x, normal_y, normal_z, tangent_x, tangent_y, tangent_z, diffuse_r, diffuse_g, diffuse_b,
  count
};
inline constexpr int kTexelChannels = static_cast<int>(TexelChannel::count);

/// A texel field as written to files: name (declared in fields.hpp), first channel, components.
struct TexelField {
  std::string_view name;
  TexelChannel first;
  int components;
  bool optics;  ///< written to the optics series instead of the texel series (density is in both)
};
/// The written fields in order: density, water, chlorophyll_ug_cm2, ..., diffuse. (arc is not among them.)
const std::vector<TexelField>& texel_fields();

class TexelGrid {
 public:
  static constexpr int kEdge = 4;     ///< voxels along a brick's edge
  static constexpr int kVoxels = 64;  ///< voxels in a brick; local index = (z * 4 + y) * 4 + x

  TexelGrid() = default;
  /// @pre nx, ny, nz positive multiples of 4; spacing_m > 0. @throws InvalidInput otherwise.
  explicit TexelGrid(const GridShape& shape);

  const GridShape& shape() const { return shape_; }
  int bricks_x() const { return shape_.nx / kEdge; }
  int bricks_y() const { return shape_.ny / kEdge; }
  int bricks_z() const { return shape_.nz / kEdge; }

  int brick_count() const { return static_cast<int>(brick_cell_.size()); }
  /// Linear brick cell index (bz * bricks_y + by) * bricks_x + bx of an allocated brick. Bricks made by
  /// reset_bricks are in ascending cell order.
  int brick_cell(int brick) const { return brick_cell_[static_cast<std::size_t>(brick)]; }
  glm::ivec3 brick_base(int brick) const;  ///< voxel coordinates of the brick's first voxel
  /// Allocated brick that holds brick cell `cell`, or -1.
  int brick_at(int cell) const { return table_[static_cast<std::size_t>(cell)]; }

  /// 64 floats of one channel of one brick.
  float* channel(int brick, TexelChannel c) {
    return data_.data() + (std::size_t(brick) * kTexelChannels + std::size_t(c)) * kVoxels;
  }
  const float* channel(int brick, TexelChannel c) const {
    return data_.data() + (std::size_t(brick) * kTexelChannels + std::size_t(c)) * kVoxels;
  }

  /// Value at a voxel; 0 where no brick is allocated or outside the grid.
  float at(int i, int j, int k, TexelChannel c) const;

  /// Drops all bricks and allocates exactly `cells` (ascending, unique). Contents are zero unless
  /// `uninitialised` (then the caller writes every channel of every brick). Memory is reused between calls.
  void reset_bricks(const std::vector<int>& cells, bool uninitialised = false);

  /// Sum of density over all voxels (double accumulation in brick order).
  double total_density() const;
  /// Number of voxels with density > 0.
  std::int64_t occupied_voxels() const;
  std::size_t memory_bytes() const;

  /// Smallest box of voxels [lo, hi) with density > 0; lo == hi == 0 when empty.
  struct Box { glm::ivec3 lo{0}, hi{0}; };
  Box occupied_box() const;

 private:
  GridShape shape_;
  std::vector<std::int32_t> table_;       // brick cell -> brick, -1 if absent
  std::vector<std::int32_t> brick_cell_;  // brick -> brick cell
  RawBuffer data_;                        // [brick][channel][64] floats
};

}  // namespace witherfield
