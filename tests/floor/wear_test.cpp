// Depth, gloss, dirt and colour as functions of the additive fields.
#include "sim/floor/wear.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace witherfield::floor {
namespace {

/// Archard by hand for the table of materials: depth of a step of 750 N on 125 cm2 that slides 10 mm.
TEST(Wear, DepthOfAStepIsThatOfTheTable) {
  const auto nm = [](const char* material) {
    return 1e9 * wear_depth_m({material_preset(material).layers.back()}, kReferenceHit_J_m2);
  };
  EXPECT_NEAR(kReferenceHit_J_m2, 600, 1e-9);
  EXPECT_NEAR(nm("granite"), 0.028, 0.001);
  EXPECT_NEAR(nm("marble"), 0.13, 0.005);
  EXPECT_NEAR(nm("limestone"), 0.30, 0.005);
  EXPECT_NEAR(nm("concrete"), 0.23, 0.01);
  EXPECT_NEAR(nm("oak"), 1.0, 0.01);
  EXPECT_NEAR(nm("pine"), 3.2, 0.1);
  EXPECT_NEAR(nm("pvc"), 0.36, 0.01);
  EXPECT_NEAR(nm("linoleum"), 1.4, 0.1);
}

TEST(Wear, LayersWearOneAfterTheOther) {
  Layer top, bottom;
  top.thickness_um = 50;
  top.hardness_Pa = 1e8;
  top.wear_coefficient = 1e-4;  // 1e-12 m per J/m2: gone after 5e7
  bottom.hardness_Pa = 1e7;
  bottom.wear_coefficient = 1e-4;
  const std::vector<Layer> both{top, bottom};
  EXPECT_DOUBLE_EQ(wear_depth_m(both, 2e7), 2e-5);
  EXPECT_NEAR(wear_depth_m(both, 5e7), 5e-5, 1e-12);
  EXPECT_NEAR(wear_depth_m(both, 6e7), 5e-5 + 1e-4, 1e-12);
  EXPECT_NEAR(wear_depth_m(both, 6e7, 1.2), 6e-5, 1e-12) << "a thicker finish lasts longer";
  EXPECT_NEAR(wear_depth_m(both, 6e7, 1, 2), 5e-5 + 0.5e-4, 1e-12) << "a harder board wears less";
}

TEST(Wear, IsMonotoneAndSmoothForEveryMaterial) {
  for (const std::string& name : material_names()) {
    const std::vector<Layer> layers = material_preset(name).layers;
    double depth = -1;
    Look last = look_of(layers, 0);
    EXPECT_EQ(wear_depth_m(layers, 0), 0);
    EXPECT_EQ(last.gloss, layers[0].gloss_new);
    EXPECT_EQ(last.colour, layers[0].colour);
    for (double hits = 1; hits < 1e8; hits *= 1.02) {
      const double work = hits * kReferenceHit_J_m2, now = wear_depth_m(layers, work);
      ASSERT_GT(now, depth) << name;
      depth = now;
      const Look look = look_of(layers, work);
      ASSERT_LT(std::abs(look.gloss - last.gloss), 0.04) << name << ' ' << hits;
      ASSERT_LT(glm::distance(look.colour, last.colour), 0.04) << name << ' ' << hits;
      last = look;
    }
    ASSERT_NEAR(last.gloss, layers.back().gloss_worn, 0.01) << name;
  }
}

TEST(Wear, GlossIsLostLongBeforeTheWoodIsBare) {
  const std::vector<Layer> layers = material_preset("varnished_oak").layers;
  const auto gloss = [&](double hits) { return look_of(layers, hits * kReferenceHit_J_m2).gloss; };
  EXPECT_GT(gloss(100), 0.8);
  EXPECT_LT(gloss(10000), 0.35);
  const auto bare = [&](double hits) {
    const Look l = look_of(layers, hits * kReferenceHit_J_m2);
    return (l.colour.z - layers[0].colour_worn.z) / (layers[1].colour.z - layers[0].colour_worn.z);
  };
  EXPECT_LT(bare(15000), 0.05);
  EXPECT_GT(bare(60000), 0.95);
}

TEST(Wear, TrafficPolishesStone) {
  const std::vector<Layer> layers = material_preset("limestone").layers;
  EXPECT_GT(look_of(layers, 1e5 * kReferenceHit_J_m2).gloss, look_of(layers, 0).gloss + 0.3);
}

TEST(Dirt, IsTheSolutionOfItsEquation) {
  const SoilOptions soil;
  // dm/ds = brought - (rubbed * footfalls + mopped * days) m over s = 0..1, by many small steps.
  for (const auto& [brought, footfalls, days] :
       {std::array{0.5, 0.0, 0.0}, {3.0, 200.0, 10.0}, {400.0, 30000.0, 7000.0}, {0.001, 5.0, 1000.0}}) {
    const double loss = soil.rubbed * footfalls + soil.mopped_per_day * days;
    double m = 0;
    const int n = 200000;
    for (int k = 0; k < n; ++k) {
      const double middle = m + 0.5 / n * (brought - loss * m);
      m += 1.0 / n * (brought - loss * middle);
    }
    EXPECT_NEAR(dirt_of(soil, brought, footfalls, days), 1 - std::exp(-m), 1e-5);
  }
  EXPECT_EQ(dirt_of(soil, 0, 1e6, 1e4), 0);
  EXPECT_LT(dirt_of(soil, 1e9, 0, 0), 1 + 1e-12);
}

TEST(Dirt, IsMoreWhereSolesAreDirtier) {
  const SoilOptions soil;
  EXPECT_GT(dirt_of(soil, 200, 10000, 1000), dirt_of(soil, 20, 10000, 1000));
}

}  // namespace
}  // namespace witherfield::floor
