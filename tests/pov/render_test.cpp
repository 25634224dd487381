// What povray makes of the scenes: they parse, east is right, the two looks agree.
#include "pov/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pov/hdr.hpp"
#include "pov/run_povray.hpp"
#include "pov/scene_parts.hpp"
#include "pov/text.hpp"
#include "sim/core/errors.hpp"
#include "tests/pov/scene_fixture.hpp"

namespace witherfield::pov {
namespace {

struct RenderTest : SceneTest {
  HdrImage raw_render(const fs::path& scene, int width, int height) {
    run_povray(scene.parent_path(),
               {"+I" + scene.filename().string(), "+Oraw.hdr", "+FH", "-D", "-P", "-A",
                "+W" + std::to_string(width), "+H" + std::to_string(height)},
               {});
    return decode_hdr(read_file(scene.parent_path() / "raw.hdr"), "raw");
  }
};

TEST_F(RenderTest, BothLooksOfATexelAndOfAField) {
  for (const bool field : {false, true}) {
    input.placement = field ? &placement : nullptr;
    for (const fs::path& scene : write_scenes(folder, input)) {
      double last = 0;
      RenderOptions options;
      options.quality = Quality::draft;
      const RenderResult r = render_scene(scene, folder / "images" / (scene.stem().string() + ".png"),
                                          options, [&](std::string_view, double f) { last = f; });
      EXPECT_TRUE(fs::exists(r.png));
      EXPECT_GT(r.seconds, 0);
      EXPECT_LE(last, 1.0);
    }
  }
  for (const auto& e : fs::directory_iterator(folder)) {
    EXPECT_NE(e.path().extension(), ".part");
    EXPECT_EQ(e.path().string().find(".part."), std::string::npos) << e.path();
  }
}

TEST_F(RenderTest, FailureShowsPovraysMessagesAndLeavesNothing) {
  fs::create_directories(folder);
  write_file(folder / "bad.pov",
             head_text({16, 9, 1, "texel", false, true}, "bad") + "#version 3.7;\nnonsense_here{}\n");
  try {
    render_scene(folder / "bad.pov", folder / "bad.png", {});
    FAIL() << "must throw";
  } catch (const IoFailure& e) {
    EXPECT_NE(std::string(e.what()).find("nonsense_here"), std::string::npos) << e.what();
  }
  std::size_t files = 0;
  for (const auto& e : fs::directory_iterator(folder)) files += e.is_regular_file();
  EXPECT_EQ(files, 1u);
}

/// One wide upright red blade.
BladeRibbons lone_blade(double x_m, double y_m) {
  BladeRibbons b = fixture::blades(1, 0.2, 0.0, 1);
  for (int k = 0; k < b.nodes_per_blade; ++k) {
    const std::size_t i = std::size_t(k);
    b.center_m[i] = {x_m, y_m, 0.15 * k / (b.nodes_per_blade - 1)};
    b.tangent[i] = {0, 0, 1};
    b.side[i] = {1, 0, 0};
    b.half_width_m[i] = k + 1 == b.nodes_per_blade ? 0 : 0.012f;
    b.fold_rad[i] = 0;
    b.diffuse[i] = {0.8f, 0.01f, 0.01f};
    b.chlorophyll_ug_cm2[i] = 0;
  }
  return b;
}

TEST_F(RenderTest, EastIsRightWhenLookingNorthInBothLooks) {
  // A red blade in the east half and far north: seen from the south it stands right of the middle.
  blades = lone_blade(0.16, 0.10);
  fine = fixture::texel(blades, fixture::shape(0.2, 64, 12));
  input.variants[0].lod[1] = nullptr;
  input.still.camera.position_m = {0.1, -0.4, 0.08};
  input.still.camera.look_at_m = {0.1, 0.1, 0.07};
  input.still.sun.azimuth_deg = 250;
  for (const fs::path& scene : write_scenes(folder, input)) {
    const HdrImage image = raw_render(scene, 64, 36);
    double left = 0, right = 0, all = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const glm::vec3 c = image.pixel[std::size_t(y) * image.width + x];
        const double red = std::max(0.0f, c.x - 2 * c.y);
        (x < image.width / 2 ? left : right) += red;
        all += red;
      }
    EXPECT_GT(right, 20 * left + 1e-3) << scene;
    EXPECT_GT(all, 0.5) << scene;
  }
}

TEST_F(RenderTest, BothLooksAgreeInBrightness) {
  // The same blades, the same light: mean radiance of the grass agrees between media and meshes.
  blades = lone_blade(0.10, 0.10);
  fine = fixture::texel(blades, fixture::shape(0.2, 128, 24));
  input.variants[0].lod[1] = nullptr;
  input.still.camera.position_m = {0.1, -0.3, 0.08};
  input.still.camera.look_at_m = {0.1, 0.1, 0.07};
  input.still.sun = {250, 40, 3};
  double red[2] = {0, 0};
  int look = 0;
  for (const fs::path& scene : write_scenes(folder, input)) {
    const HdrImage image = raw_render(scene, 160, 90);
    for (const glm::vec3& c : image.pixel) red[look] += std::max(0.0f, c.x - 2 * c.y);
    ++look;
  }
  EXPECT_NEAR(red[0] / red[1], 1.0, 0.35);
}

TEST_F(RenderTest, SkyIsBrightestTowardTheSun) {
  input.placement = &placement;
  input.still.looks = {"blades"};
  input.still.camera.position_m = {0.5, 0.5, 50};
  input.still.camera.fov_deg = 100;
  for (const double azimuth : {90.0, 20.0, 200.0}) {  // looking along the sun's azimuth, then beside it
    input.still.sun = {azimuth, 20, 3};
    const glm::dvec3 north(0, 1, 0.3);
    input.still.camera.look_at_m = input.still.camera.position_m + north;
    const HdrImage image = raw_render(write_scenes(folder, input)[0], 64, 36);
    double left = 0, right = 0;
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 64; ++x) (x < 32 ? left : right) += image.pixel[std::size_t(y) * 64 + x].y;
    if (azimuth == 90.0) {
      EXPECT_NEAR(left / right, 1.0, 0.02);
    } else if (azimuth == 20.0) {
      EXPECT_GT(right, 1.05 * left);  // the sun stands to the east: right
    } else {
      EXPECT_GT(left, 1.02 * right);  // west-southwest: left
    }
  }
}

}  // namespace
}  // namespace witherfield::pov
