// Rays against many triangles: a binary tree of boxes (surface area heuristic over bins; I. Wald, "On fast
// construction of SAH-based bounding volume hierarchies", 2007).
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::pov {

class TriangleTree {
 public:
  TriangleTree(std::span<const glm::vec3> positions, std::span<const std::array<int, 3>> triangles);
  /// The first triangle within (0, reach) along a unit direction, or -1. Either side counts.
  int first_hit(const glm::vec3& origin, const glm::vec3& direction, float reach) const;
  /// Whether any triangle lies within (0, reach).
  bool blocked(const glm::vec3& origin, const glm::vec3& direction, float reach) const;

 private:
  struct Node {
    glm::vec3 low, high;
    int first;  ///< of its triangles, or the right child (the left one follows the node)
    int count;  ///< 0: an inner node
  };
  struct Corner {
    glm::vec3 a, ab, ac;
    int face;
  };
  struct Builder;
  template <bool kAny>
  int trace(const glm::vec3& origin, const glm::vec3& direction, float reach) const;

  std::vector<Node> nodes_;
  std::vector<Corner> corners_;  ///< in the tree's order
};

}  // namespace witherfield::pov
