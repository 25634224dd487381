// Laws of texel -> points and of riding on blades.
#include "sim/grass/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "tests/grass/blade_fixtures.hpp"
#include "tests/grass/point_fixtures.hpp"

namespace witherfield::grass {
namespace {

using namespace fixtures;
using C = TexelChannel;

GridShape cube(int n, double spacing_m = 0.001) {
  return {n, n, n, glm::dvec3(-0.002, 0.003, 0), spacing_m, 0};
}

/// Every voxel of the bricks at `cells` filled: density(v) and recognisable attributes.
template <class Density>
TexelGrid filled(const GridShape& shape, const std::vector<int>& cells, const Density& density) {
  TexelGrid grid(shape);
  grid.reset_bricks(cells);
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const auto set = [&](C c, float value) { grid.channel(b, c)[v] = value; };
      set(C::density, float(density(b, v)));
      set(C::water, 0.5f + 0.001f * float(v));
      set(C::blade_id, float(b * 100 + v));
      set(C::tissue, float(1 + v % 2));
      set(C::arc, 0.25f);
      set(C::tangent_z, 1);
      set(C::normal_x, v % 2 ? 1.0f : 0.0f);
      set(C::diffuse_g, 0.125f);
    }
  return grid;
}

TEST(SamplePoints, WholeCountsAreExact) {
  const TexelGrid grid = filled(cube(8), {0, 5}, [](int, int v) { return v % 3; });
  const PointSet p = sample_points(grid, 4, 1e-6, 7);
  int expected = 0;
  for (int v = 0; v < 64; ++v) expected += 2 * 4 * (v % 3);
  EXPECT_EQ(int(p.size()), expected);
}

TEST(SamplePoints, EachPointLiesInItsVoxelAndInheritsFromIt) {
  const GridShape shape = cube(8);
  const TexelGrid grid = filled(shape, {1, 6}, [](int, int v) { return 0.1 + 0.01 * v; });
  const PointSet p = sample_points(grid, 6, 2e-6, 3);
  ASSERT_GT(p.size(), 200u);
  std::int32_t previous = -1;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::ivec3 voxel(glm::floor((p.position_m[i] - shape.origin_m) / shape.spacing_m));
    const auto at = [&](C c) { return grid.at(voxel.x, voxel.y, voxel.z, c); };
    EXPECT_EQ(p.blade_id[i], std::int32_t(at(C::blade_id)));
    EXPECT_EQ(p.water[i], at(C::water));
    EXPECT_EQ(p.tissue[i], std::uint8_t(at(C::tissue)));
    EXPECT_EQ(p.diffuse[i].g, 0.125f);
    EXPECT_EQ(p.tangent[i], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normal[i].x, at(C::normal_x));  // zero stays zero: a cone's vein
    EXPECT_EQ(p.mass_kg[i], 2e-6);
    EXPECT_EQ(p.velocity_m_s[i], glm::vec3(0));
    EXPECT_GE(p.blade_id[i], previous) << "ascending (brick, voxel)";
    previous = p.blade_id[i];
  }
}

// Fractional counts: in each voxel the mean over seeds is proportion * density within its standard error.
TEST(SamplePoints, IsUnbiasedInEveryVoxel) {
  const TexelGrid grid = filled(cube(4), {0}, [](int, int v) { return 0.013 * (v + 0.5); });
  constexpr int kSeeds = 4000;
  std::vector<double> count(64, 0);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const PointSet p = sample_points(grid, 2, 1, std::uint64_t(seed));
    for (std::int32_t v : p.blade_id) ++count[std::size_t(v)];
  }
  double chi2 = 0;
  for (int v = 0; v < 64; ++v) {
    const double expected = 2 * 0.013 * (v + 0.5), f = expected - std::floor(expected);
    const double error = std::sqrt(f * (1 - f) / kSeeds);
    const double z = (count[std::size_t(v)] / kSeeds - expected) / error;
    EXPECT_LT(std::abs(z), 4.5) << "voxel " << v;
    chi2 += z * z;
  }
  EXPECT_LT(chi2, 64 + 5 * std::sqrt(2 * 64.0));
}

// The round trip's other half, splat, conserves the points' weight exactly (splat_test); so total density is
// kept in the mean over seeds if the number of points is.
TEST(SamplePoints, KeepsTotalDensityToOnePointAndInTheMeanToOnePartInAMillion) {
  const TexelGrid grid =
      filled(cube(16), {0, 3, 9, 40, 41, 63}, [](int b, int v) { return 30 + 7 * std::sin(b + 0.37 * v); });
  const double expected = 6 * grid.total_density();
  ASSERT_GT(expected, 5e4);
  double sum = 0, squares = 0;
  constexpr int kSeeds = 100;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double off = double(sample_points(grid, 6, 1, std::uint64_t(seed)).size()) - expected;
    EXPECT_LT(std::abs(off), 1);
    sum += off, squares += off * off;
  }
  EXPECT_GT(squares, 0) << "the offset is random";
  EXPECT_LT(std::abs(sum / kSeeds) / expected, 1e-6);
}

TEST(SamplePoints, FillsTheVoxelEvenly) {
  const GridShape shape = cube(4);
  const TexelGrid grid = filled(shape, {0}, [](int, int v) { return v == 21 ? 1.0 : 0.0; });
  const PointSet p = sample_points(grid, 50000, 1, 1);
  glm::dvec3 mean(0), squares(0);
  for (const glm::dvec3& x : p.position_m) {
    const glm::dvec3 u =
        (x - shape.origin_m) / shape.spacing_m - glm::dvec3(1, 1, 1);  // voxel 21 is (1, 1, 1)
    mean += u, squares += u * u;
  }
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(mean[a] / 50000, 0.5, 5 * std::sqrt(1 / 12.0 / 50000));
    EXPECT_NEAR(squares[a] / 50000, 1 / 3.0, 0.01);
  }
}

TEST(SamplePoints, SeedsDifferAndThreadsDoNot) {
  const TexelGrid grid = meadow_texel();
  const auto sample = [&](int threads, std::uint64_t seed) {
    const ThreadLimit limit(threads);
    return sample_points(grid, 6, 1e-6, seed);
  };
  const PointSet one = sample(1, 5);
  ASSERT_GT(one.size(), 10000u);
  EXPECT_TRUE(same_bits(one, sample(2, 5)));
  EXPECT_FALSE(same_bits(one, sample(2, 6)));
}

TEST(SamplePoints, RefusesNonsense) {
  TexelGrid grid = filled(cube(4), {0}, [](int, int) { return 1.0; });
  for (double proportion : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e9})
    EXPECT_THROW(sample_points(grid, proportion, 1, 1), InvalidInput) << proportion;
  EXPECT_THROW(sample_points(grid, 6, 0, 1), InvalidInput);
  for (float density : {-1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    grid.channel(0, C::density)[9] = density;
    EXPECT_THROW(sample_points(grid, 6, 1, 1), InvalidInput) << density;
  }
}

TEST(SamplePoints, EmptyTexelGivesNoPoints) {
  EXPECT_EQ(sample_points(TexelGrid(cube(8)), 6, 1, 1).size(), 0u);
}

class OnBlades : public ::testing::Test {
 protected:
  BladeState state = make_state(BladeForm::ribbon, 24, meadow(20, 0.1));
  PointSet points = points_on(state, 60);
};

TEST_F(OnBlades, AttachThenRideWithTheSameStateGivesThePositionsBack) {
  const PointSet before = points;
  attach_to_blades(points, state);
  ride_on_blades(points, state, state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(glm::length(points.position_m[i] - before.position_m[i]), 1e-9);
    EXPECT_LT(glm::length(points.normal[i] - before.normal[i]), 1e-6f);
    EXPECT_NEAR(glm::length(points.tangent[i]), 1, 1e-6);
  }
}

// The arc that is found is the nearest on the whole blade, however wrong the inherited one was.
TEST_F(OnBlades, AttachFindsTheNearestSpotFromAFarGuess) {
  PointSet far = points;
  for (std::size_t i = 0; i < far.size(); ++i) far.arc[i] = far.arc[i] < 0.5f ? 1.0f : 0.0f;
  attach_to_blades(points, state);
  attach_to_blades(far, state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here = glm::length(points.offset[i]), there = glm::length(far.offset[i]);
    EXPECT_NEAR(here, there, 1e-7);
    EXPECT_NEAR(here, distance_to_blade(state, points.blade_id[i], points.position_m[i]), 1e-7);
  }
}

TEST_F(OnBlades, WrappedPointsReturnToTheirBlade) {
  PointSet wrapped = points;
  for (std::size_t i = 0; i < wrapped.size(); ++i)
    wrapped.position_m[i] += glm::dvec3(0.1 * (int(i % 3) - 1), 0.1 * (int(i % 5) - 2), 0);
  attach_to_blades(points, state, 0, 0.1);
  attach_to_blades(wrapped, state, 0, 0.1);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(glm::length(wrapped.position_m[i] - points.position_m[i]), 1e-12);
}

// The whole state turned rigidly about the vertical and moved: points, normals and tangents turn and move
// with it.
TEST_F(OnBlades, RidesARigidMotionExactly) {
  attach_to_blades(points, state);
  ride_on_blades(points, state, state);
  const PointSet before = points;
  const glm::dquat turn = glm::angleAxis(1.1, glm::dvec3(0, 0, 1));
  const glm::dvec3 shift(0.3, -0.2, 0.05);
  BladeState moved = state;
  for (std::size_t n = 0; n < moved.node_m.size(); ++n) {
    moved.node_m[n] = turn * state.node_m[n] + shift;
    moved.tangent[n] = turn * state.tangent[n];
    moved.side[n] = turn * state.side[n];
    moved.velocity_m_day[n] = glm::dvec3(86400, 0, 2 * 86400);
  }
  ride_on_blades(points, state, moved);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(glm::length(points.position_m[i] - (turn * before.position_m[i] + shift)), 1e-12);
    EXPECT_LT(glm::length(glm::dvec3(points.normal[i]) - turn * glm::dvec3(before.normal[i])), 2e-7);
    EXPECT_LT(glm::length(glm::dvec3(points.tangent[i]) - turn * glm::dvec3(before.tangent[i])), 2e-7);
    EXPECT_LT(glm::length(points.velocity_m_s[i] - glm::vec3(1, 0, 2)), 1e-6f);
  }
}

TEST_F(OnBlades, OffsetsShrinkWithWidthAndThickness) {
  attach_to_blades(points, state);
  ride_on_blades(points, state, state);
  const PointSet before = points;
  BladeState dry = state;
  for (float& w : dry.half_width_m) w *= 0.75f;
  for (float& t : dry.thickness_m) t *= 0.5f;
  ride_on_blades(points, state, dry);
  BladeState none = state;  // without width and thickness everything lies on the centre line
  for (float& w : none.half_width_m) w = 0;
  for (float& t : none.thickness_m) t = 0;
  PointSet centre = before;
  ride_on_blades(centre, state, none);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 fresh = before.position_m[i] - centre.position_m[i],
                     shrunk = points.position_m[i] - centre.position_m[i];
    const double side = before.offset[i].x, normal = before.offset[i].y;
    EXPECT_LE(glm::length(shrunk), glm::length(fresh) + 1e-12);
    if (points.position_m[i].z == 0) continue;  // held by the ground
    EXPECT_NEAR(glm::dot(shrunk, shrunk), 0.5625 * side * side + 0.25 * normal * normal, 1e-12);
  }
}

TEST_F(OnBlades, MaterialFollowsTheBlade) {
  attach_to_blades(points, state);
  ride_on_blades(points, state, state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int b = points.blade_id[i];
    const double arc = points.arc[i];
    EXPECT_NEAR(points.water[i], water_at(b, arc), 1e-6);
    EXPECT_NEAR(points.chlorophyll_ug_cm2[i], 40 * chlorophyll_at(b, arc), 1e-4);
    EXPECT_NEAR(points.stress_vein_MPa[i], -2 - arc, 1e-6);
    EXPECT_NEAR(points.stress_mesophyll_MPa[i], 1 + 0.5 * arc, 1e-6);
    EXPECT_EQ(points.strain_shrink[i], points.tissue[i] == 1 ? kStrainVein : kStrainMesophyll);
    EXPECT_NEAR(points.diffuse[i].r, 0.1 + 0.3 * arc, 1e-6);
  }
}

TEST_F(OnBlades, RootsDoNotMoveAndNothingSinksBelowGround) {
  for (std::size_t i = 0; i < points.size(); i += 60) {
    points.position_m[i] = state.node_m[std::size_t(points.blade_id[i] * state.nodes_per_blade())];
    points.arc[i] = 0;
  }
  attach_to_blades(points, state);
  BladeState fallen = state;  // every blade flat on the ground, pointing along x
  const int nodes = fallen.nodes_per_blade();
  for (std::size_t n = 0; n < fallen.node_m.size(); ++n) {
    const glm::dvec3 root = state.node_m[n / std::size_t(nodes) * std::size_t(nodes)];
    fallen.node_m[n] = root + glm::dvec3(0.004 * double(n % std::size_t(nodes)), 0, 0);
    fallen.tangent[n] = {1, 0, 0};
    fallen.side[n] = {0, 1, 0};
  }
  const PointSet before = points;
  ride_on_blades(points, state, fallen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GE(points.position_m[i].z, 0);
    if (i % 60 == 0) {
      EXPECT_LT(glm::length(points.position_m[i] - before.position_m[i]), 1e-9);
    }
  }
}

TEST_F(OnBlades, BladeIdsCountFromTheFirst) {
  PointSet shifted = points;
  for (std::int32_t& id : shifted.blade_id) id += 1000;
  attach_to_blades(points, state);
  attach_to_blades(shifted, state, 1000);
  EXPECT_EQ(points.arc, shifted.arc);
  EXPECT_THROW(attach_to_blades(shifted, state, 0), InvalidInput);
  EXPECT_THROW(ride_on_blades(shifted, state, state, 1001), InvalidInput);
  const BladeState other = make_state(BladeForm::ribbon, 12, meadow(20, 0.1));
  EXPECT_THROW(ride_on_blades(points, other, state), InvalidInput);
}

TEST_F(OnBlades, AnyThreadCountGivesTheSameBits) {
  points = points_on(state, 600);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    PointSet p = points;
    attach_to_blades(p, state);
    ride_on_blades(p, state, state);
    return p;
  };
  EXPECT_TRUE(same_bits(run(1), run(2)));
}

}  // namespace
}  // namespace witherfield::grass
