// A texel instance on the terrain: where a tile stands and how it is turned.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace witherfield {

/// A point p of the texel in tile coordinates (tile [0, size]^2, z up, metres) goes to the world like this:
///   u = p.xy / size - 1/2;  if mirrored u.x = -u.x;  turn u by quarter_turns * 90 deg counter-clockwise (seen from +z);
///   x = origin_m.x + (u.x + 1/2) * size;  y = origin_m.y + (u.y + 1/2) * size;
///   z = origin_m.z + slope_x * (u.x + 1/2) * size + slope_y * (u.y + 1/2) * size + height_scale * p.z.
/// Walls stay vertical (sheared to the slope), so that footprints tile exactly whatever the slope.
struct TexelInstance {
  int cell_i = 0, cell_j = 0;     ///< cell of the placement grid
  glm::dvec3 origin_m{0.0};       ///< world position of the cell's lower corner on the fitted plane
  double slope_x = 0, slope_y = 0;///< dz/dx, dz/dy of the fitted plane
  int variant = 0;                ///< which texel
  int quarter_turns = 0;          ///< 0..3
  bool mirrored = false;
  double height_scale = 1.0;
  int lod = 0;                    ///< 0 = full resolution, 1 = half, 2 = quarter, 3 = eighth
  double distance_m = 0;          ///< to the camera that set the LOD
  double sun_visibility = 1.0;    ///< 0 in the terrain's own shadow .. 1 lit
};

struct Placement {
  double tile_m = 0;
  int cells_x = 0, cells_y = 0;
  std::vector<TexelInstance> instances;  ///< row by row: index = cell_j * cells_x + cell_i
};

/// World position of texel point p (see TexelInstance).
glm::dvec3 to_world(const TexelInstance& t, double tile_m, const glm::dvec3& p);

}  // namespace witherfield
