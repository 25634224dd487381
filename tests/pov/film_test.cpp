// Laws of the film: ends are the key pictures, nothing turns back that does not turn in the keys, the blend error is
// measured and kept below its bound, the clock is even.
#include <gtest/gtest.h>

#include <cmath>

#include "pov/film.hpp"
#include "pov/tonemap.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr int kWidth = 16, kHeight = 9;

/// A worn picture: every pixel fades at a rate of its own, from bright to dark or the other way.
HdrImage wearing(double moment) {
  HdrImage image{kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double rate = 1 + 0.15 * i, gone = (1 - std::exp(-rate * moment)) / (1 - std::exp(-rate));
    const double from = 0.1 + 0.003 * i, to = 0.5 - 0.003 * i;
    image.pixel.push_back(glm::vec3(float(from + (to - from) * gone)) * glm::vec3(1, 0.8f, 0.6f));
  }
  return image;
}

KeySet keys_of(double bound, int* rendered = nullptr, int max_keys = 65) {
  return choose_keys(std::vector<double>{0, 0.1, 1}, [&](double m) { return (rendered ? ++*rendered : 0), wearing(m); },
                     {1, bound, max_keys});
}

TEST(Film, EndsAndKeysAreTheRenderedPictures) {
  const KeySet set = keys_of(0.5);
  const std::vector<double> clock = film_clock(set.keys, Pace::even, 1);
  EXPECT_EQ(picture_between(set.keys, clock, 0).pixel, wearing(0).pixel);
  EXPECT_EQ(picture_between(set.keys, clock, 1).pixel, wearing(1).pixel);
  for (std::size_t i = 0; i < clock.size(); ++i)
    EXPECT_LT(difference(picture_between(set.keys, clock, clock[i]), set.keys[i].image, 1).rms, 1e-4) << i;
}

TEST(Film, BlendErrorIsBelowItsBoundAndTrueFramesAreNearerStill) {
  int rendered = 0;
  const KeySet set = keys_of(0.5, &rendered);
  EXPECT_EQ(set.gaps_left, 0);
  EXPECT_EQ(rendered, int(set.keys.size()));  // nothing rendered is thrown away
  EXPECT_GT(set.blend_error.rms, 0);
  EXPECT_LE(set.blend_error.rms, 0.5);
  const std::vector<double> clock = film_clock(set.keys, Pace::even, 1);
  double worst = 0;
  for (double at = 0.005; at < 1; at += 0.01)
    worst = std::max(worst, difference(picture_between(set.keys, clock, at), wearing(moment_at(set.keys, clock, at)), 1).rms);
  EXPECT_LE(worst, set.blend_error.rms);
}

TEST(Film, ATighterBoundTakesMoreKeysAndALimitIsTold) {
  EXPECT_GT(keys_of(0.1).keys.size(), keys_of(2).keys.size());
  const KeySet few = keys_of(0.01, nullptr, 4);
  EXPECT_EQ(few.keys.size(), 4u);
  EXPECT_GT(few.gaps_left, 0);
}

TEST(Film, GapsAreDividedAtKnownMomentsFirst) {
  const KeySet set = keys_of(2);
  bool known = false;
  for (const KeyPicture& k : set.keys) known |= k.moment == 0.1;
  EXPECT_TRUE(known);
  for (std::size_t i = 1; i < set.keys.size(); ++i) EXPECT_GT(set.keys[i].moment, set.keys[i - 1].moment);
}

TEST(Film, NothingFlickers) {
  const KeySet set = keys_of(0.5);
  const std::vector<double> clock = film_clock(set.keys, Pace::even, 1);
  FrameWatch watch;
  constexpr int kFrames = 200;
  for (int i = 0; i < kFrames; ++i) watch.add(develop(picture_between(set.keys, clock, double(i) / (kFrames - 1)), 1));
  EXPECT_EQ(watch.largest_fall(), 0);
  EXPECT_NEAR(watch.detour(), 1, 1e-12);  // every value goes one way only
  EXPECT_GT(watch.from_first(), 10);
  EXPECT_LE(watch.neighbour_max(), 1 + 4 * 255.0 / (kFrames - 1));
}

TEST(Film, TheEvenClockMakesEqualSteps) {
  const KeySet set = keys_of(0.2);
  const auto steps = [&](Pace pace) {
    const std::vector<double> clock = film_clock(set.keys, pace, 1);
    double least = 1e9, most = 0;
    for (int i = 0; i < 40; ++i) {
      const double d = difference(picture_between(set.keys, clock, i / 40.0), picture_between(set.keys, clock, (i + 1) / 40.0), 1).rms;
      least = std::min(least, d);
      most = std::max(most, d);
    }
    return most / least;
  };
  EXPECT_LT(steps(Pace::even), 1.5);
  EXPECT_GT(steps(Pace::time), 5);
  EXPECT_NEAR(moment_at(set.keys, film_clock(set.keys, Pace::time, 1), 0.37), 0.37, 1e-9);
}

TEST(Film, KeysThatShowTheSameStillMakeAClock) {
  const HdrImage image = wearing(0.5);
  const std::vector<KeyPicture> keys{{0, image}, {0.5, image}, {1, image}};
  const std::vector<double> clock = film_clock(keys, Pace::even, 1);
  EXPECT_EQ(picture_between(keys, clock, 0.3).pixel, image.pixel);
}

TEST(FrameWatch, SeesAFlickerAndAFall) {
  FrameWatch watch;
  for (std::uint8_t level : {10, 20, 12, 30}) watch.add(std::vector<std::uint8_t>(30, level));
  EXPECT_EQ(watch.neighbour_max(), 18);
  EXPECT_EQ(watch.neighbour_p999(), 18);
  EXPECT_DOUBLE_EQ(watch.neighbour_mean_max(), 18);
  EXPECT_DOUBLE_EQ(watch.largest_fall(), 8);
  EXPECT_DOUBLE_EQ(watch.from_first(), 20);
  EXPECT_DOUBLE_EQ(watch.detour(), (10 + 8 + 18) / 20.0);
}

TEST(FrameWatch, OneGlintInAThousandIsToldApart) {
  FrameWatch watch;
  std::vector<std::uint8_t> frame(3000, 50);
  watch.add(frame);
  frame[7] = 250;
  for (std::size_t i = 100; i < 200; ++i) frame[i] = 53;
  watch.add(frame);
  EXPECT_EQ(watch.neighbour_max(), 200);
  EXPECT_EQ(watch.neighbour_p999(), 3);
}

TEST(Film, SizesAndMomentsAreChecked) {
  const HdrImage small{2, 2, std::vector<glm::vec3>(4)};
  EXPECT_THROW(difference(small, wearing(0), 1), InvalidInput);
  const PictureAt at = [](double m) { return wearing(m); };
  EXPECT_THROW(choose_keys(std::vector<double>{0}, at, {}), InvalidInput);
  EXPECT_THROW(choose_keys(std::vector<double>{1, 0}, at, {}), InvalidInput);
  EXPECT_THROW(choose_keys(std::vector<double>{0, 1}, at, {1, 0, 9}), InvalidInput);
}

}  // namespace
}  // namespace witherfield::pov
