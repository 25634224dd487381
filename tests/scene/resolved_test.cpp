// A floor's resolved scene, as run.json keeps it, is the scene again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/core/errors.hpp"
#include "sim/scene/resolved.hpp"

namespace witherfield::scene {
namespace {

constexpr const char* kRoom = R"(
name = "hall"
seed = 9
[room]
outline_m = [[0, 0], [6, 0], [6, 5], [0, 5]]
[[room.door]]
a_m = [2, 0]
b_m = [3, 0]
[[room.window]]
a_m = [6, 1]
b_m = [6, 2]
[[room.obstacle]]
name = "desk"
outline_m = [[1, 1], [2, 1], [2, 2]]
height_m = 0.7
until_day = 40
[[room.picture]]
at_m = [0, 2]
[material]
preset = "marble"
[wear]
frames = [0.0, 0.25, 1.0]
[view]
fov_deg = 61
[[still]]
name = "a"
visits_share = 0.25
[[still]]
name = "b"
haze = 0.5
)";

FloorScene load(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("witherfield_resolved_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << "kind = \"floor\"\n" << text;
  const struct Remove {
    const std::filesystem::path& file;
    ~Remove() { std::filesystem::remove(file); }
  } remove{file};
  return load_floor_scene(file.string());
}

TEST(ResolvedScene, ARoomComesBackAsItWas) {
  const FloorScene scene = load(kRoom);
  const FloorScene again = floor_scene_of(resolved_json(scene), "run.json");
  EXPECT_EQ(resolved_json(again), resolved_json(scene));
  EXPECT_EQ(again.name, "hall");
  ASSERT_EQ(again.stills.size(), 2u);
  EXPECT_EQ(again.stills[1].still.camera.fov_deg, 61);
  EXPECT_EQ(again.stills[0].visits_share, 0.25);
  ASSERT_EQ(again.floor.room.obstacles.size(), 1u);
  EXPECT_EQ(again.floor.room.obstacles[0].until_day, 40);
  EXPECT_EQ(again.floor.crowd.foot_men_m.sd, scene.floor.crowd.foot_men_m.sd);
}

TEST(ResolvedScene, StairsComeBackAsTheyWere) {
  const FloorScene scene = load("[stairs]\ntreads = 5\n[[still]]\nname = \"a\"\n");
  const FloorScene again = floor_scene_of(resolved_json(scene), "run.json");
  EXPECT_EQ(resolved_json(again), resolved_json(scene));
  ASSERT_TRUE(again.floor.stairs);
  EXPECT_EQ(again.floor.stairs->treads, 5);
}

TEST(ResolvedScene, WhatIsNoSceneIsRefusedByName) {
  for (const char* text : {"", "[1, 2]", "{\"kind\": \"floor\", \"nonsense\": 1}"}) {
    try {
      floor_scene_of(text, "out/run.json");
      FAIL() << text;
    } catch (const InvalidInput& e) {
      EXPECT_NE(std::string(e.what()).find("out/run.json"), std::string::npos) << e.what();
    }
  }
}

TEST(FloorKeys, AStandardDeviationMayBeSmallerThanTheLeastValue) {
  const FloorScene scene = load(std::string(kRoom) + "\n[crowd]\nfoot_men_m = [0.26, 0.01, 0.2, 0.3]\n");
  EXPECT_EQ(scene.floor.crowd.foot_men_m.sd, 0.01);
  EXPECT_THROW(load(std::string(kRoom) + "\n[crowd]\nfoot_men_m = [0.26, 0.01, 0.02, 0.3]\n"), InvalidInput);
}

}  // namespace
}  // namespace witherfield::scene
