// Adds turned and shifted stamps to a plane of floats: C_ij += B_ij (Su et al. 1998, sec. 2.4), fast.
//
// A stamp is turned once for every one of `angles` headings (bilinear, then scaled to the sum of the mask). Placing it
// at a fraction of a cell spreads every value over four cells with bilinear weights: exact in the place, exact in the
// sum. The plane is worked on in tiles that stay in the cache. Every cell adds its stamps in the same order (by shape,
// heading, and as given), whatever the tiles or threads: the result is the same to the last bit.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/raw_buffer.hpp"

namespace witherfield::floor {

/// One mask, turned to every heading; cut into upright strips without the empty cells above and below.
class StampSet {
 public:
  static constexpr int kWidth = 16;        ///< cells across a strip

  /// @param values size * size, size odd. @param angles multiple of 4.
  StampSet(const std::vector<float>& values, int size, int angles);

  /// What the shifted stamp may cover. The last row is empty: shifted, it takes from the row below.
  struct Strip {
    std::uint32_t first;         ///< in data(): rows of kWidth cells, then for every row the left neighbour of its first cell
    std::int16_t row, column;    ///< of the lower left cell, from the stamp's middle
    std::int16_t rows;
  };
  std::span<const Strip> strips(int angle) const {
    return {strips_.data() + first_[std::size_t(angle)], strips_.data() + first_[std::size_t(angle) + 1]};
  }
  const float* data() const { return data_.data(); }
  int angles() const { return int(first_.size()) - 1; }
  int reach() const { return reach_; }  ///< nothing but zeros further than this from the middle
  double sum() const { return sum_; }   ///< of the mask
  std::size_t memory_bytes() const { return data_.size() * sizeof(float) + strips_.size() * sizeof(Strip); }

 private:
  std::vector<Strip> strips_;
  std::vector<std::size_t> first_;
  RawBuffer data_;
  int reach_ = 0;
  double sum_ = 0;
};

inline constexpr int kStampScales = 5;

struct Placement {
  float x = 0, y = 0;          ///< of the stamp's middle, in cells from the plane's lower left corner (a centre: n + 1/2)
  std::uint16_t shape = 0;     ///< which stamp set of a pass
  std::uint16_t angle = 0;     ///< which heading, 0..angles - 1
  bool mirrored = false;       ///< a left foot: the mask mirrored at its long axis, then turned
  std::array<float, kStampScales> scale{};
};

/// Planes that get the same shapes, each times its own scale.
struct StampPass {
  const std::vector<StampSet>* shapes = nullptr;
  struct Target { float* plane; int scale; };
  std::vector<Target> targets;  ///< 1..3
};

struct TileSize { int width = 512, height = 256; };  ///< 0.6 MB a plane: fits the second-level cache

/// plane(i, j) at [j * nx + i]. Parts of stamps outside the plane are dropped.
void add_stamps(std::span<const Placement> placements, std::span<const StampPass> passes, int nx, int ny,
                TileSize tile = {});

}  // namespace witherfield::floor
