// Laws of voxelising: exact partial coverage, whatever the shape, the grid and the number of threads.
#include "sim/grass/voxelize.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "tests/grass/blade_fixtures.hpp"

namespace witherfield::grass {
namespace {

using namespace fixtures;
using C = TexelChannel;
constexpr double kVein = 0.18;

GridShape cube(int n, double spacing_m, int margin = 0) {
  return {n, n, n, glm::dvec3(-margin * spacing_m, -margin * spacing_m, 0), spacing_m, margin};
}

double area_of(const TexelGrid& g) {
  return g.total_density() * g.shape().spacing_m * g.shape().spacing_m;
}

double overlap(double lo, double hi, int i) {
  return std::max(0.0, std::min(hi, i + 1.0) - std::max(lo, double(i)));
}

TEST(TexelShape, CentresTheTileBetweenItsMargins) {
  const GridShape s = texel_shape({0.2, 256, 3});
  EXPECT_EQ(s.nx, 256);
  EXPECT_EQ(s.margin, 48);
  EXPECT_DOUBLE_EQ(s.tile_m(), 0.2);
  EXPECT_DOUBLE_EQ(s.origin_m.x + s.margin * s.spacing_m, 0.0);
  EXPECT_DOUBLE_EQ(s.origin_m.y, s.origin_m.x);
  EXPECT_DOUBLE_EQ(s.origin_m.z, 0.0);
  EXPECT_EQ(texel_shape({0.2, 32, 0}).margin, 0);
  EXPECT_THROW(texel_shape({0.2, 100, 3}), InvalidInput);
  EXPECT_THROW(texel_shape({0.2, 256, 7}), InvalidInput);
  EXPECT_THROW(texel_shape({0.0, 256, 3}), InvalidInput);
}

TEST(TotalArea, FoldingARibbonKeepsItsArea) {
  for (double fold : {0.0, 0.3, 1.2}) {
    BladeShape shape = strip_across_x({0.1, 0.1, 0}, 0.1, 0.002);
    shape.fold = fold;
    EXPECT_NEAR(total_blade_area_m2(make_state(BladeForm::ribbon, 10, {shape})), 0.1 * 0.004, 1e-10) << fold;
  }
}

TEST(TotalArea, ConeHasTheAreaOfItsSilhouette) {
  BladeShape shape;
  shape.half_width_m = 0.01, shape.pointed = true;
  EXPECT_NEAR(total_blade_area_m2(make_state(BladeForm::cone, 16, {shape})), 0.01 * 0.1, 1e-9);
}

TEST(Voxelize, ConservesAreaForEveryShapeAndGrid) {
  for (BladeForm form : {BladeForm::ribbon, BladeForm::cone}) {
    const BladeState state = make_state(form, 24, meadow(40, 0.2));
    const double area = total_blade_area_m2(state);
    for (int n : {32, 64, 128}) {
      for (double vein : {0.0, 0.18, 0.9, 1.0})
        EXPECT_NEAR(area_of(voxelize(state, texel_shape({0.2, n, 3}), vein)) / area, 1.0, 1e-6)
            << n << ' ' << vein;
    }
  }
}

// A strip in the plane y = const: what it covers of each voxel is a product of two overlaps.
TEST(Voxelize, AxisAlignedStripCoversExactFractionsVoxelByVoxel) {
  const double h = 1.0 / 64;  // a power of two: positions in voxels are exact
  const double x0 = 3.3, x1 = 11.9, z1 = 9.55, y = 6.5;
  const BladeShape shape = strip_across_x({0.5 * (x0 + x1) * h, y * h, 0}, z1 * h, 0.5 * (x1 - x0) * h);
  const TexelGrid g = voxelize(make_state(BladeForm::ribbon, 7, {shape}), cube(16, h), kVein);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(g.at(i, j, k, C::density), j == 6 ? overlap(x0, x1, i) * overlap(0, z1, k) : 0.0, 2e-6)
            << i << ' ' << j << ' ' << k;
}

// Folded by 60 degrees the halves rise along +normal = side x tangent, and each covers 1 / cos(60) of its
// shadow on the x axis.
TEST(Voxelize, FoldedStripRisesAlongTheNormal) {
  const double h = 1.0 / 64, fold = std::acos(0.5), w = 4;
  BladeShape shape = strip_across_x({8 * h, 8 * h, 0}, 8 * h, w * h);
  shape.fold = fold;
  const BladeState state = make_state(BladeForm::ribbon, 4, {shape});
  const double toward = blade_normal(state.tangent[0], state.side[0]).y;
  ASSERT_NEAR(std::abs(toward), 1, 1e-12);
  const TexelGrid g = voxelize(state, cube(16, h), kVein);
  double column[16] = {}, mean_y = 0, total = 0;
  for_occupied(g, [&](int i, int j, int k) {
    const double rho = g.at(i, j, k, C::density);
    column[i] += rho, mean_y += rho * (j + 0.5), total += rho;
    EXPECT_GT(vector_at(g, i, j, k, C::normal_x).y * toward, 0.49);
  });
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(column[i], 8 * overlap(6, 10, i) / std::cos(fold), 1e-4) << i;
  EXPECT_NEAR(mean_y / total - 8, toward * 0.5 * w * std::sin(fold), 0.3);
}

// Exact coverage means that a coarse grid holds just what its children hold.
TEST(Voxelize, CoarseGridIsTheSumOfTheFineOne) {
  const BladeState state = make_state(BladeForm::ribbon, 24, meadow(30, 0.2));
  const TexelGrid fine = voxelize(state, texel_shape({0.2, 128, 3}), kVein);
  const TexelGrid coarse = voxelize(state, texel_shape({0.2, 64, 3}), kVein);
  for_occupied(coarse, [&](int i, int j, int k) {
    double children = 0;
    for (int c = 0; c < 8; ++c)
      children += fine.at(2 * i + (c & 1), 2 * j + ((c >> 1) & 1), 2 * k + (c >> 2), C::density);
    ASSERT_NEAR(children / 4, coarse.at(i, j, k, C::density), 1e-5);
  });
}

TEST(Voxelize, InterpolatesMaterialAlongTheBlade) {
  const double h = 1.0 / 64;
  const TexelGrid g =
      voxelize(make_state(BladeForm::ribbon, 5, {strip_across_x({8 * h, 8.5 * h, 0}, 16 * h, 3 * h)}),
               cube(16, h), kVein);
  for (int k = 0; k < 16; ++k)
    for (int i = 5; i < 11; ++i) {
      const double a = (k + 0.5) / 16;  // mean arc of layer k: whole voxels
      EXPECT_NEAR(g.at(i, 8, k, C::arc), a, 1e-6);
      EXPECT_NEAR(g.at(i, 8, k, C::water), water_at(0, a), 1e-6);
      EXPECT_NEAR(g.at(i, 8, k, C::chlorophyll_ug_cm2), 40 * chlorophyll_at(0, a), 1e-4);
      EXPECT_NEAR(g.at(i, 8, k, C::stress_vein_MPa), -2 - a, 1e-5);
      EXPECT_NEAR(g.at(i, 8, k, C::stress_mesophyll_MPa), 1 + 0.5 * a, 1e-5);
      EXPECT_NEAR(g.at(i, 8, k, C::diffuse_r), 0.1 + 0.3 * a, 1e-6);
      EXPECT_NEAR(g.at(i, 8, k, C::diffuse_g), 0.3 - 0.1 * a, 1e-6);
      EXPECT_FLOAT_EQ(g.at(i, 8, k, C::specular), 0.04f);
    }
}

TEST(Voxelize, TissueSharesAreExact) {
  for (BladeForm form : {BladeForm::ribbon, BladeForm::cone}) {
    const BladeState state = make_state(form, 24, meadow(5, 0.2));
    for (double vein : {0.0, 0.18, 0.5, 1.0}) {
      const TexelGrid g = voxelize(state, texel_shape({0.2, 64, 3}), vein);
      double strain = 0;
      for_occupied(g, [&](int i, int j, int k) {
        strain += double(g.at(i, j, k, C::density)) * g.at(i, j, k, C::strain_shrink);
        const float tissue = g.at(i, j, k, C::tissue);
        ASSERT_TRUE(vein == 0 ? tissue == 2 : vein == 1 ? tissue == 1 : tissue == 1 || tissue == 2);
      });
      // Twisted strips are not quite developable: shares of the two bent triangles differ a little from those
      // of a plane one.
      EXPECT_NEAR(strain / g.total_density(), vein * kStrainVein + (1 - vein) * kStrainMesophyll, 2e-4);
    }
  }
}

TEST(Voxelize, VeinIsTheMiddleOfTheBlade) {
  const double h = 1.0 / 64;
  // 12 voxels wide around x = 8; vein where |x - 8| < reach: voxels 7 and 8 wholly, 6 and 9 in part.
  for (double reach : {1.3, 1.7}) {
    const BladeState state =
        make_state(BladeForm::ribbon, 3, {strip_across_x({8 * h, 8.5 * h, 0}, 8 * h, 6 * h)});
    const TexelGrid g = voxelize(state, cube(16, h), reach / 6);
    for (int i = 2; i < 14; ++i) {
      const double share = i == 7 || i == 8 ? 1 : i == 6 || i == 9 ? reach - 1 : 0;
      EXPECT_NEAR(g.at(i, 8, 3, C::strain_shrink), share * kStrainVein + (1 - share) * kStrainMesophyll, 1e-6)
          << i;
      EXPECT_EQ(g.at(i, 8, 3, C::tissue), share > 0.5 ? 1 : 2) << i;
    }
  }
}

TEST(Voxelize, FrameIsUnitAndFollowsTheBlade) {
  BladeShape leaning;
  leaning.lean = 0.5, leaning.azimuth = 0.7, leaning.turn = 0.4;
  const BladeState one = make_state(BladeForm::ribbon, 12, {leaning});
  const glm::dvec3 tangent = one.tangent[0], normal = blade_normal(one.tangent[0], one.side[0]);
  const TexelGrid g = voxelize(one, texel_shape({0.2, 64, 3}), kVein);
  for_occupied(g, [&](int i, int j, int k) {
    EXPECT_GT(glm::dot(vector_at(g, i, j, k, C::tangent_x), tangent), 1 - 1e-6);
    EXPECT_GT(glm::dot(vector_at(g, i, j, k, C::normal_x), normal), 1 - 1e-6);
  });
  const TexelGrid many =
      voxelize(make_state(BladeForm::ribbon, 24, meadow(300, 0.2)), texel_shape({0.2, 64, 3}), kVein);
  for_occupied(many, [&](int i, int j, int k) {
    ASSERT_NEAR(glm::length(vector_at(many, i, j, k, C::tangent_x)), 1, 1e-6);
    ASSERT_NEAR(glm::length(vector_at(many, i, j, k, C::normal_x)), 1, 1e-6);
  });
}

TEST(Voxelize, MeansStayWithinTheRangeOfTheBlades) {
  const BladeState s = make_state(BladeForm::ribbon, 24, meadow(300, 0.2));
  const TexelGrid g = voxelize(s, texel_shape({0.2, 64, 3}), kVein, 5);
  const auto [lo, hi] = std::minmax_element(s.water.begin(), s.water.end());
  for_occupied(g, [&](int i, int j, int k) {
    ASSERT_GE(g.at(i, j, k, C::water), *lo);
    ASSERT_LE(g.at(i, j, k, C::water), *hi);
    ASSERT_EQ(g.at(i, j, k, C::specular), 0.04f);
    ASSERT_EQ(g.at(i, j, k, C::diffuse_b), 0.05f);
    ASSERT_GE(g.at(i, j, k, C::arc), 0);
    ASSERT_LE(g.at(i, j, k, C::arc), 1);
    const float id = g.at(i, j, k, C::blade_id);
    ASSERT_TRUE(id >= 5 && id < 305 && id == std::floor(id));
  });
}

TEST(Voxelize, LargestBladeNamesTheVoxel) {
  const double h = 1.0 / 64;
  const BladeState s = make_state(BladeForm::ribbon, 4,
                                  {strip_across_x({8.4 * h, 8.5 * h, 0}, 8 * h, 0.2 * h),
                                   strip_across_x({8.5 * h, 8.25 * h, 0}, 8 * h, 0.4 * h),
                                   strip_across_x({8.4 * h, 8.75 * h, 0}, 8 * h, 0.3 * h)});
  const TexelGrid g = voxelize(s, cube(16, h), kVein, 100);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(g.at(8, 8, k, C::density), 1.8, 1e-6);
    EXPECT_EQ(g.at(8, 8, k, C::blade_id), 101);
    EXPECT_NEAR(g.at(8, 8, k, C::arc), (k + 0.5) / 8, 1e-6);
    // Water: mean of three blades that differ by 0.01, weighted 0.4 : 0.8 : 0.6.
    EXPECT_NEAR(g.at(8, 8, k, C::water), water_at(0, (k + 0.5) / 8) - 0.01 * (0.8 + 2 * 0.6) / 1.8, 1e-6);
  }
}

// One wide strip facing y, rising; four narrow ones facing x, two of them hanging down. The frame is the wide
// one's, although there are more of the others, and its signs are not those of what comes last.
TEST(Voxelize, FrameIsWeightedByAreaAndAxial) {
  const double h = 1.0 / 64, pi = 3.14159265358979324;
  std::vector<BladeShape> shapes{strip_across_x({8.5 * h, 8.5 * h, 0}, 8 * h, 0.45 * h)};
  for (int i = 0; i < 4; ++i) {
    BladeShape narrow = strip_across_x({(8.2 + 0.2 * i) * h, 8.5 * h, i < 2 ? 0 : 8 * h}, 8 * h, 0.05 * h);
    narrow.turn = 0.5 * pi, narrow.lean = i < 2 ? 0 : pi;
    shapes.push_back(narrow);
  }
  const BladeState state = make_state(BladeForm::ribbon, 4, shapes);
  const glm::dvec3 normal = blade_normal(state.tangent[0], state.side[0]);
  const TexelGrid g = voxelize(state, cube(16, h), kVein);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(g.at(8, 8, k, C::density), 1.3, 1e-5);
    EXPECT_GT(vector_at(g, 8, 8, k, C::tangent_x).z, 1 - 1e-6);
    EXPECT_GT(glm::dot(vector_at(g, 8, 8, k, C::normal_x), normal), 1 - 1e-3);
  }
}

TEST(Voxelize, WrapsByWholeTiles) {
  const double h = 1.0 / 256, tile = 32 * h;
  for (int margin : {0, 4, 20}) {
    const GridShape shape = cube(32 + 2 * margin, h, margin);
    BladeShape b = strip_across_x({0.4 * tile, 0.6 * tile, 0}, 0.1, 5 * h);
    b.lean = 0.1;
    const TexelGrid home = voxelize(make_state(BladeForm::ribbon, 8, {b}), shape, kVein);
    for (glm::dvec3 shift : {glm::dvec3(-3, 0, 0), glm::dvec3(3, 2, 0), glm::dvec3(-2, -5, 0)}) {
      BladeShape moved = b;
      moved.root_m += tile * shift;
      const TexelGrid g = voxelize(make_state(BladeForm::ribbon, 8, {moved}), shape, kVein);
      EXPECT_NEAR(g.total_density(), home.total_density(), 1e-4);
      // Wherever in the grid a piece lands, it is whole tiles away from the home place.
      for_occupied(g, [&](int i, int j, int k) {
        const auto back = [&](int x) { return ((x - margin) % 32 + 32) % 32 + margin; };
        ASSERT_NEAR(g.at(i, j, k, C::density), home.at(back(i), back(j), k, C::density), 1e-5)
            << i << ' ' << j;
      });
    }
  }
}

TEST(Voxelize, KeepsABladeThatOnlyLeansIntoTheMarginWhereItIs) {
  const double h = 1.0 / 256;
  const TexelGrid g =
      voxelize(make_state(BladeForm::ribbon, 4, {strip_across_x({0, 16.5 * h, 0}, 0.05, 2.5 * h)}),
               cube(48, h, 8), kVein);
  EXPECT_EQ(g.occupied_box().lo.x, 5);
  EXPECT_EQ(g.occupied_box().hi.x, 11);
}

TEST(Voxelize, BelowGroundAndAboveTheTopGoToTheEndLayers) {
  const double h = 1.0 / 64;
  const TexelGrid g =
      voxelize(make_state(BladeForm::ribbon, 4, {strip_across_x({8 * h, 8.5 * h, -3 * h}, 24 * h, h)}),
               cube(16, h), kVein);
  EXPECT_NEAR(g.at(8, 8, 0, C::density), 4, 1e-5);
  EXPECT_NEAR(g.at(8, 8, 1, C::density), 1, 1e-5);
  EXPECT_NEAR(g.at(8, 8, 15, C::density), 6, 1e-5);
}

BladeState upright_cone(double turn) {
  BladeShape shape;
  shape.root_m = {0.1, 0.1, 0};
  shape.half_width_m = 0.03, shape.length_m = 0.15, shape.turn = turn, shape.pointed = true;
  return make_state(BladeForm::cone, 12, {shape});
}

TEST(Voxelize, ConeNormalPointsFromTheAxisAndIsZeroInTheVein) {
  const GridShape shape = texel_shape({0.2, 128, 0});
  const TexelGrid g = voxelize(upright_cone(0.3), shape, 0.4);
  int outside = 0, inside = 0;
  for_occupied(g, [&](int i, int j, int k) {
    const glm::dvec3 d((i + 0.5) * shape.spacing_m - 0.1, (j + 0.5) * shape.spacing_m - 0.1, 0);
    const double radius = 0.03 * (1 - (k + 0.5) * shape.spacing_m / 0.15), r = glm::length(d),
                 slack = 2 * shape.spacing_m;
    const glm::dvec3 n = vector_at(g, i, j, k, C::normal_x);
    if (r > 0.4 * radius + slack && r > 6 * shape.spacing_m) {
      EXPECT_GT(glm::dot(n, d) / r, 0.98);
      EXPECT_NEAR(glm::length(n), 1, 1e-6);
      EXPECT_EQ(g.at(i, j, k, C::tissue), 2);
      ++outside;
    } else if (r < 0.4 * radius - slack) {
      EXPECT_EQ(glm::length(n), 0);
      EXPECT_EQ(g.at(i, j, k, C::tissue), 1);
      ++inside;
    }
    EXPECT_GT(vector_at(g, i, j, k, C::tangent_x).z, 1 - 1e-6);
  });
  EXPECT_GT(outside, 100);
  EXPECT_GT(inside, 100);
}

// A flat card would have all its mass in one plane. The cone's is the same from every side: its second moment
// across the axis is isotropic, however its silhouettes are turned, and the mass of each layer does not
// change.
TEST(Voxelize, ConeMassDoesNotDependOnTheView) {
  const GridShape shape = texel_shape({0.2, 128, 0});
  const TexelGrid reference = voxelize(upright_cone(0), shape, kVein);
  for (double turn : {0.0, 0.2, 0.55, 0.78539816339744831}) {
    const TexelGrid g = voxelize(upright_cone(turn), shape, kVein);
    double xx = 0, xy = 0, yy = 0;
    std::vector<double> layer(128, 0), layer_reference(128, 0);
    for_occupied(g, [&](int i, int j, int k) {
      const double rho = g.at(i, j, k, C::density), x = i + 0.5 - 64, y = j + 0.5 - 64;
      xx += rho * x * x, xy += rho * x * y, yy += rho * y * y, layer[std::size_t(k)] += rho;
    });
    for_occupied(reference, [&](int i, int j, int k) {
      layer_reference[std::size_t(k)] += reference.at(i, j, k, C::density);
    });
    EXPECT_NEAR(xx / yy, 1, 0.01) << turn;
    EXPECT_NEAR(xy / yy, 0, 0.01) << turn;
    for (std::size_t k = 0; k < 128; ++k) EXPECT_NEAR(layer[k], layer_reference[k], 1e-4);
  }
  EXPECT_LT(density_difference(reference, voxelize(upright_cone(0.78539816339744831), shape, kVein)), 1e-5);
}

TEST(Voxelize, SameBitsForAnyNumberOfThreads) {
  const BladeState state = make_state(BladeForm::ribbon, 24, meadow(120, 0.2));
  const GridShape shape = texel_shape({0.2, 64, 3});
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return voxelize(state, shape, kVein);
  };
  const TexelGrid one = with(1);
  for (int round = 0; round < 3; ++round) EXPECT_TRUE(same_bits(one, with(2)));
}

TEST(Voxelize, NoBladesGiveAnEmptyGrid) {
  const TexelGrid g = voxelize(make_state(BladeForm::ribbon, 8, {}), cube(16, 0.01), kVein);
  EXPECT_EQ(g.brick_count(), 0);
  EXPECT_EQ(total_blade_area_m2(make_state(BladeForm::ribbon, 8, {})), 0);
}

TEST(Voxelize, RejectsWhatCannotBeVoxelised) {
  const BladeState good = make_state(BladeForm::ribbon, 8, {BladeShape{}});
  const GridShape shape = cube(16, 0.01);
  EXPECT_THROW(voxelize(good, shape, 1.01), InvalidInput);
  EXPECT_THROW(voxelize(good, shape, std::nan("")), InvalidInput);
  BladeState bad = good;
  bad.node_m[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(voxelize(bad, shape, kVein), InvalidInput);
  bad = good;
  bad.half_width_m[0] = -1e-3f;
  EXPECT_THROW(voxelize(bad, shape, kVein), InvalidInput);
  bad = good;
  bad.water.pop_back();
  EXPECT_THROW(voxelize(bad, shape, kVein), InvalidInput);
  bad = good;
  bad.segments = 7;
  EXPECT_THROW(voxelize(bad, shape, kVein), InvalidInput);
  bad = good;
  bad.side[2].x = std::numeric_limits<double>::infinity();
  EXPECT_THROW(voxelize(bad, shape, kVein), InvalidInput);
  EXPECT_THROW(voxelize(good, cube(16, 0.01, 8), kVein), InvalidInput);
}

TEST(PrincipalAxis, FindsTheLongestAxisWhateverTheGuess) {
  std::mt19937 bits(3);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 2000; ++round) {
    const auto random = [&] { return glm::normalize(glm::vec3(normal(bits), normal(bits), normal(bits))); };
    const glm::vec3 a = random(), b = glm::normalize(glm::cross(a, random())), c = glm::cross(a, b);
    float m[6] = {};
    const float scale = std::exp(8 * normal(bits));
    add_dyad(m, scale, a), add_dyad(m, 0.6f * scale, b), add_dyad(m, 0.2f * scale, c);
    const glm::vec3 guess = round % 2 ? b : random(), axis = principal_axis(m, guess);
    EXPECT_NEAR(std::abs(glm::dot(axis, a)), 1, 1e-5);
    EXPECT_NEAR(glm::length(axis), 1, 1e-6);
    if (round % 2 == 0) {
      EXPECT_GE(glm::dot(axis, guess), 0);
    }
  }
  const float none[6] = {};
  EXPECT_EQ(principal_axis(none, {0, 1, 0}), glm::vec3(0, 1, 0));
  const float across[6] = {1, 0, 0, 0, 0, 0};
  EXPECT_EQ(principal_axis(across, {0, 1, 0}), glm::vec3(1, 0, 0));
  const float alike[6] = {1, 0, 0, 1, 0, 1};
  EXPECT_NEAR(glm::dot(principal_axis(alike, {0.6f, 0, 0.8f}), glm::vec3(0.6f, 0, 0.8f)), 1, 1e-6);
}

}  // namespace
}  // namespace witherfield::grass
