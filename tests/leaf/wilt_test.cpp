// Wilting as a whole: analytic shapes first, then a leaf.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/check/mesh_check.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/leaf_tissue.hpp"
#include "sim/leaf/wilt.hpp"
#include "sim/leaf/wilt_mechanics.hpp"
#include "tests/leaf/wilt_bodies.hpp"

namespace witherfield::leaf {
namespace {

constexpr double kLength = 0.1, kWidth = 0.01, kGravity = 9.81;

/// A strip that droops as a beam: no Poisson effect, much stiffer in its plane than in bending.
WiltOptions beam(double gamma, double length) {
  WiltOptions o;
  o.tissue.poisson = 0;
  o.tissue.thickness_m = 3e-4;
  o.tissue.compression_share = 1;
  const double weight_per_area = (o.tissue.dry_mass_kg_m2 + o.water.blade_water_kg_m2) * kGravity;
  // gamma = q L^3 / (E h^3 / 12), q weight per area.
  o.tissue.blade_bending_turgid_MPa = weight_per_area * std::pow(length, 3) * 12 / (gamma * std::pow(3e-4, 3)) * 1e-6;
  o.tissue.blade_membrane_turgid_MPa = 100;
  o.solver.contact_gap = 0;
  o.solver.tolerance = 1e-14;
  o.solver.max_iterations = 400;
  return o;
}

test::Tip tip_of_strip(double gamma, int nx) {
  const WiltBody b = test::cantilever(kLength, kWidth, nx, 4);
  const double free = kLength * (1 - 0.5 / nx);
  WiltMechanics m(b, beam(gamma, free));
  m.relax();
  const glm::dvec3 tip = m.shape().x.back();
  return {(tip.x - 0.5 * kLength / nx) / free, -tip.z / free};
}

TEST(WiltMechanics, AHeavyStripHangsAsTheElastica) {
  // Small loads: the linear beam, q L^4 / (8 E I).
  EXPECT_NEAR(test::heavy_elastica(0.01).drop, 0.01 / 8, 1e-6);
  double worst = 0;
  for (const double gamma : {0.5, 2.0, 8.0, 30.0}) {
    const test::Tip exact = test::heavy_elastica(gamma), found = tip_of_strip(gamma, 60);
    EXPECT_NEAR(found.drop / exact.drop, 1, 0.01) << gamma;
    EXPECT_NEAR(found.x, exact.x, 0.01) << gamma;
    worst = std::max(worst, std::abs(found.drop / exact.drop - 1));
  }
  std::printf("[   INFO   ] cantilever against the elastica: worst error of the droop %.3f %%\n", 100 * worst);
}

TEST(WiltMechanics, APetioleHangsAsTheElastica) {
  WiltBody b = test::strip(0.004, 0.004, 2, 2);
  for (glm::dvec3& p : b.rest.position_m) p.x += kLength;
  b.petiole_m = {{0, 0, 0}, {kLength, 0, 0}};
  b.petiole_radius_stem_m = b.petiole_radius_blade_m = 0.002;
  b.clamp = {0, 1, 2};
  WiltOptions o;
  o.tissue.dry_mass_kg_m2 = 0;  // as good as no blade
  o.water.blade_water_kg_m2 = 0.01;
  o.solver.tolerance = 1e-14;
  o.solver.max_iterations = 400;
  // The first segment is held: clamped in its middle.
  const double r = 0.002, free = kLength * (1 - 0.5 / 20);
  for (const double gamma : {1.0, 6.0}) {
    const double weight = o.water.petiole_water_kg_m3 * std::numbers::pi * r * r * kGravity;
    o.tissue.petiole_limp_MPa = 1e-2;
    o.tissue.petiole_turgid_MPa = weight * std::pow(free, 3) / (gamma * std::numbers::pi * std::pow(r, 4) / 4) * 1e-6;
    WiltMechanics m(b, o);
    m.relax();
    const glm::dvec3 tip = m.shape().x.back();
    EXPECT_NEAR(-tip.z / free / test::heavy_elastica(gamma).drop, 1, 0.01) << gamma;
  }
}

/// A cucumber leaf of some 1,000 vertices, without teeth.
LeafModel small_leaf(std::uint64_t seed = 1) {
  LeafOptions o = species_preset("cucumber");
  o.seed = seed;
  o.mesh = {0.006, 0.012, 0.0084, 0.5, 20000};
  o.margin.tooth_depth_m = 0;
  return build_leaf(o);
}

double largest_move(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double d = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) d = std::max(d, glm::distance(a[i], b[i]));
  return d;
}

TEST(WiltMechanics, TheNaturalPoseIsInEquilibriumUnderItsWeight) {
  const WiltBody body = wilt_body(small_leaf());
  WiltMechanics m(body, {});
  const RelaxReport r = m.relax();
  EXPECT_TRUE(r.converged);
  EXPECT_LT(largest_move(m.shape().x, body.rest.position_m), 1e-6);
}

TEST(WiltMechanics, WithoutLoadNothingMovesAndNothingIsStrained) {
  WiltBody body = wilt_body(small_leaf());
  body.rest_carries_weight = false;
  WiltOptions o;
  o.solver.gravity_m_s2 = 0;
  WiltMechanics m(body, o);
  m.relax();
  EXPECT_LT(largest_move(m.shape().x, body.rest.position_m), 1e-9);
  for (const double s : m.von_mises_MPa()) ASSERT_LT(s, 1e-9);
  EXPECT_NEAR(m.energy_J(), 0, 1e-15);
}

TEST(WiltMechanics, EnergyNeverRisesAndForcesVanishInEquilibrium) {
  const WiltBody body = wilt_body(small_leaf());
  WiltOptions o;
  o.solver.max_iterations = 500;
  o.solver.tolerance = 1e-12;
  WiltMechanics m(body, o);
  const std::vector<double> blade(body.rest.position_m.size(), 0.8), petiole(std::size_t(m.rod_nodes()), 0.8);
  m.set_water(blade, petiole);
  const RelaxReport r = m.relax();
  EXPECT_TRUE(r.converged) << r.residual;
  ASSERT_GT(r.energy_J.size(), 3u);
  for (std::size_t k = 1; k < r.energy_J.size(); ++k) EXPECT_LE(r.energy_J[k], r.energy_J[k - 1]);
  EXPECT_LT(r.energy_J.back(), r.energy_J.front());
}

TEST(WiltMechanics, OneLargeStepIsStable) {
  // From turgid to nearly dry at once.
  const WiltBody body = wilt_body(small_leaf());
  WiltOptions o;
  o.solver.max_iterations = 300;
  WiltMechanics m(body, o);
  const std::vector<double> blade(body.rest.position_m.size(), 0.3), petiole(std::size_t(m.rod_nodes()), 0.3);
  m.set_water(blade, petiole);
  const RelaxReport r = m.relax();
  for (std::size_t k = 1; k < r.energy_J.size(); ++k) EXPECT_LE(r.energy_J[k], r.energy_J[k - 1]);
  for (const glm::dvec3& p : m.shape().x) ASSERT_LT(glm::length(p), 1);
  EXPECT_LT(r.residual, 1e-3);
}

struct Series {
  WiltReport report;
  std::vector<WiltFrame> frames;  ///< without the pointers
  std::vector<Surface> surfaces;
};
Series run(const WiltBody& body, const WiltOptions& options) {
  Series s;
  s.report = simulate_wilt(body, options, [&](const WiltFrame& f) {
    s.surfaces.push_back(*f.surface);
    s.frames.push_back(f);
  });
  return s;
}

Surface blade_of(const Surface& s) {
  const auto& organ = s.field("organ_id").values;
  return keep_faces(s, [&](std::size_t f) { return organ[std::size_t(s.triangles[f][0])] == 0; });
}

TEST(Wilt, ACutLeafWilts) {
  const LeafModel leaf = small_leaf();
  const WiltBody body = wilt_body(leaf);
  const Series s = run(body, {});
  ASSERT_EQ(s.frames.size(), 20u);
  EXPECT_LT(s.report.balance_error, 1e-9);
  EXPECT_LT(s.report.midrib_change_max, 0.02);
  EXPECT_LT(s.report.area_change_last, -0.05);
  EXPECT_GT(s.report.area_change_last, -0.15);
  EXPECT_TRUE(s.report.energy_fell);
  EXPECT_LE(s.report.unconverged, 2);
  const WiltFrame &first = s.frames.front(), &last = s.frames.back();
  EXPECT_NEAR(first.water, 1, 1e-9);
  EXPECT_LT(largest_move(s.surfaces.front().position_m, body.rest.position_m), 1e-6);
  EXPECT_LT(last.water, turgor_loss_point({}));
  for (std::size_t k = 1; k < s.frames.size(); ++k) EXPECT_LT(s.frames[k].water, s.frames[k - 1].water);
  // The petiole droops, the blade sinks, by 30 to 60 degrees and more (seen at a relative water content of 60 to 70 %).
  EXPECT_GT(last.tip_drop_deg, 30);
  EXPECT_GT(last.drop_m, 0.1 * leaf.main_vein_m);
  for (std::size_t k = 0; k < s.surfaces.size(); ++k) {
    EXPECT_NO_THROW(s.surfaces[k].validate());
    const check::MeshReport r = check::check_mesh(to_tri_mesh(blade_of(s.surfaces[k]), true));
    EXPECT_EQ(r.self_intersections, 0u) << "frame " << k;
    EXPECT_EQ(r.degenerate_faces, 0u) << "frame " << k;
  }
  std::printf("[   INFO   ] wilting: water %.3f, area %.1f %%, midrib %.2f %%, petiole tip %.0f deg, balance %.1e\n", last.water,
              100 * last.area_change, 100 * s.report.midrib_change_max, last.tip_drop_deg, s.report.balance_error);
}

TEST(Wilt, AWateredLeafDoesNot) {
  const LeafModel leaf = small_leaf();
  WiltOptions o;
  o.water.supply_curve = {{0, 1}, {100, 1}};
  o.frames = 4;
  const Series s = run(wilt_body(leaf), o);
  EXPECT_LT(s.report.balance_error, 1e-9);
  EXPECT_GT(s.frames.back().water, 0.88);  // with open stomata it runs a little below full turgor
  EXPECT_GT(s.frames.back().area_change, -0.02);
  EXPECT_LT(s.frames.back().tip_drop_deg, 8);
  EXPECT_LT(s.frames.back().drop_m, 0.1 * leaf.main_vein_m);
}

TEST(Wilt, RewateringAboveTheTurgorLossPointBringsItBack) {
  const LeafModel leaf = small_leaf();
  const WiltBody body = wilt_body(leaf);
  WiltOptions o;
  o.water.supply_curve = {{0, 0}, {0.7, 0}, {0.75, 1}, {100, 1}};
  o.length_hours = 14;
  o.frame_hours = {0, 0.25, 0.5, 0.7, 1.5, 4, 8, 14};
  const Series s = run(body, o);
  double lowest = 1;
  for (const WiltFrame& f : s.frames) lowest = std::min(lowest, f.water);
  EXPECT_GT(lowest, turgor_loss_point(o.tissue));
  EXPECT_GT(s.frames[3].tip_drop_deg, 5);
  EXPECT_GT(s.frames[3].drop_m, 0.01);
  EXPECT_LT(s.frames.back().tip_drop_deg, 0.5 * s.frames[3].tip_drop_deg);
  EXPECT_LT(s.frames.back().drop_m, 0.5 * s.frames[3].drop_m);
  EXPECT_LT(s.report.balance_error, 1e-9);
}

TEST(Wilt, SameBitsForAnyNumberOfThreads) {
  const WiltBody body = wilt_body(small_leaf());
  WiltOptions o;
  o.frames = 3;
  o.length_hours = 2;
  std::vector<Series> all;
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    all.push_back(run(body, o));
  }
  for (std::size_t k = 1; k < all.size(); ++k)
    for (std::size_t f = 0; f < 3; ++f) {
      EXPECT_EQ(all[k].surfaces[f].position_m, all[0].surfaces[f].position_m);
      EXPECT_EQ(all[k].surfaces[f].field("stress_von_mises_MPa").values, all[0].surfaces[f].field("stress_von_mises_MPa").values);
    }
}

TEST(Wilt, RefusesBodiesThatCannotStand) {
  WiltBody b = test::strip(0.1, 0.02, 10, 2);
  EXPECT_THROW(run(b, {}), InvalidInput);  // nothing holds it
  b.clamp = {0, 1, 999};
  EXPECT_THROW(run(b, {}), InvalidInput);
  b.clamp = {0, 1, 2};
  b.rest.position_m[5].x = std::nan("");
  EXPECT_THROW(run(b, {}), InvalidInput);
  WiltOptions o;
  o.frame_hours = {0, 2, 1};
  EXPECT_THROW(run(test::cantilever(0.1, 0.02, 10, 2), o), InvalidInput);
}

}  // namespace
}  // namespace witherfield::leaf
