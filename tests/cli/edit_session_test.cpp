// The editor's state without its window: gestures, undo, and that what is saved is what was seen.
#include "cli/edit_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "cli/edit_save.hpp"
#include "cli/leaf_input.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

class EditSessionTest : public testing::Test {
 protected:
  EditSessionTest() : folder_(fs::temp_directory_path() / ("witherfield_edit_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~EditSessionTest() override { fs::remove_all(folder_); }

  static constexpr const char* kCucumber =
      "kind = \"leaf\"  # a leaf\nmain_vein_m = 0.1\n[mesh]\nedge_m = 0.006\nvein_edge_m = 0.004\noutline_spacing_m = 0.003\n";

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static EditSession open(const fs::path& file) {
    scene::LeafScene s = scene::load_leaf_scene(file.string());
    leaf::LeafInput input = read_leaf_input(s);
    return EditSession(std::move(s), std::move(input));
  }
  EditSession cucumber() { return open(write("leaf.toml", kCucumber)); }

  /// As the mouse does it: pressed, moved in steps, released.
  static void drag(EditSession& s, int handle, const glm::dvec3& by, int steps = 5) {
    s.begin();
    const glm::dvec3 from = s.handle_place(handle);
    for (int i = 1; i <= steps; ++i) s.move_handle(handle, from + by * (double(i) / steps));
    s.end();
  }
  static int tip(const EditSession& s) { return s.model().midrib.back(); }
  static double farthest(const EditSession::Positions& a, const EditSession::Positions& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, glm::distance(a[i], b[i]));
    return d;
  }
  /// What `witherfield run` makes of a saved scene.
  static EditSession::Positions as_run(const fs::path& file) {
    const scene::LeafScene s = scene::load_leaf_scene(file.string());
    const leaf::LeafModel model = leaf::build_leaf(s.leaf, read_leaf_input(s));
    EditSession::Positions p = model.natural.position_m;
    leaf::run_edit(model, s.leaf.edit, [&](const leaf::EditFrame& f) { p = *f.position_m; });
    return p;
  }

  fs::path folder_;
};

TEST_F(EditSessionTest, OpensUnchangedAndHeldAtThePetiole) {
  const EditSession s = cucumber();
  EXPECT_FALSE(s.changed());
  EXPECT_FALSE(s.can_undo());
  ASSERT_EQ(s.edit().handles.size(), 1u);
  EXPECT_EQ(s.edit().handles[0].name, "petiole");
  EXPECT_LT(farthest(s.positions(), s.model().natural.position_m), 1e-9);
}

TEST_F(EditSessionTest, ADraggedHandleTakesTheLeafAlongInBothModes) {
  for (const auto mode : {leaf::EditMode::linear, leaf::EditMode::rotation_aware}) {
    EditSession s = cucumber();
    s.set_mode(mode);
    const int v = tip(s), base = s.model().midrib.front();
    const int handle = s.add_handle(v);
    const auto before = s.positions();
    drag(s, handle, {0, 0, 0.03});
    EXPECT_NEAR(s.positions()[std::size_t(v)].z, before[std::size_t(v)].z + 0.03, mode == leaf::EditMode::linear ? 2e-3 : 1e-9);
    EXPECT_LT(glm::distance(s.positions()[std::size_t(base)], before[std::size_t(base)]), 1e-3);
    const int middle = s.model().midrib[s.model().midrib.size() / 2];
    const double rise = s.positions()[std::size_t(middle)].z - before[std::size_t(middle)].z;
    EXPECT_GT(rise, 0.002);
    EXPECT_LT(rise, 0.028);
    EXPECT_NE(s.report().area_drift, 0);
  }
}

TEST_F(EditSessionTest, ANewHandleLeavesTheShape) {
  for (const auto mode : {leaf::EditMode::linear, leaf::EditMode::rotation_aware}) {
    EditSession s = cucumber();
    s.set_mode(mode);
    drag(s, s.add_handle(tip(s)), {0, 0.01, 0.02});
    const auto before = s.positions();
    s.add_handle(s.model().border[s.model().border.size() / 4]);
    EXPECT_LT(farthest(s.positions(), before), 1e-3) << int(mode);  // what it holds around it is made to move alike
  }
}

TEST_F(EditSessionTest, UndoAndRedoRestoreEveryBit) {
  EditSession s = cucumber();
  const auto first = s.positions();
  const int handle = s.add_handle(tip(s));
  drag(s, handle, {0, 0, 0.02});
  const auto second = s.positions();
  drag(s, handle, {0.005, 0.01, 0});
  const auto third = s.positions();
  s.undo();
  EXPECT_EQ(s.positions(), second);
  s.undo();
  s.undo();
  EXPECT_EQ(s.positions(), first);
  EXPECT_EQ(s.edit().handles.size(), 1u);
  EXPECT_FALSE(s.changed());
  EXPECT_FALSE(s.can_undo());
  for (int i = 0; i < 3; ++i) s.redo();
  EXPECT_EQ(s.positions(), third);
  EXPECT_FALSE(s.can_redo());
  s.undo();
  drag(s, handle, {0, 0.01, 0});
  EXPECT_FALSE(s.can_redo());  // another way was taken
  s.reset();
  EXPECT_EQ(s.positions(), first);
  s.undo();
  EXPECT_TRUE(s.changed());
}

TEST_F(EditSessionTest, AGestureIsUndoneAsAWholeAndOneWithoutChangeLeavesNoTrace) {
  EditSession s = cucumber();
  s.begin();
  s.end();
  EXPECT_FALSE(s.can_undo());
  s.begin();
  const int handle = s.add_handle(tip(s));
  s.move_handle(handle, s.handle_place(handle) + glm::dvec3(0, 0, 0.01));
  s.end();
  s.undo();
  EXPECT_FALSE(s.can_undo());
  EXPECT_EQ(s.edit().handles.size(), 1u);
}

TEST_F(EditSessionTest, HandlesAreNotTakenTwiceNorAllRemoved) {
  EditSession s = cucumber();
  const int handle = s.add_handle(tip(s));
  EXPECT_EQ(s.add_handle(tip(s)), handle);
  EXPECT_EQ(s.edit().handles.size(), 2u);
  s.remove_handle(handle);
  EXPECT_THROW(s.remove_handle(0), InvalidInput);
  const auto along = s.held_along(0);
  ASSERT_FALSE(along.empty());  // the petiole's handle holds a patch
  EXPECT_THROW(s.add_handle(along.front()), InvalidInput);
  EXPECT_EQ(s.edit().handles.size(), 1u);
  s.set_radius(0, 0);
  EXPECT_TRUE(s.held_along(0).empty());
}

TEST_F(EditSessionTest, MovingAnOutlinePointRebuildsTheLeaf) {
  EditSession s = cucumber();
  const double area = s.model().area_m2;
  drag(s, s.add_handle(tip(s)), {0, 0, 0.02});
  const OutlinePoint p{OutlineGroup::left, int(s.points().left_m.size()) / 2};
  const glm::dvec3 from = s.place(p), out = from + glm::dvec3(0, 0.012, 0);
  s.begin();
  s.move_point(p, out);
  const auto reaches = [&](const EditSession::Positions& flat) {  // the margin goes through the point, give or take a tooth
    return std::any_of(flat.begin(), flat.end(), [&](const glm::dvec3& q) { return glm::distance(q, out) < 0.003; });
  };
  EXPECT_FALSE(reaches(s.model().flat.position_m));
  EXPECT_TRUE(reaches(s.flat_leaf().position_m));  // follows before the button is up
  s.end();
  EXPECT_TRUE(reaches(s.model().flat.position_m));
  EXPECT_GT(s.model().area_m2, area * 1.004);
  EXPECT_NEAR(s.place(p).y, out.y, 1e-8);
  // The edit is made on the new leaf.
  EXPECT_NEAR(s.handle_place(1).z - s.positions()[std::size_t(tip(s))].z, 0, 1e-3);
  EXPECT_GT(farthest(s.positions(), s.model().natural.position_m), 0.015);
  s.undo();
  EXPECT_DOUBLE_EQ(s.model().area_m2, area);
  EXPECT_FALSE(s.points_changed());
}

TEST_F(EditSessionTest, ANewPointLiesOnTheCurve) {
  EditSession s = cucumber();
  const double area = s.model().area_m2;
  const auto curve = s.curves()[1];
  const std::size_t before = s.points().right_m.size();
  const OutlinePoint p = s.add_point(curve[curve.size() / 2] + glm::dvec3(0, -0.0005, 0));
  EXPECT_EQ(p.group, OutlineGroup::right);
  EXPECT_EQ(s.points().right_m.size(), before + 1);
  EXPECT_NEAR(s.model().area_m2, area, 0.02 * area);
  s.remove_point(p);
  EXPECT_EQ(s.points().right_m.size(), before);
}

TEST_F(EditSessionTest, AnOutlineThatCrossesItselfIsRefusedAndTheLeafStays) {
  EditSession s = cucumber();
  const auto before = s.positions();
  const OutlinePoint p{OutlineGroup::left, int(s.points().left_m.size()) / 2};
  s.begin();
  EXPECT_THROW(
      {
        try {
          s.move_point(p, s.place(p) + glm::dvec3(0, -0.3, 0));
        } catch (const Error&) {
        }
        s.end();
      },
      Error);
  EXPECT_EQ(s.positions(), before);
  EXPECT_FALSE(s.can_undo());
  EXPECT_FALSE(s.in_gesture());
}

TEST_F(EditSessionTest, TheSavedSceneMakesTheSameLeaf) {
  EditSession s = cucumber();
  drag(s, s.add_handle(tip(s)), {-0.02, 0.01, 0.04});
  s.add_key();
  drag(s, s.add_handle(s.model().border[s.model().border.size() / 4]), {0, 0, -0.02});
  const OutlinePoint p{OutlineGroup::right, 2};
  s.begin();
  s.move_point(p, s.place(p) + glm::dvec3(0.004, -0.006, 0));
  s.end();
  const fs::path file = folder_ / "leaf.toml", target = edited_name(file);
  EXPECT_EQ(target.filename(), "leaf_edited.toml");
  EXPECT_EQ(edited_name(target), target);
  const auto files = save_edit(s, scene::load_leaf_scene(file.string()), file, kCucumber, target);
  ASSERT_EQ(files.size(), 4u);
  for (const fs::path& f : files) EXPECT_TRUE(fs::exists(f)) << f;
  s.mark_saved();
  EXPECT_FALSE(s.changed());
  EXPECT_LT(farthest(as_run(target), s.positions()), 1e-9);
  // Opened again, it is what it was.
  const EditSession again = open(target);
  EXPECT_LT(farthest(again.positions(), s.positions()), 1e-9);
  EXPECT_EQ(again.edit().handles.size(), s.edit().handles.size());
  EXPECT_EQ(again.edit().keys.size(), 2u);
}

TEST_F(EditSessionTest, ASceneSavedElsewhereFindsItsFiles) {
  EditSession first = cucumber();
  write("points.csv", leaf::outline_csv(first.points()));
  const std::string toml = "kind = \"leaf\"\nsource = \"points\"\npoints = \"points.csv\"\n[mesh]\nedge_m = 0.006\nvein_edge_m = 0.004\noutline_spacing_m = 0.003\n";
  const fs::path file = write("measured.toml", toml);
  EditSession s = open(file);
  drag(s, s.add_handle(tip(s)), {0, 0, 0.02});
  fs::create_directories(folder_ / "there");
  const fs::path target = folder_ / "there" / "mine.toml";
  save_edit(s, scene::load_leaf_scene(file.string()), file, toml, target);
  EXPECT_LT(farthest(as_run(target), s.positions()), 1e-9);
}

}  // namespace
}  // namespace witherfield::cli
