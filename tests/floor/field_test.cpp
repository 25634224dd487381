// FloorField and FloorPattern.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/core/errors.hpp"
#include "sim/core/floor_field.hpp"
#include "sim/core/floor_pattern.hpp"

namespace witherfield {
namespace {

TEST(FloorField, ChannelsAreDeclaredSizedAndFound) {
  FloorField f(4, 3, {1, 2}, 0.5);
  f.make("footfalls")[std::size_t(2 * 4 + 3)] = 7;
  EXPECT_EQ(f.at("footfalls").size(), 12u);
  EXPECT_EQ(f.make("diffuse").size(), 36u);
  EXPECT_EQ(f.make("footfalls")[11], 7) << "make gives what is there";
  EXPECT_DOUBLE_EQ(f.centre_m(3, 2).x, 2.75);
  EXPECT_DOUBLE_EQ(f.centre_m(3, 2).y, 3.25);
  f.validate();
  EXPECT_THROW(f.make("foot_falls"), InvalidInput);
  EXPECT_THROW(f.at("gloss"), InvalidInput);
  f.at("footfalls").pop_back();
  EXPECT_THROW(f.validate(), InvalidInput);
  EXPECT_THROW(FloorField(0, 3, {0, 0}, 1), InvalidInput);
  EXPECT_THROW(FloorField(3, 3, {0, 0}, 0), InvalidInput);
}

TEST(FloorField, AddingIsCellByCellAndNeedsOneGrid) {
  FloorField a(2, 2, {0, 0}, 1), b = a;
  a.make("footfalls") = {1, 2, 3, 4};
  b.make("footfalls") = {10, 20, 30, 40};
  b.make("slide_m") = {1, 1, 1, 1};
  add(a, b);
  EXPECT_EQ(a.at("footfalls"), (std::vector<float>{11, 22, 33, 44}));
  EXPECT_EQ(a.at("slide_m"), (std::vector<float>{1, 1, 1, 1}));
  EXPECT_THROW(add(a, FloorField(2, 2, {0, 1}, 1)), InvalidInput);
}

/// Every piece is a box of its own; the boxes fill the floor.
TEST(FloorPattern, PiecesTileTheFloor) {
  for (const Laying laying : {Laying::boards, Laying::tiles, Laying::slabs}) {
    FloorPattern p;
    p.laying = laying;
    p.length_m = laying == Laying::tiles ? 0.3 : 0.9;
    p.width_m = 0.2;
    p.turn_deg = 30;
    std::map<std::uint64_t, double> area;
    std::map<std::uint64_t, glm::dvec2> size;
    const double h = 0.01;
    for (double y = -3; y < 3; y += h)
      for (double x = -3; x < 3; x += h) {
        const FloorPiece piece = piece_at(p, {x, y});
        ASSERT_GE(piece.local_m.x, 0);
        ASSERT_LE(piece.local_m.x, piece.size_m.x);
        ASSERT_GE(piece.local_m.y, -1e-12);
        ASSERT_LE(piece.local_m.y, piece.size_m.y + 1e-12);
        ASSERT_GT(piece.size_m.x, 0.2 * p.length_m);
        area[piece.id] += h * h;
        if (size.contains(piece.id)) { ASSERT_DOUBLE_EQ(size[piece.id].x, piece.size_m.x); }
        size[piece.id] = piece.size_m;
      }
    int whole = 0;
    for (const auto& [id, a] : area)
      if (std::abs(a - size[id].x * size[id].y) < 0.08 * a) ++whole;
    EXPECT_GT(whole, int(area.size() * 0.6)) << "all but those cut at the border";
  }
}

TEST(FloorPattern, NeighboursAreStaggeredButTilesAreNot) {
  FloorPattern p;
  p.width_m = 0.1;
  p.length_m = 1;
  const auto joint_of_row = [&](int row) {  // where the first joint right of 10 m lies
    const FloorPiece piece = piece_at(p, {10, (row + 0.5) * 0.1});
    return 10 - piece.local_m.x + piece.size_m.x;
  };
  p.laying = Laying::tiles;
  EXPECT_NEAR(joint_of_row(3), joint_of_row(4), 1e-9);
  p.laying = Laying::slabs;
  int apart = 0;
  for (int row = 0; row < 20; ++row) apart += std::abs(joint_of_row(row) - joint_of_row(row + 1)) > 0.05;
  EXPECT_GE(apart, 18);
}

}  // namespace
}  // namespace witherfield
