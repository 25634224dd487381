// What an edit did to the leaf: area, stretch, faces turned over.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::leaf {

struct EditReport {
  double area_before_m2 = 0, area_after_m2 = 0;
  double area_drift = 0;            ///< after / before - 1
  double largest_strain = 0;        ///< over all faces, largest |principal stretch - 1|
  int largest_strain_face = -1;
  double rms_strain = 0;            ///< area-weighted, both principal stretches
  int flipped_faces = 0;            ///< folded back over an edge: their normal opposes that of their patch
  std::vector<int> flipped_ids;     ///< the first 100
};

/// @pre both arrays have one position per vertex.
EditReport edit_report(std::span<const glm::dvec3> before_m, std::span<const glm::dvec3> after_m,
                       std::span<const std::array<int, 3>> triangles);

/// Principal stretches of each face, larger first.
std::vector<std::array<double, 2>> principal_stretches(std::span<const glm::dvec3> before_m,
                                                       std::span<const glm::dvec3> after_m,
                                                       std::span<const std::array<int, 3>> triangles);

}  // namespace witherfield::leaf
