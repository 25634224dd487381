// Which way to go: the orientation field E(x, y, phase) of Su et al. 1998, sec. 1.3, for any room.
//
// Towards a goal. Let a point wander at random (diffusion), be lost at walls and obstacles and elsewhere at the rate
// that makes lambda = reach_m its mean range. The chance u(x) of arriving solves
//     lambda^2 Laplace(u) - u = -source,   u = 0 on walls,
// and the drift of the wanderers that do arrive is along grad(log u) (Doob's h-transform). That is E: smooth wherever
// there is ground, towards the goal along near-shortest ways, away from walls within lambda of them; every field line
// ends in the goal, because u has no maximum elsewhere. The matrix is an M-matrix: its Cholesky factor gives u to full
// relative precision though it falls by many powers of ten (Varadhan 1967: -lambda log u tends to the distance).
//
// Round the walls ("like magnetic field lines"). A potential phi with one turn about the room's middle,
//     div(sigma grad(phi)) = 0,   no flow through walls,
// with sigma high near the walls and low in the middle. E is along +-grad(phi). Around a column the flow divides.
#pragma once
#include <memory>
#include <vector>

#include "sim/floor/nav_grid.hpp"

namespace witherfield::floor {

/// Directions on the grid; not defined (0, 0) far from free ground.
struct OrientationField {
  std::vector<float> x, y;     ///< unit where free
  std::vector<float> way_m;    ///< goal fields: -lambda log(u / max u), about the way left; empty for the round

  /// Interpolated direction, unit; (0, 0) where there is none.
  glm::dvec2 at(const NavShape& shape, const NavShape::Spot& spot) const;
};

/// Round the room counter-clockwise.
struct RoundField {
  OrientationField direction;
  std::vector<float> lane_m;      ///< distance to the walls, smoothed
  std::vector<float> psi;         ///< phi = psi + angle about the middle / 2 pi
  glm::dvec2 middle_m{0.0};
  double widest_m = 0;            ///< largest distance to the walls
  double phi(const NavShape& shape, glm::dvec2 p) const;  ///< in turns; jumps by one somewhere
};

/// Solves for fields on one grid; keeps the factor, so that further goals cost little.
class FieldSolver {
 public:
  FieldSolver(const NavGrid& grid, double reach_m);
  ~FieldSolver();
  FieldSolver(const FieldSolver&) = delete;
  FieldSolver& operator=(const FieldSolver&) = delete;

  /// @param sources free cells. @throws SolverFailure when u vanishes on ground connected to them.
  OrientationField towards(const std::vector<std::size_t>& sources) const;
  RoundField round() const;

 private:
  struct Factor;
  const NavGrid& grid_;
  double reach_m_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace witherfield::floor
