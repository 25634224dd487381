// Rooms and stairs: what is written. povray is not run here.
#include "pov/room_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>

#include "pov/floor_maps.hpp"
#include "pov/floor_text.hpp"
#include "pov/room_walls.hpp"
#include "pov/scene_parts.hpp"
#include "pov/text.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "tests/pov/room_fixture.hpp"

namespace witherfield::pov {
namespace {

namespace fs = std::filesystem;

const MapArea kArea{{0, 0}, {3, 2}};

/// Mean of a map's values over a rectangle given in metres.
template <typename F>
double mean(const FloorMaps& m, glm::dvec2 low, glm::dvec2 high, F value) {
  double sum = 0;
  int n = 0;
  for (int row = 0; row < m.height; ++row)
    for (int i = 0; i < m.width; ++i) {
      const double x = 3.0 * (i + 0.5) / m.width, y = 2.0 * (m.height - row - 0.5) / m.height;
      if (x < low.x || x > high.x || y < low.y || y > high.y) continue;
      sum += value(std::size_t(row) * std::size_t(m.width) + std::size_t(i));
      ++n;
    }
  return sum / n;
}

TEST_F(RoomSceneTest, MapsShowWearWhereItIsEastRightNorthUp) {
  for (const FloorMaterial material : {FloorMaterial::wood_varnished, FloorMaterial::wood, FloorMaterial::stone,
                                       FloorMaterial::tiles, FloorMaterial::vinyl}) {
    room.look.material = material;
    const FloorMaps m = make_floor_maps(floor, room.look, kArea, map_size(kArea, 300));
    ASSERT_EQ(m.width, 300);
    ASSERT_EQ(m.height, 200);
    const auto gloss = [&](std::size_t k) { return double(m.gloss[k]); };
    const auto green = [&](std::size_t k) { return double(m.albedo[k].g); };
    const auto relief = [&](std::size_t k) { return double(m.relief_m[k]); };
    EXPECT_GT(mean(m, {0.1, 0.1}, {1.3, 1.3}, gloss), 5 * mean(m, {1.7, 0.1}, {2.9, 1.3}, gloss));
    const double west = mean(m, {0.1, 0.1}, {1.3, 1.3}, green), east = mean(m, {1.7, 0.1}, {2.9, 1.3}, green);
    EXPECT_NEAR(east / west, 2.0, 0.35) << int(material);
    EXPECT_LT(mean(m, {0.1, 1.65}, {1.3, 1.95}, green), 0.75 * west);
    EXPECT_NEAR(mean(m, {0.1, 0.1}, {1.3, 1.3}, relief) - mean(m, {1.7, 0.1}, {2.9, 1.3}, relief), 200e-6, 120e-6);
  }
}

TEST_F(RoomSceneTest, TheDrawingKeepsTheColourAndStaysInItsPiece) {
  for (float& v : floor.at("diffuse")) v = 0.3f;
  for (float& v : floor.at("dirt")) v = 0;
  room.look.material = FloorMaterial::wood;
  room.look.texture = 0;
  room.look.pattern.joint_m = 0;
  const FloorMaps bare = make_floor_maps(floor, room.look, kArea, map_size(kArea, 300));
  room.look.texture = 1;
  const FloorMaps drawn = make_floor_maps(floor, room.look, kArea, map_size(kArea, 300));
  double a = 0, b = 0, spread = 0;
  for (std::size_t k = 0; k < bare.albedo.size(); ++k) {
    a += bare.albedo[k].g;
    b += drawn.albedo[k].g;
    spread += std::abs(drawn.albedo[k].g - bare.albedo[k].g);
  }
  EXPECT_NEAR(b / a, 1.0, 0.10);
  EXPECT_GT(spread / a, 0.03);
}

TEST_F(RoomSceneTest, ReliefScaleScalesAboutTheLevel) {
  const FloorField tread = worn_floor(1.65);
  room.look.pattern = {Laying::seamless, 1, 1, 0, 0, 1};
  room.look.texture = 0;
  const auto relief_of = [&](double scale) {
    room.look.relief_scale = scale;
    return make_floor_maps(tread, room.look, kArea, map_size(kArea, 100), 1.65).relief_m;
  };
  const auto one = relief_of(1), ten = relief_of(10);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(ten[k] - 1.65, 10 * (one[k] - 1.65), 2e-5);
}

TEST_F(RoomSceneTest, SameMapsForAnyNumberOfThreads) {
  const auto maps = [&](int threads) {
    const ThreadLimit limit(threads);
    return make_floor_maps(floor, room.look, kArea, map_size(kArea, 200));
  };
  const FloorMaps a = maps(1), b = maps(0);
  EXPECT_EQ(a.gloss, b.gloss);
  EXPECT_EQ(a.relief_m, b.relief_m);
  EXPECT_EQ(a.albedo, b.albedo);
}

TEST_F(RoomSceneTest, WritesWholeFilesOfTheRightSizeAndNothingElse) {
  room.floor = &floor;
  const fs::path scene = write_room_scene(folder, room);
  EXPECT_EQ(scene.filename(), "small_room.pov");
  const std::string text = read_file(scene);
  const SceneHead head = parse_head(text, "scene");
  EXPECT_EQ(head.look, "room");
  EXPECT_EQ(head.width_px, 32);
  EXPECT_EQ(text.find(folder.string()), std::string::npos);
  for (const char* map : {"albedo", "gloss", "height"}) {
    const std::string png = read_file(folder / (std::string("small_room_") + map + ".png"));
    const auto number = [&](std::size_t at) {
      std::uint32_t v = 0;
      for (std::size_t k = at; k < at + 4; ++k) v = v << 8 | std::uint8_t(png[k]);
      return v;
    };
    EXPECT_EQ(number(16), 150u);  // IHDR: width, height, bits
    EXPECT_EQ(number(20), 100u);
    EXPECT_EQ(png[24], 16);
  }
  for (const auto& e : fs::directory_iterator(folder)) EXPECT_NE(e.path().extension(), ".part");
}

TEST_F(RoomSceneTest, FilmFramesDifferInTheMapsAlone) {
  room.film = true;
  const std::string before = read_file(write_room_scene(folder, room));
  EXPECT_EQ(before.find("radiosity{"), std::string::npos);
  EXPECT_EQ(before.find(" jitter"), std::string::npos);
  const std::string gloss = read_file(folder / "small_room_gloss.png");
  for (float& v : floor.at("gloss")) v *= 0.5f;
  for (float& v : floor.at("diffuse")) v *= 0.9f;
  EXPECT_EQ(read_file(write_room_scene(folder, room)), before);
  EXPECT_NE(read_file(folder / "small_room_gloss.png"), gloss);
}

TEST_F(RoomSceneTest, WallsFollowTheOutlineInEitherSense) {
  for (int turn = 0; turn < 2; ++turn) {
    const std::vector<Wall> walls = walls_of(room);
    ASSERT_EQ(walls.size(), 4u);
    std::size_t openings = 0;
    for (const Wall& w : walls) {
      const glm::dvec2 middle = w.a_m + 0.5 * w.length_m * w.along;
      EXPECT_GT(glm::dot(middle + w.out - glm::dvec2(1.5, 1), w.out), 1.0);  // out points away from the room
      for (const WallOpening& o : w.openings) {
        EXPECT_LT(o.a_m.x, o.b_m.x);
        const glm::dvec2 a = w.a_m + o.a_m.x * w.along;
        EXPECT_NEAR(o.kind == OpeningKind::door ? a.y : a.x, o.kind == OpeningKind::door ? 0 : 3, 1e-9);
        ++openings;
      }
    }
    EXPECT_EQ(openings, 2u);
    std::reverse(room.outline_m.begin(), room.outline_m.end());
  }
}

template <typename Write>
std::string message_of(Write write) {
  try {
    write();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST_F(RoomSceneTest, HazeIsOnlyBehindWindowsThatTheSunReaches) {
  const auto shafts = [&] { return count(read_file(write_room_scene(folder, room)), "scattering{"); };
  EXPECT_EQ(shafts(), 0u);
  room.haze = 0.5;
  EXPECT_EQ(shafts(), 1u);  // the door lets no light in
  room.openings.push_back({OpeningKind::window, {3, 1.6}, {3, 1.9}, 0.8, 1.2});
  EXPECT_EQ(shafts(), 2u);
  room.still.sun.azimuth_deg = 190;
  EXPECT_EQ(shafts(), 0u);
}

/// Where the cabinet's parts lie across the desk (its own z), summed: drawers stand out on one side.
double cabinet_side(const std::string& text) {
  double sum = 0;
  const std::string end = "} texture{Cabinet}";
  for (std::size_t at = text.find(end); at != std::string::npos; at = text.find(end, at + 1)) {
    const std::size_t box = text.rfind("box{", at);
    double a[3], b[3];
    const std::string part = text.substr(box, at - box);
    if (std::sscanf(part.c_str(), "box{<%lf,%lf,%lf>,<%lf,%lf,%lf>", a, a + 1, a + 2, b, b + 1, b + 2) == 6) sum += a[2] + b[2];
  }
  return sum;
}

TEST_F(RoomSceneTest, ADeskIsFurnishedOnTheSideOfItsSeat) {
  const auto drawers = [&] { return count(read_file(write_room_scene(folder, room)), "texture{Cabinet}"); };
  EXPECT_EQ(drawers(), 4u);  // a body and three fronts
  EXPECT_LT(cabinet_side(read_file(folder / "small_room.pov")), -50);  // cm: to the south, where the seat is
  room.seats = {{{1.3, 1.65}, -90}};
  EXPECT_EQ(drawers(), 4u);
  EXPECT_GT(cabinet_side(read_file(folder / "small_room.pov")), 50);
  room.seats = {{{2.6, 0.2}, 90}};  // of another place
  EXPECT_EQ(drawers(), 0u);
  room.seats.clear();
  EXPECT_EQ(drawers(), 0u);
  EXPECT_EQ(count(read_file(folder / "small_room.pov"), "texture{Chair}"), 0u);
}

TEST_F(RoomSceneTest, BadInputIsNamed) {
  const auto expect = [&](const RoomSceneInput& in, const char* words) {
    const std::string m = message_of([&] { write_room_scene(folder, in); });
    EXPECT_NE(m.find(words), std::string::npos) << "'" << m << "' lacks '" << words << "'";
  };
  RoomSceneInput bad = room;
  bad.outline_m.resize(2);
  expect(bad, "at least 3 corners");
  bad = room;
  bad.obstacles[0].outline_m.resize(2);
  expect(bad, "obstacle 0");
  bad = room;
  bad.openings[1].a_m.x = 2;
  expect(bad, "window (2, 0.5) m");
  bad = room;
  bad.openings[0].height_m = 5;
  expect(bad, "opening 0: height_m");
  bad = room;
  bad.haze = 2;
  expect(bad, "haze");
  bad = room;
  FloorField lacking = floor;
  std::erase_if(lacking.channels, [](const FloorChannel& c) { return c.name == "gloss"; });
  bad.floor = &lacking;
  expect(bad, "gloss");
  bad.floor = nullptr;
  expect(bad, "no floor");
  stairs.treads[2] = lacking;
  const std::string m = message_of([&] { write_stair_scene(folder, stairs); });
  EXPECT_NE(m.find("tread 2"), std::string::npos) << m;
  stairs.treads.clear();
  EXPECT_NE(message_of([&] { write_stair_scene(folder, stairs); }).find("at least one tread"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "small_room.pov"));
}

TEST_F(RoomSceneTest, StairsWriteOneMeshATread) {
  const fs::path scene = write_stair_scene(folder, stairs);
  EXPECT_EQ(parse_head(read_file(scene), "scene").look, "room");
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(fs::exists(folder / ("small_stairs_" + std::to_string(k) + ".inc")));
  EXPECT_FALSE(fs::exists(folder / "small_stairs_3.inc"));
}

}  // namespace
}  // namespace witherfield::pov
