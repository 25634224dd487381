// The plan of a maize ear: the cob's control mesh and the cells on it. Lengths in millimetres.
#pragma once
#include <vector>

#include "sim/fruit/model.hpp"
#include "sim/fruit/plant_grains.hpp"

namespace witherfield::fruit {

enum class CobPart { lower, middle, upper };

/// The cob as a polyhedron of cells: one column of vertices per row of kernels, one ring per kernel in a row
/// and a few more towards both ends. Below it ends in a sharp vertex whose valence is the number of rows; the
/// rings where the parts join are creases.
struct CobPlan {
  ShapeMesh shape;
  int rows = 0, per_row = 0;
  int first_ring = 0;     ///< kernels stand between ring first_ring + i and the next
  int joint[2] = {0, 0};  ///< rings between lower and middle, middle and upper part
  double top_mm = 0;      ///< upper end, where the bump sits
  double top_radius_mm = 0;
  CobPart part(int kernel_in_row) const;
  /// Vertex in ring r (0 = first ring of the cob, counted with the bare ones) and column c (any whole
  /// number).
  int vertex(int ring, int column) const;
};
/// The columns wind a little about the axis, as the seed has it.
CobPlan plan_cob(const MaizeOptions& options, std::uint64_t seed);

/// The cell of kernel i in row j from the refined cob (first vertices of the refinement are those of the
/// control mesh).
Cell maize_cell(const CobPlan& plan, const std::vector<glm::dvec3>& refined_cob, int row, int kernel_in_row);

/// Share of the kernel's length, from its base, where it is widest; the cells are as wide there as the
/// kernels.
inline constexpr double kWidestShare = 0.78;

}  // namespace witherfield::fruit
