// Rotation-aware editing: as-rigid-as-possible with smooth rotations (Sorkine & Alexa 2007; Levi & Gotsman 2015), because
// the linear edit shears and swells where a leaf curls strongly.
//
//   E(x, R) = sum over directed edges ij  w_ij |x_i - x_j - R_i (p_i - p_j)|^2  +  (alpha A / 2) / n_i |R_i - R_j|^2
//
// with w_ij = (cot + cot) / 2, p the shape at rest, A its area, n_i the number of neighbours.
// Positions for given rotations: L x = b with the handles held exactly, x = L^+ b + G lambda + 1 c^T with G = L^+ P^T.
// Rotations for given positions: on fine meshes the second term ties neighbours so strongly that turning vertex by vertex (as
// in both papers) creeps. All turn together instead: R_i <- exp(omega_i) R_i with H omega = gradient, where H is the
// second derivative of E for a shape at rest (its first term rounded to a multiple of the identity at each vertex). H stays
// fixed, so that it is factored once, as L is.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/leaf/laplace_solver.hpp"
#include "sim/leaf/rotation.hpp"

namespace witherfield::leaf {

class ArapEdit {
 public:
  /// @param solver the leaf's operator; must outlive this. @param rest_m the shape at rest. @param area_m2 A above.
  ArapEdit(const LaplaceSolver& solver, std::span<const glm::dvec3> rest_m, double area_m2, double alpha);

  /// Another shape at rest (weights and H stay); rotations start at the identity.
  void set_rest(std::span<const glm::dvec3> rest_m);
  /// @throws SolverFailure when the handles' system is singular.
  void set_handles(const HandleColumns& handles);

  struct Limits {
    int max_iterations = 3;
    double tolerance = 1e-5;  ///< ends when no vertex moves further in an iteration than this share of the leaf's size
  };
  /// `position_m`: the guess in, the answer out; handles end on their targets. Returns the iterations.
  int drag(std::span<const glm::dvec3> target_m, std::span<glm::dvec3> position_m, const Limits& limits);

  /// E with the best rotations for this shape, m2.
  double energy(std::span<const glm::dvec3> position_m) const;

  /// The rotations follow a rigid motion of the whole leaf.
  void turn(const Mat3& rotation);

  int factorisations() const { return turns_.factorisations(); }

 private:
  struct Turning {
    std::vector<Mat3> rotation;
    std::vector<glm::dvec3> omega;  ///< last step, part of which is taken again (heavy ball)
  };
  SparseCholesky turn_matrix(std::span<const glm::dvec3> rest_m);
  void step_rotations(std::span<const glm::dvec3> position_m, Turning& turning) const;
  double energy_with(std::span<const glm::dvec3> position_m, const std::vector<Mat3>& rotation) const;
  void right_side();
  double solve_positions(std::span<const glm::dvec3> target_m, std::span<glm::dvec3> position_m);

  const LaplaceSolver* solver_;
  double stiffness_;                    ///< alpha A / 2
  double size_m_ = 1;
  std::vector<int> start_, neighbour_;  ///< of each vertex
  std::vector<double> weight_;          ///< w_ij
  std::vector<double> smooth_;          ///< (alpha A / 2) (1 / n_i + 1 / n_j) of each directed edge
  std::vector<double> stretch_rest_;    ///< sum over j of w_ij |p_i - p_j|^2
  SparseCholesky turns_;                ///< H
  std::vector<glm::dvec3> edge_;        ///< w_ij (p_i - p_j)
  std::vector<glm::dvec3> half_delta_;  ///< sum over j of edge_
  std::vector<glm::dvec3> rest_;
  Turning turning_;
  Columns harmonic_;
  std::vector<int> vertex_;
  std::vector<double> inverse_;
  std::vector<double> right_;
  std::vector<glm::dvec3> next_;
};

}  // namespace witherfield::leaf
