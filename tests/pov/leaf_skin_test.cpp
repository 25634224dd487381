// The skin of leaves: light on leaning normals, veins where the texture coordinates say.
#include "pov/leaf_skin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "tests/pov/leaf_fixture.hpp"

namespace witherfield::pov {
namespace {

/// One flat leaf, its normals turned by `lean`.
LitMesh leaning(const ObjectPlacement& object, const glm::vec3& lean) {
  LitMesh m = place_mesh(object);
  for (LitVertex& v : m.vertices) v.normal = glm::normalize(v.normal + lean);
  return m;
}

TEST_F(LeafSkin, LightOnALeaningNormalIsForetoldFromTheStraightOne) {
  const Studio studio = make_studio(input);
  const View view(input.still);
  const auto lit = [&](const glm::vec3& lean) {
    std::vector<LitMesh> meshes{leaning(input.objects[0], lean)};
    const SceneTree tree(meshes);
    return light_studio(studio, view, tree, meshes).meshes[0];
  };
  const Glow straight = lit(glm::vec3(0.0f));
  const std::size_t middle = 60;
  for (const glm::vec3 d : {glm::vec3(0.2f, 0, 0), glm::vec3(-0.2f, 0, 0), glm::vec3(0, 0.15f, 0)}) {
    const glm::vec3 n = glm::normalize(glm::vec3(0, 0, 1) + d);
    const float really = lit(d).above.irradiance[middle].g, still = straight.above.irradiance[middle].g;
    const float foretold = straight.above.at(middle, n - glm::vec3(0, 0, 1)).g;
    if (d.x != 0) {  // toward the key light and away from it
      EXPECT_GT(std::abs(really - still), 0.05f * still);
    }
    // The room's light is found with few directions: a tenth of the change and 2 % of the whole.
    EXPECT_NEAR(foretold, really, 0.1f * std::abs(really - still) + 0.02f * still) << d.x << " " << d.y;
  }
}

TEST_F(LeafSkin, VeinsArePalerAndLieWhereUvSays) {
  const Studio studio = make_studio(input);
  const View view(input.still);
  std::vector<LitMesh> meshes{place_mesh(input.objects[0])};
  const SceneTree tree(meshes);
  const StudioGlow glow = light_studio(studio, view, tree, meshes);
  std::vector<int> faces(meshes[0].triangles.size());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = int(f);
  const SkinPictures skin =
      paint_skin(studio, view, meshes[0], faces, glow.meshes[0], look_of(input.objects[0], 0), 1);
  ASSERT_GE(skin.pixels, 64);
  const auto mean = [&](const std::vector<glm::vec3>& picture, double u, double v) {
    const int n = skin.pixels, i = int(u * n), j = n - 1 - int(v * n);
    double sum = 0;
    for (int l = -1; l <= 1; ++l)
      for (int k = -1; k <= 1; ++k) sum += picture[std::size_t((j + l) * n + i + k)].g / 9;
    return sum;
  };
  // A main vein along v at u = 0.25, a side vein along u at v = 0.8.
  EXPECT_GT(mean(skin.front, 0.25, 0.5), 1.3 * mean(skin.front, 0.55, 0.5));
  EXPECT_GT(mean(skin.front, 0.55, 0.8), 1.1 * mean(skin.front, 0.55, 0.5));
  EXPECT_NEAR(mean(skin.front, 0.75, 0.5), mean(skin.front, 0.55, 0.5), 0.25 * mean(skin.front, 0.55, 0.5));
  for (const glm::vec3& g : skin.front) ASSERT_TRUE(g.r >= 0 && g.g >= 0 && g.b >= 0);
}

TEST_F(LeafSkin, DetailNeedsTextureCoordinatesAndItsSize) {
  surface.uv.clear();
  EXPECT_THROW(write_object_scene(folder, input), InvalidInput);
  surface = leaf_fixture::flat_leaf();
  input.objects[0].looks[0].detail = [](int) { return leaf_fixture::detail(16); };
  EXPECT_THROW(write_object_scene(folder, input), InvalidInput);
}

}  // namespace
}  // namespace witherfield::pov
