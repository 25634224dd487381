// --preview: the same scene, small.
#include <gtest/gtest.h>

#include "scene_file.hpp"

namespace witherfield::scene {
namespace {

const std::string kBig = R"(
[season]
wd_frames = [0, 0.1, 0.2, 0.3, 0.917, 1]
wd_frames_other_variants = [0.3, 0.917]
[texel]
size_m = 0.2
resolution = 256
variants = 4
[blades]
count = 400
segments = 64
[terrain]
dem = "/hill.tif"
texels = [40, 30]
[view]
size_px = [1280, 720]
[[still]]
name = "a"
wd = 0.3
[[still]]
name = "b"
wd = 0.917
)";

TEST(Preview, ShrinksEverythingThatCostsTime) {
  const GrassScene s = load_text(kBig, true);
  EXPECT_LE(s.grass.texel.resolution, 64);
  EXPECT_EQ(s.grass.wd_frames, (std::vector<double>{0, 0.3, 0.917}));
  EXPECT_TRUE(s.grass.wd_frames_other_variants.empty());
  EXPECT_LE(s.placement.cells_x, 12);
  EXPECT_LE(s.placement.cells_y, 12);
  EXPECT_EQ(s.placement.variants, s.grass.variants);
  ASSERT_EQ(s.stills.size(), 2u);
  for (const Still& still : s.stills) {
    EXPECT_EQ(still.width_px, 240);
    EXPECT_EQ(still.height_px, 135);
  }
  EXPECT_LE(s.grass.samples[0].blades.segments, 8);
}

TEST(Preview, KeepsTheTerrainsExtent) {
  const GrassScene full = load_text(kBig), s = load_text(kBig, true);
  EXPECT_NEAR(s.placement.cells_x * s.grass.texel.size_m, full.placement.cells_x * full.grass.texel.size_m,
              1e-12);
  EXPECT_EQ(s.terrain->width_m, full.terrain->width_m);
  // fewer, larger tiles with more blades each
  EXPECT_GT(s.grass.samples[0].blades.count, full.grass.samples[0].blades.count);
}

TEST(Preview, SamplesShareTheBladesOfThePreview) {
  const GrassScene s = load_text(kBig + "[[mingle]]\n[[mingle]]\n[[mingle]]\ncount = 3\n", true);
  ASSERT_EQ(s.grass.samples.size(), 3u);
  int blades = 0;
  for (const grass::SampleOptions& sample : s.grass.samples) blades += sample.blades.count;
  EXPECT_LE(blades, 1600);
  EXPECT_GT(s.grass.samples[2].blades.count, 3);
  EXPECT_LT(s.grass.samples[2].blades.count, s.grass.samples[0].blades.count);
}

TEST(Preview, DropsStillsWhoseFrameIsNotKept) {
  const GrassScene s = load_text(
      "[season]\nwd_frames = [0, 0.2, 0.4, 0.6]\n"
      "[[still]]\nname = \"a\"\nwd = 0.6\n[[still]]\nname = \"b\"\nwd = 0.4\n"
      "[[still]]\nname = \"c\"\nwd = 0.2\n[[still]]\nname = \"d\"\nwd = 0\n",
      true);
  EXPECT_EQ(s.grass.wd_frames, (std::vector<double>{0.2, 0.4, 0.6}));
  ASSERT_EQ(s.stills.size(), 3u);
  EXPECT_EQ(s.stills.back().name, "c");
}

TEST(Preview, LeavesASmallSceneAsItIs) {
  const std::string small =
      "[season]\nwd_frames = [0, 1]\nsteps_per_day = 2\n[texel]\nresolution = 32\n[blades]\ncount = "
      "5\nsegments = 6\n"
      "[[still]]\nname = \"a\"\nsize_px = [100, 80]\n";
  EXPECT_EQ(resolved_json(load_text(small, true)), resolved_json(load_text(small)));
}

}  // namespace
}  // namespace witherfield::scene
