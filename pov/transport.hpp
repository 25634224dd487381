// How much light reaches a spot inside a texel: optical depth by a slab sweep, O(voxels) per direction.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sim/core/texel_grid.hpp"

namespace witherfield::pov {

/// Density of a texel as a dense block, cropped above the highest grass. Index (k * ny + j) * nx + i.
struct DenseDensity {
  int nx = 0, ny = 0, nz = 0;
  bool periodic =
      true;  ///< true: the tile, its margin folded back onto the opposite side; false: as it stands
  glm::dvec3 origin_m{0.0};  ///< lower corner of voxel (0, 0, 0), in texel coordinates
  double spacing_m = 1;
  std::vector<float> rho;
};
DenseDensity densify(const TexelGrid& grid, bool periodic);

/// Optical depth of one voxel's edge at density 1 as seen in the pictures. A far voxel, larger than a blade
/// is wide, is filled at random: 0.5 (leaf projection G of random orientations; Ross 1981). A near voxel,
/// smaller than the blade's width, is a piece of one opaque face: up to 6.5 times as much.
double depth_per_density(double blade_width_m, double spacing_m);

/// How far from a spot of grass a ray of light starts, so that a blade does not shade itself: 1.5 voxels
/// where a blade is about a voxel thick, nothing where a voxel holds many blades (which do shade one
/// another).
double ray_start_m(double blade_width_m, double spacing_m);

/// Optical depth from every point of a block up toward a light, out of the block's top (and its sides where
/// it is not periodic).
class OpticalDepth {
 public:
  /// @param to_light direction toward the light, z > 0.05; @param per_density optical depth of a voxel's edge
  /// at density 1.
  OpticalDepth(const DenseDensity& block, const glm::dvec3& to_light, double per_density);
  /// At p in texel coordinates; trilinear. Points outside a block that is not periodic are first taken along
  /// the ray to where it enters.
  double at(const glm::dvec3& p_m) const;

 private:
  void sweep(const DenseDensity& block, double per_density);
  double sample(double x, double y, double z) const;  // voxel coordinates, centre of the first voxel at 0

  int nx_, ny_, nz_;
  bool periodic_;
  glm::dvec3 origin_m_, direction_;
  double spacing_m_;
  std::vector<float> depth_;
};

/// A coarse dome of sky: 13 directions, weights sum to 1 (solid angle, for receivers of any orientation). The
/// set maps onto itself under quarter turns and mirroring, so that one sky field serves a texel in all its
/// eight orientations.
struct DomeSample {
  glm::dvec3 direction;
  double weight;
};
const std::vector<DomeSample>& sky_dome();

}  // namespace witherfield::pov
