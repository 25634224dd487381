// A scene file with another edit in it: what its author wrote stays.
#include "sim/scene/edited_scene.hpp"

#include <gtest/gtest.h>

#include "scene_file.hpp"

namespace witherfield::scene {
namespace {

const std::string kScene =
    "# My leaf.\n"
    "species = \"watermelon\"  # the big one\n"
    "points = \"old.csv\"\n"
    "points_unit = \"mm\"\n"
    "\n"
    "# About the mesh.\n"
    "[mesh]\n"
    "edge_m = 0.004 # \"fine [enough\"\n"
    "\n"
    "[edit]\n"
    "mode = \"linear\"  # as in the paper\n"
    "[[edit.handle]]\n"
    "uv = [0.1,\n  0.5]\n"
    "[[edit.key]]\n"
    "move_m = [0,\n  0, 0.1,\n]\n"
    "\n"
    "# The water.\n"
    "[wilt]\n"
    "length_hours = 9\n";

SceneEdit an_edit() {
  SceneEdit e;
  e.edit.mode = leaf::EditMode::rotation_aware;
  e.edit.smoothness = 0.07;
  e.edit.handles.resize(2);
  e.edit.handles[0].name = "a \"quoted\" \\ name";
  e.edit.handles[0].uv = {0.123456789012345, 0.75};
  e.edit.handles[0].radius_m = 0.004;
  e.edit.handles[1].by_uv = false;
  e.edit.handles[1].point_m = {0.1, -0.2, 1e-7};
  e.edit.keys = {{"one", {{0.1, 0.2, 0.3}, {0, 0, -1e-7}}}, {"two", {{0, 0, 0}, {0.01, 0.02, 0.03}}}};
  return e;
}

LeafScene load(const std::string& text) { return load_leaf_scene(SceneFile(text, "it", "leaf").path()); }

TEST(EditedScene, LoadsAsTheSameSceneWithTheNewEdit) {
  LeafScene s = load(with_edit(kScene, an_edit()));
  s.leaf.points_file = load(kScene).leaf.points_file;  // in a folder of its own each time
  LeafScene before = load(kScene);
  before.leaf.edit = an_edit().edit;
  before.leaf.points_file = s.leaf.points_file;
  EXPECT_EQ(resolved_json(s), resolved_json(before));
}

TEST(EditedScene, CommentsAndOtherKeysStayAsTheyWere) {
  const std::string text = with_edit(kScene, an_edit());
  for (const char* kept : {"# My leaf.\n", "species = \"watermelon\"  # the big one\n", "points = \"old.csv\"\n", "\n# About the mesh.\n[mesh]\n",
                           "edge_m = 0.004 # \"fine [enough\"\n", "# The water.\n[wilt]\nlength_hours = 9\n"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << "\n" << text;
  EXPECT_EQ(text.find("as in the paper"), std::string::npos);
  EXPECT_EQ(text.find("[edit]"), text.rfind("[edit]"));
  EXPECT_EQ(with_edit(text, an_edit()), text);  // saving again changes nothing
}

TEST(EditedScene, KeysOfTheTopGoAboveTheFirstTable) {
  SceneEdit e = an_edit();
  e.points_file = "new.csv";
  const std::string text = with_edit(kScene, e);
  EXPECT_EQ(text.find("old.csv"), std::string::npos);
  EXPECT_NE(text.find("points = \"new.csv\"\npoints_unit = \"m\"\n\n# About the mesh.\n[mesh]"), std::string::npos) << text;
  EXPECT_EQ(load(text).points_unit, "m");
  EXPECT_EQ(load(with_edit("", e)).points_unit, "m");
  EXPECT_EQ(load(with_edit("# nothing", e)).leaf.edit.handles.size(), 2u);
}

TEST(EditedScene, AnInlineOrDottedEditIsReplacedToo) {
  for (const char* other : {"edit = { mode = \"linear\" }\n", "edit.mode = \"linear\"\n", "edit . mode = 'linear' # so\n[\"edit\".x]\n"}) {
    const std::string text = with_edit(other + std::string("[mesh]\nedge_m = 0.01\n"), an_edit());
    EXPECT_EQ(text.find("linear"), std::string::npos) << text;
    EXPECT_DOUBLE_EQ(load(text).leaf.mesh.edge_m, 0.01);
  }
}

}  // namespace
}  // namespace witherfield::scene
