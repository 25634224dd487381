// Whole scenes: what is written. povray is not run here.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "pov/near_cells.hpp"
#include "pov/plan.hpp"
#include "pov/render.hpp"
#include "pov/scene_parts.hpp"
#include "pov/text.hpp"
#include "sim/core/errors.hpp"
#include "tests/pov/scene_fixture.hpp"

namespace witherfield::pov {
namespace {

TEST_F(SceneTest, HeadTellsSizeAndExposureBack) {
  const SceneHead h = parse_head(head_text({123, 45, 1.75, "blades", true, false}, "t"), "t.pov");
  EXPECT_EQ(h.width_px, 123);
  EXPECT_EQ(h.height_px, 45);
  EXPECT_DOUBLE_EQ(h.exposure, 1.75);
  EXPECT_EQ(h.look, "blades");
  EXPECT_TRUE(h.depth_of_field);
  EXPECT_FALSE(h.field);
  EXPECT_THROW(parse_head("#version 3.7;\n", "other.pov"), InvalidInput);
}

TEST_F(SceneTest, FilesStayInTheFolderAndNoneIsPartial) {
  input.placement = &placement;
  const auto scenes = write_scenes(folder, input);
  ASSERT_EQ(scenes.size(), 2u);
  for (const auto& e : fs::directory_iterator(folder)) {
    EXPECT_TRUE(e.path().filename().string().starts_with("small_")) << e.path();
    EXPECT_NE(e.path().extension(), ".part");
  }
  for (const fs::path& scene : scenes)
    EXPECT_EQ(read_file(scene).find('/' + std::string("tmp")), std::string::npos);
}

TEST_F(SceneTest, UnknownLookAndMissingDataAreNamed) {
  input.still.looks = {"oil"};
  EXPECT_THROW(write_scenes(folder, input), InvalidInput);
  input.still.looks = {"blades"};
  input.variants[0].blades = nullptr;
  EXPECT_THROW(write_scenes(folder, input), InvalidInput);
  input.variants.clear();
  EXPECT_THROW(write_scenes(folder, input), InvalidInput);
}

TEST_F(SceneTest, PovrayMissingNamesThePackage) {
  input.still.looks = {"blades"};
  const auto scenes = write_scenes(folder, input);
  const std::string path = getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  std::string message;
  try {
    render_scene(scenes[0], folder / "out.png", {});
  } catch (const IoFailure& e) {
    message = e.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("Debian package 'povray'"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(folder / "out.png"));
}

TEST(BoxOverlap, NeighboursNeverShareAFaceNorLeaveAGap) {
  for (int j = -2; j < 3; ++j)
    for (int i = -2; i < 3; ++i) {
      std::set<double> seen;
      for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) seen.insert(box_overlap(i + a, j + b));
      EXPECT_EQ(
          seen.size(),
          std::size_t(kCellOverlaps));  // any 2 x 2 block: all different, so tops and bottoms differ too
      // The walls of two neighbours cross by more than what POV-Ray takes for one and the same hit (1e-4
      // units).
      const double right = kUnitsPerTile * (1 + box_overlap(i, j)),
                   left = kUnitsPerTile * (1 - box_overlap(i + 1, j));
      EXPECT_GT(right - left, 5e-4);
    }
}

std::vector<double> numbers_in(std::string text, std::size_t count) {
  for (char& c : text)
    if (c == '<' || c == '>' || c == ',') c = ' ';
  std::istringstream in(text);
  std::vector<double> v(count);
  for (double& x : v) in >> x;
  EXPECT_TRUE(bool(in)) << text;
  return v;
}

/// Low and high corner of every media box of a scene. Boxes are turned by quarter turns at most: the ground
/// is level.
std::vector<std::array<double, 6>> boxes_of(const std::string& scene) {
  std::vector<std::array<double, 6>> out;
  for (std::size_t at = scene.find("\nbox{<"); at != std::string::npos; at = scene.find("\nbox{<", at + 1)) {
    const std::vector<double> v = numbers_in(scene.substr(at + 6, scene.find(" hollow", at) - at - 6), 6);
    const std::size_t end = scene.find("\nbox{", at + 1), matrix = scene.find("matrix<", at);
    std::vector<double> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    if (matrix < end) m = numbers_in(scene.substr(matrix + 7, scene.find('>', matrix) - matrix - 7), 12);
    if (std::abs(m[1]) + std::abs(m[7]) > 1e-9) continue;  // the field's surroundings slope away
    std::array<double, 6> box;
    for (std::size_t k = 0; k < 3; ++k) {
      double a = m[9 + k], b = m[9 + k];
      for (std::size_t r = 0; r < 3; ++r) {
        a += v[r] * m[3 * r + k];
        b += v[3 + r] * m[3 * r + k];
      }
      box[k] = std::min(a, b);
      box[3 + k] = std::max(a, b);
    }
    out.push_back(box);
  }
  return out;
}

/// No two boxes that overlap have a face in the same plane: POV-Ray takes hits within 1e-4 units for one.
void expect_no_common_faces(const std::vector<std::array<double, 6>>& boxes) {
  int shown = 0;
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      bool overlap = true;
      for (std::size_t k = 0; k < 3; ++k)
        overlap = overlap && boxes[a][k] < boxes[b][3 + k] && boxes[b][k] < boxes[a][3 + k];
      if (!overlap) continue;
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t p : {k, k + 3})
          for (const std::size_t q : {k, k + 3})
            if (std::abs(boxes[a][p] - boxes[b][q]) < 1.5e-4 && ++shown < 10)
              ADD_FAILURE() << "boxes " << a << " and " << b << " along " << k << " at " << boxes[a][p];
    }
  EXPECT_EQ(shown, 0);
}

TEST_F(SceneTest, PiecesOfATexelShareNoFace) {
  input.still.looks = {"texel"};
  const auto boxes = boxes_of(read_file(write_scenes(folder, input)[0]));
  ASSERT_GT(boxes.size(), 4u);
  expect_no_common_faces(boxes);
}

// Overhanging texels reach into one another, so their inner faces meet as well as their walls; level ground
// and one variant is the worst case.
TEST_F(SceneTest, PiecesOfAFieldShareNoFace) {
  for (TexelInstance& t : placement.instances) {
    t.height_scale = 1;
    t.quarter_turns = t.cell_i == 1 ? t.cell_j & 3 : 0;
    t.lod = 0;
  }
  input.placement = &placement;
  input.still.looks = {"texel"};
  input.still.camera.position_m = {0.5, -1.4, 0.7};
  input.still.camera.look_at_m = {0.5, 0.5, 0};
  for (const int width_px : {64, 240, 900}) {  // folded, overhanging, merged
    input.still.width_px = width_px;
    input.still.height_px = width_px * 9 / 16;
    const auto boxes = boxes_of(read_file(write_scenes(folder, input)[0]));
    ASSERT_GT(boxes.size(), 20u);
    expect_no_common_faces(boxes);
  }
}

TEST_F(SceneTest, NearCellHoldsWhatLeansIn) {
  // All density of a level field of one texel falls into the cells; one cell's share is a whole texel's.
  const TexelPrelight light(fine, true, 0.003);
  const std::vector<glm::vec3> white(light.voxels().size(), glm::vec3(1));
  std::vector<CellPart> parts;
  std::vector<glm::dvec3> factor;
  std::vector<TexelInstance> around(9);
  Placement p = fixture::level_placement(0.2, 3);
  for (TexelInstance& t : p.instances) {
    t.quarter_turns = (t.cell_i + 2 * t.cell_j) & 3;
    t.mirrored = t.cell_i == 2;
    parts.push_back({&t, &fine, &light, &white});
    factor.push_back(glm::dvec3(1.0));
  }
  double inside = 0;
  const NearCell cell = merge_cell(p.instances[4], 0.2, parts, factor);
  for (int z = 0; z < cell.block.nz; ++z)
    for (int y = 1; y + 1 < cell.block.ny; ++y)
      for (int x = 1; x + 1 < cell.block.nx; ++x)
        inside += cell.samples.density[(std::size_t(z) * cell.block.ny + y) * cell.block.nx + x];
  // With all parts unturned the cell would hold exactly one texel; turned ones lean in about as much as leans
  // out.
  EXPECT_NEAR(inside / fine.total_density(), 1.0, 0.2);
  for (CellPart& part : parts) part.at = &p.instances[4];
  for (std::size_t k = 0; k < 9; ++k) {
    around[k] = p.instances[k];
    around[k].quarter_turns = 0;
    around[k].mirrored = false;
    parts[k].at = &around[k];
  }
  const NearCell exact = merge_cell(around[4], 0.2, parts, factor);
  double sum = 0;
  for (int z = 0; z < exact.block.nz; ++z)
    for (int y = 1; y + 1 < exact.block.ny; ++y)
      for (int x = 1; x + 1 < exact.block.nx; ++x)
        sum += exact.samples.density[(std::size_t(z) * exact.block.ny + y) * exact.block.nx + x];
  EXPECT_NEAR(sum / fine.total_density(), 1.0, 1e-4);
}

}  // namespace
}  // namespace witherfield::pov
