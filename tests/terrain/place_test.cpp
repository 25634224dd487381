// Laws of placement: tiles meet, cover, differ from their neighbours, and do not depend on threads.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "sim/core/parallel.hpp"
#include "tests/terrain/fixtures.hpp"

namespace witherfield::terrain::test {
namespace {

const glm::dvec3 kCamera{10, -20, 15}, kSun{0.3, 0.5, 0.8};

double ground(const TexelInstance& t, double dx, double dy) {
  return t.origin_m.z + t.slope_x * dx + t.slope_y * dy;
}

// The largest step between neighbouring tiles, along the edges that they share.
double largest_step(const Placement& p) {
  double step = 0;
  const double s = p.tile_m;
  for (const TexelInstance& t : p.instances) {
    const std::size_t k = std::size_t(t.cell_j) * std::size_t(p.cells_x) + std::size_t(t.cell_i);
    for (const double a : {0.0, 0.5, 1.0}) {
      if (t.cell_i + 1 < p.cells_x)
        step = std::max(step, std::abs(ground(t, s, a * s) - ground(p.instances[k + 1], 0, a * s)));
      if (t.cell_j + 1 < p.cells_y)
        step = std::max(
            step, std::abs(ground(t, a * s, s) - ground(p.instances[k + std::size_t(p.cells_x)], a * s, 0)));
    }
  }
  return step;
}

class PlaceTest : public TerrainTest {
 protected:
  Terrain wavy() const {
    return from_asc(101, 81, 0.5, [](int i, int j) {
      return 3 * std::sin(0.08 * i + 0.3) * std::cos(0.06 * j) + 0.02 * i;
    });
  }
};

TEST_F(PlaceTest, CoversTheTerrainWithSquareTiles) {
  const Terrain t = wavy();  // 50 m x 40 m
  PlacementOptions o;
  o.cells_x = 20, o.cells_y = 16;
  const Placement p = place_texels(t, o, kCamera, kSun);
  EXPECT_DOUBLE_EQ(p.tile_m, 2.5);
  ASSERT_EQ(p.cells_x, 20);
  ASSERT_EQ(p.cells_y, 16);
  ASSERT_EQ(p.instances.size(), 320u);
  for (std::size_t k = 0; k < p.instances.size(); ++k) {
    EXPECT_EQ(p.instances[k].cell_i, int(k % 20));
    EXPECT_EQ(p.instances[k].cell_j, int(k / 20));
    EXPECT_NEAR(p.instances[k].origin_m.x, 2.5 * double(k % 20), 1e-12);
    EXPECT_NEAR(p.instances[k].origin_m.y, 2.5 * double(k / 20), 1e-12);
  }
}

TEST_F(PlaceTest, RowsThatDoNotFitAreLeftOut) {
  PlacementOptions o;
  o.cells_x = 20, o.cells_y = 40;
  EXPECT_EQ(place_texels(wavy(), o, kCamera, kSun).cells_y, 16);
  o.cells_x = 19;  // tiles of 2.63 m: 15.2 rows
  EXPECT_EQ(place_texels(wavy(), o, kCamera, kSun).cells_y, 15);
  o.cells_x = 1;  // one tile of 50 m does not fit into 40 m
  EXPECT_THROW(place_texels(wavy(), o, kCamera, kSun), InvalidInput);
}

TEST_F(PlaceTest, TilesOnAPlaneMeetExactly) {
  const Terrain t = from_asc(41, 41, 1, [](int i, int j) { return 0.37 * i - 0.21 * j; });
  PlacementOptions o;
  o.cells_x = o.cells_y = 13;
  const Placement p = place_texels(t, o, kCamera, kSun);
  EXPECT_LT(largest_step(p), 1e-9);
  for (const TexelInstance& i : p.instances) {
    EXPECT_NEAR(i.slope_x, 0.37, 1e-9);
    EXPECT_NEAR(i.slope_y, -0.21, 1e-9);
    // However the texel is turned and mirrored, its ground stays in the tile and on the plane.
    for (const glm::dvec3 corner :
         {glm::dvec3(0, 0, 0), glm::dvec3(p.tile_m, 0, 0), glm::dvec3(0, p.tile_m, 0)}) {
      const glm::dvec3 w = to_world(i, p.tile_m, corner);
      EXPECT_NEAR(w.z, t.height(w.x, w.y), 1e-9);
    }
  }
}

TEST_F(PlaceTest, StepsOnSmoothGroundShrinkWithTheSquareOfTheTile) {
  const Terrain t = wavy();
  PlacementOptions o;
  o.cells_x = 25, o.cells_y = 20;
  const double coarse = largest_step(place_texels(t, o, kCamera, kSun));
  o.cells_x = 50, o.cells_y = 40;
  const double fine = largest_step(place_texels(t, o, kCamera, kSun));
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.8);
}

TEST_F(PlaceTest, PlaneIsTheLeastSquaresFitOfTheCorners) {
  const Terrain t = wavy();
  PlacementOptions o;
  o.cells_x = 10, o.cells_y = 8;
  const Placement p = place_texels(t, o, kCamera, kSun);
  for (const TexelInstance& i : p.instances) {
    double sum = 0, sum_x = 0, sum_y = 0;  // residuals are orthogonal to 1, x, y
    for (const double dx : {0.0, p.tile_m})
      for (const double dy : {0.0, p.tile_m}) {
        const double residual = t.height(i.origin_m.x + dx, i.origin_m.y + dy) - ground(i, dx, dy);
        sum += residual, sum_x += residual * dx, sum_y += residual * dy;
      }
    EXPECT_NEAR(sum, 0, 1e-9);
    EXPECT_NEAR(sum_x, 0, 1e-9);
    EXPECT_NEAR(sum_y, 0, 1e-9);
  }
}

TEST_F(PlaceTest, NoTwoNeighboursAreAlikeAndAllEightWaysOccur) {
  const Terrain t = wavy();
  for (const int variants : {1, 3}) {
    PlacementOptions o;
    o.cells_x = 50, o.cells_y = 40, o.variants = variants, o.patchiness = 1;
    const Placement p = place_texels(t, o, kCamera, kSun);
    std::map<int, int> ways;
    const auto way = [](const TexelInstance& i) {
      return (i.variant * 4 + i.quarter_turns) * 2 + i.mirrored;
    };
    for (std::size_t k = 0; k < p.instances.size(); ++k) {
      if (k % 50) {
        EXPECT_NE(way(p.instances[k]), way(p.instances[k - 1]));
      }
      if (k >= 50) {
        EXPECT_NE(way(p.instances[k]), way(p.instances[k - 50]));
      }
      EXPECT_TRUE(p.instances[k].quarter_turns >= 0 && p.instances[k].quarter_turns < 4);
      ++ways[way(p.instances[k])];
    }
    ASSERT_EQ(ways.size(), std::size_t(8 * variants));
    const double mean = 2000.0 / (8 * variants);
    for (const auto& [key, count] : ways) EXPECT_NEAR(count, mean, 5 * std::sqrt(mean)) << key;
  }
}

TEST_F(PlaceTest, LodFollowsTheDistanceUpToItsDither) {
  const Terrain t = wavy();
  PlacementOptions o;
  o.cells_x = 50, o.cells_y = 40;
  o.lod_distance_m[0] = 30, o.lod_distance_m[1] = 38, o.lod_distance_m[2] = 48;
  const Placement p = place_texels(t, o, kCamera, kSun);
  int seen[4] = {}, dithered = 0;
  for (const TexelInstance& i : p.instances) {
    const glm::dvec3 centre = to_world(i, p.tile_m, {p.tile_m / 2, p.tile_m / 2, 0});
    EXPECT_NEAR(i.distance_m, glm::length(centre - kCamera), 1e-9);
    const auto plain = [&](double d) { return d < 30 ? 0 : d < 38 ? 1 : d < 48 ? 2 : 3; };
    EXPECT_GE(i.lod, plain(i.distance_m * 0.95));
    EXPECT_LE(i.lod, plain(i.distance_m * 1.05));
    dithered += i.lod != plain(i.distance_m);
    ++seen[i.lod];
  }
  for (const int count : seen) EXPECT_GT(count, 0);
  EXPECT_GT(dithered, 0);
}

TEST_F(PlaceTest, HeightScaleFillsItsRange) {
  PlacementOptions o;
  o.cells_x = 50, o.cells_y = 40, o.height_scale_lo = 0.5, o.height_scale_hi = 1.5;
  double lo = 9, hi = 0, mean = 0;
  const Placement p = place_texels(wavy(), o, kCamera, kSun);
  for (const TexelInstance& i : p.instances) {
    lo = std::min(lo, i.height_scale), hi = std::max(hi, i.height_scale);
    mean += i.height_scale / double(p.instances.size());
  }
  EXPECT_GE(lo, 0.5);
  EXPECT_LE(hi, 1.5);
  EXPECT_LT(lo, 0.51);
  EXPECT_GT(hi, 1.49);
  EXPECT_NEAR(mean, 1, 0.03);
}

// Share of neighbouring pairs (east) with the same variant.
double togetherness(const Placement& p) {
  int same = 0, pairs = 0;
  for (std::size_t k = 1; k < p.instances.size(); ++k) {
    if (k % std::size_t(p.cells_x) == 0) continue;
    ++pairs;
    same += p.instances[k].variant == p.instances[k - 1].variant;
  }
  return double(same) / pairs;
}

TEST_F(PlaceTest, PatchinessGathersVariantsAndKeepsTheirShares) {
  PlacementOptions o;
  o.cells_x = 50, o.cells_y = 40, o.variants = 4, o.patch_m = 8;
  double together[3];
  int n = 0;
  for (const double patchiness : {0.0, 0.6, 1.0}) {
    o.patchiness = patchiness;
    const Placement p = place_texels(wavy(), o, kCamera, kSun);
    int share[4] = {};
    for (const TexelInstance& i : p.instances) ++share[i.variant];
    for (const int count : share) EXPECT_EQ(count, 500);
    together[n++] = togetherness(p);
  }
  EXPECT_NEAR(together[0], 0.25, 0.05);
  EXPECT_GT(together[1], together[0] + 0.05);
  EXPECT_GT(together[2], 0.7);
}

TEST_F(PlaceTest, SunVisibilityIsThatOfTheTerrain) {
  const Terrain t = from_asc(61, 61, 1, [](int i, int) { return i == 30 ? 8.0 : 0.0; });
  PlacementOptions o;
  o.cells_x = o.cells_y = 20;
  const Placement p = place_texels(t, o, kCamera, {1, 0, 0.5});  // from the east, not of unit length
  for (const TexelInstance& i : p.instances) {
    if (i.cell_i <= 2 || i.cell_i >= 11) {
      EXPECT_EQ(i.sun_visibility, 1.0) << i.cell_i;
    }
    if (i.cell_i >= 6 && i.cell_i <= 8) {
      EXPECT_EQ(i.sun_visibility, 0.0) << i.cell_i;
    }
  }
}

bool same(const Placement& a, const Placement& b) {
  return std::equal(a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(),
                    [](const TexelInstance& x, const TexelInstance& y) {
                      return x.origin_m == y.origin_m && x.slope_x == y.slope_x && x.slope_y == y.slope_y &&
                             x.variant == y.variant && x.quarter_turns == y.quarter_turns &&
                             x.mirrored == y.mirrored && x.height_scale == y.height_scale && x.lod == y.lod &&
                             x.distance_m == y.distance_m && x.sun_visibility == y.sun_visibility;
                    });
}

TEST_F(PlaceTest, SameForAnyThreadCountAndDifferentForAnotherSeed) {
  const Terrain t = wavy();
  PlacementOptions o;
  o.cells_x = 50, o.cells_y = 40, o.variants = 3;
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return place_texels(t, o, kCamera, kSun);
  };
  const Placement one = with_threads(1), two = with_threads(2);
  EXPECT_TRUE(same(one, two));
  o.seed = 2;
  EXPECT_FALSE(same(one, with_threads(2)));
}

TEST_F(PlaceTest, RefusesBadOptions) {
  const Terrain t = wavy();
  const auto refuse = [&](auto&& change) {
    PlacementOptions o;
    change(o);
    EXPECT_THROW(place_texels(t, o, kCamera, kSun), InvalidInput);
  };
  refuse([](PlacementOptions& o) { o.cells_x = 0; });
  refuse([](PlacementOptions& o) { o.cells_y = 1001; });
  refuse([](PlacementOptions& o) { o.lod_distance_m[1] = 0.5; });
  refuse([](PlacementOptions& o) { o.height_scale_lo = 2; });
  refuse([](PlacementOptions& o) { o.height_scale_hi = 4; });
  refuse([](PlacementOptions& o) { o.variants = 0; });
  refuse([](PlacementOptions& o) { o.patchiness = 1.1; });
  refuse([](PlacementOptions& o) { o.patch_m = 0; });
  EXPECT_THROW(place_texels(t, {}, {std::nan(""), 0, 0}, kSun), InvalidInput);
  EXPECT_THROW(place_texels(t, {}, kCamera, {0, 0, 0}), InvalidInput);
}

}  // namespace
}  // namespace witherfield::terrain::test
