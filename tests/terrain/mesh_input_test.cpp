// Terrain from a mesh: sampled as a height field, and every mesh that is none is refused.
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <sstream>

#include "sim/core/random.hpp"
#include "tests/terrain/fixtures.hpp"

namespace witherfield::terrain::test {
namespace {

double hill(double x, double y) {
  return 5 + 2 * std::sin(0.7 * x) * std::cos(0.5 * y);
}

class MeshInput : public TerrainTest {
 protected:
  // nx x ny quads over [2, 2 + nx] x [-1, -1 + ny]; `skip` drops the face of that number.
  static std::string obj(int nx, int ny, bool upward = true, int skip = -1) {
    std::ostringstream out;
    out.precision(17);
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) out << "v " << i + 2 << ' ' << j - 1 << ' ' << hill(i + 2, j - 1) << '\n';
    int face = 0;
    const auto write = [&](int a, int b, int c) {
      if (face++ != skip) out << "f " << a << ' ' << (upward ? b : c) << ' ' << (upward ? c : b) << '\n';
    };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = j * (nx + 1) + i + 1, b = a + 1, d = a + nx + 1, c = d + 1;
        write(a, b, c);
        write(a, c, d);
      }
    return out.str();
  }
  void expect_invalid(const std::string& text, const std::vector<std::string>& parts) const {
    expect_error<InvalidInput>(mesh(write_text("bad.obj", text)), parts);
  }
};

const char* const kPlyHead =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty double x\nproperty double "
    "y\nproperty double z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const char* const kPlyVertices = "0 0 1\n1 0 2\n1 1 4\n0 1 3\n";

TEST_F(MeshInput, PassesThroughItsVerticesAndIsLinearBetween) {
  const Terrain t = load_terrain(mesh(write_text("hill.obj", obj(9, 6))));
  EXPECT_DOUBLE_EQ(t.width_m(), 9);
  EXPECT_DOUBLE_EQ(t.depth_m(), 6);
  for (int j = 0; j <= 6; ++j)
    for (int i = 0; i <= 9; ++i) EXPECT_NEAR(t.true_elevation_m(i, j), hill(i + 2, j - 1), 1e-9);
  // On the diagonal of a quad the surface is the mean of its ends; the quad's lower triangle has the corners
  // (0,0), (1,0), (1,1).
  EXPECT_NEAR(t.true_elevation_m(3.5, 2.5), (hill(5, 1) + hill(6, 2)) / 2, 1e-9);
  const double a = hill(5, 1), b = hill(6, 1), c = hill(6, 2);
  EXPECT_NEAR(t.true_elevation_m(3.75, 2.25), 0.25 * a + 0.5 * b + 0.25 * c, 1e-9);
  EXPECT_LT(glm::length(t.normal(3.75, 2.25) - glm::normalize(glm::dvec3(a - b, b - c, 1))), 1e-9);
}

TEST_F(MeshInput, LowestPointIsAtZero) {
  const Terrain t = load_terrain(mesh(write_text("hill.obj", obj(9, 6))));
  double lo = 1e9, hi = 0;
  for (int j = 0; j <= 6; ++j)
    for (int i = 0; i <= 9; ++i) lo = std::min(lo, t.height(i, j)), hi = std::max(hi, t.height(i, j));
  EXPECT_NEAR(lo, 0, 1e-12);
  EXPECT_NEAR(hi, t.max_height_m(), 1e-12);
}

TEST_F(MeshInput, CropIsAWindowOfTheWhole) {
  TerrainOptions o = mesh(write_text("hill.obj", obj(10, 10)));
  const Terrain whole = load_terrain(o);
  o.crop[0] = 0.15, o.crop[1] = 0.25, o.crop[2] = 0.85, o.crop[3] = 0.65;
  const Terrain part = load_terrain(o);
  EXPECT_NEAR(part.width_m(), 7, 1e-12);
  EXPECT_NEAR(part.depth_m(), 4, 1e-12);
  double lo = 1e9;
  for (double x = 0; x <= 7; x += 0.25)
    for (double y = 0; y <= 4; y += 0.25) {
      EXPECT_NEAR(part.true_elevation_m(x, y), whole.true_elevation_m(x + 1.5, y + 2.5), 1e-9);
      lo = std::min(lo, part.height(x, y));
    }
  EXPECT_GE(lo, 0);
}

TEST_F(MeshInput, FacingDownAltogetherIsTheSameGround) {
  const Terrain up = load_terrain(mesh(write_text("up.obj", obj(5, 4)))),
                down = load_terrain(mesh(write_text("down.obj", obj(5, 4, false))));
  for (double x = 0; x <= 5; x += 0.3) EXPECT_NEAR(up.height(x, 1.7), down.height(x, 1.7), 1e-12);
  EXPECT_GT(down.normal(2.2, 1.1).z, 0);
}

// Triangles of very different size and shape: the search must find the right one everywhere.
TEST_F(MeshInput, UnevenTrianglesGiveAnExactPlane) {
  std::ostringstream out;
  out.precision(17);
  const int n = 12;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = 100 * std::pow(double(i) / n, 3), y = 40 * std::pow(double(j) / n, 2);
      out << "v " << x << ' ' << y << ' ' << 3 + 0.2 * x - 0.1 * y << '\n';
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i + 1;
      out << "f " << a << ' ' << a + 1 << ' ' << a + n + 2 << ' ' << a + n + 1 << '\n';  // quads
    }
  const Terrain t = load_terrain(mesh(write_text("uneven.obj", out.str())));
  Random random(3, Stream::test, 0);
  for (int k = 0; k < 2000; ++k) {
    const double x = random.uniform(0, 100), y = random.uniform(0, 40);
    ASSERT_NEAR(t.true_elevation_m(x, y), 3 + 0.2 * x - 0.1 * y, 1e-9) << x << ' ' << y;
  }
}

TEST_F(MeshInput, PlyAsciiAndBinary) {
  const Terrain ascii =
      load_terrain(mesh(write_text("a.ply", std::string(kPlyHead) + kPlyVertices + "3 0 1 2\n3 0 2 3\n")));
  EXPECT_NEAR(ascii.true_elevation_m(0.5, 0.5), 2.5, 1e-6);
  std::string binary(kPlyHead);
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  const double v[] = {0, 0, 1, 1, 0, 2, 1, 1, 4, 0, 1, 3};
  binary.append(reinterpret_cast<const char*>(v), sizeof v);
  for (const auto& f : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
    binary.push_back(3);
    binary.append(reinterpret_cast<const char*>(f.data()), sizeof f);
  }
  const Terrain same = load_terrain(mesh(write_text("b.ply", binary)));
  EXPECT_NEAR(same.true_elevation_m(0.75, 0.25), ascii.true_elevation_m(0.75, 0.25), 1e-6);
  expect_error<IoFailure>(mesh(write_text("cut.ply", binary.substr(0, binary.size() - 6))), {"cut.ply"});
  expect_error<IoFailure>(mesh(write_text("cut2.ply", binary.substr(0, binary.size() - 60))), {"cut2.ply"});
  std::string out_of_range = binary;
  out_of_range[out_of_range.size() - 4] = 9;  // last corner of the last face
  expect_error<InvalidInput>(mesh(write_text("far.ply", out_of_range)), {"far.ply", "cannot be used"});
  const double nan = std::nan("");
  std::string bad = binary;
  std::memcpy(bad.data() + bad.find("end_header\n") + 11 + 5 * 8, &nan, 8);
  expect_error<InvalidInput>(mesh(write_text("nan.ply", bad)), {"nan.ply", "not finite"});
}

// Map coordinates are large: in 24 bits 5,000 km are known to half a metre only.
TEST_F(MeshInput, KeepsDoublePrecision) {
  const std::string vertices =
      "5000000.125 300000 1.0000001\n5000001.125 300000 2\n5000001.125 300001 4\n5000000.125 300001 3\n";
  const Terrain ply =
      load_terrain(mesh(write_text("far.ply", std::string(kPlyHead) + vertices + "3 0 1 2\n3 0 2 3\n")));
  EXPECT_DOUBLE_EQ(ply.width_m(), 1);
  EXPECT_DOUBLE_EQ(ply.true_elevation_m(0, 0), 1.0000001);
  const Terrain obj =
      load_terrain(mesh(write_text("far.obj",
                                   "v 5000000.125 300000 1.0000001\nv 5000001.125 300000 2\n"
                                   "v 5000001.125 300001 4\nv 5000000.125 300001 3\nf 1 2 3\nf 1 3 4\n")));
  EXPECT_DOUBLE_EQ(obj.width_m(), 1);
  EXPECT_DOUBLE_EQ(obj.true_elevation_m(0, 0), 1.0000001);
}

TEST_F(MeshInput, BigEndianPly) {
  std::string file(kPlyHead);
  file.replace(file.find("ascii"), 5, "binary_big_endian");
  const auto append = [&](const auto& value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    file.append(bytes.rbegin(), bytes.rend());
  };
  for (const double v : {0., 0., 1., 1., 0., 2., 1., 1., 4., 0., 1., 3.}) append(v);
  for (const auto& f : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
    file.push_back(3);
    for (const int v : f) append(v);
  }
  EXPECT_NEAR(load_terrain(mesh(write_text("big.ply", file))).true_elevation_m(0.5, 0.5), 2.5, 1e-12);
}

TEST_F(MeshInput, MissingFileAndUnknownKind) {
  expect_error<IoFailure>(mesh(path("nowhere.obj")), {"terrain.mesh", "nowhere.obj", "does not exist"});
  expect_error<InvalidInput>(mesh(write_text("hill.stl", "solid")), {"hill.stl", ".obj"});
}

TEST_F(MeshInput, UnreadableText) {
  expect_error<IoFailure>(mesh(write_text("a.obj", "hello")), {"a.obj"});
  expect_error<IoFailure>(mesh(write_text("b.obj", "")), {"b.obj"});
  expect_error<IoFailure>(mesh(write_text("c.obj", "v 0 0 0\nv 1 x 0\n")), {"c.obj:2", "'x'"});
  expect_error<IoFailure>(mesh(write_text("d.ply", "hello")), {"d.ply:1"});
  expect_error<IoFailure>(mesh(write_text("e.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\n")),
                          {"e.ply:3"});
}

TEST_F(MeshInput, CutOff) {
  const std::string whole = obj(6, 6);
  const std::size_t faces = whole.find("f ");
  expect_error<IoFailure>(mesh(write_text("a.obj", whole.substr(0, faces / 2))), {"a.obj"});
  expect_error<IoFailure>(mesh(write_text("b.obj", whole.substr(0, whole.rfind(' ')))), {"b.obj", "cut off"});
  // Cut between two lines the file still reads well, but ground is missing.
  expect_error<InvalidInput>(mesh(write_text("c.obj", whole.substr(0, whole.rfind("f ")))),
                             {"c.obj", "covers only"});
  const std::string head(kPlyHead);
  expect_error<IoFailure>(mesh(write_text("d.ply", head.substr(0, 60))), {"d.ply", "cut off"});
  expect_error<IoFailure>(mesh(write_text("e.ply", head + "0 0 1\n1 0")), {"e.ply:12", "cut off"});
  expect_error<IoFailure>(mesh(write_text("f.ply", head + kPlyVertices + "3 0 1 2\n")),
                          {"f.ply", "1 of 2", "face"});
  expect_error<IoFailure>(mesh(write_text("g.ply", head + kPlyVertices + "3 0 1 2\n3 0 2")), {"g.ply:16"});
}

TEST_F(MeshInput, NotFinite) {
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 nan\nf 1 2 3\n", {"bad.obj:3", "finite"});
  expect_invalid("v 0 0 0\nv 1 0 inf\nv 1 1 0\nf 1 2 3\n", {"bad.obj:2", "finite"});
  expect_error<InvalidInput>(
      mesh(write_text("a.ply", std::string(kPlyHead) + "0 0 1\n1 0 nan\n1 1 4\n0 1 3\n3 0 1 2\n3 0 2 3\n")),
      {"a.ply:12", "finite"});
}

TEST_F(MeshInput, VertexNumbersOutOfRange) {
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", {"bad.obj:4", "vertex 4", "3 vertices"});
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 2 3\n", {"bad.obj:4", "vertex 0"});
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -4 -2 -1\n", {"bad.obj:4", "vertex -4"});
  expect_error<InvalidInput>(
      mesh(write_text("a.ply", std::string(kPlyHead) + kPlyVertices + "3 0 1 2\n3 0 2 4\n")),
      {"a.ply:16", "vertex 4"});
  expect_error<InvalidInput>(
      mesh(write_text("b.ply", std::string(kPlyHead) + kPlyVertices + "3 0 1 2\n3 0 2 -1\n")),
      {"b.ply:16", "vertex -1"});
}

TEST_F(MeshInput, NotManifold) {
  // Three faces at one edge.
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 -1 0\nf 1 2 3\nf 2 1 5\nf 1 2 4\n",
                 {"not manifold"});
  // Neighbours turned against each other.
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n", {"not manifold"});
  expect_invalid("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 3\n", {"bad.obj:6", "vertex 3 twice"});
}

TEST_F(MeshInput, NoHeightField) {
  // A fold: the middle strip runs back below the first.
  expect_invalid(
      "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nv 3 0 -2\nv 3 1 -2\n"
      "f 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\nf 5 7 8\nf 5 8 6\n",
      {"no height field", "overhanging"});
  // A step with a vertical wall.
  expect_invalid(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 1\nv 1 1 1\nv 2 0 1\nv 2 1 1\n"
      "f 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\nf 5 7 8\nf 5 8 6\n",
      {"no height field", "vertical"});
  // Two sheets, both facing up.
  expect_invalid(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.2 0.2 1\nv 0.8 0.2 1\nv 0.5 0.8 1\nf 1 2 3\nf 1 3 4\nf 5 6 "
      "7\n",
      {"no height field", "overhangs"});
}

TEST_F(MeshInput, HolesAndNoArea) {
  expect_invalid(obj(5, 5, true, 17), {"covers only 98.0000 %"});
  expect_invalid("v 0 0 0\nv 0 1 0\nv 0 1 1\nf 1 2 3\n", {"no area"});
  TerrainOptions around_the_hole = mesh(write_text("hole.obj", obj(5, 5, true, 0)));
  around_the_hole.crop[0] = 0.3;
  EXPECT_NEAR(load_terrain(around_the_hole).width_m(), 3.5, 1e-12);
}

TEST_F(MeshInput, NothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  const std::string file = write_text("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n");
  EXPECT_THROW(load_terrain(mesh(file)), InvalidInput);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace witherfield::terrain::test
