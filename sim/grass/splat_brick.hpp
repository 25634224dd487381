// The inner part of splat_points: the sums of one brick, and what they give. Compiled for several instruction
// sets.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/point_set.hpp"
#include "sim/core/texel_grid.hpp"

namespace witherfield::grass {

/// What is summed per voxel: sum of w, of w * scalar, of w * dyads (xx, xy, xz, yy, yz, zz).
enum SplatSum {
  kWeight,
  kWater,
  kChlorophyll,
  kStressVein,
  kStressMesophyll,
  kStrain,
  kSpecular,
  kRed,
  kGreen,
  kBlue,
  kTangent,
  kNormal = kTangent + 6,
  kSplatSums = kNormal + 6
};
constexpr int kSplatRecord =
    24;  ///< floats of a point's record before its rows of weights: kSplatSums, padded

/// A point's window: voxels lo..hi along each axis.
struct SplatWindow {
  std::array<std::int16_t, 3> lo, hi;
};

/// Points prepared for summing: a record each. First the values to be summed, then three rows of weights (x,
/// y, z), which start at the window's first brick.
struct SplatRecords {
  int row = 0;             ///< floats of a row of weights
  std::size_t stride = 0;  ///< floats of a record
  std::unique_ptr<float[]> floats;
  std::vector<SplatWindow> windows;
};

/// Sums the points order[0..count) in the brick with brick coordinates (bx, by, bz) and writes all channels
/// of it.
void splat_brick(const PointSet& points, const SplatRecords& records, const std::uint32_t* order,
                 std::size_t count, const std::array<int, 3>& brick, float* channels);

}  // namespace witherfield::grass
