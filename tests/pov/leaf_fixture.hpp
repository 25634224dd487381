// A flat square leaf with two veins, seen from above, for tests of object scenes.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "pov/object_scene.hpp"

namespace witherfield::pov {

namespace fs = std::filesystem;

namespace leaf_fixture {

/// 0.1 m wide, 11 x 11 vertices around the origin, 0.1 m above z = 0, uv = 0..1.
inline Surface flat_leaf() {
  Surface s;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      s.position_m.emplace_back(0.01 * i - 0.05, 0.01 * j - 0.05, 0.1);
      s.uv.emplace_back(i / 10.0, j / 10.0);
    }
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const int a = 11 * j + i;
      s.triangles.push_back({a, a + 1, a + 12});
      s.triangles.push_back({a, a + 12, a + 11});
    }
  auto& diffuse = s.make_field("diffuse").values;
  for (std::size_t v = 0; v < s.position_m.size(); ++v) {
    diffuse[3 * v] = 0.06f;
    diffuse[3 * v + 1] = 0.11f;
    diffuse[3 * v + 2] = 0.03f;
  }
  return s;
}

/// A main vein at u = 0.25, a side vein at v = 0.8.
inline LeafDetail detail(int n) {
  LeafDetail d{n, {}, {}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n, v = (j + 0.5) / n;
      const double main = std::exp(-std::pow((u - 0.25) / 0.03, 2)),
                   side = 0.65 * std::exp(-std::pow((v - 0.8) / 0.03, 2));
      d.vein.push_back(float(std::max(main, side)));
      d.height.push_back(1.0f);
    }
  return d;
}

}  // namespace leaf_fixture

struct LeafSkin : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("witherfield_leaf_" + std::to_string(getpid()));
  Surface surface = leaf_fixture::flat_leaf();
  ObjectSceneInput input;

  void SetUp() override {
    ObjectPlacement o;
    o.surface = &surface;
    o.looks[0].kind = LookKind::leaf;
    o.looks[0].relief = 0;
    o.looks[0].detail = leaf_fixture::detail;
    input.objects = {o};
    input.backdrop = Backdrop::dark;
    input.rim = 0;
    input.still.name = "leaf";
    input.still.width_px = input.still.height_px = 64;
    input.still.sun.azimuth_deg = 0;
    input.still.sun.elevation_deg = 45;
    input.still.camera.position_m = {0, -1e-3, 0.5};
    input.still.camera.look_at_m = {0, 0, 0.1};
    input.still.camera.fov_deg = 17;
  }
  void TearDown() override { fs::remove_all(folder); }
};

}  // namespace witherfield::pov
