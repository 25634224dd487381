// Pigments -> spectrum -> colour: each step of the chain against measured spectra and published colours.
#include "sim/grass/pigments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/colour.hpp"

namespace witherfield::grass {
namespace {

// USGS lawn grass GDS91 (Kokaly et al. 2017), 400..700 nm by 10 nm.
constexpr Spectrum kLawn{0.02516, 0.02762, 0.02987, 0.03087, 0.03127, 0.03552, 0.03642, 0.03658, 0.03661, 0.03679, 0.03945,
                         0.04658, 0.06368, 0.08418, 0.09395, 0.09705, 0.09494, 0.08426, 0.07237, 0.06598, 0.06341, 0.05997,
                         0.05584, 0.05314, 0.04997, 0.04498, 0.04254, 0.03908, 0.03837, 0.04624, 0.09008};
// USGS golden dry grass GDS480.
constexpr Spectrum kGolden{0.04255, 0.0513,  0.0609,  0.07075, 0.08026, 0.08896, 0.0974,  0.10535, 0.11295, 0.12034, 0.12753,
                           0.13459, 0.14158, 0.14852, 0.15544, 0.16247, 0.1694,  0.17635, 0.18325, 0.18972, 0.19629, 0.20273,
                           0.20873, 0.21478, 0.22034, 0.22553, 0.23063, 0.23544, 0.24063, 0.24712, 0.2541};

void expect_levels(const Spectrum& s, glm::dvec3 levels, double tolerance) {
  const glm::dvec3 got = srgb_levels(spectrum_to_linear_srgb(s));
  EXPECT_NEAR(got.x, levels.x, tolerance);
  EXPECT_NEAR(got.y, levels.y, tolerance);
  EXPECT_NEAR(got.z, levels.z, tolerance);
}

Spectrum constant(double r) {
  Spectrum s;
  s.fill(r);
  return s;
}

TEST(Colorimetry, GreysAreNeutralAndWhiteIsOne) {
  for (double r : {0.02, 0.18, 0.5, 1.0}) {
    const glm::dvec3 rgb = spectrum_to_linear_srgb(constant(r));
    EXPECT_NEAR(rgb.x, r, 1e-12);
    EXPECT_NEAR(rgb.y, r, 1e-12);
    EXPECT_NEAR(rgb.z, r, 1e-12);
  }
}

TEST(Colorimetry, StepAndBandMatchIndependentIntegration) {
  Spectrum step = constant(0), band = constant(0);
  for (int i = 0; i < kBands; ++i) {
    step[std::size_t(i)] = band_nm(i) > 580 ? 1 : band_nm(i) == 580 ? 0.5 : 0;
    band[std::size_t(i)] = std::exp(-0.5 * std::pow((band_nm(i) - 550) / 25, 2));
  }
  const glm::dvec3 a = spectrum_to_xyz(step), b = spectrum_to_xyz(band);  // 1 nm integration: .5118 .2861; .2710 .5199 .0242
  EXPECT_NEAR(a.x, 0.5118, 0.006);
  EXPECT_NEAR(a.y, 0.2861, 0.006);
  EXPECT_NEAR(b.x, 0.2710, 0.002);
  EXPECT_NEAR(b.y, 0.5199, 0.002);
  EXPECT_NEAR(b.z, 0.0242, 0.002);
}

TEST(Colorimetry, MeasuredGrassesHaveTheirPublishedColours) {
  expect_levels(kLawn, {69, 80, 47}, 1.0);
  expect_levels(kGolden, {130, 111, 81}, 1.0);
  expect_levels(reflectance_dry_grass(), {149, 132, 98}, 1.0);
}

TEST(Absorption, PeaksStandWhereTheyWereMeasured) {
  const auto peak_nm = [](const Spectrum& s) {
    return band_nm(int(std::max_element(s.begin(), s.end()) - s.begin()));
  };
  EXPECT_EQ(peak_nm(absorption_chl_a()), 430);         // 427.75 nm in ether
  EXPECT_EQ(peak_nm(absorption_chl_b()), 450);         // 453 nm
  EXPECT_EQ(peak_nm(absorption_beta_carotene()), 450); // 448.7 nm
  EXPECT_EQ(peak_nm(absorption_chl_in_vivo()), 440);
  for (int i = 15; i < kBands; ++i) EXPECT_EQ(absorption_beta_carotene()[std::size_t(i)], 0);  // none beyond 540 nm
}

TEST(PaperPigments, StartAt27To9To4AndCarotenoidStays) {
  const Pigments fresh = paper_pigments(1), dry = paper_pigments(0), half = paper_pigments(0.5);
  EXPECT_DOUBLE_EQ(fresh.chl_a / fresh.chl_b, 3);
  EXPECT_DOUBLE_EQ(fresh.chl_a / fresh.carotenoid, 27.0 / 4);
  EXPECT_DOUBLE_EQ(fresh.chl_a + fresh.chl_b + fresh.carotenoid, 1);
  EXPECT_EQ(dry.chl_a, 0);
  EXPECT_DOUBLE_EQ(dry.carotenoid, fresh.carotenoid);
  EXPECT_DOUBLE_EQ(half.chl_b, 0.5 * fresh.chl_b);
}

TEST(KubelkaMunk, ReproducesLawnGrassAndDryGrass) {
  const Spectrum green = reflectance_kubelka_munk(1), dry = reflectance_kubelka_munk(0);
  double square = 0;
  for (std::size_t i = 0; i < kBands; ++i) {
    square += std::pow(green[i] - kLawn[i], 2);
    EXPECT_NEAR(dry[i], reflectance_dry_grass()[i], 1e-12);
  }
  EXPECT_LT(std::sqrt(square / kBands), 0.0105);
  expect_levels(green, {69, 80, 47}, 8);
}

TEST(KubelkaMunk, StepsMatchTheirTable) {
  expect_levels(reflectance_kubelka_munk(1), {68, 80, 41}, 1.5);
  expect_levels(reflectance_kubelka_munk(0.75), {76, 87, 47}, 1.5);
  expect_levels(reflectance_kubelka_munk(0.5), {87, 96, 55}, 1.5);
  expect_levels(reflectance_kubelka_munk(0.25), {106, 110, 68}, 1.5);
  expect_levels(reflectance_kubelka_munk(0.1), {126, 122, 82}, 1.5);
}

TEST(KubelkaMunk, LessChlorophyllReflectsMoreEverywhereAndHueFalls) {
  double last_hue = 360;
  Spectrum last = constant(0);
  for (double c = 1; c >= 0; c -= 0.02) {
    const Spectrum r = reflectance_kubelka_munk(c);
    for (std::size_t i = 0; i < kBands; ++i) {
      EXPECT_GE(r[i], last[i]);
      EXPECT_GT(r[i], 0);
      EXPECT_LT(r[i], 1);
    }
    const double hue = lab_hue_deg(spectrum_to_linear_srgb(r));
    EXPECT_LT(hue, last_hue);
    last_hue = hue;
    last = r;
  }
}

TEST(PaperSubtraction, IsNearWhiteAsComputedFromItsFormula) {
  expect_levels(reflectance_paper(1), {237, 255, 209}, 6);
  expect_levels(reflectance_paper(0), {255, 255, 244}, 3);
}

TEST(PigmentTable, InterpolatesTheChain) {
  for (PigmentModel model : {PigmentModel::kubelka_munk, PigmentModel::paper}) {
    const PigmentTable table(model);
    for (double c = 0; c <= 1; c += 0.0313) {
      const glm::dvec3 exact = spectrum_to_linear_srgb(model == PigmentModel::paper ? reflectance_paper(c) : reflectance_kubelka_munk(c));
      EXPECT_NEAR(table(c).x, std::min(exact.x, 1.0), 1e-5);
      EXPECT_NEAR(table(c).y, std::min(exact.y, 1.0), 1e-5);
      EXPECT_NEAR(table(c).z, std::min(exact.z, 1.0), 1e-5);
    }
  }
}

}  // namespace
}  // namespace witherfield::grass
