// A small worn floor for the tests of rooms and stairs.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "pov/room_scene.hpp"

namespace witherfield::pov {

/// 3 m x 2 m, worn dull and pale in the east, a dirty stripe in the north. Cells of 5 cm.
inline FloorField worn_floor(double level_m = 0, double width_m = 3, double depth_m = 2) {
  FloorField f(int(width_m / 0.05), int(depth_m / 0.05), {0, 0}, 0.05);
  for (const char* name : {"footfalls", "gloss", "dirt", "wear_depth_um", "height_m", "diffuse"}) f.make(name);
  for (int j = 0; j < f.ny; ++j)
    for (int i = 0; i < f.nx; ++i) {
      const std::size_t n = std::size_t(j) * std::size_t(f.nx) + std::size_t(i);
      const bool east = i >= f.nx / 2, north = j >= f.ny * 3 / 4;
      f.at("gloss")[n] = east ? 0.1f : 0.85f;
      f.at("dirt")[n] = north ? 0.6f : 0.0f;
      f.at("wear_depth_um")[n] = east ? 200.0f : 0.0f;
      f.at("height_m")[n] = float(level_m) - (east ? 200e-6f : 0.0f);
      for (std::size_t c = 0; c < 3; ++c) f.at("diffuse")[3 * n + c] = (east ? 0.4f : 0.2f) * (north ? 0.6f : 1.0f);
    }
  return f;
}

struct RoomSceneTest : testing::Test {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("witherfield_room_" + std::to_string(getpid()));
  FloorField floor = worn_floor();
  RoomSceneInput room;
  StairSceneInput stairs;

  void SetUp() override {
    room.floor = &floor;
    room.look.pattern = {Laying::boards, 1.2, 0.14, 0.001, 0, 1};
    room.look.map_px = 150;
    room.outline_m = {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    room.openings = {{OpeningKind::door, {0.5, 0}, {1.4, 0}, 0, 2.03}, {OpeningKind::window, {3, 0.5}, {3, 1.5}, 0.8, 1.2}};
    room.obstacles = {{ObstacleKind::desk, {{1, 1}, {1.6, 1}, {1.6, 1.4}, {1, 1.4}}, 0.74}};
    room.seats = {{{1.3, 0.75}, 90}};
    room.pictures = {{{1.5, 2}, 0.8, 0.5, 1.5}};
    room.still.name = "small";
    room.still.width_px = 32;
    room.still.height_px = 24;
    room.still.camera.position_m = {0.3, 0.3, 1.6};
    room.still.camera.look_at_m = {2, 1.2, 0};
    room.still.sun.azimuth_deg = 10;
    stairs.still = room.still;
    stairs.still.camera.position_m = {0.7, -1.2, 1.3};
    stairs.still.camera.look_at_m = {0.7, 0.5, 0.3};
    stairs.look.map_px = 64;
    for (int k = 0; k < 3; ++k) stairs.treads.push_back(worn_floor((k + 1) * stairs.rise_m, 1.4, 0.3));
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
};

}  // namespace witherfield::pov
