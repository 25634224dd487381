// Core value types: laws of curves, random streams, colour, sparse grids, placement.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "sim/core/colour.hpp"
#include "sim/core/curve.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/placement.hpp"
#include "sim/core/random.hpp"
#include "sim/core/texel_grid.hpp"
#include "sim/core/view.hpp"

namespace witherfield {
namespace {

TEST(Random, PhiloxKnownAnswers) {  // Random123's kat_vectors for philox4x32-10
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, StreamsDifferAndMomentsHold) {
  std::set<std::uint32_t> first;
  for (int i = 0; i < 100; ++i) first.insert(Random(7, Stream::test, std::uint64_t(i)).bits());
  EXPECT_EQ(first.size(), 100u);
  Random r(1, Stream::test, 0);
  double sum = 0, square = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = r.normal();
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1, 4 * std::sqrt(2.0 / n));
}

TEST(Curve, PassesThroughKeysAndNeverOvershoots) {
  const std::vector<std::pair<double, double>> keys{{0, 1}, {0.2, 1}, {0.25, 0.3}, {0.6, 0.28}, {1, 0}};
  const Curve c(keys, "c");
  for (const auto& [x, y] : keys) EXPECT_DOUBLE_EQ(c(x), y);
  double last = c(0);
  for (double x = 0; x <= 1; x += 1e-4) {
    EXPECT_LE(c(x), last + 1e-12);
    last = c(x);
  }
  EXPECT_EQ(c(-1), 1);
  EXPECT_EQ(c(2), 0);
}

TEST(Curve, ReproducesStraightLinesAndItsDerivative) {
  const Curve line({{0, 1}, {0.3, 1.6}, {1, 3}}, "line");
  const Curve bent({{0, 0}, {0.4, 0.1}, {1, 1}}, "bent");
  for (double x = 0.05; x < 1; x += 0.05) {
    EXPECT_NEAR(line(x), 1 + 2 * x, 1e-12);
    EXPECT_NEAR(bent.derivative(x), (bent(x + 1e-6) - bent(x - 1e-6)) / 2e-6, 1e-5);
  }
}

TEST(Curve, RefusesKeysThatDoNotAscend) {
  try {
    Curve({{0, 1}, {0.5, 0.5}, {0.5, 0.2}}, "season.water_curve");
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("season.water_curve"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("key 3"), std::string::npos);
    EXPECT_EQ(e.exit_code(), 2);
  }
  EXPECT_THROW(Curve({{0, 1}}, "c"), InvalidInput);
  EXPECT_THROW(Curve({{0, 1}, {NAN, 2}}, "c"), InvalidInput);
}

TEST(Colour, EncodingAndMatricesInvert) {
  for (double x = 0; x <= 1; x += 0.01) EXPECT_NEAR(srgb_decode(srgb_encode(x)), x, 1e-9);
  const glm::dvec3 c(0.2, 0.5, 0.1), back = xyz_to_linear_srgb(linear_srgb_to_xyz(c));
  EXPECT_LT(glm::length(c - back), 1e-5);
  EXPECT_NEAR(srgb_levels({0.18, 0.18, 0.18}).x, 117.5, 0.5);
}

TEST(Fields, UnknownNameSuggestsTheNearest) {
  EXPECT_EQ(field_spec("water").unit, "1");
  try {
    field_spec("stress_vien_MPa");
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("stress_vein_MPa"), std::string::npos);
  }
  for (const TexelField& f : texel_fields()) EXPECT_EQ(field_spec(f.name).components, f.components);
}

TEST(TexelGrid, SparseStorageAddressesVoxels) {
  TexelGrid g(GridShape{16, 8, 12, glm::dvec3(0), 0.5, 0});
  g.reset_bricks({0, 5, 23});
  for (int b = 0; b < g.brick_count(); ++b) {
    const glm::ivec3 base = g.brick_base(b);
    EXPECT_EQ(((base.z / 4) * g.bricks_y() + base.y / 4) * g.bricks_x() + base.x / 4, g.brick_cell(b));
    g.channel(b, TexelChannel::density)[(2 * 4 + 1) * 4 + 3] = float(b + 1);
    EXPECT_EQ(g.at(base.x + 3, base.y + 1, base.z + 2, TexelChannel::density), float(b + 1));
  }
  EXPECT_EQ(g.total_density(), 6);
  EXPECT_EQ(g.occupied_voxels(), 3);
  EXPECT_EQ(g.at(4, 0, 0, TexelChannel::density), 0);
  EXPECT_EQ(g.at(-1, 0, 0, TexelChannel::density), 0);
  g.reset_bricks({5});
  EXPECT_EQ(g.total_density(), 0);
  EXPECT_EQ(g.brick_at(0), -1);
}

TEST(TexelGrid, RefusesBadShapes) {
  EXPECT_THROW(TexelGrid(GridShape{15, 8, 8, glm::dvec3(0), 1, 0}), InvalidInput);
  EXPECT_THROW(TexelGrid(GridShape{16, 8, 8, glm::dvec3(0), 0, 0}), InvalidInput);
}

TEST(Placement, TurnsMirrorsAndShears) {
  TexelInstance t;
  t.origin_m = {2, 3, 1};
  t.slope_x = 0.5;
  const double tile = 0.2;
  EXPECT_LT(glm::distance(to_world(t, tile, {0.05, 0.02, 0.1}), glm::dvec3(2.05, 3.02, 1 + 0.025 + 0.1)), 1e-12);
  t.slope_x = 0;
  t.quarter_turns = 1;  // +x edge goes to +y edge
  EXPECT_LT(glm::distance(to_world(t, tile, {0.2, 0.1, 0}), glm::dvec3(2.1, 3.2, 1)), 1e-12);
  t.mirrored = true;  // mirrored first: +x goes to -x, then to -y
  EXPECT_LT(glm::distance(to_world(t, tile, {0.2, 0.1, 0}), glm::dvec3(2.1, 3.0, 1)), 1e-12);
  t.quarter_turns = 4;
  t.mirrored = false;
  EXPECT_LT(glm::distance(to_world(t, tile, {0.2, 0.1, 0}), glm::dvec3(2.2, 3.1, 1)), 1e-12);
}

TEST(Sun, DirectionIsUnitAndRises) {
  Sun s;
  s.azimuth_deg = 90;
  s.elevation_deg = 30;
  EXPECT_NEAR(glm::length(s.direction()), 1, 1e-12);
  EXPECT_NEAR(s.direction().y, std::cos(M_PI / 6), 1e-12);
  EXPECT_NEAR(s.direction().z, 0.5, 1e-12);
}

TEST(Parallel, CoversEveryItemOnce) {
  ThreadLimit two(2);
  std::vector<int> hits(10007, 0);
  parallel_for(hits.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++hits[i];
  });
  for (int h : hits) ASSERT_EQ(h, 1);
}

}  // namespace
}  // namespace witherfield
