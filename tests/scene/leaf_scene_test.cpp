// Leaf scenes: printed defaults load back, and what a scene says arrives in the options.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "sim/core/errors.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::scene {
namespace {

class LeafSceneFile {
 public:
  explicit LeafSceneFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("witherfield_leaf_" + std::to_string(std::hash<std::string>{}(text)) + ".toml")) {
    std::ofstream(path_) << text;
  }
  ~LeafSceneFile() { std::filesystem::remove(path_); }
  LeafScene load(bool preview = false) const {
    LeafScene s = load_leaf_scene(path_.string(), preview);
    s.name = "x";
    return s;
  }
  std::string reason() const {
    try {
      load();
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

const std::string kKind = "kind = \"leaf\"\n";

TEST(LeafSceneDefaults, AnEmptySceneIsTheDefaultStruct) {
  LeafScene plain;
  plain.name = "x";
  EXPECT_EQ(resolved_json(LeafSceneFile(kKind).load()), resolved_json(plain));
  EXPECT_FALSE(LeafSceneFile(kKind).load().leaf.wilts);
}

TEST(LeafSceneDefaults, PrintedDefaultsLoadBackToTheDefaults) {
  LeafScene plain;
  plain.name = "x";
  const LeafScene printed = LeafSceneFile(print_defaults("leaf")).load();
  EXPECT_EQ(resolved_json(printed), resolved_json(plain));
}

TEST(LeafSceneKeys, ArriveInTheOptions) {
  const LeafScene s = LeafSceneFile(kKind + R"(
species = "watermelon"
main_vein_m = 0.11
[mesh]
edge_m = 0.004
[edit]
mode = "linear"
[[edit.handle]]
uv = [0.1, 0.5]
radius_m = 0.01
[[edit.key]]
name = "up"
move_m = [0, 0, 0.02]
[wilt]
length_hours = 9
frame_hours = [0, 3, 9]
vein_conductivity_kg_m_s = 0.5
conductance_loss = 0.7
supply_curve = [[0, 1], [2, 0]]
)").load();
  EXPECT_EQ(s.leaf.species, "watermelon");
  EXPECT_EQ(s.leaf.main_vein_m, 0.11);
  EXPECT_EQ(s.leaf.mesh.edge_m, 0.004);
  EXPECT_EQ(s.leaf.edit.mode, leaf::EditMode::linear);
  ASSERT_EQ(s.leaf.edit.keys.size(), 1u);
  EXPECT_EQ(s.leaf.edit.keys[0].move_m.at(0).z, 0.02);
  EXPECT_TRUE(s.leaf.wilts);
  EXPECT_EQ(s.leaf.wilt.length_hours, 9);
  EXPECT_EQ(s.leaf.wilt.frame_hours, (std::vector<double>{0, 3, 9}));
  EXPECT_EQ(s.leaf.wilt.water.vein_conductivity_kg_m_s, 0.5);
  EXPECT_EQ(s.leaf.wilt.water.conductance_loss, 0.7);
  EXPECT_EQ(s.leaf.wilt.water.supply_curve.size(), 2u);
}

TEST(LeafSceneKeys, MistakesAreNamedWithTheirLine) {
  EXPECT_NE(LeafSceneFile(kKind + "specis = \"cucumber\"\n").reason().find(":2: specis"), std::string::npos);
  EXPECT_NE(LeafSceneFile(kKind + "main_vein_m = 15\n").reason().find("0.01..1 m"), std::string::npos);
  EXPECT_NE(LeafSceneFile(kKind + "source = \"points\"\n").reason().find("name of a file"), std::string::npos);
}

TEST(LeafScenePreview, IsCoarse) {
  const LeafScene s = LeafSceneFile(kKind + "[wilt]\nframes = 40\n").load(true);
  EXPECT_GE(s.leaf.mesh.edge_m, 0.006);
  EXPECT_LE(s.leaf.wilt.frames, 3);
}

}  // namespace
}  // namespace witherfield::scene
