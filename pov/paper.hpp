// The seamless paper of a studio: level under the objects, bent upward behind them into a wall. Its light is worked
// out at the nodes of a grid that is fine where the objects stand and coarse far off.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace witherfield::pov {

class Paper {
 public:
  Paper() = default;
  /// @param center of the fine region, on the paper; @param away level unit vector from the camera to the back;
  /// @param fine half the fine region's extent across and along `away`; @param size scale of all else (metres)
  Paper(const glm::dvec3& center, const glm::dvec3& away, double fine_across, double fine_along, double size,
        int nodes);
  int nodes() const { return nodes_; }
  bool empty() const { return nodes_ == 0; }
  struct Node {
    glm::dvec3 position_m, normal;
  };
  /// Node i across, j from the front to the back and up the wall.
  Node node(int i, int j) const;
  double level_m() const { return center_.z; }
  /// Index j * nodes + i of the node nearest to a point of the level part, -1 off it.
  int nearest(double x, double y) const;
  /// mesh2 with uv for a picture of one pixel per node.
  std::string mesh_text(double unit) const;

 private:
  /// Grid coordinate -1..1 to metres and back: straight up to 0.8, then ever wider.
  struct Scale {
    double fine = 1, far = 1;
    double metres(double s) const;
    double grid(double x) const;
  };
  double coordinate(int i) const { return nodes_ > 1 ? 2.0 * i / (nodes_ - 1) - 1 : 0; }
  glm::dvec3 center_{0.0}, away_{0, 1, 0}, across_{1, 0, 0};
  Scale side_, depth_;
  double back_ = 1, bend_ = 1;  ///< where the bend begins, and its radius
  int nodes_ = 0;
};

}  // namespace witherfield::pov
