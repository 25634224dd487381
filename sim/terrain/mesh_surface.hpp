// A height field through a triangle mesh seen from above: linear on each triangle, found through a grid of
// bins.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim/core/tri_mesh.hpp"
#include "sim/terrain/surface.hpp"

namespace witherfield::terrain {

class MeshSurface final : public Surface {
 public:
  /// @param crop x0, y0, x1, y1 as fractions of the mesh's bounding box.
  /// @throws InvalidInput naming `file` when the mesh spans no area, or is no height field: it has vertical
  /// or overhanging faces, overlaps itself, or does not cover the crop.
  MeshSurface(const TriMesh& mesh, const double (&crop)[4], const std::string& file);
  double elevation_m(double x_m, double y_m) const override;
  glm::dvec2 gradient(double x_m, double y_m) const override;

 private:
  struct Triangle {
    std::array<glm::dvec2, 3> p;  // counter-clockwise, from the crop's south-west corner
    double z0 = 0;                // elevation at p[0]
    glm::dvec2 slope{0.0};
    int face = 0;  // in the mesh
    double at(const glm::dvec2& q) const { return z0 + slope.x * (q.x - p[0].x) + slope.y * (q.y - p[0].y); }
  };
  void take_triangles(const TriMesh& mesh, const glm::dvec2& corner, const std::string& file);
  void fill_bins();
  void require_no_overlap(const std::string& file) const;
  void require_covered(const std::string& file);
  std::array<int, 2> bin_of(const glm::dvec2& q) const;
  const Triangle& find(const glm::dvec2& q) const;

  std::vector<Triangle> triangles_;
  int bins_x_ = 1, bins_y_ = 1;
  std::vector<int> bin_start_,
      bin_triangle_;  // triangles of bin b: bin_triangle_[bin_start_[b] .. bin_start_[b + 1])
};

}  // namespace witherfield::terrain
