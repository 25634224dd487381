// What the camera sees of placed meshes: only that needs to be fine.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pov/bvh.hpp"
#include "pov/lit_mesh.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

/// All faces of all placed meshes in one tree; face f of mesh m has the number first[m] + f.
struct SceneTree {
  explicit SceneTree(std::span<const LitMesh> placed);
  std::vector<int> first;
  int faces = 0;
  TriangleTree tree;
};

/// The camera's view, a little wider than the picture.
class View {
 public:
  View(const Still& still);
  bool contains(const glm::vec3& point) const;
  const glm::vec3& position() const { return position_; }
  /// Width of a pixel at a point, metres.
  double pixel_m(const glm::vec3& point) const;

 private:
  glm::vec3 position_, ahead_, right_, up_;
  float wide_, high_, pixel_;
};

/// Marks vertices of faces that the camera sees, and their neighbours.
void mark_seen(LitMesh& placed, const SceneTree& tree, const View& view);

}  // namespace witherfield::pov
