// Tissue and blade mechanics: laws, rest states, convergence, thread independence.
#include "sim/grass/mechanics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::grass {
namespace {

BladeMotion motion(const TissueOptions& t, const SeasonOptions& s, int count = 30, BladeForm form = BladeForm::ribbon) {
  BladeOptions b;
  b.count = count;
  b.form = form;
  return BladeMotion(make_blades(b, 0.2, s, 0.0, 11, 0), b, s, t, ColourOptions{});
}

double arc_length(const BladeState& s, int blade) {
  double l = 0;
  const std::size_t n = std::size_t(s.nodes_per_blade()), base = n * std::size_t(blade);
  for (std::size_t k = 1; k < n; ++k) l += glm::distance(s.node_m[base + k], s.node_m[base + k - 1]);
  return l;
}

TEST(Turgor, MatchesThePressureVolumeRelation) {  // pi0 = -1.2, eps = 8 MPa: turgor loss at RWC 0.85; P(1) = 1.2, P(.9) = .4
  TissueOptions t;
  EXPECT_NEAR(turgor_MPa(t, 1.0), 1.2, 1e-12);
  EXPECT_NEAR(turgor_MPa(t, 0.9), 0.4, 1e-12);
  EXPECT_NEAR(turgor_MPa(t, 0.85), 0.0, 1e-12);
  EXPECT_EQ(turgor_MPa(t, 0.5), 0.0);
}

TEST(Tissue, BendingModulusIsFreshLimpDry) {
  TissueOptions t;
  EXPECT_DOUBLE_EQ(bending_modulus_MPa(t, 1.0), 300);
  EXPECT_DOUBLE_EQ(bending_modulus_MPa(t, 0.6), 40);
  EXPECT_DOUBLE_EQ(bending_modulus_MPa(t, 0.0), 600);
}

TEST(Tissue, FreshIsWithoutStrainAndStress) {
  const TissueState s = tissue_state(TissueOptions{}, 1.0);
  EXPECT_EQ(s.strain_vein, 0);
  EXPECT_EQ(s.strain_mesophyll, 0);
  EXPECT_EQ(s.stress_vein_MPa, 0);
  EXPECT_EQ(s.stress_mesophyll_MPa, 0);
}

TEST(Tissue, VeinShrinksLessAndForcesBalance) {
  TissueOptions t;
  for (double w = 0.98; w >= 0; w -= 0.02) {
    const TissueState s = tissue_state(t, w);
    EXPECT_LT(s.strain_mesophyll, s.strain_vein);
    EXPECT_LT(s.strain_vein, 0);
    EXPECT_LT(s.stress_vein_MPa, 0) << "the shrinking mesophyll presses the vein";
    EXPECT_GT(s.stress_mesophyll_MPa, 0);
    EXPECT_NEAR(t.vein_fraction * s.stress_vein_MPa + (1 - t.vein_fraction) * s.stress_mesophyll_MPa, 0, 1e-9);
    EXPECT_GT(modulus_vein_MPa(t, w), modulus_mesophyll_MPa(t, w));
  }
  EXPECT_NEAR(tissue_state(t, 0).strain_mesophyll, -0.68, 1e-12);
}

TEST(Tissue, ShrinkingSlowsDownAsTheWallsStiffen) {
  TissueOptions t;
  double last = 1e9;
  for (double w = 0.95; w >= 0.05; w -= 0.05) {
    const double rate = (shrink_progress(t, w - 1e-5) - shrink_progress(t, w + 1e-5)) / 2e-5;
    EXPECT_LT(rate, last);
    EXPECT_NEAR(rate * modulus_mesophyll_MPa(t, w), 50 / std::log(6.0), 1e-3) << "d eps = k dw E_fresh / E(w)";
    last = rate;
  }
}

class BothMotions : public ::testing::TestWithParam<Motion> {
 protected:
  TissueOptions tissue() const {
    TissueOptions t;
    t.motion = GetParam();
    return t;
  }
};

TEST_P(BothMotions, RootsDoNotMoveAndEverythingStaysAboveGround) {
  BladeMotion m = motion(tissue(), SeasonOptions{});
  const BladeState start = m.state();
  m.advance_to(1.0);
  const BladeState end = m.state();
  const std::size_t n = std::size_t(start.nodes_per_blade());
  for (std::size_t b = 0; b < start.node_m.size(); b += n) EXPECT_LT(glm::distance(start.node_m[b], end.node_m[b]), 1e-9);
  for (const glm::dvec3& p : end.node_m) EXPECT_GE(p.z, 0);
  for (std::size_t i = 0; i < end.node_m.size(); ++i) {
    EXPECT_NEAR(glm::length(end.tangent[i]), 1, 1e-12);
    EXPECT_NEAR(glm::length(end.side[i]), 1, 1e-12);
    EXPECT_NEAR(glm::dot(end.side[i], end.tangent[i]), 0, 1e-12);
  }
}

TEST_P(BothMotions, BladesDroopTipFasterThanRoot) {
  BladeMotion m = motion(tissue(), SeasonOptions{});
  const BladeState start = m.state();
  m.advance_to(0.7);
  const BladeState end = m.state();
  const std::size_t n = std::size_t(start.nodes_per_blade());
  double before = 0, after = 0, low = 0, high = 0;
  for (std::size_t b = 0; b < start.node_m.size(); b += n) {
    before += start.node_m[b + n - 1].z;
    after += end.node_m[b + n - 1].z;
    const auto turned = [&](std::size_t k) {
      return std::acos(std::clamp(glm::dot(glm::normalize(start.node_m[b + k] - start.node_m[b]),
                                           glm::normalize(end.node_m[b + k] - end.node_m[b])), -1.0, 1.0));
    };
    low += turned(n / 4);
    high += turned(n - 1);
  }
  EXPECT_LT(after, 0.85 * before);
  EXPECT_GT(high, 1.5 * low);
}

TEST_P(BothMotions, SecondOrderInTheTimeStep) {
  SeasonOptions s;
  TissueOptions t = tissue();
  t.response_days = 6;  // lets the coarse steps be coarse: the stability floor is 3 steps per response time
  const auto tips = [&](double per_day) {
    s.steps_per_day = per_day;
    BladeMotion m = motion(t, s, 12);
    m.advance_to(0.55);
    const BladeState state = m.state();
    std::vector<glm::dvec3> out;
    const std::size_t n = std::size_t(state.nodes_per_blade());
    for (std::size_t b = n - 1; b < state.node_m.size(); b += n) out.push_back(state.node_m[b]);
    return out;
  };
  const auto reference = tips(256);
  const auto error = [&](double per_day) {
    const auto x = tips(per_day);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += glm::distance(x[i], reference[i]);
    return sum;
  };
  const double e1 = error(2), e3 = error(8);
  EXPECT_GT(0.5 * std::log2(e1 / e3), 1.7);
  EXPECT_LT(e3 / double(reference.size()), 2e-5) << "metres";
}

TEST_P(BothMotions, KeyFramesOnTheWayChangeNothing) {
  SeasonOptions s;
  s.steps_per_day = 8;
  BladeMotion direct = motion(tissue(), s), stepped = motion(tissue(), s);
  direct.advance_to(0.6);
  for (double wd : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}) stepped.advance_to(wd);
  const BladeState a = direct.state(), b = stepped.state();
  for (std::size_t i = 0; i < a.node_m.size(); ++i) EXPECT_LT(glm::distance(a.node_m[i], b.node_m[i]), 2e-5);
}

TEST_P(BothMotions, SameBitsForAnyThreadCount) {
  std::vector<BladeState> states;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    BladeMotion m = motion(tissue(), SeasonOptions{}, 50);
    m.advance_to(0.8);
    states.push_back(m.state());
  }
  EXPECT_EQ(0, std::memcmp(states[0].node_m.data(), states[1].node_m.data(), states[0].node_m.size() * sizeof(glm::dvec3)));
  EXPECT_EQ(states[0].stress_vein_MPa, states[1].stress_vein_MPa);
}

INSTANTIATE_TEST_SUITE_P(Grass, BothMotions, ::testing::Values(Motion::rod, Motion::paper),
                         [](const auto& info) { return info.param == Motion::rod ? "Rod" : "Paper"; });

TEST(Rod, KeepsItsLengthButForTheShrinkage) {
  TissueOptions t;
  BladeMotion m = motion(t, SeasonOptions{});
  const BladeState start = m.state();
  m.advance_to(1.0);
  const BladeState end = m.state();
  for (int b = 0; b < start.blade_count(); ++b) {
    EXPECT_NEAR(arc_length(start, b), m.blades()[std::size_t(b)].length_m, 1e-9);
    const double ratio = arc_length(end, b) / arc_length(start, b);
    EXPECT_GT(ratio, 1 + t.shrink_length - 1e-9);
    EXPECT_LT(ratio, 1 + 0.9 * t.shrink_length);
  }
}

TEST(Rod, FreshGrassStandsStill) {
  SeasonOptions s;
  s.water_curve = {{0, 1}, {1, 1}};
  BladeMotion m = motion(TissueOptions{}, s);
  const BladeState start = m.state();
  m.advance_to(1.0);
  const BladeState end = m.state();
  for (std::size_t i = 0; i < start.node_m.size(); ++i) EXPECT_LT(glm::distance(start.node_m[i], end.node_m[i]), 1e-9);
  for (const glm::dvec3& v : end.velocity_m_day) EXPECT_LT(glm::length(v), 1e-6);
}

TEST(Rod, SagsAsMuchAsACantileverInTheSmall) {
  // A short stiff horizontal blade whose stiffness drops from E1 to E2 sags by w L^4 / 8 I (1/E2 - 1/E1) (Euler-Bernoulli).
  TissueOptions t;
  t.bending_fresh_MPa = 3000;
  t.bending_limp_MPa = 1000;
  t.bending_dry_MPa = 1000;
  t.base_to_tip_stiffness = 1;
  t.shrink_length = 0;
  t.creep_days = 1000;
  SeasonOptions s;
  s.length_days = 20;
  s.steps_per_day = 20;
  s.onset_sd = 0;
  s.tip_advance = 0;
  s.water_curve = {{0, 1}, {0.2, 0.6}, {1, 0.6}};
  BladeOptions b;
  b.form = BladeForm::cone;
  b.segments = 128;
  Blade blade;
  blade.root_m = {0, 0, 0};
  blade.length_m = 0.03;
  blade.width_m = 0.001;
  blade.thickness_m = 0.0002;
  blade.lean_rad = M_PI / 2 - 0.25;  // clear of the ground
  t.dry_mass_fraction = 0.9;
  BladeMotion m({blade}, b, s, t, ColourOptions{});
  const BladeState start = m.state();
  m.advance_to(1.0);
  const BladeState end = m.state();
  const double sag = start.node_m.back().z - end.node_m.back().z;
  // The cone's taper has no closed form handy: integrate the same Euler-Bernoulli integral independently, finely.
  const int n = 20000;
  const double L = blade.length_m, ds = L / n, mass_factor = 0.9 + 0.1 * 0.6, lean = blade.lean_rad;
  std::vector<double> shear(n + 1, 0), moment(n + 1, 0);
  double w = 0, first_moment = 0;
  for (int k = n - 1; k >= 0; --k) {
    const double x = (k + 0.5) * ds, d = 0.001 * std::max(0.02, 1 - x / L), area = M_PI / 4 * d * d;
    const double fresh = 850 * area * ds * 9.81;
    w += fresh;
    first_moment += fresh * x;
    moment[std::size_t(k)] = (first_moment - w * k * ds) * std::sin(lean);
  }
  double slope = 0, deflection = 0;
  for (int k = 0; k < n; ++k) {
    const double d = 0.001 * std::max(0.02, 1 - k * ds / L), inertia = M_PI / 64 * d * d * d * d;
    slope += moment[std::size_t(k)] / inertia * (mass_factor / 1000e6 - 1.0 / 3000e6) * ds;
    deflection += slope * ds;
  }
  EXPECT_NEAR(sag, deflection * std::sin(lean), 0.06 * deflection);
}

TEST(PaperMotion, TurnsByTheSquareOfTheHeight) {
  // v_i = omega_i l_i with omega_i = omega (h_i / H)^2: for a nearly straight leaning blade the angles turned go with k^2.
  TissueOptions t;
  t.motion = Motion::paper;
  t.shrink_length = 0;
  t.droop_rate_per_day = 0.002;  // a small turn: the lever arm hardly changes on the way
  SeasonOptions s;
  s.onset_sd = 0;
  s.tip_advance = 0;
  BladeOptions b;
  Blade blade;
  blade.length_m = 0.1;
  blade.width_m = 0.003;
  blade.thickness_m = 0.0002;
  blade.lean_rad = 0.6;
  BladeMotion m({blade}, b, s, t, ColourOptions{});
  const BladeState start = m.state();
  m.advance_to(0.6);
  const BladeState end = m.state();
  const auto turned = [&](std::size_t k) {
    return std::acos(std::clamp(glm::dot(glm::normalize(start.node_m[k]), glm::normalize(end.node_m[k])), -1.0, 1.0));
  };
  EXPECT_NEAR(turned(24) / turned(12), 4.0, 0.1);
  EXPECT_NEAR(turned(24) / turned(8), 9.0, 0.3);
  for (std::size_t k = 1; k <= 24; ++k)
    EXPECT_NEAR(glm::length(end.node_m[k]), glm::length(start.node_m[k]), 1e-9) << "l_i stays";
}

TEST(BladeMotion, RefusesToGoBack) {
  BladeMotion m = motion(TissueOptions{}, SeasonOptions{}, 2);
  m.advance_to(0.5);
  EXPECT_THROW(m.advance_to(0.4), InvalidInput);
  EXPECT_THROW(m.advance_to(1.1), InvalidInput);
}

}  // namespace
}  // namespace witherfield::grass
