#include "sim/leaf/editor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::leaf {
namespace {

std::string reason_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "nothing was thrown";
}

void expect_reason(const std::function<void()>& action, const std::string& part) {
  const std::string reason = reason_of(action);
  EXPECT_NE(reason.find(part), std::string::npos) << reason;
}

TEST(LeafEditor, FactorsOnceWhateverIsDone) {
  const Surface s = test::sheet(15);
  LeafEditor editor(s);
  const int once = editor.factorisations();
  EXPECT_EQ(once, 2);  // the leaf's operator, and that of its rotations
  for (const EditMode m : {EditMode::linear, EditMode::rotation_aware}) {
    editor.set_mode(m);
    for (int set = 0; set < 3; ++set) {
      editor.set_handles({{set, 10}, {200 + set, 10}});
      for (int k = 0; k < 4; ++k) {
        const auto& p = editor.positions();
        std::vector<glm::dvec3> target{p[std::size_t(set)], p[std::size_t(200 + set)] + glm::dvec3(0, 0, 0.05)};
        editor.drag(target);
      }
    }
  }
  EXPECT_EQ(editor.factorisations(), once);
}

TEST(LeafEditor, NewHandlesKeepTheShapeAndResetRestoresTheLeafExactly) {
  const Surface s = test::sheet(15);
  for (const EditMode m : {EditMode::linear, EditMode::rotation_aware}) {
    EditOptions o;
    o.mode = m;
    LeafEditor editor(s, o);
    editor.set_handles({{0, 10}, {14, 10}, {210, 10}});
    std::vector<glm::dvec3> target{s.position_m[0], s.position_m[14] + glm::dvec3(0, 0, 0.5), s.position_m[210]};
    const auto dragged = editor.drag(target);
    editor.set_handles({{100, 10}, {7, 10}});
    EXPECT_EQ(editor.positions(), dragged);
    const std::vector<glm::dvec3> same{dragged[100], dragged[7]};
    EXPECT_EQ(editor.drag(same), dragged);  // identity from the new shape, too
    editor.reset();
    EXPECT_EQ(editor.positions(), s.position_m);
    editor.restore(dragged);  // undo
    EXPECT_EQ(editor.positions(), dragged);
    EXPECT_NE(editor.report().area_drift, 0);
  }
}

TEST(LeafEditor, OneHandleCarriesTheWholeLeaf) {
  const Surface s = test::sheet(11);
  for (const EditMode m : {EditMode::linear, EditMode::rotation_aware}) {
    EditOptions o;
    o.mode = m;
    LeafEditor editor(s, o);
    editor.set_handles({{5, 10}});
    const std::vector<glm::dvec3> target{s.position_m[5] + glm::dvec3(1, -2, 0.5)};
    const auto& p = editor.drag(target);
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_LT(glm::distance(p[i], s.position_m[i] + glm::dvec3(1, -2, 0.5)), 1e-9);
  }
}

TEST(LeafEditor, DegenerateMeshesGetAReason) {
  expect_reason([] { LeafEditor e(Surface{}); }, "no triangle");
  Surface flat = test::sheet(4, 0);
  flat.position_m[5] = 0.5 * (flat.position_m[0] + flat.position_m[10]);
  flat.position_m[1] = 0.5 * (flat.position_m[0] + flat.position_m[5]);
  expect_reason([&] { LeafEditor e(flat); }, "no area");
  Surface lonely = test::sheet(4);
  lonely.position_m.push_back({5, 5, 5});
  expect_reason([&] { LeafEditor e(lonely); }, "vertex 16 at (5");
  Surface two = test::sheet(4);
  Surface other = test::sheet(3);
  for (auto& p : other.position_m) p.x += 10;
  append(two, other);
  expect_reason([&] { LeafEditor e(two); }, "2 pieces");
  Surface fin = test::sheet(4);
  fin.position_m.push_back({0, 0, 1});
  fin.triangles.push_back({0, 5, 16});
  expect_reason([&] { LeafEditor e(fin); }, "more than two triangles");
  Surface holed = test::sheet(4);
  holed.position_m[3].x = std::nan("");
  expect_reason([&] { LeafEditor e(holed); }, "vertex 3 is not finite");
}

TEST(LeafEditor, WrongHandlesGetAReason) {
  LeafEditor editor(test::sheet(4));
  const std::vector<glm::dvec3> one{{0, 0, 0}};
  expect_reason([&] { editor.drag(one); }, "before handles are set");
  expect_reason([&] { editor.set_handles({}); }, "no handle");
  expect_reason([&] { editor.set_handles({{16, 1}}); }, "vertices 0..15");
  expect_reason([&] { editor.set_handles({{3, 1}, {3, 1}}); }, "named by two handles");
  expect_reason([&] { editor.set_handles({{3, 0}}); }, "0.01..1e6");
  editor.set_handles({{3, 1}, {4, 1}});
  expect_reason([&] { editor.drag(one); }, "1 targets for 2 handles");
  const std::vector<glm::dvec3> wild{{0, 0, 0}, {0, INFINITY, 0}};
  expect_reason([&] { editor.drag(wild); }, "handle 1 is not finite");
}

TEST(EditReport, MeasuresStretchAreaAndFlips) {
  const Surface s = test::sheet(5, 0);
  auto p = s.position_m;
  for (auto& q : p) q = {1.2 * q.x, 0.9 * q.y, 0};
  const EditReport r = edit_report(s.position_m, p, s.triangles);
  EXPECT_NEAR(r.area_drift, 1.2 * 0.9 - 1, 1e-12);
  EXPECT_NEAR(r.largest_strain, 0.2, 1e-12);
  EXPECT_NEAR(r.rms_strain, std::sqrt(0.5 * (0.04 + 0.01)), 1e-12);
  EXPECT_EQ(r.flipped_faces, 0);
  for (const auto& [larger, smaller] : principal_stretches(s.position_m, p, s.triangles)) {
    EXPECT_NEAR(larger, 1.2, 1e-12);
    EXPECT_NEAR(smaller, 0.9, 1e-12);
  }
  // Simple shear by g: stretches (sqrt(1 + g^2 / 4) +- g / 2), area kept.
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = s.position_m[i] + glm::dvec3(0.6 * s.position_m[i].y, 0, 0);
  const auto sheared = principal_stretches(s.position_m, p, s.triangles)[0];
  EXPECT_NEAR(sheared[0], std::sqrt(1.09) + 0.3, 1e-12);
  EXPECT_NEAR(sheared[1], std::sqrt(1.09) - 0.3, 1e-12);

  // One inner vertex pulled over its neighbours: some faces now lie upside down.
  p = s.position_m;
  p[12] += glm::dvec3(0.9, 0.1, 0);
  EXPECT_GT(edit_report(s.position_m, p, s.triangles).flipped_faces, 0);
  EXPECT_EQ(edit_report(p, p, s.triangles).flipped_faces, 0);  // only what the edit did
}

LeafModel small_leaf() {
  LeafOptions o;
  o.mesh = {0.004, 0.008, 0.006, 0.5, 20000};
  o.margin.tooth_depth_m = 0;
  o.veins.net_spacing_m = 0;
  return build_leaf(o);
}

TEST(EditScript, ReachesItsKeysFromHandlesPickedByUvAndByPoint) {
  const LeafModel leaf = small_leaf();
  EditOptions o;
  HandleOptions base, tip;
  base.by_uv = false;
  base.point_m = {0, 0, 0};
  base.radius_m = 0.012;
  const int apex = leaf.midrib.back();
  tip.uv = leaf.natural.uv[std::size_t(apex)];
  o.handles = {base, tip};
  o.keys = {{"up", {{0, 0, 0}, {-0.01, 0, 0.05}}}, {"home", {{0, 0, 0}, {0, 0, 0}}}};
  for (const EditMode m : {EditMode::linear, EditMode::rotation_aware}) {
    o.mode = m;
    int seen = 0;
    run_edit(leaf, o, [&](const EditFrame& f) {
      EXPECT_EQ(f.index, seen++);
      const glm::dvec3 want = leaf.natural.position_m[std::size_t(apex)] + f.key->move_m[1];
      EXPECT_LT(glm::distance((*f.position_m)[std::size_t(apex)], want), m == EditMode::linear ? 2e-3 : 1e-12);
      EXPECT_LT(std::abs(f.report.area_drift), m == EditMode::linear ? 0.5 : 0.08) << f.key->name;
    });
    EXPECT_EQ(seen, 2);
  }
  o.handles[1] = base;
  expect_reason([&] { run_edit(leaf, o, [](const EditFrame&) {}); }, "holds already");
  o.handles.pop_back();
  expect_reason([&] { run_edit(leaf, o, [](const EditFrame&) {}); }, "2 moves for 1 handles");
}

}  // namespace
}  // namespace witherfield::leaf
