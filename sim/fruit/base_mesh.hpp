// Neighbourhood and tags of a control mesh, checked. Internal to subdivision.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "sim/fruit/subdivision.hpp"

namespace witherfield::fruit {

enum class EdgeKind : unsigned char { smooth, crease, border };

/// What the masks ask of a vertex.
struct VertexClass {
  VertexRule rule = VertexRule::smooth;
  bool border = false;
  bool regular =
      false;  ///< Hoppe et al. 1994: crease with two smooth edges on each side (border: on the one side)
  double centre = 1;  ///< weight of itself ...
  double ring = 0;    ///< ... and of each neighbour; of the two along the crease for rule = crease
};

struct BaseMesh {
  int vertices = 0;
  std::vector<std::array<int, 2>>
      edge_ends;  ///< lower-numbered end first; edges in the order the triangles name them
  std::vector<std::array<int, 2>>
      edge_half;  ///< half-edge 3 f + i running up and down the numbers; -1 = none
  std::vector<EdgeKind> edge_kind;
  std::vector<int> edge_of;     ///< of half-edge 3 f + i, from corner i to corner i + 1
  std::vector<int> ring_start;  ///< vertex -> its part of the two lists below
  std::vector<int> ring_edge,
      ring_vertex;  ///< counter-clockwise; a border vertex starts at its outgoing border edge
  std::vector<VertexClass> vertex_class;
};

/// @throws InvalidInput as Refinement does.
BaseMesh analyse(const ControlMesh& mesh, Scheme scheme);

/// Edges of a mesh whose indices are in range: fills edge_of, edge_ends, edge_half. @throws InvalidInput
void find_edges(const ControlMesh& mesh, BaseMesh& base);

/// Weight of the end of class `own` in the point of an edge to an end of class `other`; none: Loop's smooth
/// mask.
std::optional<double> edge_weight(Scheme scheme, EdgeKind kind, const VertexClass& own,
                                  const VertexClass& other);

/// Class of every vertex that is born on a crease or border edge.
VertexClass born_class(Scheme scheme, EdgeKind kind);

/// Loop's weight of each of n neighbours: (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n.
double loop_alpha(int valence);

}  // namespace witherfield::fruit
