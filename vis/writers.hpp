// Simulation data -> VTK files that ParaView opens as they are (names, units: docs/formats.md). VTK is
// included nowhere but in .cpp files. Files are written under a temporary name in the same folder and renamed
// when whole: a failed write leaves nothing.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/core/blade_ribbons.hpp"
#include "sim/core/floor_field.hpp"
#include "sim/core/placement.hpp"
#include "sim/core/point_set.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/core/tri_mesh.hpp"

namespace witherfield::vis {

enum class Compression { lz4, zlib };

/// Time and weathering of a file (FieldData TimeValue, wd, length_unit).
struct Stamp {
  double time_days = 0, wd = 0;
};

/// Min and max of one component-wise array over the voxels / points that hold something.
struct ValueRange {
  double lo = 0, hi = 0;
};
using ValueRanges = std::map<std::string, ValueRange>;
void merge_ranges(ValueRanges& into, const ValueRanges& from);

/// Box of voxels to write: [lo, hi).
struct VoxelBox {
  glm::ivec3 lo{0}, hi{0};
};

/// Writes the texel fields (optics = false) or the optics (optics = true; density in both) as .vti: appended
/// raw, UInt64 header, compressed, float32 rounded to 10 mantissa bits, cropped to `box` (of the run's
/// union), geometry in millimetres, attributes bled one voxel outward (density not). Never makes a dense
/// copy: compressed blocks that hold no grass are all alike. Voxels are point data at the voxel centres.
/// Returns the ranges of the arrays over voxels with density > 0.
/// @throws IoFailure naming the file (cannot create, disk full).
ValueRanges write_texel_vti(const std::filesystem::path& file, const TexelGrid& grid, const VoxelBox& box,
                            bool optics, const Stamp& stamp, Compression compression = Compression::lz4);

/// Which voxels of a grid go where in a file. Worked out once, it serves both files of a key frame.
class TexelPlan {
 public:
  /// @param grid outlives the plan. @throws InvalidInput as write_texel_vti.
  TexelPlan(const TexelGrid& grid, const VoxelBox& box);
  ~TexelPlan();
  struct Parts;
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};
ValueRanges write_texel_vti(const std::filesystem::path& file, const TexelPlan& plan, bool optics, const Stamp& stamp,
                            Compression compression = Compression::lz4);

/// All point fields plus mass_kg, velocity_m_s, radius_m (scalar), as vertices, millimetres.
ValueRanges write_points_vtp(const std::filesystem::path& file, const PointSet& points, const Stamp& stamp,
                             Compression compression = Compression::lz4);

/// Terrain triangles in metres with elevation_m, texel_id, rotation (quarter turns; negative = mirrored: -1 -
/// turns), lod per cell. true_elevation_m has one value per vertex.
void write_terrain_vtp(const std::filesystem::path& file, const TriMesh& mesh,
                       const std::vector<double>& true_elevation_m, const Placement& placement);

/// All channels of a floor as cell data of a flat image, metres, z = 0. Float32 rounded to 10 mantissa bits.
ValueRanges write_floor_vti(const std::filesystem::path& file, const FloorField& floor, const Stamp& stamp,
                            Compression compression = Compression::lz4);

/// Points as vertices and curves (chains of point numbers) as polylines, millimetres.
/// @throws InvalidInput when a chain names a point that is not there; IoFailure.
void write_curves_vtp(const std::filesystem::path& file, const std::vector<glm::dvec3>& points_m,
                      const std::vector<std::vector<int>>& curves, const Stamp& stamp,
                      Compression compression = Compression::lz4);

/// .pvd time series. Entries are (days, path relative to the .pvd).
void write_pvd(const std::filesystem::path& file, const std::vector<std::pair<double, std::string>>& entries);

/// A ParaView start-up script (Python) for a run's <kind>.pvd: fixes the colour scales to `ranges`, shows one field
/// (water of grass and leaves, moisture of fruit, wear of floors) with its unit, the day and wd; and the terrain of
/// grass, where there is one. @param kind grass, leaf, fruit, floor. @throws InvalidInput for any other, IoFailure.
void write_paraview_script(const std::filesystem::path& file, const std::string& kind, const ValueRanges& ranges);

}  // namespace witherfield::vis
