// The linear Laplacian editing of Miao et al. (sec. 3): minimise ||L V' - L V||^2 + sum over handles k_i^2 |v'_i - u_i|^2.
//
// Normal equations: (L^T L + K^2) D = K^2 (U - V_handles) with D = V' - V. L^T L is never formed. With lambda = K^2 (U - V' at
// the handles), L^2 D = P^T lambda, which can be solved when the lambda sum to zero (they do: 1^T L = 0), so
//   D = B lambda + 1 c^T,   (P B + K^-2) lambda + 1 c^T = U - V_handles,   1^T lambda = 0,   B = L^+ L^+ P^T.
// The small system has one row a handle. D is linear in the handles' moves: D = R (U - V_handles), R kept as columns.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/leaf/laplace_solver.hpp"

namespace witherfield::leaf {

class LaplacianEdit {
 public:
  /// @param weight k_i > 0, one per handle. @throws SolverFailure when the handles' system is singular.
  LaplacianEdit(const HandleColumns& handles, std::span<const double> weight);

  /// position = base + R (target - base at the handles). Nothing moves when no target differs from the base.
  void drag(std::span<const glm::dvec3> base_m, std::span<const glm::dvec3> target_m, std::span<glm::dvec3> position_m) const;

  /// The same by two back substitutions instead of the response matrix: what a drag costs without it.
  void solve(const LaplaceSolver& solver, std::span<const glm::dvec3> base_m, std::span<const glm::dvec3> target_m,
             std::span<glm::dvec3> position_m) const;

  const Columns& response() const { return response_; }

 private:
  std::vector<int> vertex_;
  Columns response_;
  std::vector<double> inverse_;  ///< (h + 1) x h: moves -> lambda (h rows), c (last row)
};

/// ||L (V' - V)||^2 + sum k_i^2 |v'_i - u_i|^2, m2.
double linear_energy(const SparseMatrix& l, std::span<const glm::dvec3> base_m, std::span<const glm::dvec3> position_m,
                     std::span<const int> vertex, std::span<const double> weight, std::span<const glm::dvec3> target_m);

/// (h + 1) x h, row by row: right side -> (lambda, c) of [A 1; 1^T 0] with A = columns at the handles + diag(extra).
/// @throws SolverFailure when singular.
std::vector<double> constraint_inverse(const Columns& columns, std::span<const int> vertex, std::span<const double> extra);

}  // namespace witherfield::leaf
