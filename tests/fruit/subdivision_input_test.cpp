// Every kind of broken control mesh is refused by name.
#include <gtest/gtest.h>

#include "sim/core/errors.hpp"
#include "tests/fruit/mesh_fixtures.hpp"

namespace witherfield::fruit {
namespace {

using namespace fixtures;

void expect_refused(const ControlMesh& mesh, const std::vector<std::string>& parts,
                    Scheme scheme = Scheme::hoppe1994, int steps = 1) {
  try {
    const Refinement r(mesh, scheme, steps);
    ADD_FAILURE() << "accepted; must say " << parts[0];
  } catch (const InvalidInput& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << '"' << error.what() << "\" must say " << part;
  }
}

TEST(SubdivisionInput, IndexOutOfRange) {
  ControlMesh m = tetrahedron();
  m.triangles[2][1] = 4;
  expect_refused(m, {"triangle 2", "vertex 4", "0..3"});
  m.triangles[2][1] = -1;
  expect_refused(m, {"triangle 2", "vertex -1", "0..3"});
}

TEST(SubdivisionInput, TriangleWithOneVertexTwice) {
  ControlMesh m = tetrahedron();
  m.triangles[1] = {0, 3, 0};
  expect_refused(m, {"triangle 1", "twice"});
}

TEST(SubdivisionInput, EdgeWithThreeFaces) {
  ControlMesh m = tetrahedron();
  m.position_m.emplace_back(2, 2, 2);
  m.triangles.push_back({0, 1, 4});
  expect_refused(m, {"edge 0-1", "triangles 0 and 4", "more than two faces"});
}

TEST(SubdivisionInput, OppositeOrientation) {
  ControlMesh m = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 2, 3}});
  expect_refused(m, {"edge 1-2", "triangles 0 and 1", "orientation"});
}

TEST(SubdivisionInput, SeveralFansInAVertex) {
  // Two triangles that touch in vertex 2; two tetrahedra that share a vertex.
  ControlMesh m = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}}, {{0, 1, 2}, {2, 3, 4}});
  expect_refused(m, {"vertex 2", "several fans"});
  ControlMesh two = tetrahedron();
  for (const auto& p : tetrahedron().position_m) two.position_m.push_back(p + glm::dvec3(2));
  for (auto t : tetrahedron().triangles) {
    for (int& v : t) v = v == 0 ? 0 : v + 4;
    two.triangles.push_back(t);
  }
  expect_refused(two, {"vertex 0", "several fans"});
}

TEST(SubdivisionInput, CreaseThatIsNoEdge) {
  ControlMesh m = octahedron();
  m.crease_edges = {{0, 1}};  // opposite vertices
  expect_refused(m, {"crease edge 0-1", "no edge"});
  m.crease_edges = {{0, 6}};
  expect_refused(m, {"crease edge 0-6", "vertex 6", "0..5"});
}

TEST(SubdivisionInput, SharpVertex) {
  ControlMesh m = octahedron();
  m.sharp_vertices = {17};
  expect_refused(m, {"sharp vertex 17", "0..5"});
  ControlMesh open = sheet(2);
  open.sharp_vertices = {2};  // a corner of one face
  expect_refused(open, {"sharp vertex 2", "valence 2", "3 or more"}, Scheme::liu2007);
  EXPECT_NO_THROW(Refinement(open, Scheme::hoppe1994, 1));
}

TEST(SubdivisionInput, StepsAndSize) {
  expect_refused(octahedron(), {"steps is 9", "0..8"}, Scheme::hoppe1994, 9);
  expect_refused(octahedron(), {"steps is -1", "0..8"}, Scheme::hoppe1994, -1);
  expect_refused(torus(200, 100, 0), {"40000 triangles", "8 steps", "2^31"}, Scheme::hoppe1994, 8);
}

TEST(SubdivisionInput, WrongLengths) {
  const Refinement r(octahedron(), Scheme::hoppe1994, 1);
  Points five(5), six(6), eighteen(18), nineteen(19);
  EXPECT_THROW(r.evaluate(five, eighteen), InvalidInput);
  EXPECT_THROW(r.evaluate(six, nineteen), InvalidInput);
  EXPECT_THROW(r.evaluate_limit(six, eighteen, nineteen), InvalidInput);
  EXPECT_THROW(r.evaluate_limit(six, nineteen, eighteen), InvalidInput);
  std::vector<float> control(12), refined(36);
  EXPECT_NO_THROW(r.evaluate(control, refined, 2));
  EXPECT_THROW(r.evaluate(control, refined, 3), InvalidInput);
  EXPECT_THROW(r.evaluate(control, refined, 0), InvalidInput);
  Surface other;
  other.position_m = tetrahedron().position_m;
  other.triangles = tetrahedron().triangles;
  EXPECT_THROW(refine(r, other), InvalidInput);
}

TEST(SubdivisionInput, CreaseAngle) {
  ControlMesh m = octahedron();
  EXPECT_THROW(add_creases_by_angle(m, -1), InvalidInput);
  EXPECT_THROW(add_creases_by_angle(m, 181), InvalidInput);
  EXPECT_THROW(add_creases_by_angle(m, NAN), InvalidInput);
  m.triangles[0][0] = 99;
  EXPECT_THROW(add_creases_by_angle(m, 30), InvalidInput);
}

TEST(SubdivisionInput, NothingAtAll) {
  const Refinement r(ControlMesh{}, Scheme::hoppe1994, 3);
  EXPECT_EQ(r.vertices(), 0u);
  EXPECT_EQ(r.faces(), 0u);
  EXPECT_NO_THROW(r.evaluate(std::span<const glm::dvec3>(), std::span<glm::dvec3>()));
  EXPECT_NO_THROW(r.evaluate_limit({}, {}, {}));
}

}  // namespace
}  // namespace witherfield::fruit
