// The whole grass pipeline: laws that hold from blades to the mingled texel.
#include "sim/grass/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <set>

#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/mechanics.hpp"
#include "sim/grass/voxelize.hpp"

namespace witherfield::grass {
namespace {

GrassOptions small(int samples = 1, int blades = 60) {
  GrassOptions o;
  o.seed = 5;
  o.texel.resolution = 96;
  o.wd_frames = {0.0, 0.3, 0.6, 1.0};
  for (int i = 0; i < samples; ++i) {
    SampleOptions s;
    s.blades.count = blades;
    s.blades.segments = 16;
    o.samples.push_back(s);
  }
  return o;
}

/// Copies of every frame's texel.
struct Frames {
  std::vector<TexelGrid> texel;
  std::vector<BladeRibbons> blades;
  GrassReport report;
};

Frames simulate(const GrassOptions& o) {
  Frames f;
  f.report = simulate_grass(o, [&](const GrassFrame& frame) {
    f.texel.push_back(*frame.texel);
    f.blades.push_back(*frame.blades);
  });
  return f;
}

glm::dvec3 mean_diffuse(const TexelGrid& g) {
  glm::dvec3 sum(0);
  double weight = 0;
  for (int b = 0; b < g.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const double d = double(g.channel(b, TexelChannel::density)[v]);
      sum += d * glm::dvec3(g.channel(b, TexelChannel::diffuse_r)[v], g.channel(b, TexelChannel::diffuse_g)[v],
                            g.channel(b, TexelChannel::diffuse_b)[v]);
      weight += d;
    }
  return sum / weight;
}

double mean_height_m(const TexelGrid& g) {
  double sum = 0, weight = 0;
  for (int b = 0; b < g.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const double d = double(g.channel(b, TexelChannel::density)[v]);
      sum += d * (g.brick_base(b).z + v / 16 + 0.5) * g.shape().spacing_m;
      weight += d;
    }
  return sum / weight;
}

TEST(Simulate, LawsHoldOverTheSeason) {
  const Frames f = simulate(small());
  EXPECT_TRUE(f.report.all_finite);
  EXPECT_LT(f.report.density_error_max, 1e-6);
  EXPECT_LT(f.report.root_shift_max_m, 1e-9);
  EXPECT_GT(f.report.points_first, 1000u);
  EXPECT_EQ(f.report.points_first - f.report.merges, f.report.points_last);
  for (const TexelGrid& g : f.texel)
    for (int b = 0; b < g.brick_count(); ++b)
      for (int v = 0; v < TexelGrid::kVoxels; ++v) {
        if (!(g.channel(b, TexelChannel::density)[v] > 0)) continue;
        const glm::vec3 t(g.channel(b, TexelChannel::tangent_x)[v], g.channel(b, TexelChannel::tangent_y)[v],
                          g.channel(b, TexelChannel::tangent_z)[v]);
        ASSERT_NEAR(glm::length(t), 1.0f, 1e-4f);
        for (int c = 0; c < kTexelChannels; ++c) ASSERT_TRUE(std::isfinite(g.channel(b, TexelChannel(c))[v]));
      }
}

TEST(Simulate, FreshFrameIsTheVoxelisedTexel) {
  const GrassOptions o = small();
  const Frames f = simulate(o);
  BladeMotion motion(make_blades(o.samples[0].blades, o.texel.size_m, o.samples[0].season, o.colour.brightness_sd, o.seed, 0),
                     o.samples[0].blades, o.samples[0].season, o.tissue, o.colour);
  const TexelGrid initial = voxelize(motion.state(), texel_shape(o.texel), o.tissue.vein_fraction);
  ASSERT_EQ(initial.brick_count(), f.texel[0].brick_count());
  for (int b = 0; b < initial.brick_count(); ++b)
    EXPECT_EQ(0, std::memcmp(initial.channel(b, TexelChannel::density), f.texel[0].channel(b, TexelChannel::density),
                             sizeof(float) * TexelGrid::kVoxels * kTexelChannels));
}

TEST(Simulate, ColourGoesFromLawnGreenToDryGrass) {
  const Frames f = simulate(small(1, 200));
  const glm::dvec3 green = srgb_levels(mean_diffuse(f.texel.front())), dry = srgb_levels(mean_diffuse(f.texel.back()));
  EXPECT_NEAR(green.x, 69, 12);  // USGS lawn grass GDS91
  EXPECT_NEAR(green.y, 80, 12);
  EXPECT_NEAR(green.z, 47, 12);
  const glm::dvec3 golden(130, 111, 81), dry_long(149, 132, 98);  // USGS golden dry grass, dry long grass
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(dry[c], golden[c] - 12);
    EXPECT_LT(dry[c], dry_long[c] + 12);
  }
  double last = 360;
  for (const TexelGrid& g : f.texel) {
    const double hue = lab_hue_deg(mean_diffuse(g));
    EXPECT_LT(hue, last);
    last = hue;
  }
}

TEST(Simulate, GrassDroopsAndShrinks) {
  const Frames f = simulate(small());
  EXPECT_LT(mean_height_m(f.texel[3]), 0.85 * mean_height_m(f.texel[0]));
  float width_first = 0, width_last = 0;
  for (float w : f.blades.front().half_width_m) width_first += w;
  for (float w : f.blades.back().half_width_m) width_last += w;
  EXPECT_NEAR(width_last / width_first, 0.75, 0.02);  // a fresh blade loses a quarter of its width
}

TEST(Simulate, SamplesMingleByAlgorithm2) {
  GrassOptions o = small(3, 20);
  o.samples[1].ageing = {{0, 0}, {0.3, 0.8}, {1, 1}};
  o.samples[2].ageing = {{0, 0}, {0.6, 0.1}, {1, 1}};
  const Frames all = simulate(o);
  EXPECT_EQ(all.report.blades, 60);
  EXPECT_EQ(all.blades[0].blade_count(), 60);
  std::set<int> ids;
  const TexelGrid& g = all.texel[0];
  for (int b = 0; b < g.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v)
      if (g.channel(b, TexelChannel::density)[v] > 0) ids.insert(int(g.channel(b, TexelChannel::blade_id)[v]));
  EXPECT_EQ(ids.size(), 60u);
  // At wd = 0.3 the second sample is straw already, the third still green.
  const BladeRibbons& r = all.blades[1];
  double mean[3] = {0, 0, 0};
  for (std::size_t i = 0; i < r.center_m.size(); ++i) mean[i / std::size_t(20 * r.nodes_per_blade)] += r.chlorophyll_ug_cm2[i];
  EXPECT_LT(mean[1], 0.2 * mean[0]);
  EXPECT_GT(mean[2], mean[0]);
}

TEST(Simulate, SevenSamplesOfOneHundredGiveSevenHundredBlades) {
  GrassOptions o = small(7, 100);
  o.texel.resolution = 64;
  o.wd_frames = {0.5};
  for (int used = 1; used <= 7; used += 2) {
    GrassOptions part = o;
    part.samples.resize(std::size_t(used));
    EXPECT_EQ(simulate(part).report.blades, 100 * used);
  }
}

TEST(Simulate, VariantsDifferAndAgeApart) {
  GrassOptions o = small();
  o.variants = 2;
  o.variant_spread = 1;
  o.wd_frames_other_variants = {0.3, 0.6};
  const Frames f = simulate(o);
  ASSERT_EQ(f.texel.size(), 6u);
  EXPECT_NE(f.texel[1].total_density(), f.texel[4].total_density());
  EXPECT_LT(lab_hue_deg(mean_diffuse(f.texel[1])), lab_hue_deg(mean_diffuse(f.texel[4]))) << "variant 0 is early";
}

TEST(Simulate, SameBitsForOneAndTwoThreads) {
  for (Motion m : {Motion::rod, Motion::paper}) {
    GrassOptions o = small(2, 30);
    o.tissue.motion = m;
    std::vector<Frames> runs;
    for (int threads : {1, 2}) {
      ThreadLimit limit(threads);
      runs.push_back(simulate(o));
    }
    for (std::size_t i = 0; i < runs[0].texel.size(); ++i) {
      const TexelGrid &a = runs[0].texel[i], &b = runs[1].texel[i];
      ASSERT_EQ(a.brick_count(), b.brick_count());
      ASSERT_EQ(0, std::memcmp(a.channel(0, TexelChannel::density), b.channel(0, TexelChannel::density),
                               sizeof(float) * TexelGrid::kVoxels * kTexelChannels * std::size_t(a.brick_count())));
    }
  }
}

TEST(Simulate, PaperModelRunsOnCones) {
  GrassOptions o = small();
  o.tissue.motion = Motion::paper;
  o.colour.model = PigmentModel::paper;
  o.samples[0].blades.form = BladeForm::cone;
  const Frames f = simulate(o);
  EXPECT_TRUE(f.report.all_finite);
  EXPECT_LT(f.report.density_error_max, 1e-6);
  EXPECT_LT(mean_height_m(f.texel[3]), mean_height_m(f.texel[0]));
}

TEST(Simulate, RefusesNonsense) {
  const auto refused = [](auto change) {
    GrassOptions o = small();
    change(o);
    EXPECT_THROW(simulate_grass(o, [](const GrassFrame&) {}), InvalidInput);
  };
  refused([](GrassOptions& o) { o.points.proportion = 0; });
  refused([](GrassOptions& o) { o.points.proportion = NAN; });
  refused([](GrassOptions& o) { o.samples[0].blades.length_m = {-0.1, 0.1}; });
  refused([](GrassOptions& o) { o.samples[0].blades.length_m = {0.2, 0.1}; });
  refused([](GrassOptions& o) { o.samples[0].ageing = {{0, 0.5}, {1, 0.2}}; });
  refused([](GrassOptions& o) { o.samples.clear(); });
  refused([](GrassOptions& o) { o.texel.resolution = 100; });
  refused([](GrassOptions& o) { o.wd_frames = {0.5, 0.2}; });
  refused([](GrassOptions& o) { o.tissue.volume_strain_vein = -0.8; });
}

TEST(Simulate, TwinsAreTheSameBladesInOtherClimates) {
  GrassOptions o = small(2, 30);
  o.wd_frames = {0.0, 0.5};
  for (SampleOptions& s : o.samples) {
    s.blades.clumping = 1;
    s.blades.tuft_radius_m = 0.002;
    s.blades.twin = 3;
  }
  o.samples[0].blades.tufts_at = {{0.25, 0.5}};
  o.samples[1].blades.tufts_at = {{0.75, 0.5}};
  o.samples[0].season.climate = Climate::cold;
  o.samples[1].season.climate = Climate::water_rich;
  const Frames f = simulate(o);
  const std::size_t half = f.blades[0].center_m.size() / 2;
  const glm::dvec3 apart{0.5 * o.texel.size_m, 0, 0};
  double tip_apart = 0, water_apart = 0;
  for (std::size_t i = 0; i < half; ++i) {
    EXPECT_NEAR(f.blades[0].center_m[i].z, f.blades[0].center_m[half + i].z, 1e-12);
    EXPECT_LT(glm::distance(f.blades[0].center_m[i] + apart, f.blades[0].center_m[half + i]), 1e-9);
    tip_apart = std::max(tip_apart, glm::distance(f.blades[1].center_m[i] + apart, f.blades[1].center_m[half + i]));
    water_apart += double(f.blades[1].water[half + i] - f.blades[1].water[i]) / double(half);
  }
  EXPECT_GT(tip_apart, 0.001);
  EXPECT_GT(water_apart, 0.05);  // the well watered one has more
  // Without twins the blades differ.
  for (SampleOptions& s : o.samples) s.blades.twin = -1;
  const Frames own = simulate(o);
  EXPECT_GT(glm::distance(own.blades[0].center_m[5] + apart, own.blades[0].center_m[half + 5]), 1e-6);
}

}  // namespace
}  // namespace witherfield::grass
