// Laws of mingling, of the level-of-detail chain and of folding the margin.
#include "sim/grass/mingle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/voxelize.hpp"
#include "tests/grass/blade_fixtures.hpp"

namespace witherfield::grass {
namespace {

using namespace fixtures;
using C = TexelChannel;

constexpr C kMeans[] = {C::water,         C::chlorophyll_ug_cm2, C::stress_vein_MPa, C::stress_mesophyll_MPa,
                        C::strain_shrink, C::diffuse_r,          C::diffuse_g,       C::diffuse_b,
                        C::specular};

TexelGrid sample(unsigned seed, int resolution = 64, int blades = 60, int first_blade_id = 0) {
  return voxelize(make_state(BladeForm::ribbon, 16, meadow(blades, 0.2, seed)),
                  texel_shape({0.2, resolution, 3}), 0.18, first_blade_id);
}

double area_of(const TexelGrid& g) {
  return g.total_density() * g.shape().spacing_m * g.shape().spacing_m;
}

/// A grid of 8^3 voxels with one voxel set.
TexelGrid one_voxel(float density, float water, glm::vec3 tangent, glm::vec3 normal, float id) {
  TexelGrid g(GridShape{8, 8, 8, glm::dvec3(0), 0.01, 0});
  g.reset_bricks({7});
  const int v = 21;  // voxel (1, 1, 1) of the brick: (5, 5, 5)
  const auto set = [&](C c, float x) { g.channel(0, c)[v] = x; };
  set(C::density, density), set(C::water, water), set(C::blade_id, id), set(C::tissue, id > 1 ? 1 : 2),
      set(C::arc, 0.1f * id);
  for (int k = 0; k < 3; ++k) {
    g.channel(0, TexelChannel(int(C::tangent_x) + k))[v] = tangent[k];
    g.channel(0, TexelChannel(int(C::normal_x) + k))[v] = normal[k];
  }
  return g;
}

TEST(Mingle, OneSampleComesBackBitForBit) {
  const TexelGrid g = sample(1);
  EXPECT_TRUE(same_bits(mingle({&g}), g));
}

TEST(Mingle, DensityIsTheSumAndTheRestTheWeightedMean) {
  const TexelGrid a = one_voxel(0.25f, 0.8f, {0, 0, 1}, {1, 0, 0}, 1),
                  b = one_voxel(0.75f, 0.4f, {0, 0, 1}, {1, 0, 0}, 3);
  for (const TexelGrid& m : {mingle({&a, &b}), mingle({&b, &a})}) {
    EXPECT_EQ(m.at(5, 5, 5, C::density), 1.0f);
    EXPECT_FLOAT_EQ(m.at(5, 5, 5, C::water), 0.5f);
    EXPECT_EQ(m.at(5, 5, 5, C::blade_id), 3);
    EXPECT_EQ(m.at(5, 5, 5, C::tissue), 1);
    EXPECT_EQ(m.at(5, 5, 5, C::arc), 0.1f * 3);
    EXPECT_EQ(m.occupied_voxels(), 1);
  }
}

TEST(Mingle, OnATieTheFirstSampleNamesTheVoxel) {
  const TexelGrid a = one_voxel(0.5f, 1, {0, 0, 1}, {1, 0, 0}, 1),
                  b = one_voxel(0.5f, 1, {0, 0, 1}, {1, 0, 0}, 3);
  EXPECT_EQ(mingle({&a, &b}).at(5, 5, 5, C::blade_id), 1);
  EXPECT_EQ(mingle({&b, &a}).at(5, 5, 5, C::blade_id), 3);
}

TEST(Mingle, OppositeTangentsAreTheSameFibre) {
  const glm::vec3 t = glm::normalize(glm::vec3(1, 2, 3)), n(0.8f, 0, -0.6f);
  const TexelGrid a = one_voxel(0.5f, 1, t, n, 1), b = one_voxel(0.4f, 1, -t, -n, 2);
  const TexelGrid m = mingle({&a, &b});
  EXPECT_NEAR(glm::dot(vector_at(m, 5, 5, 5, C::tangent_x), glm::dvec3(t)), 1, 1e-6);
  EXPECT_NEAR(glm::dot(vector_at(m, 5, 5, 5, C::normal_x), glm::dvec3(n)), 1, 1e-6);
}

TEST(Mingle, ZeroNormalsOfVeinsStayZeroAndDoNotDiluteOthers) {
  const TexelGrid vein = one_voxel(0.5f, 1, {0, 0, 1}, {0, 0, 0}, 1),
                  thin = one_voxel(0.1f, 1, {0, 0, 1}, {0, 1, 0}, 2);
  EXPECT_EQ(glm::length(vector_at(mingle({&vein, &vein}), 5, 5, 5, C::normal_x)), 0);
  EXPECT_NEAR(std::abs(vector_at(mingle({&vein, &thin}), 5, 5, 5, C::normal_x).y), 1, 1e-6);
}

TEST(Mingle, SevenSamplesSumExactlyAndStayWithinRange) {
  std::vector<TexelGrid> grids;
  for (unsigned i = 0; i < 7; ++i) grids.push_back(sample(10 + i, 64, 100, int(100 * i)));
  std::vector<const TexelGrid*> samples;
  for (const TexelGrid& g : grids) samples.push_back(&g);
  const TexelGrid m = mingle(samples);
  int shared = 0;
  for_occupied(m, [&](int i, int j, int k) {
    float rho = 0, densest = 0, id = -1;
    int present = 0;
    for (const TexelGrid& g : grids) {
      const float r = g.at(i, j, k, C::density);
      rho += r, present += r > 0;
      if (r > densest) densest = r, id = g.at(i, j, k, C::blade_id);
    }
    shared += present > 1;
    ASSERT_EQ(m.at(i, j, k, C::density), rho);
    ASSERT_EQ(m.at(i, j, k, C::blade_id), id);
    ASSERT_NEAR(glm::length(vector_at(m, i, j, k, C::tangent_x)), 1, 1e-6);
    ASSERT_NEAR(glm::length(vector_at(m, i, j, k, C::normal_x)), 1, 1e-6);
    for (C c : kMeans) {
      float lo = std::numeric_limits<float>::max(), hi = -lo;
      double mean = 0;
      for (const TexelGrid& g : grids) {
        const float r = g.at(i, j, k, C::density), x = g.at(i, j, k, c);
        if (!(r > 0)) continue;
        lo = std::min(lo, x), hi = std::max(hi, x), mean += double(r) * x / rho;
      }
      ASSERT_GE(m.at(i, j, k, c), lo);
      ASSERT_LE(m.at(i, j, k, c), hi);
      ASSERT_NEAR(m.at(i, j, k, c), mean, 1e-5 * (1 + std::abs(mean)));
    }
  });
  EXPECT_GT(shared, 1000);
  std::int64_t voxels = 0;  // nothing is lost: occupied where any sample is
  for (const TexelGrid& g : grids)
    for_occupied(g, [&](int i, int j, int k) { voxels += m.at(i, j, k, C::density) > 0 ? 0 : 1; });
  EXPECT_EQ(voxels, 0);
}

TEST(Mingle, RejectsNoneAndUnequalGrids) {
  const TexelGrid a = sample(1, 32, 5), b = sample(1, 64, 5);
  EXPECT_THROW(mingle({}), InvalidInput);
  EXPECT_THROW(mingle({&a, &b}), InvalidInput);
}

TEST(HalfResolution, ChainConservesBladeArea) {
  TexelGrid g = sample(3, 256);
  const double area = area_of(g);
  for (int n : {128, 64, 32}) {
    g = half_resolution(g);
    EXPECT_EQ(g.shape().nx, n);
    EXPECT_EQ(g.shape(), texel_shape({0.2, n, 3}));
    EXPECT_NEAR(area_of(g) / area, 1, 1e-6);
  }
}

TEST(HalfResolution, EqualsVoxelisingAtHalfTheResolution) {
  const TexelGrid half = half_resolution(sample(4, 128)), direct = sample(4, 64);
  EXPECT_LT(density_difference(half, direct), 1e-5);
  for_occupied(direct, [&](int i, int j, int k) {
    if (direct.at(i, j, k, C::density) < 1e-3) return;
    for (C c : kMeans) ASSERT_NEAR(half.at(i, j, k, c), direct.at(i, j, k, c), 1e-3) << int(c);
  });
}

TEST(HalfResolution, AttributesAreWeightedMeansOfTheChildren) {
  TexelGrid g(GridShape{8, 8, 8, glm::dvec3(0), 0.01, 2});
  g.reset_bricks({0});
  // Children (2, 0, 0) and (3, 1, 1) of coarse voxel (1, 0, 0).
  const int a = 2, b = 16 + 4 + 3;
  g.channel(0, C::density)[a] = 3, g.channel(0, C::density)[b] = 1;
  g.channel(0, C::water)[a] = 0.2f, g.channel(0, C::water)[b] = 0.6f;
  g.channel(0, C::blade_id)[a] = 8, g.channel(0, C::blade_id)[b] = 9;
  g.channel(0, C::tangent_z)[a] = 1, g.channel(0, C::tangent_z)[b] = -1;
  const TexelGrid h = half_resolution(g);
  EXPECT_EQ(h.shape(), (GridShape{4, 4, 4, glm::dvec3(0), 0.02, 1}));
  EXPECT_EQ(h.occupied_voxels(), 1);
  EXPECT_EQ(h.at(1, 0, 0, C::density), 1);
  EXPECT_FLOAT_EQ(h.at(1, 0, 0, C::water), 0.3f);
  EXPECT_EQ(h.at(1, 0, 0, C::blade_id), 8);
  EXPECT_FLOAT_EQ(h.at(1, 0, 0, C::tangent_z), 1);
}

TEST(HalfResolution, RejectsOddShapes) {
  EXPECT_THROW(half_resolution(TexelGrid(GridShape{12, 8, 8, glm::dvec3(0), 0.01, 0})), InvalidInput);
  EXPECT_THROW(half_resolution(TexelGrid(GridShape{8, 8, 8, glm::dvec3(0), 0.01, 1})), InvalidInput);
}

// Folding the margin is the same as wrapping the blades at the tile's edge in the first place.
TEST(FoldToTile, EqualsVoxelisingThePeriodicTile) {
  for (int sixteenths : {0, 2, 3, 6}) {
    const BladeState state = make_state(BladeForm::ribbon, 16, meadow(60, 0.2));
    const GridShape shape = texel_shape({0.2, 128, sixteenths});
    GridShape bare = shape;
    bare.nx = bare.ny = shape.nx - 2 * shape.margin, bare.margin = 0, bare.origin_m = glm::dvec3(0);
    const TexelGrid direct = voxelize(state, bare, 0.18), folded = fold_to_tile(voxelize(state, shape, 0.18));
    EXPECT_EQ(folded.shape().nx, bare.nx);
    EXPECT_EQ(folded.shape().margin, 0);
    EXPECT_NEAR(folded.shape().origin_m.x, 0, 1e-15);
    EXPECT_NEAR(folded.shape().tile_m(), 0.2, 1e-12);
    EXPECT_NEAR(folded.total_density() / direct.total_density(), 1, 1e-6);
    double worst = 0, worst_water = 0;
    for_occupied(direct, [&](int i, int j, int k) {
      const float rho = direct.at(i, j, k, C::density);
      worst = std::max(worst, std::abs(double(rho) - double(folded.at(i, j, k, C::density))));
      if (rho > 1e-2)
        worst_water = std::max(worst_water, std::abs(double(direct.at(i, j, k, C::water)) -
                                                     double(folded.at(i, j, k, C::water))));
    });
    EXPECT_LT(worst, 1e-5) << sixteenths;
    EXPECT_LT(worst_water, 1e-4) << sixteenths;
  }
}

TEST(FoldToTile, WorksWhereTheMarginCutsBricks) {
  // Resolution 32 with 3/16: margin 6 is no multiple of the brick's edge, the tile of 20 is.
  const TexelGrid g = sample(5, 32), folded = fold_to_tile(g);
  EXPECT_EQ(folded.shape().nx, 20);
  EXPECT_NEAR(folded.total_density() / g.total_density(), 1, 1e-6);
  for_occupied(folded, [&](int i, int j, int k) {
    double sum = 0;
    for (int y = j + 6 - 20; y < 32; y += 20)
      for (int x = i + 6 - 20; x < 32; x += 20) sum += g.at(x, y, k, C::density);
    ASSERT_NEAR(folded.at(i, j, k, C::density), sum, 1e-5);
  });
}

TEST(FoldToTile, RejectsATileThatCutsBricks) {
  EXPECT_THROW(fold_to_tile(TexelGrid(GridShape{16, 16, 16, glm::dvec3(0), 0.01, 3})), InvalidInput);
  EXPECT_THROW(fold_to_tile(TexelGrid(GridShape{16, 16, 16, glm::dvec3(0), 0.01, 8})), InvalidInput);
}

TEST(Mingle, SameBitsForAnyNumberOfThreads) {
  const TexelGrid a = sample(6), b = sample(7), c = sample(8);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<TexelGrid> out;
    out.push_back(mingle({&a, &b, &c}));
    out.push_back(half_resolution(out[0]));
    out.push_back(fold_to_tile(out[0]));
    return out;
  };
  const std::vector<TexelGrid> one = with(1), two = with(2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(same_bits(one[i], two[i])) << i;
}

}  // namespace
}  // namespace witherfield::grass
