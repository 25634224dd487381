// Studio pictures: light that wanders below the skin, the softbox, the camera's frame, what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "pov/object_scene.hpp"
#include "pov/scene_parts.hpp"
#include "pov/studio_light.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

/// A ball of n x 2 n faces or so, of reflectance 0.5.
Surface ball(double radius_m, int n) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const double t = 3.14159265358979 * j / n, a = 3.14159265358979 * i / n;
      s.position_m.push_back(radius_m *
                             glm::dvec3(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      const int a = j * 2 * n + i, b = j * 2 * n + (i + 1) % (2 * n), c = b + 2 * n, d = a + 2 * n;
      if (j > 0) s.triangles.push_back({a, d, b});
      if (j + 1 < n) s.triangles.push_back({b, d, c});
    }
  auto& diffuse = s.make_field("diffuse").values;
  std::fill(diffuse.begin(), diffuse.end(), 0.5f);
  return s;
}

/// A square of `side`, facing +z, in n x n quads.
Surface plate(double side_m, int n) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      s.position_m.push_back({side_m * (double(i) / n - 0.5), side_m * (double(j) / n - 0.5), 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      s.triangles.push_back({a, a + 1, a + n + 2});
      s.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  auto& diffuse = s.make_field("diffuse").values;
  std::fill(diffuse.begin(), diffuse.end(), 0.5f);
  return s;
}

/// Integral of light over the mesh with the same mass as the diffusion's: a third of the faces around.
glm::dvec3 total(const LitMesh& m, const std::vector<glm::vec3>& light) {
  glm::dvec3 sum(0.0);
  for (const auto& t : m.triangles) {
    const glm::dvec3 a = m.vertices[std::size_t(t[0])].position_m,
                     b = m.vertices[std::size_t(t[1])].position_m,
                     c = m.vertices[std::size_t(t[2])].position_m;
    const double third = glm::length(glm::cross(b - a, c - a)) / 6;
    for (const int v : t) sum += third * glm::dvec3(light[std::size_t(v)]);
  }
  return sum;
}

LitMesh lit(const Surface& s, double spread_m) {
  ObjectPlacement o;
  o.surface = &s;
  LitMesh m = place_mesh(o);
  for (LitVertex& v : m.vertices) v.spread_m = glm::vec3(float(spread_m), float(spread_m) / 2, 0.0f);
  return m;
}

TEST(SpreadLight, KeepsTheTotalAndWhatDoesNotWander) {
  const Surface s = ball(0.01, 24);
  const LitMesh m = lit(s, 0.002);
  std::vector<glm::vec3> light(m.vertices.size(), glm::vec3(0.0f));
  for (std::size_t v = 0; v < light.size(); ++v) light[v] = glm::vec3(s.position_m[v].x > 0 ? 1.0f : 0.1f);
  const auto spread = spread_light(m, light);
  const glm::dvec3 before = total(m, light), after = total(m, spread);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 2e-3) << c;
  float lo = 9, hi = 0;
  for (std::size_t v = 0; v < light.size(); ++v) {
    lo = std::min(lo, spread[v].x);
    hi = std::max(hi, spread[v].x);
    EXPECT_NEAR(spread[v].z, light[v].z, 1e-6) << "blue does not wander here";
  }
  EXPECT_GE(lo, 0.1f - 1e-4f) << "no darker than the darkest: a maximum principle";
  EXPECT_LE(hi, 1.0f + 1e-4f);
}

TEST(SpreadLight, EdgeOfShadowDecaysByTheMeanWay) {
  // Beside a long straight edge on a flat plate, (1 - l^2 d2/dx2) s = e has s = 1 - exp(-x / l) / 2 on the
  // lit side.
  const double l = 0.002;
  const Surface s = plate(0.04, 160);
  const LitMesh m = lit(s, l);
  std::vector<glm::vec3> light(m.vertices.size(), glm::vec3(0.0f));
  for (std::size_t v = 0; v < light.size(); ++v)
    light[v] = glm::vec3(std::abs(s.position_m[v].x) < 1e-9 ? 0.5f : s.position_m[v].x > 0 ? 1.0f : 0.0f);
  const auto spread = spread_light(m, light);
  for (std::size_t v = 0; v < light.size(); ++v) {
    const double x = s.position_m[v].x;
    if (std::abs(s.position_m[v].y) > 0.01 || std::abs(x) > 0.01) continue;
    const double wanted = x > 0 ? 1 - 0.5 * std::exp(-x / l) : 0.5 * std::exp(x / l);
    EXPECT_NEAR(spread[v].x, wanted, 0.01) << "at " << x;
  }
}

Still still_from(double azimuth_deg, double elevation_deg) {
  Still still;
  still.name = "a";
  still.width_px = still.height_px = 64;
  still.sun.azimuth_deg = azimuth_deg;
  still.sun.elevation_deg = elevation_deg;
  return still;
}

TEST(Studio, PlateFacingTheBoxSendsBackItsReflectance) {
  const Surface s = plate(0.02, 8);
  ObjectSceneInput in;
  in.objects.resize(1);
  in.objects[0].surface = &s;
  in.still = still_from(90, 90);  // straight above
  in.still.camera = frame_objects(in.objects, 270, 60, 20, 1);
  in.backdrop = Backdrop::dark;
  in.fill = in.rim = 0;
  const Studio studio = make_studio(in);
  ASSERT_EQ(studio.boxes.size(), 1u);
  std::vector<LitMesh> meshes{place_mesh(in.objects[0])};
  const SceneTree tree(meshes);
  const StudioGlow glow = light_studio(studio, View(in.still), tree, meshes);
  const std::size_t middle = 4 * 9 + 4;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(glow.meshes[0].front[middle][c], 0.5 * studio.boxes[0].colour[c], 0.02) << c;
}

TEST(Studio, WhatStandsInTheWayShades) {
  // A ball, not a second plate: the inside of an open sheet glows like its outside, because organs are closed.
  const Surface s = plate(0.02, 8), over = ball(0.02, 24);
  ObjectSceneInput in;
  in.objects.resize(2);
  in.objects[0].surface = &s;
  in.objects[1].surface = &over;
  in.objects[1].position_m = {0, 0, 0.03};
  in.still = still_from(90, 90);
  in.still.camera = frame_objects(in.objects, 270, 60, 20, 1);
  in.backdrop = Backdrop::dark;  // white paper would throw light in from the sides
  in.fill = in.rim = 0;
  in.key_size = 0.05;
  const std::vector<LitMesh> meshes{place_mesh(in.objects[0]), place_mesh(in.objects[1])};
  const StudioGlow glow = light_studio(make_studio(in), View(in.still), SceneTree(meshes), meshes);
  float brightest = 0;
  for (const glm::vec3& g : glow.meshes[1].front) brightest = std::max(brightest, g.y);
  EXPECT_GT(brightest, 0.2f);
  EXPECT_LT(glow.meshes[0].front[4 * 9 + 4].y, 0.1f * brightest);
}

TEST(Frame, EveryVertexIsInThePictureAndTouchesItsMargin) {
  const Surface s = ball(0.03, 12);
  ObjectPlacement o;
  o.surface = &s;
  o.scale = 1.7;
  o.pitch_deg = 40;
  for (const double aspect : {0.5, 1.0, 2.0})
    for (const double margin : {0.0, 0.1}) {
      const Camera c = frame_objects({&o, 1}, 200, 25, 30, aspect, margin);
      const glm::dvec3 view = glm::normalize(c.look_at_m - c.position_m),
                       right = glm::normalize(glm::cross(view, glm::dvec3(0, 0, 1))),
                       up = glm::cross(right, view);
      const double half = std::tan(c.fov_deg * 3.14159265358979 / 360);
      double most = 0;
      for (const glm::dvec3& p : s.position_m) {
        const glm::dvec3 d = o.world(p) - c.position_m;
        const double z = glm::dot(d, view), x = std::abs(glm::dot(d, right)) / (z * half),
                     y = std::abs(glm::dot(d, up)) / (z * half / aspect);
        most = std::max({most, x, y});
      }
      EXPECT_NEAR(most, 1 - 2 * margin, 1e-6) << aspect << " " << margin;
    }
}

TEST(Frame, ObjectsInARowDoNotTouchAndStandOnTheGround) {
  const Surface s = ball(0.01, 8);
  std::vector<ObjectPlacement> row(3);
  for (std::size_t i = 0; i < row.size(); ++i) {
    row[i].surface = &s;
    row[i].scale = 1 + double(i);
  }
  stand_in_row(row, 0.004);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Bounds b = bounds_of({&row[i], 1});
    EXPECT_NEAR(b.low.z, 0, 1e-12);
    EXPECT_NEAR(b.low.y + b.high.y, 0, 1e-12);
    if (i == 0) continue;
    EXPECT_NEAR(b.low.x - bounds_of({&row[i - 1], 1}).high.x, 0.004, 1e-12);
  }
}

struct ObjectScene : testing::Test {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("witherfield_object_" + std::to_string(getpid()));
  Surface surface = ball(0.01, 8);
  ObjectSceneInput in;
  void SetUp() override {
    in.objects.resize(1);
    in.objects[0].surface = &surface;
    in.still = still_from(220, 45);
    in.still.camera = frame_objects(in.objects, 270, 15, 20, 1);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(ObjectScene, SameBytesForAnyNumberOfThreads) {
  const auto text = [&](int threads) {
    const ThreadLimit limit(threads);
    std::string all;
    write_object_scene(folder, in);
    for (const char* name :
         {"a_object.pov", "a_object_0_0.inc", "a_object_0_front.png", "a_object_paper.png"})
      all += read_file(folder / name);
    return all;
  };
  const std::string one = text(1);
  EXPECT_GT(one.size(), 10000u);
  EXPECT_EQ(one, text(4));
}

TEST_F(ObjectScene, BadInputIsNamed) {
  const auto message = [&](const auto& spoil) {
    ObjectSceneInput bad = in;
    Surface s = surface;
    bad.objects[0].surface = &s;
    spoil(bad, s);
    try {
      write_object_scene(folder, bad);
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  using In = ObjectSceneInput;
  EXPECT_NE(message([](In& i, Surface&) { i.fill = 5; }).find("fill"), std::string::npos);
  EXPECT_NE(message([](In& i, Surface&) { i.key_size = 0; }).find("key_size"), std::string::npos);
  EXPECT_NE(message([](In& i, Surface&) { i.objects.clear(); }).find("at least one object"),
            std::string::npos);
  EXPECT_NE(message([](In& i, Surface&) { i.objects[0].scale = 0; }).find("scale"), std::string::npos);
  EXPECT_NE(message([](In&, Surface& s) { s.fields.clear(); }).find("diffuse"), std::string::npos);
  EXPECT_NE(message([](In&, Surface& s) { s.triangles[3][1] = 99999; }).find("triangle 3"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a_object.pov"));
}

}  // namespace
}  // namespace witherfield::pov
