// How a floor is laid: boards, tiles or slabs. The wear of a floor and its picture ask the same functions, so that what
// is worn and what is drawn are the same pieces.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

namespace witherfield {

enum class Laying {
  seamless,  ///< one piece: linoleum, screed
  boards,    ///< long pieces along `turn_deg`, their ends staggered at random
  tiles,     ///< a square or oblong grid, joints in line
  slabs,     ///< rows whose pieces have lengths of their own, joints offset
};

struct FloorPattern {
  Laying laying = Laying::boards;
  double length_m = 1.8;      ///< of a piece, along the laying direction, 0.02..20 (slabs, boards: mean)
  double width_m = 0.14;      ///< across it, 0.02..20
  double joint_m = 0.001;     ///< width of the gap, 0..0.1
  double turn_deg = 0;        ///< laying direction, counter-clockwise from x, -360..360
  std::uint64_t seed = 1;     ///< of the staggering and of what differs between pieces
};

/// The piece that covers a place.
struct FloorPiece {
  std::uint64_t id = 0;       ///< same for every place of the piece
  glm::dvec2 local_m{0.0};    ///< from the piece's lower left corner, x along the laying direction
  glm::dvec2 size_m{0.0};     ///< of this piece, joint included on two sides
  double edge_m = 1e9;        ///< distance to the piece's nearest edge; negative within the joint
};

FloorPiece piece_at(const FloorPattern& pattern, glm::dvec2 place_m);

/// A number in [0, 1) that belongs to the piece; `which` tells apart hardness, brightness and so on.
double piece_random(const FloorPattern& pattern, std::uint64_t id, std::uint32_t which);

}  // namespace witherfield
