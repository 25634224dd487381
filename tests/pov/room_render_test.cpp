// What povray makes of rooms and stairs: the scenes parse, and the picture follows the floor.
#include <algorithm>
#include <cmath>

#include "pov/hdr.hpp"
#include "pov/render.hpp"
#include "pov/run_povray.hpp"
#include "pov/text.hpp"
#include "tests/pov/room_fixture.hpp"

namespace witherfield::pov {
namespace {

namespace fs = std::filesystem;

TEST_F(RoomSceneTest, RoomAndStairsRender) {
  room.haze = 0.3;
  for (const fs::path& scene : {write_room_scene(folder, room), write_stair_scene(folder, stairs)}) {
    RenderOptions options;
    options.quality = Quality::draft;
    EXPECT_TRUE(fs::exists(render_scene(scene, folder / "images" / (scene.stem().string() + ".png"), options).png));
  }
}

/// Seen from above, without the ceiling's shadow on it: east right and north up, no mirror.
TEST_F(RoomSceneTest, TheFloorLiesAsTheFieldSays) {
  room.film = true;
  room.obstacles.clear();
  room.openings.resize(1);  // no window: fill light only
  room.lamps = 0;
  for (float& v : floor.at("gloss")) v = 0;
  room.still.camera.position_m = {1.5, 0.999, 2.6};
  room.still.camera.look_at_m = {1.5, 1.0, 0};
  room.still.camera.fov_deg = 60;
  const fs::path scene = write_room_scene(folder, room);
  run_povray(folder, {"+I" + scene.filename().string(), "+Oraw.hdr", "+FH", "-D", "-P", "-A", "+W45", "+H30"}, {});
  const HdrImage image = decode_hdr(read_file(folder / "raw.hdr"), "raw");
  // Camera 2.6 m up, 60 degrees: the picture is 3 m wide and 2 m high: the floor fills it exactly.
  const auto mean = [&](int x0, int x1, int y0, int y1) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += image.pixel[std::size_t(y) * 45 + std::size_t(x)].g;
    return sum / ((x1 - x0) * (y1 - y0));
  };
  const double south_west = mean(3, 20, 16, 28), south_east = mean(25, 42, 16, 28), north_west = mean(3, 20, 2, 6);
  EXPECT_NEAR(south_east / south_west, 2.0, 0.5);
  EXPECT_LT(north_west, 0.8 * south_west);
}

TEST_F(RoomSceneTest, FilmRendersTheSameTwice) {
  room.film = true;
  const fs::path scene = write_room_scene(folder, room);
  const auto picture = [&](const char* name) {
    RenderOptions options;
    options.quality = Quality::draft;
    return read_file(render_scene(scene, folder / name, options).png);
  };
  EXPECT_EQ(picture("a.png"), picture("b.png"));
}

}  // namespace
}  // namespace witherfield::pov
