// What a texel file holds where. Filled voxels (density > 0) are packed into plain arrays, brick by brick;
// every empty voxel that touches a filled one (26 neighbours) takes its attributes from the densest of them,
// because attributes of empty voxels would be 0 otherwise and interpolation between blade and air would show
// a false dry rim. One rule for all attributes: nothing is blended, so that blade ids, tissues and axial
// directions stay meaningful.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/texel_grid.hpp"

namespace witherfield::vis {

/// The filled voxels of a grid, numbered brick by brick. The grid's own layout (all channels of a brick
/// together) would touch a new page of memory for every brick and field; the packed arrays are small and read
/// in order.
class PackedVoxels {
 public:
  explicit PackedVoxels(const TexelGrid& grid);
  const TexelGrid& grid() const { return *grid_; }
  std::size_t count() const { return first_.back(); }
  std::uint64_t mask(int brick) const { return mask_[std::size_t(brick)]; }  ///< bit v = voxel v is filled
  /// Number of a filled voxel.
  std::uint32_t number(int brick, int voxel) const;
  const float* density(int brick) const { return density_.data() + std::size_t(brick) * TexelGrid::kVoxels; }
  /// Values of all filled voxels, one vector per channel asked for; rounded to 10 bits of mantissa but for
  /// labels.
  std::vector<std::vector<float>> values(std::span<const TexelChannel> channels) const;

 private:
  const TexelGrid* grid_;
  std::vector<std::uint64_t> mask_;
  std::vector<std::uint32_t> first_;  // number of a brick's first filled voxel; one more entry: the count
  std::vector<float> density_;        // [brick][64]
};

/// Where the values of a file come from.
class BleedMap {
 public:
  explicit BleedMap(const PackedVoxels& voxels);

  /// A filled voxel's code is its own number; a bled voxel's is ~number of its source.
  static bool is_filled(std::int32_t code) { return code >= 0; }
  static std::int32_t number(std::int32_t code) { return code >= 0 ? code : ~code; }

  struct Brick {
    std::int32_t x;       ///< brick coordinate along x
    std::uint32_t first;  ///< its first code in the layer's codes
    std::uint64_t mask;   ///< voxels that have a code; the codes follow in the order of the bits
  };
  /// Bricks of one brick coordinate z, row by row.
  struct Layer {
    std::vector<Brick> bricks;
    std::vector<std::int32_t> codes;
    std::vector<std::uint32_t> row_start;  ///< bricks_y + 1 entries
    /// Bricks of row by, ascending in x.
    std::span<const Brick> row(int by) const {
      const std::uint32_t first = row_start[std::size_t(by)];
      return {bricks.data() + first, row_start[std::size_t(by) + 1] - first};
    }
  };
  const Layer& layer(int bz) const { return layers_[std::size_t(bz)]; }

 private:
  std::vector<Layer> layers_;
};

}  // namespace witherfield::vis
