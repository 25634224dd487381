// Made-up grass for the tests of vis: curved ribbons in a texel, points, a hill. Smooth attributes with known
// laws.
#pragma once
#include <filesystem>

#include "sim/core/placement.hpp"
#include "sim/core/point_set.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/core/tri_mesh.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis::sample {

/// resolution^3 voxels over a 0.2 m tile with a margin of 3/16 on each side; `blades` ribbons some 10 cm
/// long. Deterministic.
TexelGrid texel(int resolution, int blades, double wd);
/// Box of the occupied voxels and two around them, cut to the grid.
VoxelBox box_of(const TexelGrid& grid);
/// One point in the middle of every filled voxel.
PointSet points(const TexelGrid& grid);
/// A hill of n x n quads, 1 m cells from (0, 0), with a placement of 2 m tiles.
struct Hill {
  TriMesh mesh;
  std::vector<double> elevation_m;
  Placement placement;
};
Hill hill(int n);

/// A folder of its own for a test, emptied first and removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Names of everything in it.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string content(const std::filesystem::path& file);

}  // namespace witherfield::vis::sample
