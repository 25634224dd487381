// Is a mesh sound? Checked with CGAL on the OpenMesh mesh itself.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/core/tri_mesh.hpp"

namespace witherfield::check {

struct MeshCheckOptions {
  bool self_intersections = true;  ///< the slowest check, n log n
  std::size_t listed = 100;        ///< at most so many ids in each list below; counts are always complete
};

/// Ids are indices of faces and vertices in the mesh, from 0, ascending.
struct MeshReport {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t components = 0;           ///< sets of faces connected by edges
  std::size_t border_loops = 0;         ///< closed chains of edges that have a face on one side only
  std::size_t isolated_vertices = 0;    ///< belong to no face
  std::size_t non_finite_vertices = 0;  ///< NaN or infinite; then nothing geometric is checked
  std::size_t non_manifold_vertices =
      0;                  ///< where several fans of faces meet in one vertex, or that a reader had to double
  bool closed = false;    ///< has faces and no border
  bool manifold = false;  ///< no non-manifold vertex (the mesh type holds no non-manifold edges)

  // Geometry; left at zero / false when a vertex is not finite.
  bool geometry_checked = false;
  bool self_intersections_checked = false;
  double area_m2 = 0;
  double volume_m3 = 0;              ///< enclosed, negative when inside out; 0 unless closed
  bool oriented_outward = false;     ///< closed, and every component encloses a positive volume
  bool oriented_up = false;          ///< no face looks down
  std::size_t faces_down = 0;        ///< faces whose normal has z < 0
  std::size_t degenerate_faces = 0;  ///< corners on one line (exact test)
  std::vector<int> degenerate_ids;
  std::size_t self_intersections = 0;  ///< pairs of faces that meet elsewhere than in what they share
  std::vector<std::pair<int, int>> self_intersection_ids;  ///< first < second

  /// Nothing that would spoil a rendering or a simulation on the mesh.
  bool sound() const {
    return faces > 0 && geometry_checked && manifold && degenerate_faces == 0 && self_intersections == 0 &&
           isolated_vertices == 0;
  }
};

/// @pre the mesh holds no elements marked as deleted (call garbage_collection() first).
/// @throws InvalidInput otherwise.
MeshReport check_mesh(const TriMesh& mesh, const MeshCheckOptions& options = {});

}  // namespace witherfield::check
