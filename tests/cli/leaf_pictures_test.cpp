// What pictures of leaves add to the leaf: handles, stem, stages.
#include "cli/leaf_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cli/leaf_input.hpp"
#include "sim/leaf/editor.hpp"

namespace witherfield::cli {
namespace {

leaf::LeafModel small_leaf() {
  leaf::LeafOptions o = leaf::species_preset("cucumber");
  o.mesh = {0.006, 0.012, 0.0084, 0.5, 20000};
  return leaf::build_leaf(o);
}

/// Vertices of an organ, and the mean of their colours.
struct Part {
  std::vector<glm::dvec3> position;
  glm::dvec3 colour{0.0};
};
Part part_of(const Surface& s, int organ, std::size_t from = 0) {
  Part p;
  const auto &id = s.field("organ_id").values, &diffuse = s.field("diffuse").values;
  for (std::size_t v = from; v < s.position_m.size(); ++v) {
    if (int(id[v]) != organ) continue;
    p.position.push_back(s.position_m[v]);
    for (int c = 0; c < 3; ++c) p.colour[c] += diffuse[3 * v + std::size_t(c)];
  }
  p.colour /= std::max<double>(1, double(p.position.size()));
  return p;
}

leaf::EditOptions one_handle(const leaf::LeafModel& m, int vertex) {
  leaf::EditOptions e;
  leaf::HandleOptions h;
  h.by_uv = false;
  h.point_m = m.natural.position_m[std::size_t(vertex)];
  e.handles = {h};
  return e;
}

TEST(LeafPictures, HandlesAreRedWhereHeldAndBlueWhereDragged) {
  const leaf::LeafModel m = small_leaf();
  const int tip = m.midrib.back();
  const leaf::EditOptions edit = one_handle(m, tip);
  std::vector<glm::dvec3> pose = m.natural.position_m;
  for (glm::dvec3& p : pose) p.z += 0.05;  // markers follow the leaf that is shown
  for (const bool dragged : {false, true}) {
    Surface s = whole_leaf(m, pose);
    const std::size_t before = s.position_m.size();
    leaf::EditKey key;
    if (dragged) key.move_m = {{0, 0, 0.05}};
    add_handles(s, m, edit, key);
    s.validate();
    // First the ball; the cord of the margin stays where the leaf was before.
    Part ball, margin;
    for (std::size_t v = before; v < s.position_m.size(); ++v) {
      ASSERT_EQ(int(s.field("organ_id").values[v]), kMarkerOrgan);
      const bool near = glm::distance(s.position_m[v], pose[std::size_t(tip)]) < 0.0301 * m.main_vein_m;
      Part& p = near ? ball : margin;
      p.position.push_back(s.position_m[v]);
      for (int c = 0; c < 3; ++c) p.colour[c] += s.field("diffuse").values[3 * v + std::size_t(c)];
    }
    ASSERT_GT(ball.position.size(), 50u);
    ASSERT_GT(margin.position.size(), 6 * m.border.size() - 7);
    EXPECT_EQ(ball.colour.b > ball.colour.r, dragged);
    double highest = -1;
    for (const glm::dvec3& p : margin.position) highest = std::max(highest, p.z);
    double border = -1;
    for (const int v : m.border) border = std::max(border, m.natural.position_m[std::size_t(v)].z);
    EXPECT_NEAR(highest, border, 0.005 * m.main_vein_m);
  }
}

TEST(LeafPictures, TheStemHoldsThePetiolesEndAndReachesTheGround) {
  const leaf::LeafModel m = small_leaf();
  Surface s = whole_leaf(m, m.natural.position_m);
  add_stem(s, m, -0.2);
  s.validate();
  const Part stem = part_of(s, kStemOrgan);
  ASSERT_FALSE(stem.position.empty());
  const glm::dvec3 end = m.petiole.line_m.front();
  double low = 1, high = -1, nearest = 1;
  for (const glm::dvec3& p : stem.position) {
    low = std::min(low, p.z), high = std::max(high, p.z);
    nearest = std::min(nearest, std::hypot(p.x - end.x, p.y - end.y));
  }
  EXPECT_NEAR(low, -0.2, 1e-9);
  EXPECT_NEAR(high, end.z + 0.05, 2 * m.petiole.radius_stem_m);
  EXPECT_LT(nearest, 1.5 * m.petiole.radius_stem_m);  // they touch

  leaf::LeafModel without = m;
  without.petiole.line_m.clear();
  Surface bare = whole_leaf(without, m.natural.position_m);
  const std::size_t before = bare.position_m.size();
  add_stem(bare, without, -0.2);
  EXPECT_EQ(bare.position_m.size(), before);
}

TEST(LeafPictures, StagesShowPointsSplinesMeshesAndTheirRepair) {
  const leaf::LeafModel m = small_leaf();
  const std::vector<Surface> stages = stage_objects(m);
  ASSERT_EQ(stages.size(), 5u);
  ASSERT_GT(m.ears_split, 0);
  const auto has = [](const Surface& s, auto hue) {
    const auto& d = s.field("diffuse").values;
    for (std::size_t v = 0; v < s.position_m.size(); ++v)
      if (hue(d[3 * v], d[3 * v + 1], d[3 * v + 2])) return true;
    return false;
  };
  const auto red = [](float r, float g, float) { return r > 10 * g; };
  const auto blue = [](float r, float g, float b) { return b > 3 * g && b > 3 * r; };
  for (std::size_t i = 0; i < 5; ++i) {
    stages[i].validate();
    EXPECT_EQ(has(stages[i], red), i == 3) << i;   // triangles with two border edges ...
    EXPECT_EQ(has(stages[i], blue), i == 4) << i;  // ... and what replaced them
  }
}

}  // namespace
}  // namespace witherfield::cli
