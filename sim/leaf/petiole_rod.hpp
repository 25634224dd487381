// The stalk as an elastic rod with a frame per segment (Cosserat rod; Spillmann & Teschner 2007), clamped at the stem, which carries
// the blade: the held vertices of the blade follow the frame of its last segment.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "sim/leaf/block_matrix.hpp"

namespace witherfield::leaf {

/// Positions of all nodes (blade, then rod) and the frames of the rod's segments (material -> space, third axis along).
struct WiltShape {
  std::vector<glm::dvec3> x;
  std::vector<glm::dquat> frame;
};

class PetioleRod {
 public:
  PetioleRod() = default;
  /// @param line_m centre line from the stem; resampled to `segments` equal ones. @param first_node number of the rod's first node;
  /// @param first_frame number that the first segment's frame has among the nodes of the system (3 rotations as a node);
  /// @param held vertices of the blade at the rod's end.
  PetioleRod(const std::vector<glm::dvec3>& line_m, double radius_stem_m, double radius_end_m, int segments, int first_node,
             int first_frame, std::vector<int> held, std::span<const glm::dvec3> blade_m);

  bool empty() const { return rest_.empty(); }
  int segments() const { return int(length_.size()); }
  int nodes() const { return empty() ? 0 : segments() + 1; }
  const std::vector<glm::dvec3>& rest_m() const { return rest_; }
  const std::vector<glm::dquat>& rest_frames() const { return frame_; }
  double radius_m(int node) const;
  double segment_m(int segment) const { return length_[std::size_t(segment)]; }

  void set_modulus(std::span<const double> segment_Pa);
  std::vector<std::pair<int, int>> couplings() const;
  double energy(const WiltShape& s) const;
  /// @param exactness as in Shell::assemble.
  double assemble(const WiltShape& s, std::span<glm::dvec3> gradient, BlockMatrix& h, double exactness) const;
  /// As Shell::preload; `u` holds displacements of nodes and small rotations of frames.
  void preload(const WiltShape& rest, std::span<const glm::dvec3> u);
  /// Largest bending stress in a segment's skin, MPa.
  std::vector<double> stress_MPa(const WiltShape& s) const;

 private:
  /// A residual r with energy sum_c stiffness_c r_c^2 / 2 that depends on up to three nodes.
  struct Term {
    glm::dvec3 r, stiffness;
    int count = 0;
    int node[3];
    glm::dmat3 derivative[3];  ///< d r / d node
    bool turn = false;         ///< between two frames; else of an arm seen from a frame (the last node)
    glm::dvec3 arm;            ///< in space, or the vector part of the turn
    double share = 1;          ///< d arm / d node: -share, share of the first two nodes
  };
  static void add_curvature(const Term& t, const glm::dvec3& force, double exactness, BlockMatrix& h);
  template <class Visit>
  void each_term(const WiltShape& s, const Visit& visit) const;

  int first_node_ = 0, first_frame_ = 0;
  double radius_stem_ = 0, radius_end_ = 0;
  std::vector<glm::dvec3> rest_;
  std::vector<glm::dquat> frame_, rest_turn_;   ///< per segment; per inner node
  std::vector<double> length_, modulus_;
  std::vector<int> held_;
  std::vector<glm::dvec3> held_at_;             ///< in the last segment's frame, from the last node
  std::vector<glm::dvec3> preload_;             ///< per term
};

/// exp(d) q: a frame turned by the small rotation vector d.
glm::dquat turned(const glm::dquat& q, const glm::dvec3& d);

}  // namespace witherfield::leaf
