// What an edit window computes without a screen: rays, markers under the pointer, the camera.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "vis/edit_camera.hpp"
#include "vis/ray_pick.hpp"

namespace witherfield::vis {
namespace {

const std::vector<glm::dvec3> kPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
const std::vector<std::array<int, 3>> kTriangles{{0, 1, 2}, {3, 4, 5}};

TEST(RayPick, TheNearestTriangleIsHitFromEitherSide) {
  const auto from_above = first_hit({{0.6, 0.2, 5}, {0, 0, -3}}, kPoints, kTriangles);
  ASSERT_TRUE(from_above);
  EXPECT_EQ(from_above->triangle, 1);
  EXPECT_EQ(from_above->vertex, 4);
  EXPECT_LT(glm::distance(from_above->point_m, glm::dvec3(0.6, 0.2, 2)), 1e-12);
  const auto from_below = first_hit({{0.1, 0.8, -5}, {0, 0, 1}}, kPoints, kTriangles);
  ASSERT_TRUE(from_below);
  EXPECT_EQ(from_below->triangle, 0);
  EXPECT_EQ(from_below->vertex, 2);
  EXPECT_EQ(first_hit({{0.1, 0.1, 1}, {0, 0, -1}}, kPoints, kTriangles)->triangle, 0);  // what lies behind the eye is not seen
  EXPECT_FALSE(first_hit({{0.6, 0.6, 5}, {0, 0, -1}}, kPoints, kTriangles));
  EXPECT_FALSE(first_hit({{0, 0, 5}, {0, 0, -1}}, kPoints, {}));
}

TEST(RayPick, APlaneIsMetInFrontOnly) {
  EXPECT_LT(glm::distance(*meet_plane({{0, 0, 4}, {1, 0, -1}}, {0, 0, 1}, {0, 0, 2}), glm::dvec3(3, 0, 1)), 1e-12);
  EXPECT_FALSE(meet_plane({{0, 0, 4}, {0, 0, 1}}, {0, 0, 1}, {0, 0, 1}));
  EXPECT_FALSE(meet_plane({{0, 0, 4}, {1, 0, 0}}, {0, 0, 1}, {0, 0, 1}));
}

EditCamera a_camera(bool flat) {
  EditCamera c;
  c.azimuth_deg = 40;
  c.elevation_deg = 25;
  c.focus_m = {0.1, -0.05, 0.02};
  c.reach_m = 0.12;
  c.flat = flat;
  return c;
}

TEST(EditCamera, PixelsAndRaysAgree) {
  for (const bool flat : {false, true}) {
    const EditCamera c = a_camera(flat);
    const ScreenMap map = c.screen_map(800, 600, 0.1 * c.distance_m(), 2 * c.distance_m());
    const glm::dvec3 middle = map.pixel(c.focus_m);
    EXPECT_NEAR(middle.x, 400, 1e-9);
    EXPECT_NEAR(middle.y, 300, 1e-9);
    const glm::dvec3 p{0.14, -0.02, 0.05}, px = map.pixel(p);
    const Ray ray = map.ray(px.x, px.y);
    EXPECT_LT(glm::length(glm::cross(glm::normalize(p - ray.origin), ray.direction)), 1e-9);
    EXPECT_NEAR(map.metres_per_pixel(c.focus_m), 2 * c.reach_m / 600, 1e-6);
    // Up on the screen is up.
    EXPECT_LT(map.pixel(c.focus_m + 0.01 * c.up()).y, 300);
  }
}

TEST(EditCamera, ZoomKeepsThePlaceUnderThePointer) {
  EditCamera c = a_camera(false);
  const glm::dvec3 at = c.focus_m + 0.04 * c.up();  // in the plane of the focus
  const auto place = [&] { return c.screen_map(800, 600, 0.01, 10).pixel(at); };
  const glm::dvec3 before = place();
  c.zoom(0.5, at);
  EXPECT_NEAR(place().y, before.y, 1e-6);
  EXPECT_DOUBLE_EQ(c.reach_m, 0.06);
  c.shift(30, -20, 600);
  EXPECT_NEAR(place().x, before.x + 30, 1e-6);
  EXPECT_NEAR(place().y, before.y - 20, 1e-6);
}

TEST(EditMarkers, TheNearestWithinReachIsTakenAndDotsAreNot) {
  const EditCamera c = a_camera(true);
  const ScreenMap map = c.screen_map(800, 600, 0.01, 10);
  const double px = 2 * c.reach_m / 600;
  const auto right = [&](double n) { return c.focus_m + glm::dvec3(0, -n * px, 0); };  // +x is up, so -y is to the right
  const std::vector<Marker> markers{{right(0), MarkerLook::handle, false}, {right(14), MarkerLook::handle, false}, {right(6), MarkerLook::dot, false}};
  EXPECT_EQ(marker_at(markers, map, 405, 300, 13), 0);
  EXPECT_EQ(marker_at(markers, map, 410, 300, 13), 1);
  EXPECT_EQ(marker_at(markers, map, 400, 320, 13), -1);
}

}  // namespace
}  // namespace witherfield::vis
