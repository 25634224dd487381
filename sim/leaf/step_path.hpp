// Large steps of a thin shell without stretching it.
//
// A straight step that turns a part of a thin sheet by phi stretches it by phi^2 / 2, and the sheet resists stretching so much more
// than bending that only tiny steps would lower the energy. Here a step is a curve instead: every triangle's gradient is turned by the
// finite rotation that its part of the step stands for, and the positions follow from the gradients by one Poisson solve (as
// in Yu et al. 2004, Poisson-based gradient field manipulation). To first order it is the straight step.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "sim/leaf/petiole_rod.hpp"
#include "sim/leaf/shell_patch.hpp"
#include "sim/leaf/sparse.hpp"

namespace witherfield::leaf {

class StepPath {
 public:
  /// @param clamp vertices held in space (no rod) or by the rod's end. @param rod_nodes 0 = none; they follow the blade's vertices.
  StepPath(std::span<const glm::dvec3> blade_rest_m, const std::vector<ShellPatch>& patches, std::vector<int> clamp, int rod_nodes);

  /// The shape at `share` of the step (displacements of nodes, then rotations of frames).
  WiltShape at(const WiltShape& from, std::span<const glm::dvec3> step, double share) const;

 private:
  void move_rod(const WiltShape& from, std::span<const glm::dvec3> step, double share, WiltShape& to) const;
  void move_blade(const WiltShape& from, std::span<const glm::dvec3> step, double share, WiltShape& to) const;

  const std::vector<ShellPatch>* patches_;
  std::vector<int> clamp_;
  std::size_t vertices_, rod_nodes_;
  double anchor_ = 0;
  std::unique_ptr<SparseCholesky> poisson_;
};

}  // namespace witherfield::leaf
