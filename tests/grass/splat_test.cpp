// Laws of points -> texel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/points.hpp"
#include "tests/grass/point_fixtures.hpp"

namespace witherfield::grass {
namespace {

using namespace fixtures;
using C = TexelChannel;

constexpr double kSpacing = 0.001;

GridShape cube(int n, int margin = 0) {
  return {n, n, n, glm::dvec3(-margin * kSpacing, -margin * kSpacing, 0), kSpacing, margin};
}

glm::dvec3 place(const GridShape& shape, const glm::dvec3& voxels) {
  return shape.origin_m + voxels * shape.spacing_m;
}

double total_weight(const PointSet& p) {
  return std::accumulate(p.mass_kg.begin(), p.mass_kg.end(), 0.0) / p.point_mass_kg;
}

/// Straight from the definition, in doubles and without any trick: weight of a point at voxel (i, j, k).
class Reference {
 public:
  Reference(const GridShape& shape, double sigma, const glm::dvec3& voxels) : sigma_(sigma), at_(voxels) {
    const int reach = std::max(1, int(std::ceil(2 * sigma)));
    const glm::ivec3 own(glm::floor(voxels)), size(shape.nx, shape.ny, shape.nz);
    lo = glm::max(own - reach, glm::ivec3(0)), hi = glm::min(own + reach, size - 1);
    for (int k = lo.z; k <= hi.z; ++k)
      for (int j = lo.y; j <= hi.y; ++j)
        for (int i = lo.x; i <= hi.x; ++i) sum_ += gauss(i, j, k);
  }
  double weight(int i, int j, int k) const {
    if (i < lo.x || j < lo.y || k < lo.z || i > hi.x || j > hi.y || k > hi.z) return 0;
    return gauss(i, j, k) / sum_;
  }
  glm::ivec3 lo, hi;

 private:
  double gauss(int i, int j, int k) const {
    const glm::dvec3 d = glm::dvec3(i, j, k) + 0.5 - at_;
    return std::exp(-glm::dot(d, d) / (2 * sigma_ * sigma_));
  }
  double sigma_, sum_ = 0;
  glm::dvec3 at_;
};

TEST(SplatPoints, OnePointIsTheGaussianOverItsCube) {
  const GridShape shape = cube(32);
  for (double sigma : {0.3, 0.6, 1.0, 2.5})
    for (const glm::dvec3 at :
         {glm::dvec3(15.2, 12.5, 17.97), glm::dvec3(16, 15.999, 12.01), glm::dvec3(0.1, 31.9, 3)}) {
      PointSet p = plain_points(1);
      p.position_m[0] = place(shape, at);
      p.mass_kg[0] = 3;
      TexelGrid grid;
      splat_points(p, shape, sigma, grid);
      const Reference reference(shape, sigma, at);
      for (int k = 0; k < 32; ++k)
        for (int j = 0; j < 32; ++j)
          for (int i = 0; i < 32; ++i) {
            const double expected = 3 * reference.weight(i, j, k) / 6;
            EXPECT_NEAR(grid.at(i, j, k, C::density), expected, 1e-6 * expected + 1e-15)
                << sigma << ": " << i << ' ' << j << ' ' << k;
          }
    }
}

TEST(SplatPoints, KeepsTheTotalWeightWhereverPointsLie) {
  for (int margin : {0, 8}) {
    const GridShape shape = cube(64, margin);
    // Also outside the grid: wrapped in x and y, clamped in z.
    const PointSet p = random_points(20000, place(shape, glm::dvec3(-100, -100, -5)),
                                     place(shape, glm::dvec3(200, 150, 70)));
    TexelGrid grid;
    for (double sigma : {0.6, 1.7}) {
      splat_points(p, shape, sigma, grid);
      EXPECT_NEAR(grid.total_density() * p.proportion / total_weight(p), 1, 1e-6);
    }
  }
}

TEST(SplatPoints, WrapsByWholeTilesAndClampsInHeight) {
  const GridShape shape = cube(32, 4);  // the tile is 24 voxels wide
  const glm::dvec3 inside(10.3, 20.6, 9.2);
  const auto splat = [&](const glm::dvec3& voxels) {
    PointSet p = plain_points(1);
    p.position_m[0] = place(shape, voxels);
    TexelGrid grid;
    splat_points(p, shape, 0.6, grid);
    return grid;
  };
  const TexelGrid expected = splat(inside);
  EXPECT_LT(density_difference(splat(inside + glm::dvec3(24, -48, 0)), expected), 1e-7);
  EXPECT_LT(density_difference(splat(inside + glm::dvec3(-24 * 3, 24, 0)), expected), 1e-7);
  EXPECT_LT(density_difference(splat({10.3, 20.6, -7}), splat({10.3, 20.6, 0})), 1e-7);
  EXPECT_LT(density_difference(splat({10.3, 20.6, 99}), splat({10.3, 20.6, 31.9999999})), 1e-7);
  EXPECT_GT(splat({10.3, 20.6, 99}).at(10, 20, 31, C::density), 0.03f);
  // The margin belongs to the grid: nothing is moved there.
  EXPECT_GT(splat({1.5, 20.6, 9.2}).at(1, 20, 9, C::density), 0.03f);
}

TEST(SplatPoints, AttributesAreWeightedMeans) {
  const GridShape shape = cube(16);
  PointSet p = random_points(200, place(shape, glm::dvec3(5)), place(shape, glm::dvec3(9)));
  TexelGrid grid;
  splat_points(p, shape, 0.6, grid);
  std::vector<Reference> references;
  for (const glm::dvec3& x : p.position_m)
    references.emplace_back(shape, 0.6, (x - shape.origin_m) / kSpacing);
  for_occupied(grid, [&](int i, int j, int k) {
    double weight = 0, water = 0, strain = 0, red = 0, heaviest = 0;
    std::size_t leader = 0;
    for (std::size_t n = 0; n < p.size(); ++n) {
      const double w = references[n].weight(i, j, k) * p.mass_kg[n];
      weight += w, water += w * p.water[n], strain += w * p.strain_shrink[n], red += w * p.diffuse[n].r;
      if (w > heaviest) heaviest = w, leader = n;
    }
    EXPECT_NEAR(grid.at(i, j, k, C::density), weight / 6, 1e-5 * weight);
    EXPECT_NEAR(grid.at(i, j, k, C::water), water / weight, 1e-5);
    EXPECT_NEAR(grid.at(i, j, k, C::strain_shrink), strain / weight, 1e-5);
    EXPECT_NEAR(grid.at(i, j, k, C::diffuse_r), red / weight, 1e-5);
    EXPECT_EQ(grid.at(i, j, k, C::blade_id), float(p.blade_id[leader]));
    EXPECT_EQ(grid.at(i, j, k, C::tissue), float(p.tissue[leader]));
    EXPECT_EQ(grid.at(i, j, k, C::arc), p.arc[leader]);
    const glm::dvec3 t = vector_at(grid, i, j, k, C::tangent_x), n = vector_at(grid, i, j, k, C::normal_x);
    EXPECT_NEAR(glm::length(t), 1, 1e-6);
    EXPECT_NEAR(glm::length(n), 1, 1e-6);
    EXPECT_GE(t.z, 0);
    EXPECT_GE(glm::dot(n, glm::dvec3(p.normal[leader])), -1e-6);
  });
}

// t and -t are the same fibre: a voxel with both keeps the direction, and the mean of two axes lies between
// them.
TEST(SplatPoints, TangentsAreAxial) {
  const GridShape shape = cube(16);
  PointSet p = plain_points(2);
  p.position_m = {place(shape, glm::dvec3(8.5)), place(shape, glm::dvec3(8.5))};
  const glm::vec3 t = glm::normalize(glm::vec3(0.6f, -0.2f, 0.5f));
  p.tangent = {t, -t};
  TexelGrid grid;
  splat_points(p, shape, 0.6, grid);
  EXPECT_LT(glm::length(vector_at(grid, 8, 8, 8, C::tangent_x) - glm::dvec3(t)), 1e-6);
  p.tangent = {glm::vec3(0.6f, 0, 0.8f),
               glm::vec3(0.6f, 0, -0.8f)};  // the axes are nearer to each other across z
  splat_points(p, shape, 0.6, grid);
  EXPECT_NEAR(vector_at(grid, 8, 8, 8, C::tangent_x).z, 1, 1e-5);
}

TEST(SplatPoints, NoNormalWherePointsHaveNone) {
  const GridShape shape = cube(16);
  PointSet p = plain_points(1);
  p.position_m[0] = place(shape, glm::dvec3(8.5));
  p.normal[0] = glm::vec3(0);
  TexelGrid grid;
  splat_points(p, shape, 0.6, grid);
  EXPECT_EQ(vector_at(grid, 8, 8, 8, C::normal_x), glm::dvec3(0));
  EXPECT_EQ(vector_at(grid, 8, 8, 8, C::tangent_x), glm::dvec3(0, 0, 1));
}

TEST(SplatPoints, EmptySpaceIsEmptyAndEverythingIsFinite) {
  const GridShape shape = cube(64);
  const PointSet p = random_points(3000, place(shape, glm::dvec3(8)), place(shape, glm::dvec3(20)));
  TexelGrid grid;
  splat_points(p, shape, 0.6, grid);
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v)
      for (int c = 0; c < kTexelChannels; ++c) {
        const float value = grid.channel(b, C(c))[v];
        EXPECT_TRUE(std::isfinite(value));
        if (grid.channel(b, C::density)[v] == 0) {
          EXPECT_EQ(value, 0);
        }
      }
  const TexelGrid::Box box = grid.occupied_box();
  for (int a = 0; a < 3; ++a) {
    EXPECT_GE(box.lo[a], 6);
    EXPECT_LE(box.hi[a], 22);
  }
}

TEST(SplatPoints, ReusesTheGridWithoutTrace) {
  const GridShape shape = cube(64);
  const PointSet many = random_points(5000, place(shape, glm::dvec3(0)), place(shape, glm::dvec3(64)), 5, 1);
  const PointSet few = random_points(50, place(shape, glm::dvec3(30)), place(shape, glm::dvec3(60)), 5, 2);
  TexelGrid fresh, used;
  splat_points(few, shape, 0.6, fresh);
  splat_points(many, shape, 0.6, used);
  splat_points(few, shape, 0.6, used);
  EXPECT_TRUE(same_bits(fresh, used));
  splat_points(plain_points(0), shape, 0.6, used);
  EXPECT_EQ(used.brick_count(), 0);
}

TEST(SplatPoints, AnyThreadCountGivesTheSameBits) {
  const GridShape shape = cube(64);
  const PointSet p = random_points(20000, place(shape, glm::dvec3(0)), place(shape, glm::dvec3(64)));
  TexelGrid one, two;
  {
    const ThreadLimit limit(1);
    splat_points(p, shape, 0.6, one);
  }
  {
    const ThreadLimit limit(2);
    splat_points(p, shape, 0.6, two);
  }
  EXPECT_TRUE(same_bits(one, two));
}

// Texel -> points -> texel: density of the two differs by the blur and the drawing only, the total by one
// point.
TEST(RoundTrip, KeepsTotalDensityBladeAndFrame) {
  const TexelGrid before = meadow_texel();
  const PointSet p = sample_points(before, 6, 1e-6, 1);
  TexelGrid after;
  splat_points(p, before.shape(), 0.6, after);
  EXPECT_NEAR(after.total_density() * 6, double(p.size()), 1e-6 * double(p.size()));
  EXPECT_NEAR(after.total_density(), before.total_density(), 1.0 / 6 + 1e-6 * before.total_density());
  int same_blade = 0, along = 0, shared = 0;
  for_occupied(after, [&](int i, int j, int k) {
    if (!(before.at(i, j, k, C::density) > 0.2f)) return;
    ++shared;
    same_blade += before.at(i, j, k, C::blade_id) == after.at(i, j, k, C::blade_id);
    const glm::dvec3 s = vector_at(before, i, j, k, C::tangent_x),
                     t = vector_at(after, i, j, k, C::tangent_x);
    along += std::abs(glm::dot(s, t)) > 0.95;
  });
  ASSERT_GT(shared, 3000);
  EXPECT_GT(same_blade, 0.95 * shared);
  EXPECT_GT(along, 0.95 * shared);
}

TEST(SplatPoints, RefusesNonsense) {
  const GridShape shape = cube(16);
  TexelGrid grid;
  PointSet p = plain_points(1);
  for (double sigma : {0.0, 0.29, 4.1, std::nan("")})
    EXPECT_THROW(splat_points(p, shape, sigma, grid), InvalidInput);
  p.position_m[0].x = std::nan("");
  EXPECT_THROW(splat_points(p, shape, 0.6, grid), SolverFailure);
  p = plain_points(1);
  p.proportion = 0;
  EXPECT_THROW(splat_points(p, shape, 0.6, grid), InvalidInput);
  p = plain_points(1);
  p.point_mass_kg = 0;
  EXPECT_THROW(splat_points(p, shape, 0.6, grid), InvalidInput);
}

}  // namespace
}  // namespace witherfield::grass
