// The additive picture C_t.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/floor/wear.hpp"
#include "tests/floor/floor_rooms.hpp"
#include "tests/floor/footprint_lists.hpp"

namespace witherfield::floor {
namespace {

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

FloorOptions small_office() {
  FloorOptions o = office_round_trips();
  o.crowd.visits = 400;
  o.crowd.visits_each = 1;
  o.footprints.pixels_per_m = 60;
  o.footprints.angle_steps = 120;
  return o;
}

TEST(Accumulate, SumIsThatOfAllStampsInTheRoom) {
  const FloorOptions o = small_office();
  std::vector<Footprint> prints = walked(o);
  std::erase_if(prints, [](const Footprint& f) { return f.x_m < 0.4f; });  // none reaches over the sill
  const Wear wear = accumulate(o, source_of(prints));
  const SoleSet soles(o);
  double footfalls = 0, dose = 0, slide = 0;
  for (const Footprint& f : prints) {
    const Mask& m = soles.masks()[std::size_t(soles.mask_of(f))];
    footfalls += m.pressure_sum();
    const double load = f.phase() == Phase::stand ? 0.5 : 0.5 / o.gait.stance_share;
    dose += load * f.weight_N() * f.contact_s() * 60 * 60;  // impulse over the area of a cell
    slide += f.slip_m() * sum(m.slide);
  }
  EXPECT_NEAR(sum(wear.floors[0].at("footfalls")), footfalls, 1e-5 * footfalls);
  EXPECT_NEAR(sum(wear.floors[0].at("dose_N_s_m2")), dose, 1e-5 * dose) << "what the floor carries is what people weigh";
  EXPECT_NEAR(sum(wear.floors[0].at("slide_m")), slide, 1e-5 * slide);
  EXPECT_EQ(wear.prints, std::int64_t(prints.size()));
}

TEST(Accumulate, NothingFallsOutsideTheRoom) {
  FloorOptions o = small_office();
  o.room.outline_m = {{0, 0}, {12, 0}, {12, 7}, {1, 7}, {0, 6}};  // a corner cut off
  const Wear wear = accumulate(o, source_of(walked(o)));
  const FloorField& f = wear.floors[0];
  for (int j = 0; j < f.ny; ++j)
    for (int i = 0; i < f.nx; ++i)
      if (const glm::dvec2 p = f.centre_m(i, j); p.y - p.x > 6.001) {
        ASSERT_EQ(f.at("footfalls")[std::size_t(j) * std::size_t(f.nx) + std::size_t(i)], 0);
      }
}

TEST(Accumulate, StretchesAddUp) {
  const FloorOptions o = small_office();
  const Wear whole = accumulate(o, source_of(walked(o)));
  Wear parts = accumulate(o, source_of(walked(o, {0, 130})));
  for (const Stretch s : {Stretch{130, 131}, {131, 400}}) add(parts, accumulate(o, source_of(walked(o, s))));
  EXPECT_EQ(parts.prints, whole.prints);
  for (const char* name : {"footfalls", "dose_N_s_m2", "slide_m"}) {
    const std::vector<float>&a = whole.floors[0].at(name), &b = parts.floors[0].at(name);
    const float top = *std::max_element(a.begin(), a.end());
    for (std::size_t n = 0; n < a.size(); ++n) ASSERT_NEAR(a[n], b[n], 2e-6f * top) << name;
  }
}

TEST(Accumulate, WhatIsAddedCanBeTakenAway) {
  const FloorOptions o = small_office();
  Wear wear = accumulate(o, source_of(walked(o)));
  const double before = sum(wear.floors[0].at("footfalls"));
  add(wear, accumulate(o, source_of(walked(o)), -1));
  for (const float v : wear.floors[0].at("footfalls")) ASSERT_EQ(v, 0) << before;
  FloorOptions other = o;
  other.footprints.pixels_per_m = 50;
  EXPECT_THROW(add(wear, accumulate(other, source_of({}))), InvalidInput);
}

TEST(Accumulate, SameBitsForAnyThreadsAndPortions) {
  const FloorOptions o = small_office();
  const std::vector<Footprint> prints = walked(o);
  Wear one, two;
  {
    const ThreadLimit limit(1);
    ASSERT_EQ(walked(o), prints) << "walking";
    one = accumulate(o, source_of(prints));
  }
  {
    const ThreadLimit limit(2);
    two = accumulate(o, source_of(prints, 17));
  }
  EXPECT_EQ(one.floors[0].at("footfalls"), two.floors[0].at("footfalls"));
  EXPECT_EQ(one.work_J_m2[0], two.work_J_m2[0]);
  EXPECT_EQ(one.soil[0], two.soil[0]);
}

TEST(Accumulate, AVisitMayStandForMany) {
  FloorOptions o = small_office();
  const Wear once = accumulate(o, source_of(walked(o)));
  o.crowd.visits_each = 8;
  const Wear eight = accumulate(o, source_of(walked(o)));
  for (std::size_t n = 0; n < once.floors[0].cells(); ++n)
    ASSERT_EQ(eight.floors[0].at("footfalls")[n], 8 * once.floors[0].at("footfalls")[n]);
}

TEST(Accumulate, UserMasksAreStamped) {
  FloorOptions o = small_office();
  o.footprints.masks = {{"dot", 5, 60, std::vector<float>(25)}};
  o.footprints.masks[0].grey[12] = 1;  // one cell in the middle
  std::vector<Footprint> prints = walked(o, {0, 50});
  std::erase_if(prints, [](const Footprint& f) { return f.x_m < 0.1f; });
  const Wear wear = accumulate(o, source_of(prints));
  EXPECT_NEAR(sum(wear.floors[0].at("footfalls")), double(prints.size()), 1e-4 * double(prints.size()));
}

}  // namespace
}  // namespace witherfield::floor
