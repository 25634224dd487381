// Shadows against geometry.
#include <cmath>
#include <numbers>

#include "tests/terrain/fixtures.hpp"

namespace witherfield::terrain::test {
namespace {

using SunTest = TerrainTest;

constexpr double kDegree = std::numbers::pi / 180;

glm::dvec3 sun(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

double at_ground(const Terrain& t, double x, double y, const glm::dvec3& s) {
  return t.sun_visibility({x, y, t.height(x, y)}, s);
}

// A wall of cells along x = 60 m (north-south).
double wall(int i, int) {
  return i == 60 || i == 61 ? 10.0 : 0.0;
}

TEST_F(SunTest, FlatGroundIsLitWhileTheSunIsUp) {
  const Terrain t = from_asc(20, 20, 1, [](int, int) { return 3.0; });
  for (const double elevation : {5.0, 30.0, 90.0}) EXPECT_EQ(at_ground(t, 7, 9, sun(123, elevation)), 1.0);
  EXPECT_EQ(at_ground(t, 7, 9, sun(123, -1)), 0.0);
  EXPECT_EQ(at_ground(t, 7, 9, sun(123, 0)), 0.0);
}

TEST_F(SunTest, SlopeShadesItselfOnlyWhenItTurnsAway) {
  const Terrain t = from_asc(40, 40, 1, [](int i, int) { return 0.5 * i; });  // rises to the east at 26.6 deg
  EXPECT_EQ(at_ground(t, 20, 20, sun(180, 10)), 1.0);  // sun in the west, faces the slope
  EXPECT_EQ(at_ground(t, 20, 20, sun(0, 40)), 1.0);
  EXPECT_EQ(at_ground(t, 20, 20, sun(0, 15)), 0.0);  // sun in the east, behind the slope
}

TEST_F(SunTest, WallCastsAShadowOfTheRightLength) {
  const Terrain t = from_asc(121, 21, 1, wall);
  const double top =
      t.max_height_m() - t.height(20, 10);  // the smooth wall stands a little higher than its samples
  for (const double elevation : {12.0, 20.0, 35.0}) {
    const glm::dvec3 s =
        sun(0, elevation);  // from the east: the shadow falls to the west of the wall's crest at 60.5 m
    double lit = 0, dark = 59;
    for (int k = 0; k < 40; ++k) {
      const double middle = (lit + dark) / 2;
      (at_ground(t, middle, 10, s) > 0.5 ? lit : dark) = middle;
    }
    // The march starts a tenth of a cell above the ground, where the shadow is that much shorter.
    EXPECT_NEAR(60.5 - lit, (top - 0.1) / std::tan(elevation * kDegree), 0.15) << elevation;
    EXPECT_EQ(at_ground(t, 63, 10, s), 1.0);  // the sunny side
    EXPECT_EQ(at_ground(t, 119, 10, s), 1.0);
    EXPECT_EQ(at_ground(t, 58, 10, s), 0.0);
  }
}

TEST_F(SunTest, ShadowGrowsSofterAlongItsWay) {
  const Terrain t = from_asc(121, 21, 1, wall);
  const glm::dvec3 s = sun(0, 20);
  double previous = 2;
  int soft = 0;
  for (double x = 20; x < 58; x += 0.05) {  // toward the wall: from light into shadow, never brighter again
    const double v = at_ground(t, x, 10, s);
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
    EXPECT_LE(v, previous + 1e-12);
    soft += v > 0 && v < 1;
    previous = v;
  }
  EXPECT_GT(soft, 3);    // an edge, not a step
  EXPECT_LT(soft, 100);  // 5 m
}

TEST_F(SunTest, HighPointsLookOverTheWall) {
  const Terrain t = from_asc(121, 21, 1, wall);
  EXPECT_EQ(t.sun_visibility({50, 10, 0}, sun(0, 20)), 0.0);
  EXPECT_EQ(t.sun_visibility({50, 10, 9}, sun(0, 20)), 1.0);
}

TEST_F(SunTest, ScaleDoesNotChangeShadows) {
  TerrainOptions o = dem(write_asc(121, 21, 1, wall));
  const Terrain real = load_terrain(o);
  o.width_m = 6;
  const Terrain small = load_terrain(o);
  for (double x = 20; x < 60; x += 0.7)
    EXPECT_NEAR(at_ground(real, x, 10, sun(20, 25)), at_ground(small, x * 0.05, 0.5, sun(20, 25)), 1e-6);
}

}  // namespace
}  // namespace witherfield::terrain::test
