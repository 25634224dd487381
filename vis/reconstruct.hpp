// Continuous fields from voxel values, for pictures. A blade is thinner than a voxel: its density, taken
// linearly between the voxels, is a string of beads. Pictures take it as a cubic B-spline instead (the values
// as the spline's coefficients), whose values at the voxels are means with weights 1/6, 4/6, 1/6 along each
// axis. Files are never smoothed.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::vis {

/// Values of an image, x fastest; `components` per voxel.
struct ImageValues {
  std::array<int, 3> size{0, 0, 0};
  int components = 1;
  std::span<const float> values;
  std::size_t index(int i, int j, int k) const {
    return (std::size_t(k) * std::size_t(size[1]) + std::size_t(j)) * std::size_t(size[0]) + std::size_t(i);
  }
};

/// The scalar image's B-spline at the voxels; outside the image is 0. Same bits for any thread count.
std::vector<float> spline_at_voxels(const ImageValues& scalar);

/// Value of `field` at a point in voxel coordinates (voxel (i, j, k) is at (i, j, k)): mean over the filled
/// voxels nearby, weighted by density and nearness, so that air has no part in it. nearest: that of the voxel
/// with the largest weight.
/// @param out `components` values; zeros when no voxel within two is filled.
void value_near(const ImageValues& field, std::span<const float> density, const glm::dvec3& at, bool nearest,
                double* out);

}  // namespace witherfield::vis
