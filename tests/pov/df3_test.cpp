// DF3: bytes, order, and where POV-Ray finds the samples.
#include "pov/df3.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "pov/media.hpp"
#include "sim/core/errors.hpp"
#include "tests/pov/fixture.hpp"

namespace witherfield::pov {
namespace {

unsigned byte(const std::string& s, std::size_t i) {
  return static_cast<unsigned char>(s.at(i));
}

TEST(Df3, HeaderIsBigEndianWithOurYAndZExchanged) {
  const std::vector<float> values(std::size_t(300) * 2 * 5, 0.0f);
  const std::string df3 = encode_df3(values, 300, 2, 5, 1.0);
  ASSERT_EQ(df3.size(), 6u + 3000u);
  const unsigned expected[6] = {1, 44, 0, 5, 0, 2};  // 300, our nz = 5 is POV-Ray's y, our ny = 2 its z
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(byte(df3, i), expected[i]) << i;
}

TEST(Df3, SamplesRunXThenHeightThenNorth) {
  std::vector<float> values(std::size_t(2) * 3 * 4);
  std::iota(values.begin(), values.end(), 0.0f);  // value = (z * 3 + y) * 2 + x
  const std::string df3 = encode_df3(values, 2, 3, 4, 255.0);
  std::size_t at = 6;
  for (unsigned y = 0; y < 3; ++y)
    for (unsigned z = 0; z < 4; ++z)
      for (unsigned x = 0; x < 2; ++x) EXPECT_EQ(byte(df3, at++), (z * 3 + y) * 2 + x);
}

TEST(Df3, RoundsAndClamps) {
  const std::string df3 = encode_df3(std::vector<float>{-1.0f, 0.5f, 1.0f, 7.0f}, 4, 1, 1, 1.0);
  EXPECT_EQ(byte(df3, 6), 0u);
  EXPECT_EQ(byte(df3, 7), 128u);
  EXPECT_EQ(byte(df3, 8), 255u);
  EXPECT_EQ(byte(df3, 9), 255u);
}

TEST(Df3, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(encode_df3(std::vector<float>(3), 2, 2, 1, 1.0), InvalidInput);
  EXPECT_THROW(encode_df3(std::vector<float>{}, 0, 1, 1, 1.0), InvalidInput);
}

TEST(MediaBlock, SamplesLieAtVoxelCentresAndReachBeyondTheWalls) {
  const TexelGrid grid = fixture::texel(fixture::blades(20, 0.2, 0.3, 1), fixture::shape(0.2, 32, 8));
  const MediaBlock b = media_block(grid, true);
  const double h = 0.2 / 32;
  EXPECT_EQ(b.nx, 34);
  EXPECT_NEAR(b.first_m.x, -h / 2, 1e-12);  // repeats the last column
  EXPECT_NEAR(b.first_m.z, -h / 2, 1e-12);  // the layer below the ground
  EXPECT_NEAR(b.box_lo_m.x, 0.0, 1e-12);
  EXPECT_NEAR(b.box_hi_m.x, 0.2, 1e-12);
  EXPECT_NEAR(b.box_lo_m.z, 0.0, 1e-12);
  // The box ends at the empty top layer, before the wrap to the ground.
  EXPECT_NEAR(b.box_hi_m.z, b.first_m.z + (b.nz - 1) * h, 1e-12);
  EXPECT_EQ(b.nz, grid.occupied_box().hi.z + 2);
}

TEST(MediaBlock, KeepsAllDensityFoldedAndUnfolded) {
  const TexelGrid grid = fixture::texel(fixture::blades(40, 0.2, 0.6, 3), fixture::shape(0.2, 32, 8));
  const TexelPrelight light(grid, true, 0.003);
  const std::vector<glm::vec3> white(light.voxels().size(), glm::vec3(1));
  for (const bool folded : {true, false}) {
    const MediaBlock b = media_block(grid, folded);
    MediaSamples s(b);
    add_texel(s, b, grid, light, white, folded);
    const auto at = [&](int x, int y, int z) { return s.density[(std::size_t(z) * b.ny + y) * b.nx + x]; };
    double inside = 0, top = 0;
    for (int z = 0; z < b.nz; ++z)
      for (int y = 0; y < b.ny; ++y) {
        for (int x = 1; x + 1 < b.nx; ++x) inside += y > 0 && y + 1 < b.ny ? at(x, y, z) : 0;
        for (int x = 0; x < b.nx; ++x) top += z + 1 == b.nz ? at(x, y, z) : 0;
        // Folded: the sides repeat the opposite ones, so that tiles meet without a seam. Else nothing is
        // there.
        EXPECT_EQ(at(0, y, z), folded ? at(b.nx - 2, y, z) : 0.0f);
        EXPECT_EQ(at(b.nx - 1, y, z), folded ? at(1, y, z) : 0.0f);
      }
    EXPECT_NEAR(inside / grid.total_density(), 1.0, 1e-5);
    EXPECT_EQ(top, 0.0);  // no wrap from the ground to the tips
    EXPECT_EQ(s.density, s.emission[1]);
  }
}

TEST(MediaPieces, CoverAllGrassWithinTheLimitOfIntervals) {
  const TexelGrid grid = fixture::texel(fixture::blades(30, 0.2, 0.3, 5), fixture::shape(0.2, 64, 12));
  const TexelPrelight light(grid, false, 0.003);
  const MediaBlock b = media_block(grid, false);
  MediaSamples s(b);
  add_texel(s, b, grid, light, std::vector<glm::vec3>(light.voxels().size(), glm::vec3(1)), false);
  const auto pieces = find_pieces(b, s.density, 20);
  double volume = 0;
  for (const MediaPiece& p : pieces) {
    EXPECT_LE(p.intervals, 20);
    const glm::dvec3 size = p.hi_m - p.lo_m;
    volume += size.x * size.y * size.z;
  }
  const glm::dvec3 all = b.box_hi_m - b.box_lo_m;
  EXPECT_LT(volume, 0.8 * all.x * all.y * all.z);  // empty air is left out
  for (std::size_t i = 0; i < s.density.size(); ++i) {
    if (!(s.density[i] > 0)) continue;
    const int x = int(i % std::size_t(b.nx)), y = int(i / std::size_t(b.nx) % std::size_t(b.ny)),
              z = int(i / (std::size_t(b.nx) * b.ny));
    const glm::dvec3 p = b.first_m + glm::dvec3(x, y, z) * b.spacing_m;
    int holders = 0;
    for (const MediaPiece& m : pieces)
      holders += p.x >= m.lo_m.x - 1e-9 && p.x < m.hi_m.x - 1e-9 && p.y >= m.lo_m.y - 1e-9 &&
                 p.y < m.hi_m.y - 1e-9 && p.z >= m.lo_m.z - 1e-9 && p.z < m.hi_m.z - 1e-9;
    ASSERT_EQ(holders, 1) << x << " " << y << " " << z;
  }
}

}  // namespace
}  // namespace witherfield::pov
