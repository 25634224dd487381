// A small scene of one variant for the tests of whole scenes.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "pov/scene_writer.hpp"
#include "tests/pov/fixture.hpp"

namespace witherfield::pov {

namespace fs = std::filesystem;

struct SceneTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("witherfield_scene_" + std::to_string(getpid()));
  BladeRibbons blades = fixture::blades(40, 0.2, 0.3, 1);
  TexelGrid fine = fixture::texel(blades, fixture::shape(0.2, 64, 12)),
            coarse = fixture::texel(blades, fixture::shape(0.2, 32, 8));
  Placement placement = fixture::level_placement(0.2, 5);
  SceneInput input;

  void SetUp() override {
    VariantFrame v;
    v.lod[0] = &fine;
    v.lod[1] = &coarse;
    v.blades = &blades;
    input.variants = {v};
    input.tile_m = 0.2;
    input.still.name = "small";
    input.still.looks = {"texel", "blades"};
    input.still.width_px = 32;
    input.still.height_px = 18;
    input.still.camera.position_m = {0.1, -0.4, 0.25};
    input.still.camera.look_at_m = {0.1, 0.1, 0.04};
  }
  void TearDown() override { fs::remove_all(folder); }
};

}  // namespace witherfield::pov
