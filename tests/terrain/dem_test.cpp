// Laws of the height field made from a DEM: planes stay planes, C1, scale, crop, units.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/random.hpp"
#include "tests/terrain/fixtures.hpp"

namespace witherfield::terrain::test {
namespace {

using DemTest = TerrainTest;

double rough(int i, int j) {
  return 20 * Random(7, Stream::test, std::uint64_t(j) * 1000 + std::uint64_t(i)).uniform();
}

TEST_F(DemTest, PlaneStaysAPlaneUpToItsEdges) {
  const Terrain t = from_asc(9, 7, 10, [](int i, int j) { return 100 + 3.0 * i - 2.0 * j; });
  EXPECT_DOUBLE_EQ(t.width_m(), 80);
  EXPECT_DOUBLE_EQ(t.depth_m(), 60);
  EXPECT_NEAR(t.max_height_m(), 3 * 8 + 2 * 6, 1e-9);
  for (double x = 0; x <= 80; x += 3.7)
    for (double y = 0; y <= 60; y += 2.9) {
      EXPECT_NEAR(t.true_elevation_m(x, y), 100 + 0.3 * x - 0.2 * y, 1e-9);
      EXPECT_NEAR(t.height(x, y), 12 + 0.3 * x - 0.2 * y, 1e-9);
      EXPECT_LT(glm::length(t.normal(x, y) - glm::normalize(glm::dvec3(-0.3, 0.2, 1))), 1e-12);
    }
}

TEST_F(DemTest, PassesThroughItsSamplesWithNorthUp) {
  const Terrain t = from_asc(6, 5, 2, rough);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(t.true_elevation_m(2 * i, 2 * j), rough(i, j), 1e-12) << i << ' ' << j;
}

TEST_F(DemTest, SlopeIsContinuousAcrossCells) {
  const Terrain t = from_asc(8, 8, 1, rough);
  const double e = 1e-7;
  for (int cell = 1; cell < 7; ++cell)
    for (double along = 0.13; along < 7; along += 0.37) {
      const auto slope_x = [&](double x) {
        return (t.height(x + e, along) - t.height(x - e, along)) / (2 * e);
      };
      const auto slope_y = [&](double y) {
        return (t.height(along, y + e) - t.height(along, y - e)) / (2 * e);
      };
      EXPECT_NEAR(slope_x(cell - 3 * e), slope_x(cell + 3 * e), 1e-4);
      EXPECT_NEAR(slope_y(cell - 3 * e), slope_y(cell + 3 * e), 1e-4);
      EXPECT_LT(glm::length(t.normal(cell - 1e-12, along) - t.normal(cell + 1e-12, along)), 1e-9);
    }
}

TEST_F(DemTest, NormalIsThatOfFiniteDifferencesAtAnyScale) {
  TerrainOptions o = dem(write_asc(8, 6, 5, rough));
  o.width_m = 3;
  o.vertical_exaggeration = 1.7;
  const Terrain t = load_terrain(o);
  const double e = 1e-5;
  for (double x = 0.11; x < t.width_m() - 0.1; x += 0.23)
    for (double y = 0.09; y < t.depth_m() - 0.1; y += 0.19) {
      const double dx = (t.height(x + e, y) - t.height(x - e, y)) / (2 * e);
      const double dy = (t.height(x, y + e) - t.height(x, y - e)) / (2 * e);
      EXPECT_LT(glm::length(t.normal(x, y) - glm::normalize(glm::dvec3(-dx, -dy, 1))), 1e-6);
    }
}

TEST_F(DemTest, ScalingKeepsTheRelief) {
  TerrainOptions o = dem(write_asc(11, 9, 10, rough));
  const Terrain real = load_terrain(o);
  o.width_m = 8;
  const Terrain small = load_terrain(o);
  o.vertical_exaggeration = 2.5;
  const Terrain tall = load_terrain(o);
  EXPECT_DOUBLE_EQ(real.horizontal_scale(), 1);
  EXPECT_DOUBLE_EQ(small.horizontal_scale(), 8.0 / 100);
  EXPECT_DOUBLE_EQ(small.width_m(), 8);
  EXPECT_NEAR(small.depth_m(), 80 * 0.08, 1e-12);
  EXPECT_NEAR(small.max_height_m() / small.width_m(), real.max_height_m() / real.width_m(), 1e-12);
  for (double x = 0; x <= 100; x += 7.3) {
    EXPECT_NEAR(small.height(0.08 * x, 3), 0.08 * real.height(x, 3 / 0.08), 1e-9);
    EXPECT_NEAR(tall.height(0.08 * x, 3), 2.5 * small.height(0.08 * x, 3), 1e-9);
    EXPECT_NEAR(tall.true_elevation_m(0.08 * x, 3), real.true_elevation_m(x, 3 / 0.08), 1e-9);
  }
}

// The interpolant overshoots its samples; the lowest and highest points are those of the surface, not of the
// samples.
TEST_F(DemTest, LowestPointIsAtZeroAndHighestAtMaxHeight) {
  TerrainOptions o = dem(write_asc(10, 10, 1, rough));
  o.crop[0] = 0.07, o.crop[1] = 0.13, o.crop[2] = 0.83, o.crop[3] = 0.91;
  const Terrain t = load_terrain(o);
  double lo = 1e9, hi = -1e9;
  const double datum = t.true_elevation_m(0, 0) - t.height(0, 0);
  const int n = 1500;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = t.width_m() * i / n, y = t.depth_m() * j / n, h = t.height(x, y);
      ASSERT_NEAR(t.true_elevation_m(x, y) - h, datum, 1e-5);  // nothing is cut off at zero
      lo = std::min(lo, h);
      hi = std::max(hi, h);
    }
  EXPECT_GE(lo, 0);
  EXPECT_LT(lo, 1e-3);
  EXPECT_LE(hi, t.max_height_m() + 1e-5);
  EXPECT_GT(hi, t.max_height_m() - 1e-3);
}

TEST_F(DemTest, CropIsAWindowOfTheWhole) {
  TerrainOptions o = dem(write_asc(21, 11, 1, rough));
  const Terrain whole = load_terrain(o);
  o.crop[0] = 0.23, o.crop[1] = 0.31, o.crop[2] = 0.77, o.crop[3] = 0.69;
  const Terrain part = load_terrain(o);
  EXPECT_NEAR(part.width_m(), 20 * 0.54, 1e-12);
  EXPECT_NEAR(part.depth_m(), 10 * 0.38, 1e-12);
  for (double x = 0; x <= part.width_m(); x += 0.31)
    for (double y = 0; y <= part.depth_m(); y += 0.27) {
      EXPECT_NEAR(part.true_elevation_m(x, y), whole.true_elevation_m(x + 4.6, y + 3.1), 1e-11);
      EXPECT_LT(glm::length(part.normal(x, y) - whole.normal(x + 4.6, y + 3.1)), 1e-11);
    }
}

TEST_F(DemTest, PointsOutsideAreClampedToTheEdge) {
  const Terrain t = from_asc(5, 5, 1, rough);
  EXPECT_EQ(t.height(-3, 2), t.height(0, 2));
  EXPECT_EQ(t.height(9, 7), t.height(4, 4));
}

TEST_F(DemTest, FlatGroundHasNoHeight) {
  const Terrain t = from_asc(4, 4, 1, [](int, int) { return 250.0; });
  EXPECT_EQ(t.max_height_m(), 0);
  EXPECT_EQ(t.height(1.3, 2.2), 0);
  EXPECT_NEAR(t.true_elevation_m(1.3, 2.2), 250, 1e-12);
  EXPECT_LT(glm::length(t.normal(1.3, 2.2) - glm::dvec3(0, 0, 1)), 1e-12);
}

TEST_F(DemTest, TiffAndAsciiGridOfTheSameGroundAgree) {
  Tiff tiff;
  tiff.nx = 7, tiff.ny = 6, tiff.dx = tiff.dy = 4, tiff.height = rough, tiff.epsg = 32633;
  const Terrain a = load_terrain(dem(write_tiff(tiff))), b = from_asc(7, 6, 4, rough);
  for (double x = 0; x <= a.width_m(); x += 1.7)
    for (double y = 0; y <= a.depth_m(); y += 1.3) EXPECT_NEAR(a.height(x, y), b.height(x, y), 1e-9);
}

TEST_F(DemTest, DegreesBecomeMetresOnTheEllipsoid) {
  Tiff tiff;
  tiff.nx = tiff.ny = 3, tiff.dx = tiff.dy = 0.001, tiff.epsg = 4326;
  // At the equator a degree is a * pi / 180 = 111319.491 m east and a (1 - e^2) pi / 180 = 110574.276 m north
  // (WGS 84).
  tiff.west = 10, tiff.south = -0.0015;
  const Terrain equator = load_terrain(dem(write_tiff(tiff, "a.tif")));
  EXPECT_NEAR(equator.width_m(), 222.638982, 1e-4);
  EXPECT_NEAR(equator.depth_m(), 221.148552, 1e-4);
  // At 60 deg: 55800.0 m and 111412.3 m (tables of the WGS 84 graticule).
  tiff.south = 59.9985;
  const Terrain north = load_terrain(dem(write_tiff(tiff, "b.tif")));
  EXPECT_NEAR(north.width_m(), 2 * 55.8000, 2e-4);
  EXPECT_NEAR(north.depth_m(), 2 * 111.4123, 2e-4);
}

TEST_F(DemTest, FeetBecomeMetres) {
  Tiff tiff;
  tiff.unit = "ft";
  tiff.height = [](int i, int) { return 100.0 * i; };
  const Terrain t = load_terrain(dem(write_tiff(tiff)));
  EXPECT_NEAR(t.true_elevation_m(3, 1), 300 * 0.3048, 1e-9);
  EXPECT_DOUBLE_EQ(t.width_m(), 3);
}

TEST_F(DemTest, SixteenBitPngTakesItsScaleFromTheOptions) {
  TerrainOptions o = dem(write_png(5, 4, [](int i, int j) { return 1000.0 * i + 10.0 * j + 7; }));
  o.png_elevation_per_unit_m = 0.01;
  o.png_cell_m = 2.5;
  const Terrain t = load_terrain(o);
  EXPECT_DOUBLE_EQ(t.width_m(), 10);
  EXPECT_DOUBLE_EQ(t.depth_m(), 7.5);
  EXPECT_NEAR(t.true_elevation_m(10, 7.5), 40.37, 1e-9);
  EXPECT_NEAR(t.max_height_m(), 40.30, 1e-9);
}

TEST_F(DemTest, MeshOfTheTerrainLiesOnIt) {
  const Terrain t = from_asc(9, 7, 3, rough);
  const TriMesh m = terrain_mesh(t, 12, 10);
  ASSERT_EQ(m.n_vertices(), 13u * 11u);
  ASSERT_EQ(m.n_faces(), 2u * 12u * 10u);
  for (const auto v : m.vertices()) {
    const auto p = m.point(v), n = m.normal(v);
    EXPECT_NEAR(p[2], t.height(p[0], p[1]), 1e-12);
    EXPECT_LT(glm::length(glm::dvec3(n[0], n[1], n[2]) - t.normal(p[0], p[1])), 1e-12);
  }
  double area_seen_from_above = 0;
  for (const auto f : m.faces()) {
    EXPECT_GT(m.normal(f)[2], 0);
    area_seen_from_above += m.calc_face_area(f) * m.normal(f)[2];
  }
  EXPECT_NEAR(area_seen_from_above, t.width_m() * t.depth_m(), 1e-9);
  EXPECT_THROW(terrain_mesh(t, 0, 5), InvalidInput);
}

// --- the DEMs that ship with the examples

double extreme_sample(const Terrain& t, int nx, int ny, bool highest) {
  double value = t.true_elevation_m(0, 0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double z = t.true_elevation_m(t.width_m() * i / (nx - 1), t.depth_m() * j / (ny - 1));
      value = highest ? std::max(value, z) : std::min(value, z);
    }
  return value;
}

TEST_F(DemTest, MaungaWhau) {
  const Terrain t = load_terrain(dem(WITHERFIELD_EXAMPLE_DATA "/maunga_whau.asc"));
  EXPECT_DOUBLE_EQ(t.width_m(), 860);
  EXPECT_DOUBLE_EQ(t.depth_m(), 600);
  EXPECT_NEAR(extreme_sample(t, 87, 61, false), 94, 1e-9);
  EXPECT_NEAR(extreme_sample(t, 87, 61, true), 195, 1e-9);
  EXPECT_NEAR(t.max_height_m(), 101, 1.0);
  EXPECT_NEAR(t.true_elevation_m(0, 0), 100, 1e-9);    // R: volcano[1, 1]
  EXPECT_NEAR(t.true_elevation_m(0, 600), 103, 1e-9);  // volcano[1, 61]
}

TEST_F(DemTest, Jacksboro) {
  const Terrain t = load_terrain(dem(WITHERFIELD_EXAMPLE_DATA "/jacksboro.tif"));
  // 402 and 343 steps of 3" at latitude 36.5896: 74.57 m and 92.48 m.
  EXPECT_NEAR(t.width_m(), 402 * 74.57, 402 * 0.05);
  EXPECT_NEAR(t.depth_m(), 343 * 92.48, 343 * 0.05);
  EXPECT_NEAR(extreme_sample(t, 403, 344, false), 236, 1e-6);
  EXPECT_NEAR(extreme_sample(t, 403, 344, true), 1076, 1e-6);
  EXPECT_NEAR(t.true_elevation_m(0, t.depth_m()), 483,
              1e-6);  // first value of the file: its north-west corner
}

}  // namespace
}  // namespace witherfield::terrain::test
