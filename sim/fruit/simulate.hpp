// Crop fruit from control meshes: the whole of Liu et al. 2007 and its ripening in time (docs/physics.md).
#pragma once
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/core/progress.hpp"
#include "sim/core/surface.hpp"
#include "sim/fruit/options.hpp"
#include "sim/fruit/organ.hpp"

namespace witherfield::fruit {

/// The fruit at one moment: metres, z up, the fruit's axis along z, its lowest point at z = 0.
struct FruitFrame {
  int index = 0;
  double wd = 0, time_days = 0;  ///< since wd = 0
  Surface surface;               ///< organ_id, kernel_id, sharpness, diffuse, water, moisture_wb, normal, uv
};
using FrameSink = std::function<void(const FruitFrame&)>;

struct FruitReport {
  int spikelets = 0, rows = 0;  ///< 0 where the crop has none
  int kernels = 0, organs = 0;
  std::size_t vertices = 0, triangles = 0;  ///< of one frame
  struct Frame {
    double wd = 0, time_days = 0;
    double moisture_wb = 0;                             ///< mean over the kernels
    double kernel_volume_mm3 = 0, kernel_area_mm2 = 0;  ///< means over the kernels
    glm::dvec3 size_m{0};                               ///< of the bounding box
    double seconds = 0;                                 ///< wall clock for making the surface
  };
  std::vector<Frame> frames;
  double overlap =
      0;  ///< share of the kernels' volume that lies in more than one of them, at the last frame, by voxels
  double setup_seconds = 0;
};

/// @throws InvalidInput.
FruitReport simulate(const FruitOptions& options, const FrameSink& sink, const Progress& progress = {});

/// Every closed shell of the fruit at wd, apart: for the checker.
struct Shell {
  std::string name;
  OrganKind kind = OrganKind::kernel;
  int kernel = -1;
  Surface surface;
};
std::vector<Shell> shells(const FruitOptions& options, double wd);

/// The single kernel at rest (grain axis along z, base at the origin), refined by `step` steps: 0 is the
/// control mesh. For the picture of the subdivision. Crop mesh: the user's mesh.
Surface kernel_step(const FruitOptions& options, int step);
/// Its control mesh, with tags.
ControlMesh kernel_control(const FruitOptions& options);

/// Share of the shells' summed volume that is counted more than once, by voxels of the given edge. Only the
/// organs that are kernels count. @pre the surface comes from simulate or mesh_organs.
double overlap_share(const Surface& surface, double voxel_m);

}  // namespace witherfield::fruit
