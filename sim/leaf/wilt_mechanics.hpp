// The shape of a leaf in equilibrium: blade (shell with ribs), petiole (rod), weight and contact, for given water contents.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/leaf/petiole_rod.hpp"
#include "sim/leaf/vein_ribs.hpp"
#include "sim/leaf/wilt_body.hpp"
#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf {

struct RelaxReport {
  int iterations = 0;
  bool converged = false;        ///< residual below the tolerance within the iterations
  double residual = 0;           ///< energy that one more step would gain, over weight times size
  std::vector<double> energy_J;  ///< before the first and after each step: never rises
  int touching = 0;              ///< pairs of vertices in contact
};

class WiltMechanics {
 public:
  /// Starts in the natural pose with full water. @throws InvalidInput, SolverFailure.
  WiltMechanics(const WiltBody& body, const WiltOptions& options);
  ~WiltMechanics();
  WiltMechanics(WiltMechanics&&) noexcept;
  WiltMechanics& operator=(WiltMechanics&&) noexcept;

  /// @param blade relative water content per vertex; @param petiole per node of the rod (rod_nodes() values).
  void set_water(std::span<const double> blade, std::span<const double> petiole);
  /// Newton's method with line search from the present shape. @throws SolverFailure when a value is not finite.
  RelaxReport relax();

  const WiltShape& shape() const;
  const RibLayout& ribs() const;
  int rod_nodes() const;
  double rod_radius_m(int node) const;
  std::vector<double> von_mises_MPa() const;       ///< per triangle
  std::vector<double> rod_stress_MPa() const;      ///< per segment
  double energy_J() const;
  std::vector<glm::dvec3> forces_N() const;        ///< minus the energy's gradient per node, also of held ones
  const std::vector<float>& vein() const;          ///< the body's, or made from its curves

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::leaf
