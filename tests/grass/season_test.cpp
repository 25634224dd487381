// Water and chlorophyll over the season.
#include "sim/grass/season.hpp"

#include <gtest/gtest.h>

#include <array>

#include "sim/core/errors.hpp"
#include "sim/grass/blades.hpp"

namespace witherfield::grass {
namespace {

SeasonCurves curves(Climate climate) {
  SeasonOptions o;
  o.climate = climate;
  return SeasonCurves(o);
}

TEST(Season, CurvesMatchTheirTable) {
  constexpr std::array chlorophyll{1.0, .992, .970, .907, .759, .510, .261, .113, .050, .028, .020};
  constexpr std::array standard{1.0, .996, .985, .956, .886, .739, .512, .286, .139, .069, .040};
  constexpr std::array rich{1.0, .999, .997, .992, .979, .944, .862, .697, .463, .249, .120};
  constexpr std::array cold{1.0, .996, .977, .886, .600, .240, .086, .049, .042, .040, .040};
  for (std::size_t i = 0; i < 11; ++i) {
    const double wd = 0.1 * double(i);
    EXPECT_NEAR(curves(Climate::standard).chlorophyll(wd), chlorophyll[i], 6e-4) << wd;
    EXPECT_NEAR(curves(Climate::standard).water(wd), standard[i], 6e-4) << wd;
    EXPECT_NEAR(curves(Climate::water_rich).water(wd), rich[i], 6e-4) << wd;
    EXPECT_NEAR(curves(Climate::cold).water(wd), cold[i], 6e-4) << wd;
  }
}

TEST(Season, WaterRichStaysWetterAndColdDriesSooner) {
  for (double wd = 0.02; wd < 0.99; wd += 0.02) {
    EXPECT_GT(curves(Climate::water_rich).water(wd), curves(Climate::standard).water(wd));
    EXPECT_LE(curves(Climate::cold).water(wd), curves(Climate::standard).water(wd) + 0.005);
  }
  EXPECT_LT(curves(Climate::cold).water(0.4), 0.7 * curves(Climate::standard).water(0.4));
}

TEST(Season, SpotsStayWithinTheSeasonAndFallMonotonically) {
  const SeasonCurves c = curves(Climate::standard);
  for (double onset : {0.05, 0.3, 0.5, 0.8, 0.95})
    for (double arc : {0.0, 0.5, 1.0}) {
      EXPECT_DOUBLE_EQ(c.spot_wd(0, onset, arc), 0);
      EXPECT_DOUBLE_EQ(c.spot_wd(1, onset, arc), 1);
      double last = 2;
      for (double wd = 0; wd <= 1; wd += 0.01) {
        EXPECT_LE(c.spot_chlorophyll(wd, onset, arc), last);
        last = c.spot_chlorophyll(wd, onset, arc);
        EXPECT_LE(c.spot_water(wd, onset, 1.0), c.spot_water(wd, onset, 0.0) + 1e-12) << "the tip dries first";
      }
    }
}

TEST(Season, MeanOverBladesFollowsTheCanopyCurve) {
  SeasonOptions o;
  const SeasonCurves c(o);
  const std::vector<Blade> blades = make_blades(BladeOptions{.count = 4000}, 1.0, o, 0.0, 3, 0);
  for (double wd : {0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0}) {
    double mean = 0;
    for (const Blade& b : blades)
      for (double arc : {0.1, 0.3, 0.5, 0.7, 0.9}) mean += c.spot_chlorophyll(wd, b.onset, arc);
    mean /= double(blades.size()) * 5;
    EXPECT_NEAR(mean, c.chlorophyll(wd), 0.08) << wd;  // a spread of fast onsets makes the slow canopy curve
  }
}

TEST(Season, UserCurvesReplaceThePresetsAndAreChecked) {
  SeasonOptions o;
  o.water_curve = {{0, 1}, {0.5, 0.8}, {1, 0.1}};
  EXPECT_DOUBLE_EQ(SeasonCurves(o).water(0.5), 0.8);
  o.water_curve = {{0, 1}, {0.5, 0.2}, {1, 0.4}};
  EXPECT_THROW(SeasonCurves{o}, InvalidInput);
  o.water_curve = {{0, 1.2}, {1, 0.4}};
  EXPECT_THROW(SeasonCurves{o}, InvalidInput);
  o.water_curve = {{0, 1}, {0, 0.4}};
  EXPECT_THROW(SeasonCurves{o}, InvalidInput);
}

}  // namespace
}  // namespace witherfield::grass
