// Extended Loop subdivision: smooth, crease and sharp vertices on a fixed topology.
//
// Two schemes. liu2007: Loop's rules plus sharp vertex, crease vertex and crease edge (Liu et al. 2007;
// docs/physics.md). hoppe1994: the complete piecewise smooth scheme of Hoppe et al. 1994 (smooth, dart,
// regular and non-regular crease, corner, boundary). The topology is refined once into index tables;
// positions and any other values per vertex are then evaluated as often as the control mesh moves, level by
// level: a refined vertex depends on about a dozen control vertices, but only on two to seven of the level
// before, so the tables of the levels are an order of magnitude smaller than one table of weights would be,
// and memory traffic is what evaluation costs. Rows of the implied weights sum to 1.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/surface.hpp"

namespace witherfield::fruit {

enum class Scheme { liu2007, hoppe1994 };

/// A control mesh with tags. Border edges are creases by themselves.
struct ControlMesh {
  std::vector<glm::dvec3> position_m;
  std::vector<std::array<int, 3>> triangles;     ///< counter-clockwise from outside
  std::vector<std::array<int, 2>> crease_edges;  ///< vertex pairs, any order; must be edges of the mesh
  std::vector<int> sharp_vertices;  ///< liu2007: the sharp rule; hoppe1994: corner (stays where it is)
};

/// Adds every edge whose faces meet at more than `angle_deg` (0..180) to the creases.
void add_creases_by_angle(ControlMesh& mesh, double angle_deg);

/// What a vertex is under the rules.
enum class VertexRule : unsigned char { smooth, dart, crease, sharp };

/// The refinement of one topology by a number of steps. Immutable; copies share the tables; safe to use from
/// threads.
class Refinement {
 public:
  /// @param steps 0..8. Indices, manifoldness and tags are checked.
  /// @throws InvalidInput naming the triangle, edge or vertex: index out of range, edge with more than two
  /// faces or two faces of opposite orientation, several fans in a vertex, crease that is no edge, sharp
  /// vertex of valence < 3 (liu2007: weight 0 or negative), a mesh that would exceed 2^31 - 1 indices. A
  /// vertex without faces stays where it is. liu2007: a sharp vertex on the border stays where it is, too;
  /// crease edges are halved whatever they end in; where three or more creases meet, or border and crease,
  /// the vertex stays.
  Refinement(const ControlMesh& topology, Scheme scheme, int steps);
  /// The same in the memory of `old`, if no copy of `old` lives: for topologies that change as often as
  /// positions do. `r = Refinement(mesh, scheme, steps, std::move(r))`. When it throws, `old` is unchanged.
  Refinement(const ControlMesh& topology, Scheme scheme, int steps, Refinement&& old);

  std::size_t control_vertices() const;
  std::size_t vertices() const;
  std::size_t faces() const;
  /// Order is stable: vertices of step k come first in step k + 1, then one per edge; the children of face f
  /// are 4 f .. 4 f + 3 (three corners in the face's order, then the middle one).
  std::span<const std::array<int, 3>> triangles() const;
  /// Control face of refined face f: f >> (2 * steps).
  int steps() const;
  std::span<const VertexRule> rules() const;  ///< of the refined vertices
  /// For tags that must not be mixed: a control vertex keeps its own number, an edge's vertex takes that of
  /// the lower-numbered end.
  std::vector<int> control_vertex() const;

  /// Refined values from control values. Same bits for any number of threads.
  /// @throws InvalidInput unless the sizes are those of control_vertices() and vertices() (times channels).
  void evaluate(std::span<const glm::dvec3> control, std::span<glm::dvec3> refined) const;
  void evaluate(std::span<const glm::vec3> control, std::span<glm::vec3> refined) const;
  /// Any number of channels, interleaved.
  void evaluate(std::span<const float> control, std::span<float> refined, int channels) const;
  /// Where the refined vertices end up after infinitely many steps, and the unit normals there. Where the
  /// limit has no single normal (crease, corner, cusp; also darts of liu2007) it is the area-weighted mean
  /// over the faces around in the limit; zero for a vertex without faces.
  void evaluate_limit(std::span<const glm::dvec3> control, std::span<glm::dvec3> position,
                      std::span<glm::dvec3> normal) const;

  struct Tables;

 private:
  explicit Refinement(std::nullptr_t) {}
  std::shared_ptr<Tables> tables_;
};

/// The control surface refined: positions, uv and fields of vertices are evaluated, fields of faces are
/// inherited; fields of vertices that number things (names in "_id", tissue, vein) are taken from
/// control_vertex(); "sharpness", where the control surface has it, from rules(). With `to_limit`, positions
/// are the limit's and normals are filled.
/// @throws InvalidInput when the surface is not valid or not of the refinement's size.
Surface refine(const Refinement& refinement, const Surface& control, bool to_limit = false);

}  // namespace witherfield::fruit
