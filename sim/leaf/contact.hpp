// Keeps parts of a leaf from passing through each other: vertices that are far apart on the leaf but near in space repel each other.
//
// Energy of a pair at distance d < d0: stiffness (d0 - d)^3 / (3 d0): smooth, zero from d0 on. d0 is the sum of the two radii, or
// 60 % of the pair's distance at rest where that is smaller, so that the rest shape feels nothing. A step in which a pair would come
// much nearer than where it repels, even for a moment, is not allowed: nothing jumps through.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/leaf/block_matrix.hpp"

namespace witherfield::leaf {

class Contact {
 public:
  Contact() = default;
  /// @param radius_m per node, from the first on; pairs nearer than `neighbour_m` at rest never repel.
  Contact(std::vector<glm::dvec3> rest_m, std::vector<double> radius_m, double neighbour_m);

  double energy(std::span<const glm::dvec3> x) const;
  /// Adds to gradient and to the diagonal blocks only (a bound from above of the second derivatives: keeps the pattern).
  double assemble(std::span<const glm::dvec3> x, std::span<glm::dvec3> gradient, BlockMatrix& h) const;
  /// Whether all nodes may go straight from one place to the other at the same time.
  bool allows(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) const;
  /// Pairs that repel each other now.
  int touching(std::span<const glm::dvec3> x) const;

 private:
  struct Pair {
    int a, b;
    double gap_m;
  };
  /// All pairs that are nearer than their gap plus `reach_m`; in an order that depends on the positions only.
  std::vector<Pair> find(std::span<const glm::dvec3> x, double reach_m) const;

  std::vector<glm::dvec3> rest_;
  std::vector<double> radius_;
  double neighbour_ = 0, largest_ = 0;
};

}  // namespace witherfield::leaf
