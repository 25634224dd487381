// Light in a texel before it is rendered: what each voxel of grass sends to the eye, so that POV-Ray need
// only add up emission behind absorption. Also the light at blades and on the ground from the same transport.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pov/leaf_optics.hpp"
#include "pov/transport.hpp"
#include "sim/core/texel_grid.hpp"

namespace witherfield::pov {

/// Light in POV-Ray's convention: radiance of a white diffuser facing it (no factor pi anywhere).
struct Illumination {
  glm::dvec3 to_sun{0, 0, 1};  ///< unit, in the frame of what is lit
  glm::dvec3 sun_rgb{3.0};     ///< on a face turned to the sun
  glm::dvec3 sky_rgb{0.43};    ///< on a face that sees the whole sky
};

/// Light scattered inside the canopy, on a spot that sees the share `sky` of the sky: from above after scattering, and
/// sent back from below, by the mean albedo of the blades (reflectance + transmittance) (Goudriaan 1977).
glm::dvec3 scattered_light(const Illumination& light, const glm::dvec3& mean_albedo, double sky);

/// Share of the sky seen from each point (1 on top of the grass), over sky_dome().
/// @param offset_m the ray starts this far out, so that a blade does not shade itself.
std::vector<float> sky_visibility(const DenseDensity& block, double per_density,
                                  std::span<const glm::dvec3> points_m, double offset_m);

/// Shares of the sun's beam and of the sky that reach the ground.
struct GroundShares {
  double sun = 1, sky = 1;
};

/// The voxels of one texel that hold grass, with their sky visibility; shaded for any number of lights and
/// eyes.
class TexelPrelight {
 public:
  /// @param periodic the texel repeats over a terrain (light comes through its copies); false: it stands
  /// alone.
  TexelPrelight(const TexelGrid& grid, bool periodic, double blade_width_m);

  struct Shading {
    std::vector<glm::vec3> radiance;  ///< per voxel, to the eye
    glm::dvec3 mean_sun{0.0},
        mean_rest{0.0};  ///< parts due to the sun's beam and to all else, weighted to what is seen
  };
  /// @param eye_m in the texel's frame. Diffuse: two-sided leaf (reflectance on the lit side, transmittance
  /// on the other) mixed with the fibre term sin(t, l) of Kajiya & Kay 1989; specular: theirs, with both
  /// vectors outward.
  Shading shade(const Illumination& light, const glm::dvec3& eye_m) const;

  /// Light on what is seen of the tile's ground from outside: a spot counts by its own share of the sky, because
  /// gaps that let light down are the ones that let the eye in.
  GroundShares ground(const glm::dvec3& to_sun) const;

  const DenseDensity& block() const { return block_; }
  double per_density() const { return per_density_; }
  double start_m() const { return start_m_; }                       ///< see ray_start_m
  const std::vector<glm::ivec3>& voxels() const { return voxel_; }  ///< in the grid's own voxel numbers
  const std::vector<float>& density() const { return density_; }
  const std::vector<float>& sky() const { return sky_; }
  const glm::dvec3& mean_albedo() const { return mean_albedo_; }
  const glm::dvec3& mean_diffuse() const { return mean_diffuse_; }

 private:
  void gather(const TexelGrid& grid);
  std::vector<glm::dvec3> ground_points() const;

  DenseDensity block_;
  double per_density_, start_m_;
  std::vector<glm::ivec3> voxel_;
  std::vector<glm::dvec3> point_m_;
  std::vector<float> density_, sky_, specular_;
  std::vector<glm::vec3> normal_, tangent_;
  std::vector<LeafOptics> leaf_;
  glm::dvec3 mean_albedo_{0.0}, mean_diffuse_{0.0};
};

}  // namespace witherfield::pov
