// Laws of the parts: scales, colours, camera, reconstruction, bleeding, file information, memory.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "tests/vis/sample.hpp"
#include "vis/colour_map.hpp"
#include "vis/framing.hpp"
#include "vis/info.hpp"
#include "vis/legend.hpp"
#include "vis/reconstruct.hpp"
#include "vis/ticks.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

TEST(Ticks, AreRoundFewAndInside) {
  Random r(1, Stream::test, 2);
  for (int n = 0; n < 2000; ++n) {
    const double lo = r.uniform(-10, 10) * std::pow(10, r.uniform(-6, 6)),
                 hi = lo + std::pow(10, r.uniform(-3, 5)) * (1 + std::abs(lo));
    const int wanted = 2 + int(r.uniform(0, 6));
    const Ticks t = ticks(lo, hi, wanted);
    ASSERT_EQ(t.values.size(), t.labels.size());
    ASSERT_GE(t.values.size(), 2u) << lo << ' ' << hi << ' ' << wanted;
    ASSERT_LE(t.values.size(), std::size_t(wanted) + 3) << lo << ' ' << hi << ' ' << wanted;
    for (std::size_t i = 0; i < t.values.size(); ++i) {
      const double slack = 1e-6 * (hi - lo);
      EXPECT_TRUE(t.values[i] >= lo - slack && t.values[i] <= hi + slack);
      if (i > 0) {
        EXPECT_NE(t.labels[i], t.labels[i - 1]);
      }
    }
  }
  EXPECT_EQ(ticks(0, 1, 5).labels, (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(ticks(-40, 60, 5).labels, (std::vector<std::string>{"-40", "-20", "0", "20", "40", "60"}));
}

TEST(ColourMap, WaterGetsDarkerAsItGetsWetter) {
  const ColourMap map = colour_map("water", 0, 1);
  const auto luminance = [&](double w) { return glm::dot(map.at(w), glm::dvec3(0.2126, 0.7152, 0.0722)); };
  for (double w = 0; w < 0.99; w += 0.05) EXPECT_GT(luminance(w), luminance(w + 0.05));
  EXPECT_EQ(map.at(-3), map.at(0));
  EXPECT_EQ(map.at(7), map.at(1));
}

TEST(ColourMap, StressIsNeutralAtZeroWhereTheRangeSpansIt) {
  for (const auto& [lo, hi] : {std::pair{-1.0, 4.0}, {-6.0, 0.5}, {-2.0, 2.0}}) {
    const ColourMap map = colour_map("stress_vein_MPa", lo, hi);
    const glm::dvec3 zero = map.at(0);
    EXPECT_LT(std::max({zero.r, zero.g, zero.b}) - std::min({zero.r, zero.g, zero.b}), 0.06)
        << lo << ' ' << hi;
    EXPECT_LT(map.at(lo).r, map.at(lo).b);  // compression blue
    EXPECT_GT(map.at(hi).r, map.at(hi).b);  // tension red
    // One scale for both sides: the part of the symmetric map that the range covers.
    const double reach = std::max(-lo, hi);
    for (double x = lo; x <= hi; x += (hi - lo) / 16)
      EXPECT_LT(glm::length(map.at(x) - colour_map("stress_vein_MPa", -reach, reach).at(x)), 0.03) << x;
  }
  EXPECT_NE(colour_map("stress_vein_MPa", 0, 4).at(0), colour_map("stress_vein_MPa", -4, 4).at(0));
}

TEST(ColourMap, LabelsAreNotBlended) {
  const ColourMap tissue = colour_map("tissue", 1, 2);
  EXPECT_EQ(tissue.at(1.3), tissue.at(1));
  EXPECT_NE(tissue.at(1), tissue.at(2));
  const ColourMap blades = colour_map("blade_id", 3000, 3100);
  EXPECT_EQ(blades.at(3001), blades.at(3001 + double(blades.colours.size())));
  EXPECT_NE(blades.at(3001), blades.at(3002));
}

TEST(Units, AreTypeset) {
  EXPECT_EQ(typeset_unit("ug/cm2"), "\u00b5g/cm\u00b2");
  EXPECT_EQ(typeset_unit("m/s"), "m/s");
  EXPECT_EQ(typeset_unit("MPa"), "MPa");
  EXPECT_EQ(typeset_unit("1"), "\u2013");
}

TEST(Framing, TheBoxFillsItsRectangleFromEverySide) {
  const std::array<double, 6> box{-20, 230, 0, 180, 0, 120};
  const std::array<double, 4> room{96, 1010, 84, 650};
  for (double azimuth = -180; azimuth <= 180; azimuth += 23)
    for (const double elevation : {-90.0, -30.0, 0.0, 18.0, 70.0, 90.0}) {
      const Framing f = frame_box(box, azimuth, elevation, 1, 1088, 720, room);
      glm::dvec2 lo{1e9}, hi{-1e9};
      for (int c = 0; c < 8; ++c) {
        const glm::dvec2 p = f.project({box[c & 1], box[2 + (c >> 1 & 1)], box[4 + (c >> 2)]});
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
      }
      EXPECT_NEAR((lo.x + hi.x) / 2, (room[0] + room[1]) / 2, 1) << azimuth << ' ' << elevation;
      EXPECT_NEAR((lo.y + hi.y) / 2, (room[2] + room[3]) / 2, 1);
      EXPECT_LE(hi.x - lo.x, room[1] - room[0] + 1);
      EXPECT_LE(hi.y - lo.y, room[3] - room[2] + 1);
      // One of the two is filled.
      EXPECT_GT(std::max((hi.x - lo.x) / (room[1] - room[0]), (hi.y - lo.y) / (room[3] - room[2])), 0.99);
    }
}

TEST(Framing, AzimuthZeroLooksFromPlusX) {
  const Framing f = frame_box({0, 1, 0, 1, 0, 1}, 0, 0, 1, 400, 300, {0, 400, 0, 300});
  EXPECT_GT(f.position.x, 1);
  EXPECT_NEAR(f.position.y, 0.5, 1e-9);
  EXPECT_GT(f.project({1, 1, 0.5}).x, f.project({1, 0, 0.5}).x);  // +y is to the right
  EXPECT_GT(f.project({1, 0.5, 1}).y, f.project({1, 0.5, 0}).y);
}

TEST(Spline, KeepsSumsConstantsAndSymmetry) {
  const std::array<int, 3> size{9, 7, 8};
  std::vector<float> ones(9 * 7 * 8, 1.0f), one(9 * 7 * 8, 0.0f);
  const ImageValues image{size, 1, ones};
  EXPECT_NEAR(spline_at_voxels(image)[image.index(4, 3, 4)], 1, 1e-6);
  one[image.index(4, 3, 4)] = 1;
  const std::vector<float> spread = spline_at_voxels({size, 1, one});
  EXPECT_NEAR(std::accumulate(spread.begin(), spread.end(), 0.0), 1, 1e-6);
  EXPECT_NEAR(spread[image.index(4, 3, 4)], std::pow(4.0 / 6, 3), 1e-6);  // the cubic B-spline at its knots
  EXPECT_NEAR(spread[image.index(5, 3, 4)], 16.0 / 216, 1e-6);
  EXPECT_NEAR(spread[image.index(5, 2, 4)], 4.0 / 216, 1e-6);
  EXPECT_NEAR(spread[image.index(3, 4, 5)], 1.0 / 216, 1e-6);
}

TEST(ValueNear, IsAMeanOfFilledVoxelsOnly) {
  const TexelGrid grid = sample::texel(32, 6, 0.4);
  std::vector<float> density, water;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        density.push_back(grid.at(i, j, k, TexelChannel::density));
        water.push_back(grid.at(i, j, k, TexelChannel::water));
      }
  const ImageValues image{{32, 32, 32}, 1, water};
  Random r(5, Stream::test, 9);
  int reached = 0;
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec3 at{r.uniform(0, 31), r.uniform(0, 31), r.uniform(0, 20)};
    double mean = 0, nearest = 0;
    value_near(image, density, at, false, &mean);
    value_near(image, density, at, true, &nearest);
    if (mean == 0) continue;
    ++reached;
    EXPECT_GT(mean, 0.45);  // the least water at wd 0.4: air would pull it down
    EXPECT_LT(mean, 0.96);
    EXPECT_NE(std::find(water.begin(), water.end(), float(nearest)), water.end());
  }
  EXPECT_GT(reached, 500);
}

TEST(FileInfo, TellsWhatWasWritten) {
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(64, 12, 0.4);
  const VoxelBox box = sample::box_of(grid);
  const ValueRanges ranges = write_texel_vti(folder / "a.vti", grid, box, true, {12, 0.4});
  const FileInfo info = file_info(folder / "a.vti");
  EXPECT_EQ(info.type, "image");
  EXPECT_EQ(info.length_unit, "mm");
  EXPECT_TRUE(info.has_time);
  EXPECT_EQ(info.time_days, 12);
  EXPECT_EQ(info.wd, 0.4);
  const glm::ivec3 size = box.hi - box.lo;
  EXPECT_EQ(info.points, std::int64_t(size.x) * size.y * size.z);
  for (int a = 0; a < 3; ++a) EXPECT_EQ(info.dimensions[a], size[a]);
  EXPECT_NEAR(info.bounds[1] - info.bounds[0], (size.x - 1) * grid.shape().spacing_m * 1e3, 1e-9);
  ASSERT_EQ(info.arrays.size(), ranges.size());
  for (const ArrayInfo& a : info.arrays) {
    EXPECT_EQ(a.lo, ranges.at(a.name).lo) << a.name;  // of the voxels that hold something, not of the air
    EXPECT_EQ(a.hi, ranges.at(a.name).hi) << a.name;
    EXPECT_EQ(a.components, a.name == "density" || a.name == "specular" ? 1 : 3);
    EXPECT_EQ(a.unit, "1");
  }
}

TEST(Memory, WritingNeedsFarLessThanADenseCopy) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers use memory of their own";
#endif
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(256, 130, 0.4);
  const auto peak_mib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  };
  // In a child, whose peak starts at what is resident now.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const ThreadLimit one(1);
    const long before = peak_mib();
    write_texel_vti(folder / "a.vti", grid, {{0, 0, 0}, {256, 256, 256}}, false, {});
    _exit(static_cast<int>(std::min(peak_mib() - before, 250L)));
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_LT(WEXITSTATUS(status), 64);  // MiB; one dense array is 64, all eight 512
}

}  // namespace
}  // namespace witherfield::vis
