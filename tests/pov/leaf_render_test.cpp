// What povray makes of a leaf: both sides, the light that comes through, the veins.
#include <array>

#include "pov/hdr.hpp"
#include "pov/run_povray.hpp"
#include "pov/text.hpp"
#include "tests/pov/leaf_fixture.hpp"

namespace witherfield::pov {
namespace {

constexpr int kSide = 48;

/// Mean colour of 3 x 3 pixels at shares of the picture from its top left.
std::array<double, 3> at(const HdrImage& p, double x, double y) {
  std::array<double, 3> sum{};
  for (int l = -1; l <= 1; ++l)
    for (int k = -1; k <= 1; ++k) {
      const auto& c = p.pixel[std::size_t(int(y * kSide) + l) * kSide + std::size_t(int(x * kSide) + k)];
      for (int i = 0; i < 3; ++i) sum[std::size_t(i)] += c[i] / 9;
    }
  return sum;
}

HdrImage rendered(const fs::path& folder, const ObjectSceneInput& input) {
  const fs::path scene = write_object_scene(folder, input);
  run_povray(folder, {"+I" + scene.filename().string(), "+Oraw.hdr", "+FH", "-D", "-P", "-A", "+W48", "+H48"},
             {});
  return decode_hdr(read_file(folder / "raw.hdr"), "raw");
}

TEST_F(LeafSkin, RenderedFromAboveAndAgainstTheLight) {
  const HdrImage above = rendered(folder, input);
  // The picture is 0.12 m wide: u = 0.25 lies at 0.29 of it; v = 0.8 at 0.25 from the top.
  const auto blade = at(above, 0.6, 0.6), main = at(above, 0.29, 0.6), side = at(above, 0.6, 0.25);
  EXPECT_GT(blade[1], blade[0]);
  EXPECT_GT(blade[1], 2 * blade[2]);
  EXPECT_GT(main[1], 1.3 * blade[1]);
  EXPECT_GT(side[1], 1.1 * blade[1]);
  // From below there is only what comes through: a saturated yellow-green.
  input.backdrop = Backdrop::sky;  // no paper between
  input.fill = 0.02;
  input.still.camera.position_m = {0, -1e-3, -0.3};
  const auto through = at(rendered(folder, input), 0.6, 0.6);
  EXPECT_GT(through[1], 0.02);
  EXPECT_GT(through[1] / through[2], 1.5 * blade[1] / blade[2]);
}

}  // namespace
}  // namespace witherfield::pov
