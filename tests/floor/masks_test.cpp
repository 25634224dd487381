// Sole masks and their rotation.
#include "sim/floor/masks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/core/errors.hpp"
#include "tests/floor/floor_rooms.hpp"

namespace witherfield::floor {
namespace {

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

struct Centre { double x, y; };
Centre centre(const std::vector<float>& v, int size) {
  Centre c{0, 0};
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double w = v[std::size_t(j * size + i)];
      c.x += w * (i - (size - 1) / 2);
      c.y += w * (j - (size - 1) / 2);
    }
  return {c.x / sum(v), c.y / sum(v)};
}

/// Sum over the part of a sole between shares `from` and `to` of the mask's length.
double part(const Mask& m, double from, double to) {
  double s = 0;
  for (int j = 0; j < m.size; ++j)
    for (int i = int(from * m.size); i < int(to * m.size); ++i) s += m.pressure[std::size_t(j * m.size + i)];
  return s;
}

TEST(Masks, ThePapersSizeHoldsEverySole) {
  for (const Sole sole : {Sole::man, Sole::woman, Sole::man_toe_slide, Sole::woman_toe_slide}) {
    const Mask m = make_mask(sole, 0.271, 250, 99);
    EXPECT_EQ(m.size, 99);
    EXPECT_EQ(*std::max_element(m.pressure.begin(), m.pressure.end()), 1.0f);
    EXPECT_EQ(*std::min_element(m.pressure.begin(), m.pressure.end()), 0.0f);
    for (int j = 0; j < 99; ++j)  // nothing is lost in any turn
      for (int i = 0; i < 99; ++i)
        if (std::hypot(i - 49, j - 49) > 49) { ASSERT_EQ(m.pressure[std::size_t(j * 99 + i)], 0); }
  }
}

TEST(Masks, AreaAndPressureAreThoseOfAFoot) {
  const Mask m = make_mask(Sole::man, 0.271, 500);
  double area = 0;
  for (const float p : m.pressure) area += p > 0.05;
  EXPECT_NEAR(area / 500 / 500, 0.0190, 0.004) << "outsole";
  // Mean pressure under 700 N: some 50 to 100 kPa, with peaks of two to four times that.
  const double mean = sum(m.pressure) / area;
  EXPECT_GT(1 / mean, 2.0);
  EXPECT_LT(1 / mean, 4.5);
  EXPECT_GT(part(m, 0.5, 1), part(m, 0, 0.5)) << "the forefoot carries more";
}

TEST(Masks, ARaisedHeelLeavesTheWaistUntouched) {
  const Mask man = make_mask(Sole::man, 0.26, 400, 141), woman = make_mask(Sole::woman, 0.26, 400, 141);
  EXPECT_GT(part(man, 0.38, 0.46), 5 * part(woman, 0.38, 0.46));
  EXPECT_LT(sum(woman.pressure), sum(man.pressure));
}

TEST(Masks, ToeSlideReachesFurtherAndOnlyForward) {
  const Mask plain = make_mask(Sole::man, 0.27, 300, 121), slide = make_mask(Sole::man_toe_slide, 0.27, 300, 121);
  const double toe = 0.5 + 0.27 / 2 * 300 / 121;
  EXPECT_GT(part(slide, toe, 1), part(plain, toe, 1) + 3);
  EXPECT_GT(centre(slide.pressure, 121).x, centre(plain.pressure, 121).x);
}

TEST(Masks, AnyResolutionShowsTheSameSole) {
  const Mask coarse = make_mask(Sole::woman, 0.246, 150), fine = make_mask(Sole::woman, 0.246, 600);
  EXPECT_NEAR(sum(coarse.pressure) / 150 / 150, sum(fine.pressure) / 600 / 600, 0.02 * sum(fine.pressure) / 600 / 600);
  EXPECT_NEAR(centre(coarse.pressure, coarse.size).x / 150, centre(fine.pressure, fine.size).x / 600, 5e-4);
}

TEST(Masks, EvenOrTooSmallIsRefused) {
  EXPECT_THROW(make_mask(Sole::man, 0.271, 250, 98), InvalidInput);
  EXPECT_THROW(make_mask(Sole::man, 0.271, 250, 51), InvalidInput);
  UserMask u{"mine", 4, 250, std::vector<float>(16, 1)};
  EXPECT_THROW(make_mask(u, 250), InvalidInput);
  u = {"mine", 5, 250, std::vector<float>(25, 1)};
  u.grey[3] = 1.5f;
  EXPECT_THROW(make_mask(u, 250), InvalidInput);
  u.grey.assign(25, 0.0f);
  EXPECT_THROW(make_mask(u, 250), InvalidInput);
}

TEST(Masks, AUsersMaskIsKeptOrResampled) {
  UserMask u{"mine", 9, 250, std::vector<float>(81)};
  for (int n = 20; n < 60; ++n) u.grey[std::size_t(n)] = 0.01f * float(n);
  EXPECT_EQ(make_mask(u, 250).pressure, u.grey) << "to the last bit at its own resolution";
  const Mask half = make_mask(u, 125);
  EXPECT_NEAR(sum(half.pressure) * 4, sum(u.grey), 0.02 * sum(u.grey));
}

TEST(Rotation, QuarterTurnsPermuteExactly) {
  const Mask m = make_mask(Sole::man, 0.271, 250, 99);
  const auto at = [](const std::vector<float>& v, int i, int j) { return v[std::size_t(j * 99 + i)]; };
  const std::vector<float> quarter = rotate(m.pressure, 99, rotation(1, 4), 99);
  const std::vector<float> half = rotate(m.pressure, 99, rotation(2, 4), 99);
  for (int j = 0; j < 99; ++j)
    for (int i = 0; i < 99; ++i) {  // counter-clockwise: (x, y) goes to (-y, x)
      ASSERT_EQ(at(quarter, 98 - j, i), at(m.pressure, i, j));
      ASSERT_EQ(at(half, 98 - i, 98 - j), at(m.pressure, i, j));
    }
  EXPECT_EQ(rotate(m.pressure, 99, rotation(0, 4), 99), m.pressure);
  EXPECT_EQ(rotate(rotate(half, 99, rotation(1, 4), 99), 99, rotation(1, 4), 99), m.pressure);
}

TEST(Rotation, TurnsTheToeWhereTheHeadingPoints) {
  const Mask m = make_mask(Sole::man, 0.271, 250, 99);
  const Centre before = centre(m.pressure, 99);
  ASSERT_GT(before.x, 1);
  for (int k = 0; k < 16; ++k) {
    const double a = 2 * std::numbers::pi * k / 16;
    const std::vector<float> v = rotate(m.pressure, 99, rotation(k, 16), 99);
    const Centre c = centre(v, 99);
    EXPECT_NEAR(c.x, before.x * std::cos(a) - before.y * std::sin(a), 0.05) << k;
    EXPECT_NEAR(c.y, before.x * std::sin(a) + before.y * std::cos(a), 0.05) << k;
    EXPECT_NEAR(sum(v), sum(m.pressure), 0.005 * sum(m.pressure)) << "a rotation keeps the area (the printed one does not)";
  }
}

TEST(SoleSet, ChoosesSexKindAndNearestSize) {
  FloorOptions o = patrol_gallery();
  const SoleSet set(o);
  EXPECT_EQ(set.masks().size(), 12u);
  Step s;
  const auto mask = [&](double length, Sole sole) { return set.mask_of(pack(s, 0, 700, length, int(sole), Behaviour::pass)); };
  EXPECT_EQ(mask(0.271, Sole::man), 1);
  EXPECT_EQ(mask(0.250, Sole::man), 0);
  EXPECT_EQ(mask(0.300, Sole::man), 2);
  EXPECT_EQ(mask(0.246, Sole::woman), 4);
  EXPECT_EQ(mask(0.260, Sole::woman_toe_slide), 11);
  EXPECT_LT(set.masks()[0].size, set.masks()[2].size);
}

}  // namespace
}  // namespace witherfield::floor
