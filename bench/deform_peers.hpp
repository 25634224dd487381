// Libraries that deform a mesh by handles, each behind the same calls.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sim/leaf/sparse.hpp"

namespace witherfield::bench {

struct DeformInput {
  std::vector<glm::dvec3> position;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> handle;
  double weight = 10;  ///< k of the linear edit
};

/// (L^T L + K^2) V' = L^T L V + K^2 U: the paper's normal equations (lower triangle and all), made once outside of the timing.
leaf::SparseMatrix normal_matrix(const DeformInput& input);

class DeformPeer {
 public:
  virtual ~DeformPeer() = default;
  virtual void prepare() = 0;   ///< timed: order and factor, or what the library calls preprocessing
  virtual void drag(std::span<const glm::dvec3> target) = 0;  ///< timed: one move of the handles
  virtual std::vector<glm::dvec3> positions() const = 0;
};

std::unique_ptr<DeformPeer> eigen_llt(const DeformInput& input);
std::unique_ptr<DeformPeer> cholmod_simplicial(const DeformInput& input);
std::unique_ptr<DeformPeer> cholmod_supernodal(const DeformInput& input);
/// @param iterations of each deform(); 0 = the library's default (5, tolerance 1e-4).
std::unique_ptr<DeformPeer> cgal_original_arap(const DeformInput& input, int iterations = 0);
std::unique_ptr<DeformPeer> cgal_sre_arap(const DeformInput& input, int iterations = 0);

}  // namespace witherfield::bench
