// Which voxels a texel file fills, and from where: every voxel with density > 0 from itself, and every empty
// voxel that touches one (26 neighbours) from the densest of them. Attributes of empty voxels would be 0
// otherwise, and interpolation between a blade and the air would show a false dry rim. One rule for all
// attributes: nothing is blended, so that blade ids, tissues and axial directions stay meaningful.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/texel_grid.hpp"

namespace witherfield::vis {

class BleedMap {
 public:
  explicit BleedMap(const TexelGrid& grid);

  /// A filled voxel's code is its own place (brick * 64 + voxel); a bled voxel's is ~place of its source.
  static bool is_filled(std::int32_t code) { return code >= 0; }
  static std::int32_t place(std::int32_t code) { return code >= 0 ? code : ~code; }

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
