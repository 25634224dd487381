// Blades as one mesh2 a variant, coloured by pictures in which every blade has a few rows.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "pov/prelight.hpp"
#include "sim/core/blade_ribbons.hpp"
#include "sim/core/surface.hpp"

namespace witherfield::pov {

/// How finely blades are drawn.
struct BladeDetail {
  int segments = 8;
  bool folded = true;  ///< two facets across (the V), else one
};

/// Rows and columns of the pictures: along x root to tip, `rows` pixels in y per blade.
struct AtlasLayout {
  int blades = 0, columns = 32, rows = 8;
  int height() const { return blades * rows; }
};
AtlasLayout atlas_layout(int blades);

/// The blades as one open surface in texel coordinates, a shell per blade in the blades' order (cones: a tube with a
/// seam): normals splayed as across a round blade, uv for the atlas, fields blade_id, water, chlorophyll_ug_cm2, diffuse.
Surface blade_surface(const BladeRibbons& blades, const BladeDetail& detail);
/// Its mesh2{...} (flipped, times unit).
std::string blade_mesh(const BladeRibbons& blades, const BladeDetail& detail, double unit);

/// Three pictures of the same layout: reflectance, transmittance, and the light that is not the sun's beam
/// (radiance).
struct BladeAtlas {
  AtlasLayout layout;
  std::vector<glm::vec3> reflected, transmitted, ambient;
};
/// @param sky per node, share of the sky seen.
BladeAtlas blade_atlas(const BladeRibbons& blades, std::span<const float> sky, const Illumination& light,
                       const glm::dvec3& mean_albedo);

}  // namespace witherfield::pov
