// Is a mesh sound? Checked with CGAL on the OpenMesh mesh itself. For plain arrays, which may hold anything
// (non-manifold edges, faces twice): surface_check.hpp, with the same report.
#pragma once
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/core/tri_mesh.hpp"

namespace witherfield::check {

struct MeshCheckOptions {
  bool self_intersections = true;  ///< the slowest check, n log n
  std::size_t listed = 100;        ///< at most so many ids in each list below; counts are always complete
};

/// A set of faces connected by edges: one shell.
struct ComponentReport {
  std::size_t faces = 0;
  int first_face = 0;            ///< least face id: what fields of the mesh say about it tells what it is
  std::size_t border_edges = 0;  ///< edges with one face
  bool closed = false;           ///< every edge has two faces that run through it in opposite directions
  double area_m2 = 0;
  double volume_m3 = 0;  ///< enclosed, negative when inside out; 0 unless closed
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
  bool closed = false;    ///< has faces, and every edge has two that run through it in opposite directions
  bool manifold = false;  ///< no non-manifold vertex or edge, no edge that its two faces run through alike

  // Only check_surface fills these: the OpenMesh mesh holds none of it.
  std::size_t non_manifold_edges = 0;  ///< edges with three faces or more
  std::size_t clashing_edges = 0;      ///< edges whose two faces are oriented against each other
  std::size_t duplicate_faces = 0;     ///< faces with the same corners as an earlier one
  std::size_t repeated_corners = 0;    ///< faces that name a vertex twice; they are degenerate too
  std::vector<std::array<int, 2>> non_manifold_edge_ids, clashing_edge_ids;  ///< the edge's vertices
  std::vector<int> non_manifold_vertex_ids, isolated_ids, non_finite_ids;    ///< vertices
  std::vector<int> duplicate_ids;                                            ///< faces
  std::vector<ComponentReport> component;                                    ///< in order of first_face

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
  /// Pairs of faces that meet elsewhere than in what they share; check_surface counts those within one shell
  /// here and those of two shells (kernels pressed into a cob) in shell_intersections, check_mesh counts all
  /// here.
  std::size_t self_intersections = 0;
  std::vector<std::pair<int, int>> self_intersection_ids;  ///< first < second
  std::size_t shell_intersections = 0;
  std::vector<std::pair<int, int>> shell_intersection_ids;

  /// Nothing that would spoil a rendering or a simulation on the mesh. Shells may cut each other.
  bool sound() const {
    return faces > 0 && geometry_checked && manifold && degenerate_faces == 0 && duplicate_faces == 0 &&
           self_intersections == 0 && isolated_vertices == 0;
  }
};

/// @pre the mesh holds no elements marked as deleted (call garbage_collection() first).
/// @throws InvalidInput otherwise.
MeshReport check_mesh(const TriMesh& mesh, const MeshCheckOptions& options = {});

}  // namespace witherfield::check
