// Stamping against a plain sum in doubles.
#include "sim/floor/stamp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "sim/floor/masks.hpp"

namespace witherfield::floor {
namespace {

constexpr int kAngles = 72;

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

/// Two unlike masks.
const std::vector<Mask>& masks() {
  static const std::vector<Mask> m{make_mask(Sole::man, 0.27, 120), make_mask(Sole::woman_toe_slide, 0.24, 120)};
  return m;
}
const std::vector<StampSet>& sets() {
  static const std::vector<StampSet> s{StampSet(masks()[0].pressure, masks()[0].size, kAngles),
                                       StampSet(masks()[1].pressure, masks()[1].size, kAngles)};
  return s;
}

std::vector<Placement> random_placements(int n, int nx, int ny) {
  Random r(5, Stream::test, 1);
  std::vector<Placement> all(static_cast<std::size_t>(n));
  for (Placement& p : all) {
    p.x = float(r.uniform(-30, nx + 30));
    p.y = float(r.uniform(-30, ny + 30));
    p.shape = std::uint16_t(r.uniform() * 2);
    p.angle = std::uint16_t(r.uniform() * kAngles);
    p.mirrored = r.uniform() < 0.5;
    for (float& s : p.scale) s = float(r.uniform(0.5, 2));
  }
  return all;
}

std::vector<float> stamped(const std::vector<Placement>& all, int nx, int ny, TileSize tile = {}, int scale = 0) {
  std::vector<float> plane(std::size_t(nx) * std::size_t(ny));
  const StampPass pass[] = {{&sets(), {{plane.data(), scale}}}};
  add_stamps(all, pass, nx, ny, tile);
  return plane;
}

/// The definition: mirror, turn, scale to the mask's sum, spread over four cells.
std::vector<double> reference(const std::vector<Placement>& all, int nx, int ny) {
  std::vector<double> plane(std::size_t(nx) * std::size_t(ny));
  for (const Placement& p : all) {
    const Mask& m = masks()[p.shape];
    std::vector<float> v = m.pressure;
    if (p.mirrored)
      for (int j = 0; j < m.size; ++j)
        for (int i = 0; i < m.size; ++i)
          v[std::size_t(j * m.size + i)] = m.pressure[std::size_t((m.size - 1 - j) * m.size + i)];
    const int out = m.size + 4, c = (out - 1) / 2;
    v = rotate(v, m.size, rotation(p.angle, kAngles), out);
    const double ratio = sum(m.pressure) / sum(v);
    const double x = p.x - 0.5, y = p.y - 0.5;
    const int i0 = int(std::floor(x)), j0 = int(std::floor(y));
    for (int j = 0; j < out; ++j)
      for (int i = 0; i < out; ++i)
        for (int b = 0; b < 2; ++b)
          for (int a = 0; a < 2; ++a) {
            const int k = i0 + i - c + a, l = j0 + j - c + b;
            if (k < 0 || l < 0 || k >= nx || l >= ny) continue;
            plane[std::size_t(l) * std::size_t(nx) + std::size_t(k)] += double(p.scale[0]) * ratio *
                v[std::size_t(j * out + i)] * (a ? x - i0 : 1 - (x - i0)) * (b ? y - j0 : 1 - (y - j0));
          }
  }
  return plane;
}

TEST(Stamps, AreThePlainSumCellByCell) {
  const int nx = 150, ny = 90;
  const std::vector<Placement> all = random_placements(200, nx, ny);
  const std::vector<float> fast = stamped(all, nx, ny, {64, 32});
  const std::vector<double> plain = reference(all, nx, ny);
  const double top = *std::max_element(plain.begin(), plain.end());
  for (std::size_t n = 0; n < plain.size(); ++n) ASSERT_NEAR(fast[n], plain[n], 2e-6 * top) << n % std::size_t(nx) << ' ' << n / std::size_t(nx);
}

TEST(Stamps, OneStampKeepsItsSumWhereverItLies) {
  for (const double x : {60.0, 60.25, 60.5, 63.9})
    for (int angle = 0; angle < kAngles; angle += 7)
      for (const bool mirrored : {false, true}) {
        Placement p;
        p.x = float(x);
        p.y = 57.3f;
        p.angle = std::uint16_t(angle);
        p.mirrored = mirrored;
        p.scale[0] = 1;
        ASSERT_NEAR(sum(stamped({p}, 128, 120)), sum(masks()[0].pressure), 1e-4);
      }
}

TEST(Stamps, QuarterTurnsOfAWholeCellStampAreExact) {
  Placement p;
  p.x = p.y = 40.5f;
  p.scale[0] = 1;
  const std::vector<float> still = stamped({p}, 81, 81);
  p.angle = kAngles / 4;
  const std::vector<float> turned = stamped({p}, 81, 81);
  for (int j = 0; j < 81; ++j)
    for (int i = 0; i < 81; ++i) ASSERT_EQ(turned[std::size_t(i * 81 + 80 - j)], still[std::size_t(j * 81 + i)]);
}

TEST(Stamps, ALeftFootIsTheMirrorImageOfARightOne) {
  Placement p;
  p.x = p.y = 40.5f;
  p.scale[0] = 1;
  p.angle = 5;
  const std::vector<float> right = stamped({p}, 81, 81);
  p.angle = kAngles - 5;
  p.mirrored = true;
  const std::vector<float> left = stamped({p}, 81, 81);
  for (int j = 0; j < 81; ++j)
    for (int i = 0; i < 81; ++i) ASSERT_EQ(left[std::size_t((80 - j) * 81 + i)], right[std::size_t(j * 81 + i)]);
}

TEST(Stamps, SameBitsForAnyTilesAndThreads) {
  const int nx = 700, ny = 300;
  const std::vector<Placement> all = random_placements(3000, nx, ny);
  const std::vector<float> whole = stamped(all, nx, ny, {1024, 512});
  for (const TileSize tile : {TileSize{512, 64}, {100, 37}, {33, 300}, {16, 16}}) {
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      ASSERT_EQ(stamped(all, nx, ny, tile), whole) << tile.width << ' ' << tile.height << ' ' << threads;
    }
  }
}

TEST(Stamps, PlanesDifferByTheirScaleOnly) {
  const int nx = 200, ny = 200;
  std::vector<Placement> all = random_placements(300, nx, ny);
  for (Placement& p : all) p.scale = {1, 2, 0.5f, 0, 0};
  std::vector<float> a(40000), b(40000), c(40000);
  const StampPass pass[] = {{&sets(), {{a.data(), 0}, {b.data(), 1}, {c.data(), 2}}}};
  add_stamps(all, pass, nx, ny);
  for (std::size_t n = 0; n < a.size(); ++n) {  // powers of two: exact
    ASSERT_EQ(b[n], 2 * a[n]);
    ASSERT_EQ(c[n], 0.5f * a[n]);
  }
  const std::vector<float> alone = stamped(all, nx, ny);
  for (std::size_t n = 0; n < a.size(); ++n) ASSERT_NEAR(a[n], alone[n], 1e-5f * (1 + a[n]));
}

TEST(Stamps, OutsideThePlaneNothingHappens) {
  Placement p;
  p.x = -500;
  p.y = 20;
  p.scale[0] = 1;
  EXPECT_EQ(sum(stamped({p}, 64, 64)), 0);
  EXPECT_EQ(sum(stamped({}, 64, 64)), 0);
}

}  // namespace
}  // namespace witherfield::floor
