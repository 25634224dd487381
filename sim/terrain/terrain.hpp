// Terrain: a digital elevation model (through GDAL) or a mesh (OBJ, PLY through OpenMesh), brought to scene
// size.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "sim/core/placement.hpp"
#include "sim/core/tri_mesh.hpp"
#include "sim/core/view.hpp"

namespace witherfield::terrain {

struct TerrainOptions {
  std::string dem;   ///< GeoTIFF, ESRI ASCII grid, or 16-bit PNG; exactly one of dem and mesh
  std::string mesh;  ///< OBJ or PLY, z up
  double png_elevation_per_unit_m =
      0;                  ///< metres per grey level of a PNG (which has no scale of its own), > 0 for PNGs
  double png_cell_m = 0;  ///< metres between the pixels of a PNG, > 0 for PNGs
  double crop[4] = {0, 0, 1,
                    1};  ///< part used: x0, y0, x1, y1 as fractions of the width and height, y up (south = 0)
  double width_m =
      0;  ///< east-west extent in the scene; 0 = true size. Horizontal scale = width_m / true width.
  double vertical_exaggeration = 1;  ///< on top of the horizontal scale, 0.01..100
};

/// A terrain in scene coordinates (a DEM spans from the centre of its first cell to that of its last): x in
/// [0, width], y in [0, depth], z >= 0 up (lowest point at 0).
class Terrain {
 public:
  double width_m() const;
  double depth_m() const;
  double height(double x_m, double y_m)
      const;  ///< C1 smooth (Catmull-Rom on the DEM; barycentric on a mesh); clamped at the edges
  glm::dvec3 normal(double x_m, double y_m) const;  ///< unit
  double max_height_m() const;
  double true_elevation_m(double x_m, double y_m) const;  ///< metres above the DEM's datum, unscaled
  double horizontal_scale() const;                        ///< scene metres per true metre
  double cell_m() const;  ///< spacing of the DEM's samples (mesh: size of a triangle) in the scene
  /// 1 where the sun's ray meets no terrain, 0 in shadow, soft by the sun's half-degree and the cell size in
  /// between.
  double sun_visibility(const glm::dvec3& point_m, const glm::dvec3& to_sun) const;

  struct Data;  // defined in terrain_data.hpp
  explicit Terrain(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

 private:
  std::shared_ptr<const Data> data_;
};

/// @throws IoFailure when the file is missing or unreadable; InvalidInput for NaN or void cells (how many,
/// where the first), zero area, a degenerate crop, a PNG without scale, a mesh that is not a height field
/// seen from above.
Terrain load_terrain(const TerrainOptions& options);

struct PlacementOptions {
  int cells_x = 40, cells_y = 40;  ///< texels east-west and north-south, 1..1000 each
  double lod_distance_m[3] = {
      1, 2, 4};  ///< nearer than [0]: full; [1]: half; [2]: quarter; beyond: eighth. Ascending.
  double height_scale_lo = 0.88, height_scale_hi = 1.12;  ///< 0.1..3
  int variants = 1;
  double patchiness =
      0.6;               ///< 0 = variants at random, 1 = by smooth noise only (patches of the same variant)
  double patch_m = 1.0;  ///< size of the patches
  std::uint64_t seed = 1;
};

/// Texels over the terrain: a cells_x x cells_y grid that covers it with square tiles of tile_m = width /
/// cells_x (rows that do not fit are left out); each stands on the least-squares plane of its corners, is
/// turned and mirrored at random (keyed by the seed and the cell), no two neighbours alike, and takes its LOD
/// from the distance to the camera.
Placement place_texels(const Terrain& terrain, const PlacementOptions& options, const glm::dvec3& camera_m,
                       const glm::dvec3& to_sun);

/// Triangle mesh of the terrain at `cells_x` x `cells_y` quads over the terrain's extent (each split in two),
/// normals set, oriented up.
TriMesh terrain_mesh(const Terrain& terrain, int cells_x, int cells_y);

}  // namespace witherfield::terrain
