#include "sim/core/floor_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/random.hpp"

namespace witherfield {
namespace {

std::uint64_t piece_id(std::int64_t row, std::int64_t column) {
  return (std::uint64_t(std::uint32_t(row)) << 32) | std::uint32_t(column);
}

/// Where joint `column` of a row lies: regular joints, each moved by less than half a piece.
double joint_at(const FloorPattern& p, std::int64_t row, std::int64_t column, double offset, double spread) {
  return (double(column) + offset + spread * (piece_random(p, piece_id(row, column), 0xFFFF) - 0.5)) * p.length_m;
}

}  // namespace

double piece_random(const FloorPattern& p, std::uint64_t id, std::uint32_t which) {
  return philox4x32({std::uint32_t(id), std::uint32_t(id >> 32), which, std::uint32_t(Stream::floor_material)},
                    {std::uint32_t(p.seed), std::uint32_t(p.seed >> 32)})[0] *
         0x1p-32;
}

FloorPiece piece_at(const FloorPattern& p, glm::dvec2 place) {
  FloorPiece piece;
  const double a = p.turn_deg * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  const glm::dvec2 q{c * place.x + s * place.y, c * place.y - s * place.x};
  if (p.laying == Laying::seamless) {
    piece.local_m = q;
    piece.size_m = {1e9, 1e9};
    return piece;
  }
  const std::int64_t row = std::int64_t(std::floor(q.y / p.width_m));
  const bool staggered = p.laying != Laying::tiles;
  // Boards: a random shift a row and ends that vary; slabs vary less, neighbouring rows are half a piece apart.
  const double shift = p.laying == Laying::boards ? piece_random(p, piece_id(row, 0), 0xFFFE)
                       : p.laying == Laying::slabs ? 0.5 * double(row & 1)
                                                   : 0.0;
  const double spread = !staggered ? 0.0 : p.laying == Laying::boards ? 0.7 : 0.45;
  std::int64_t column = std::int64_t(std::floor(q.x / p.length_m - shift));
  while (joint_at(p, row, column, shift, spread) > q.x) --column;
  while (joint_at(p, row, column + 1, shift, spread) <= q.x) ++column;
  const double left = joint_at(p, row, column, shift, spread), right = joint_at(p, row, column + 1, shift, spread);
  piece.id = piece_id(row, column);
  piece.local_m = {q.x - left, q.y - double(row) * p.width_m};
  piece.size_m = {right - left, p.width_m};
  piece.edge_m = std::min({piece.local_m.x, piece.size_m.x - piece.local_m.x, piece.local_m.y,
                           piece.size_m.y - piece.local_m.y}) -
                 0.5 * p.joint_m;
  return piece;
}

}  // namespace witherfield
