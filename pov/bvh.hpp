// Rays against many triangles: a tree of boxes, four a node (surface area heuristic over bins: I. Wald, "On fast
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
  /// Four numbers side by side (a vector type of GCC and Clang).
  typedef float Four __attribute__((vector_size(16)));
  struct Node {
    Four low[3], high[3];  ///< boxes of four children
    int first[4];          ///< the child's group of triangles, or the child's node
    int count[4];          ///< of its triangles; 0: a node; -1: nothing
  };
  /// Up to four triangles: a corner and the two edges from it.
  struct Group {
    Four a[3], ab[3], ac[3];
    int face[4];
  };
  struct Builder;
  template <bool kAny>
  int trace(const glm::vec3& origin, const glm::vec3& direction, float reach) const;

  std::vector<Node> nodes_;
  std::vector<Group> groups_;
};

}  // namespace witherfield::pov
