// The peer of splat_points: OpenVDB's ValueAccessor scatter of the same points with the same kernel into the
// same sums. (C++17: includes nothing of ours but the points.)
#pragma once
#include <memory>

#include "sim/core/point_set.hpp"

namespace witherfield::bench {

/// The grid, without margins: points must lie in it.
struct ScatterGrid {
  int nx, ny, nz;
  glm::dvec3 origin_m;
  double spacing_m;
};

/// Sparse sums per voxel: weight, 6 weighted scalars, colour, dyads of tangent and normal, weight and index
/// of the heaviest point. One thread. What splat_points does after that (means, principal axes, look-up of
/// the heaviest point's blade) is left out, in the peer's favour.
class OpenvdbSplat {
 public:
  OpenvdbSplat(const PointSet& points, const ScatterGrid& grid, double sigma_voxels);
  ~OpenvdbSplat();
  double weight(int i, int j, int k) const;
  std::size_t voxels() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::bench
