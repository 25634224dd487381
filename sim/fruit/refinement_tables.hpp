// What a Refinement stores. Internal to subdivision.
//
// Every level k has vertices 0..V, edges 0..E, faces 0..F. Refining it gives vertex v -> v, edge e -> vertex
// V + e; edge e
// -> edges 2 e (at its lower-numbered end) and 2 e + 1; face f -> three inner edges 2 E + 3 f + i, the i-th
// one cutting off corner i, and four faces. All numbers of the next level follow from these by arithmetic, so
// nothing is ever searched.
#pragma once
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "sim/core/raw_buffer.hpp"
#include "sim/fruit/base_mesh.hpp"

namespace witherfield::fruit {

/// A point of a special edge: weight_lo * lo + weight_hi * hi.
struct EdgeOverride {
  int edge, lo, hi;
  double weight_lo, weight_hi;
};

/// A vertex on a crease or border: centre * itself + side * (a + b).
struct VertexOverride {
  int vertex, a, b;
  double centre, side;
};

/// A vertex that was born on a special edge.
struct LineVertex {
  int vertex, level;  ///< the level it first appears in
  int lo, hi;         ///< its neighbours along the line in that level
  int edge;           ///< of the level before
  EdgeKind kind;
  bool left, right;  ///< which faces of the edge, seen from lo to hi, there are
};

/// Neighbours of an edge's vertex, counter-clockwise: hi, left near hi, left near lo, lo, right near lo,
/// right near hi. On a border the missing side repeats what is there: read, never used.
inline constexpr int kRing = 6;

struct Level {
  int vertices = 0, edges = 0, faces = 0;
  int* corner = nullptr;   ///< 3 a face
  int* edge_of = nullptr;  ///< 3 a face: edge from corner i to corner i + 1; not in the last level
  int* ring = nullptr;     ///< kRing of every vertex born in this level, as vertices of this level
  int* spoke = nullptr;    ///< kRing of every vertex born in this level, coded as spoke_vertex() reads them
  std::vector<EdgeOverride> edge_rules;  ///< of the step from this level to the next
  std::vector<VertexOverride> vertex_rules;
};

/// An edge around a vertex is stored as the number that its half next to the vertex gets in the level after;
/// from then on the vertex is the lower end, so the half of the half is twice the number, and so on.
/// @param birth level in which the vertex first appears; level > birth
/// @return the neighbour across that edge in `level`, `below` = number of vertices of the level before
inline int spoke_vertex(int code, int birth, int level, int below) {
  return below + (level == birth + 1 ? code >> 1 : code << (level - birth - 2));
}

/// Uninitialised ints: small ones from the heap, large ones in huge pages.
class IndexMemory {
 public:
  int* require(std::size_t n);

 private:
  std::size_t capacity_ = 0;
  std::unique_ptr<int[]> small_;
  RawBuffer large_;
};

struct LimitTables {
  IndexMemory memory;
  const int* ring = nullptr;   ///< of the last level
  const int* spoke = nullptr;  ///< of the level before
};

struct Refinement::Tables {
  Scheme scheme;
  int steps = 0;
  BaseMesh base;
  std::vector<int> base_spoke;  ///< parallel to base.ring_edge, coded as for spoke_vertex() with birth 0
  std::vector<Level> levels;    ///< steps + 1
  std::vector<LineVertex> line_vertices;  ///< all that are born on creases and borders, in order
  VertexRule* rules = nullptr;
  IndexMemory memory;
  mutable std::mutex limit_lock;
  mutable std::unique_ptr<LimitTables> limit;  ///< made when first asked for

  void build(const ControlMesh& mesh);  ///< from scheme, steps and base; memory may be that of another
  const LimitTables& limit_tables() const;
  int born_in(int vertex) const;  ///< level in which a vertex of the last level first appears
};

/// Values of all refined vertices, `channels` interleaved.
void evaluate_tables(const Refinement::Tables& tables, const double* control, double* refined, int channels);
void evaluate_tables(const Refinement::Tables& tables, const float* control, float* refined, int channels);

/// Limit positions and normals of the refined values x.
void limit_of_tables(const Refinement::Tables& tables, std::span<const glm::dvec3> x,
                     std::span<glm::dvec3> position, std::span<glm::dvec3> normal);

/// Refines faces of `from` into the arrays of `to` that are there.
void split_faces(const Level& from, const Level& to);

}  // namespace witherfield::fruit
