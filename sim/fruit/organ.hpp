// An organ is one closed shell: a kernel, an awn, a wedge of the shank. Ears are lists of organs; organs of
// one make share a template, which is one control mesh topology refined once.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "sim/core/surface.hpp"
#include "sim/fruit/subdivision.hpp"

namespace witherfield::fruit {

/// Values of the field organ_id.
enum class OrganKind : int {
  stem = 0,
  wedge,
  kernel,
  glume,
  lemma,
  awn,
  cob,
  cob_bump,
  shank,
  body,
  sepal,
  style,
  user_mesh
};
const char* organ_name(OrganKind kind);  ///< as scene files write it

/// Where a vertex lies on its organ, for colour and texture; rides through the subdivision like a position.
/// x across -1..1, y along 0 (root) .. 1 (tip), z free for the organ (depth of a kernel's groove, crown).
using Paint = glm::vec3;

/// A control mesh whose vertices come with their paint.
struct ShapeMesh {
  ControlMesh mesh;
  std::vector<Paint> paint;
};

/// How an organ looks at one moment: colours at root, middle and tip, linear sRGB, and its water.
struct Coat {
  std::array<glm::vec3, 3> along{};  ///< at paint.y = 0, 1/2, 1
  glm::vec3 mark{};                  ///< where paint.z is 1 (groove, crown, rim)
  float mottle = 0.0f;               ///< relative variation of brightness over the organ, 0..0.5
  float mottle_phase = 0.0f;
  float nerves = 0.0f;  ///< how much five lengthwise nerves stand out from what is between them, 0..0.5
  float water = 1.0f, moisture_wb = 0.0f;
};

struct Organ {
  int shape = 0;  ///< index of the template
  OrganKind kind = OrganKind::kernel;
  int kernel = -1;                      ///< running number of the kernel, -1 for other organs
  std::string name{};                   ///< "segment 3 kernel 2", "wedge 7", ...
  std::vector<glm::dvec3> control_m{};  ///< in the fruit's frame
  bool mirrored = false;                ///< control_m is a mirror image: faces turn round
  Coat coat{};
};

/// A fruit at one moment.
struct Fruit {
  const std::vector<ShapeMesh>* shapes = nullptr;
  const std::vector<Refinement>* refinements = nullptr;
  std::vector<Organ> organs;
};

/// Where each organ's vertices and triangles begin in the joint surface; one entry more than organs.
struct OrganRanges {
  std::vector<std::size_t> vertex, face;
};
OrganRanges organ_ranges(const Fruit& fruit, std::size_t first, std::size_t last);

/// One surface of organs [first, last): fields organ_id, kernel_id, sharpness, diffuse, water, moisture_wb;
/// normals; uv.
Surface mesh_organs(const Fruit& fruit, std::size_t first, std::size_t last);

/// Volume enclosed by the closed shell of triangles [begin, end), m3, positive when it faces outward; and its
/// area, m2.
double enclosed_volume_m3(const Surface& surface, std::size_t begin, std::size_t end);
double area_m2(const Surface& surface, std::size_t begin, std::size_t end);

}  // namespace witherfield::fruit
