// The handles of an edit on a leaf and the way from one key to the next: what run_edit does, for callers that stop on the way.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/leaf/editor.hpp"

namespace witherfield::leaf {

class EditWalk {
 public:
  /// Picks the vertices of all handles and sets them; the editor goes back to its leaf as given and takes the mode of
  /// `options`. `editor` must outlive this. @throws InvalidInput naming the handle: none, one vertex taken twice.
  EditWalk(LeafEditor& editor, const EditOptions& options);

  /// To another key: displacements from the leaf as given, one per handle. Long ways of the rotation-aware mode are gone
  /// in several drags, so that rotations follow; the last one is exact to the options' tolerance.
  void go(std::span<const glm::dvec3> move_m);
  /// The same in one drag of a few iterations: while a mouse moves the handles.
  void follow(std::span<const glm::dvec3> move_m, int iterations);

  int vertex(std::size_t handle) const { return centre_[handle]; }
  /// All vertices that are held, and the handle that each belongs to.
  const std::vector<int>& vertices() const { return held_; }
  const std::vector<std::size_t>& owners() const { return owner_; }

 private:
  std::vector<glm::dvec3> targets(std::span<const glm::dvec3> move_m) const;

  LeafEditor* editor_;
  EditMode mode_;
  int max_iterations_;
  double tolerance_, step_m_;
  std::vector<int> centre_, held_;
  std::vector<std::size_t> owner_;
  std::vector<glm::dvec3> home_, now_;
};

}  // namespace witherfield::leaf
