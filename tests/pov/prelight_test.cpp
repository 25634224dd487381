// Laws of light in a texel.
#include "pov/prelight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/plan.hpp"
#include "pov/sky.hpp"
#include "sim/core/parallel.hpp"
#include "tests/pov/fixture.hpp"

namespace witherfield::pov {
namespace {

glm::dvec3 toward(double azimuth_deg, double elevation_deg) {
  return Sun{azimuth_deg, elevation_deg, 3}.direction();
}

TEST(OpticalDepth, NothingInTheWayGivesZero) {
  DenseDensity air;
  air.nx = air.ny = 8;
  air.nz = 4;
  air.spacing_m = 0.01;
  air.rho.assign(8 * 8 * 4, 0.0f);
  const OpticalDepth depth(air, toward(30, 40), 1.0);
  EXPECT_EQ(depth.at({0.03, 0.05, 0.0}), 0.0);
}

TEST(OpticalDepth, SlabFollowsBeerLambert) {
  const DenseDensity slab = densify(fixture::uniform_slab(fixture::shape(0.2, 32, 0), 16, 0.25f), true);
  const double k = 0.7;
  for (const double elevation : {90.0, 60.0, 35.0, 20.0}) {
    const OpticalDepth depth(slab, toward(25, elevation), k);
    // From the ground (the lowest voxels' centre: half a voxel up), 16 layers of 0.25.
    const double expected = k * 0.25 * 16 / std::sin(elevation * 3.14159265358979 / 180);
    EXPECT_NEAR(depth.at({0.1, 0.07, 0.003125}), expected * 15.5 / 16, expected * 0.04) << elevation;
    EXPECT_EQ(depth.at({0.1, 0.07, 0.15}), 0.0) << elevation;
  }
}

TEST(OpticalDepth, PeriodicTileRepeats) {
  const TexelGrid grid = fixture::texel(fixture::blades(60, 0.2, 0.2, 2), fixture::shape(0.2, 32, 8));
  const OpticalDepth depth(densify(grid, true), toward(200, 30), 1.0);
  for (const glm::dvec3 p : {glm::dvec3(0.01, 0.19, 0.02), glm::dvec3(0.12, 0.03, 0.05)})
    EXPECT_NEAR(depth.at(p), depth.at(p + glm::dvec3(0.2, -0.4, 0)), 1e-6);
}

TEST(OpticalDepth, LoneTexelThrowsItsShadowAwayFromTheSun) {
  const DenseDensity block =
      densify(fixture::uniform_slab(fixture::shape(0.2, 32, 0), 16, 1.0f), false);  // 0.1 m high
  const OpticalDepth depth(block, toward(0, 45), 1.0);                              // sun in the east
  EXPECT_GT(depth.at({-0.05, 0.1, 0.0}), 1.0);  // west of it: shadow, 0.1 m long
  EXPECT_EQ(depth.at({-0.12, 0.1, 0.0}), 0.0);
  EXPECT_EQ(depth.at({0.25, 0.1, 0.0}), 0.0);  // east of it: sun
}

TEST(OpticalDepth, SameBitsForAnyThreadCount) {
  const DenseDensity block =
      densify(fixture::texel(fixture::blades(60, 0.2, 0.2, 2), fixture::shape(0.2, 64, 0)), true);
  const auto probe = [&] {
    const OpticalDepth depth(block, toward(130, 25), 1.3);
    double sum = 0;
    for (int i = 0; i < 500; ++i) sum += depth.at({0.0004 * i, 0.00037 * i, 0.0001 * i});
    return sum;
  };
  double one, two;
  {
    const ThreadLimit limit(1);
    one = probe();
  }
  {
    const ThreadLimit limit(2);
    two = probe();
  }
  EXPECT_EQ(one, two);
}

TEST(Dome, WeightsSumToOneAndTurnOntoItself) {
  double sum = 0;
  for (const DomeSample& d : sky_dome()) {
    sum += d.weight;
    EXPECT_NEAR(glm::length(d.direction), 1.0, 1e-12);
    for (const glm::dvec3 image : {glm::dvec3(-d.direction.y, d.direction.x, d.direction.z),
                                   glm::dvec3(-d.direction.x, d.direction.y, d.direction.z)})
      EXPECT_TRUE(std::any_of(sky_dome().begin(), sky_dome().end(), [&](const DomeSample& e) {
        return glm::length(e.direction - image) < 1e-9 && e.weight == d.weight;
      }));
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Prelight, SkyIsWholeAboveTheGrassAndLessBelow) {
  const TexelGrid grid = fixture::texel(fixture::blades(200, 0.2, 0.2, 2), fixture::shape(0.2, 64, 8));
  const TexelPrelight light(grid, true, 0.003);
  const double top = light.block().nz * light.block().spacing_m;
  const std::vector<glm::dvec3> points{{0.1, 0.1, top + 0.01}, {0.1, 0.1, 0.0}};
  const auto sky = sky_visibility(light.block(), light.per_density(), points, 0);
  EXPECT_NEAR(sky[0], 1.0, 1e-6);
  EXPECT_LT(sky[1], 0.6);
  EXPECT_GT(light.ground(toward(20, 70)).sun, light.ground(toward(20, 20)).sun);  // a low sun goes a longer way
}

TEST(Prelight, TheGroundThatIsSeenIsLighterThanTheMean) {
  const TexelGrid grid = fixture::texel(fixture::blades(200, 0.2, 0.2, 2), fixture::shape(0.2, 64, 8));
  const TexelPrelight light(grid, true, 0.003);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 400; ++i) points.push_back({0.01 * (i % 20 + 0.5), 0.01 * (i / 20 + 0.5), 0.0});
  double mean = 0, most = 0;
  for (const float s : sky_visibility(light.block(), light.per_density(), points, 0)) {
    mean += s / double(points.size());
    most = std::max<double>(most, s);
  }
  const GroundShares seen = light.ground(toward(20, 50));
  EXPECT_GT(seen.sky, 1.05 * mean);
  EXPECT_LT(seen.sky, most);
  EXPECT_GE(seen.sun, 0.0);
  EXPECT_LE(seen.sun, 1.0);
}

TEST(Prelight, EnergyStaysBelowTheUnshadedLeaf) {
  const TexelGrid grid = fixture::texel(fixture::blades(150, 0.2, 0.5, 4), fixture::shape(0.2, 64, 8));
  const TexelPrelight light(grid, true, 0.003);
  const Illumination sun{toward(200, 35), glm::dvec3(6.0), glm::dvec3(1.0)};
  const auto shading = light.shade(sun, {0.1, -1, 0.3});
  const auto leaf = leaf_optics(glm::vec3(0.31f, 0.24f, 0.126f), 0.0);  // the brightest straw there is
  const glm::vec3 most =
      (leaf.reflectance + leaf.transmittance) * float(6.0 + 1.0) + glm::vec3(6.0f * 0.04f) +
      glm::vec3(scattered_light(sun, light.mean_albedo(), 1)) * (leaf.reflectance + leaf.transmittance);
  for (const glm::vec3& r : shading.radiance)
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(r[k], 0.0f);
      ASSERT_LE(r[k], most[k]);
    }
  // Without sun only the rest is left, and twice the light is twice the picture.
  const auto dark = light.shade({sun.to_sun, glm::dvec3(0.0), sun.sky_rgb}, {0.1, -1, 0.3});
  const auto twice = light.shade({sun.to_sun, sun.sun_rgb * 2.0, sun.sky_rgb * 2.0}, {0.1, -1, 0.3});
  for (std::size_t i = 0; i < shading.radiance.size(); i += 97) {
    EXPECT_LE(dark.radiance[i].y, shading.radiance[i].y + 1e-6f);
    EXPECT_NEAR(twice.radiance[i].y, 2 * shading.radiance[i].y, 1e-4 * shading.radiance[i].y + 1e-6);
  }
  EXPECT_EQ(dark.mean_sun, glm::dvec3(0.0));
}

TEST(Prelight, TurnedTexelInTurnedLightIsTheSamePicture) {
  const TexelGrid grid = fixture::texel(fixture::blades(40, 0.2, 0.3, 6), fixture::shape(0.2, 32, 4));
  const TexelPrelight light(grid, true, 0.003);
  const glm::dvec3 to_sun = toward(215, 33), eye{0.4, -5, 1};
  for (const bool mirrored : {false, true})
    for (int q = 0; q < 4; ++q) {
      TexelInstance t;
      t.quarter_turns = q;
      t.mirrored = mirrored;
      // As the scenes do it: the light taken back into the texel's frame ...
      const glm::dvec3 middle{0.1, 0.1, 0};
      const auto here = light.shade({to_local_direction(t, to_sun), glm::dvec3(6), glm::dvec3(1)},
                                    to_local_direction(t, eye - middle) + middle);
      // ... against the texel itself turned, under the light as it is.
      const TexelGrid turned = fixture::turned(grid, q, mirrored);
      const TexelPrelight other(turned, true, 0.003);
      const auto there = other.shade({to_sun, glm::dvec3(6), glm::dvec3(1)}, eye);
      ASSERT_EQ(here.radiance.size(), there.radiance.size());
      double a = 0, b = 0;
      for (std::size_t i = 0; i < here.radiance.size(); ++i) {
        a += double(light.density()[i]) * here.radiance[i].y;
        b += double(other.density()[i]) * there.radiance[i].y;
      }
      EXPECT_NEAR(a / b, 1.0, 1e-4) << q << mirrored;
      EXPECT_NEAR(here.mean_sun.x / there.mean_sun.x, 1.0, 1e-3) << q << mirrored;
    }
}

TEST(Prelight, ToLocalUndoesToWorld) {
  for (int q = 0; q < 4; ++q)
    for (const bool mirrored : {false, true}) {
      TexelInstance t;
      t.quarter_turns = q;
      t.mirrored = mirrored;
      const glm::dvec3 d{0.3, -0.2, 0.7};
      const glm::dvec3 world =
          to_world(t, 1.0, d + glm::dvec3(0.5, 0.5, 0)) - to_world(t, 1.0, {0.5, 0.5, 0});
      EXPECT_LT(glm::length(to_local_direction(t, world) - d), 1e-12) << q << mirrored;
    }
}

TEST(LeafOptics, ConservesEnergyAndIsYellowGreenInTransmission) {
  const glm::vec3 lawn(0.0595f, 0.0802f, 0.0284f);
  const LeafOptics fresh = leaf_optics(lawn, 1.0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LE(fresh.reflectance[c], lawn[c] + 1e-6f);  // a thin layer sends back less than a thick stack
    EXPECT_LT(fresh.reflectance[c] + fresh.transmittance[c], 1.0f);
  }
  EXPECT_GT(fresh.transmittance.y, 1.5f * fresh.transmittance.x);  // more saturated than the reflected green
  EXPECT_GT(fresh.transmittance.x, 10 * fresh.transmittance.z);
  // Limits: no absorption -> R + T = 1; a thick black one -> nothing.
  const LeafOptics white = leaf_optics(glm::vec3(0.95f), 0.0), black = leaf_optics(glm::vec3(0.0f), 1.0);
  EXPECT_GT(white.reflectance.x + white.transmittance.x, 0.99f);
  EXPECT_LT(black.transmittance.x, 1e-6f);
}

TEST(Sky, BrightAndWhiteNearTheSunBlueOppositeAndSunReddensWhenLow) {
  const Sun sun{140, 40, 3};
  const glm::dvec3 near = preetham_radiance(sun, toward(140, 50)),
                   far = preetham_radiance(sun, toward(320, 60));
  EXPECT_GT(near.y, far.y);
  EXPECT_GT(far.z / far.x, near.z / near.x);
  const Daylight noon = make_daylight({140, 60, 3}), evening = make_daylight({140, 8, 3});
  EXPECT_GT(noon.sun_rgb.y, evening.sun_rgb.y);
  EXPECT_GT(evening.sun_rgb.x / evening.sun_rgb.z, 1.5 * noon.sun_rgb.x / noon.sun_rgb.z);
}

}  // namespace
}  // namespace witherfield::pov
