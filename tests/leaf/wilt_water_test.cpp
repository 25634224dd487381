// Water in the leaf: balance, bounds, steady states, convergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/leaf_tissue.hpp"
#include "sim/leaf/leaf_water.hpp"
#include "sim/leaf/vein_ribs.hpp"
#include "tests/leaf/wilt_bodies.hpp"

namespace witherfield::leaf {
namespace {

WiltBody small_leaf() {
  LeafOptions o = species_preset("cucumber");
  o.mesh = {0.006, 0.012, 0.0084, 0.5, 20000};
  o.margin.tooth_depth_m = 0;
  return wilt_body(build_leaf(o));
}

struct Rod {
  std::vector<glm::dvec3> line;
  std::vector<double> radius;
};
Rod rod_of(const WiltBody& b) {
  Rod r;
  for (int k = 0; k <= 10; ++k) {
    r.line.push_back(b.petiole_m.front() + (b.petiole_m.back() - b.petiole_m.front()) * (k / 10.0));
    r.radius.push_back(0.0025);
  }
  return r;
}

double lowest(std::span<const double> w) { return *std::min_element(w.begin(), w.end()); }
double highest(std::span<const double> w) { return *std::max_element(w.begin(), w.end()); }

TEST(LeafWater, BalanceHoldsWhateverHappens) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  WiltOptions o;
  o.water.supply_curve = {{0, 1}, {1, 1}, {1.5, 0}, {4, 0}, {4.2, 1}, {12, 1}};  // watered, cut off, watered again
  LeafWater water(body, rod.line, rod.radius, o);
  for (double hours = 0.5; hours <= 8; hours += 0.5) {
    water.advance_to(hours);
    EXPECT_LT(water.balance().error(water.start_kg()), 1e-9) << hours;
    EXPECT_GE(lowest(water.blade()), 0);
    EXPECT_LE(highest(water.blade()), 1 + 1e-12);
  }
  EXPECT_GT(water.balance().out_kg, 0.1 * water.start_kg());  // it was not idle
  EXPECT_GT(water.balance().in_kg, 0.1 * water.start_kg());
}

TEST(LeafWater, StaysWithinBoundsAndBalancedForAnyStep) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  for (const double steps : {0.02, 1.0, 400.0}) {
    WiltOptions o;
    o.water.steps_per_hour = steps;
    o.water.transpiration_kg_m2_s = 1e-3;  // a storm
    LeafWater water(body, rod.line, rod.radius, o);
    water.advance_to(steps > 100 ? 1 : 100);
    EXPECT_GE(lowest(water.blade()), 0) << steps;
    EXPECT_LE(highest(water.blade()), 1 + 1e-12) << steps;
    EXPECT_LT(water.balance().error(water.start_kg()), 1e-9) << steps;
  }
}

TEST(LeafWater, AStripDriesByTheParabolaOfSteadyDiffusion) {
  // Water enters at x = 0 and leaves everywhere at a constant rate e: D W0 w'' = e, so 1 - w = e / (D W0) (L x - x^2 / 2).
  const double length = 0.04;
  WiltBody b = test::strip(length, 0.004, 40, 4);
  for (int v = 0; v < 5; ++v) b.clamp.push_back(v);
  WiltOptions o;
  o.water.supply_curve = {{0, 1}, {1000, 1}};
  o.water.margin_gain = 0;
  o.water.diffusivity_blade_m2_s = 1e-6;
  o.water.petiole_conductance_kg_s = 1;  // no resistance where it enters
  o.water.transpiration_kg_m2_s = 1e-6;
  LeafWater water(b, {}, {}, o);
  water.advance_to(50);  // many times L^2 / D = 27 min
  const double drop = o.water.transpiration_kg_m2_s / (1e-6 * o.water.blade_water_kg_m2);
  for (std::size_t i = 0; i < b.rest.position_m.size(); ++i) {
    const double x = b.rest.position_m[i].x, wanted = drop * (length * x - x * x / 2);
    EXPECT_NEAR(1 - water.blade()[i], wanted, 0.01 * drop * length * length / 2) << x;
  }
}

TEST(LeafWater, ErrorFallsWithTheFirstPowerOfTheStep) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  const auto mean_at = [&](double steps) {
    WiltOptions o;
    o.water.steps_per_hour = steps;
    LeafWater water(body, rod.line, rod.radius, o);
    water.advance_to(2);
    return water.mean_blade();
  };
  const double best = mean_at(640), coarse = std::abs(mean_at(10) - best), fine = std::abs(mean_at(40) - best);
  EXPECT_LT(coarse, 0.02);
  EXPECT_NEAR(coarse / fine, 4, 1.2);
}

TEST(LeafWater, AWateredLeafKeepsItsTurgorAndACutOneDriesFromTheMargin) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  WiltOptions o;
  o.water.supply_curve = {{0, 1}, {100, 1}};
  LeafWater watered(body, rod.line, rod.radius, o);
  watered.advance_to(24);
  EXPECT_GT(turgor_MPa(o.tissue, lowest(watered.blade())), 0);
  EXPECT_GT(watered.mean_blade(), 0.88);

  o.water.supply_curve = {};
  LeafWater cut(body, rod.line, rod.radius, o);
  cut.advance_to(4);
  EXPECT_LT(cut.mean_blade(), turgor_loss_point(o.tissue));
  // What lies far from veins and near the margin dries first.
  double vein = 0, veins = 0, blade = 0, blades = 0;
  for (std::size_t i = 0; i < body.vein.size(); ++i)
    if (body.vein[i] > 0.9) vein += cut.blade()[i], ++veins;
    else if (body.vein[i] < 0.1) blade += cut.blade()[i], ++blades;
  EXPECT_GT(vein / veins, blade / blades + 0.02);
}

TEST(LeafWater, AMeshWithoutVeinsLivesByVeinsFinerThanItself) {
  LeafOptions o;
  o.source = LeafSource::mesh;
  const WiltBody sheet = test::strip(0.15, 0.12, 30, 24);
  LeafInput input;
  input.mesh = sheet.rest;
  WiltBody body = wilt_body(build_leaf(o, input));
  ASSERT_TRUE(body.veins.empty());
  const Rod rod = rod_of(body);
  WiltOptions w;
  w.water.margin_gain = 0;
  w.water.supply_curve = {{0, 1}, {100, 1}};
  LeafWater watered(body, rod.line, rod.radius, w);
  watered.advance_to(24);
  // Steady: transpiration times the resistances of petiole and blade, alike everywhere.
  const double loss_kg_s = 0.15 * 0.12 * w.water.transpiration_kg_m2_s * transpiration_share(w.tissue, w.water.cuticular_share, watered.mean_blade());
  EXPECT_NEAR(1 - watered.mean_blade(), 2 * loss_kg_s / w.water.petiole_conductance_kg_s, 0.002);
  EXPECT_NEAR(lowest(watered.blade()), highest(watered.blade()), 1e-6);
  EXPECT_LT(watered.balance().error(watered.start_kg()), 1e-9);

  w.water.supply_curve = {};
  w.water.margin_gain = 0.5;
  LeafWater cut(body, rod.line, rod.radius, w);
  cut.advance_to(5);
  EXPECT_LT(cut.mean_blade(), turgor_loss_point(w.tissue));
  EXPECT_LT(lowest(cut.blade()), highest(cut.blade()) - 0.05);  // the margin first
}

TEST(LeafWater, RewateringRefills) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  WiltOptions o;
  o.water.supply_curve = {{0, 0}, {1.0, 0}, {1.05, 1}, {100, 1}};
  LeafWater water(body, rod.line, rod.radius, o);
  water.advance_to(1);
  const double dry = water.mean_blade();
  water.advance_to(13);
  EXPECT_LT(dry, 0.95);
  EXPECT_GT(water.mean_blade(), 0.88);
  EXPECT_GT(water.mean_blade(), dry + 0.02);
}

TEST(LeafWater, RefusesWhatCannotBe) {
  const WiltBody body = small_leaf();
  const Rod rod = rod_of(body);
  EXPECT_THROW(LeafWater(body, rod.line, {}, {}), InvalidInput);
  LeafWater water(body, rod.line, rod.radius, {});
  water.advance_to(1);
  EXPECT_THROW(water.advance_to(0.5), InvalidInput);
  WiltOptions o;
  o.water.transpiration_kg_m2_s = 1;
  EXPECT_THROW(LeafWater(body, rod.line, rod.radius, o), InvalidInput);
}

}  // namespace
}  // namespace witherfield::leaf
