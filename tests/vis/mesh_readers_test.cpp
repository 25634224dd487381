// Mesh files from elsewhere: every dialect means the same mesh; what is broken is named, and nothing crashes.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include "sim/core/errors.hpp"
#include "tests/vis/mesh_sample.hpp"
#include "tests/vis/sample.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::vis {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

MeshFile read_text(const sample::Folder& folder, const std::string& name, const std::string& content) {
  std::ofstream(folder / name, std::ios::binary) << content;
  return read_mesh_file(folder / name);
}

std::string failure(const sample::Folder& folder, const std::string& name, const std::string& content) {
  try {
    read_text(folder, name, content);
  } catch (const InvalidInput& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find((folder / name).string()), std::string::npos) << message;
    return message;
  }
  return "it was read";
}

// A house: four walls of a unit square, a quad floor, a roof of four triangles about the top.
const std::vector<glm::dvec3> kHouse{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}};
const Triangles kHouseTriangles{{3, 2, 1}, {3, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

TEST(MeshReaders, ObjPolygonsAreFansAndIndicesMayBeNegative) {
  const sample::Folder folder;
  const MeshFile m =
      read_text(folder, "a.OBJ",
                "# made elsewhere\r\nmtllib a.mtl\r\no house\r\nv 0 0 0\r\nv +1 0 0 1.0\r\nv 1 1 0\r\n"
                "v 0 1 0 0.1 0.2 0.3\r\ng roof\r\nusemtl wood\r\ns off\r\n"
                "v 5e-1 .5 7.5E-1\r\n\r\nf 4// 3// 2// \\\r\n 1//\r\nf -5 2 5 # front\r\n"
                "f 2 -3 -1\r\nf 3 4 5\r\nf 4 1 5\r\nl 1 2\r\n");
  EXPECT_EQ(m.length_unit, "");
  EXPECT_EQ(m.surface.position_m, kHouse);
  EXPECT_EQ(m.surface.triangles, kHouseTriangles);
  EXPECT_TRUE(m.surface.uv.empty());
}

TEST(MeshReaders, ObjFacesMayStandBeforeTheirVertices) {
  const sample::Folder folder;
  const MeshFile m = read_text(folder, "a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(m.surface.triangles, (Triangles{{0, 1, 2}}));
}

TEST(MeshReaders, ObjTextureCoordinatesOnlyWhenEveryVertexHasOne) {
  const sample::Folder folder;
  const std::string head =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0\nvt 0 0\n";
  const MeshFile single =
      read_text(folder, "a.obj", head + "f 1/1 2/2 3/3\nf 1/6 3/3 4/4\n");  // 6 is equal to 1
  EXPECT_EQ(single.surface.uv, (std::vector<glm::dvec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const MeshFile seam = read_text(folder, "a.obj", head + "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n");
  EXPECT_TRUE(seam.surface.uv.empty());
  EXPECT_EQ(seam.surface.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(read_text(folder, "a.obj", head + "f 1/1 2/2 3/3\nf 1 3 4\n").surface.uv.empty());
}

// ---- PLY in its three encodings

template <class T>
void put(std::string& bytes, T value, bool big) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

std::string house_ply(const std::string& format) {
  std::string text =
      "ply\nformat " + format +
      " 1.0\ncomment made elsewhere\nobj_info 1\nelement camera 1\nproperty short id\n"
      "property list uchar int marks\nelement vertex 5\nproperty double x\nproperty float y\n"
      "property float32 z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property list uint8 float extra\nproperty float water\nelement face 5\nproperty int kernel_id\n"
      "property list uchar uint vertex_index\nend_header\n";
  const std::vector<std::vector<int>> faces{{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const bool big = format == "binary_big_endian";
  if (format == "ascii") {
    text += "7 2 5 6\n";
    for (const auto& p : kHouse)
      text += std::to_string(p.x) + " " + std::to_string(p.y) + "  " + std::to_string(p.z) +
              " 255 0 188 1 0.5 0.25\n";
    for (std::size_t f = 0; f < faces.size(); ++f) {
      text += std::to_string(10 + f) + " " + std::to_string(faces[f].size());
      for (const int v : faces[f]) text.append(" ").append(std::to_string(v));
      text += "\n";
    }
    return text;
  }
  put(text, std::int16_t(7), big);
  put(text, std::uint8_t(2), big);
  put(text, std::int32_t(5), big);
  put(text, std::int32_t(6), big);
  for (const auto& p : kHouse) {
    put(text, double(p.x), big);
    put(text, float(p.y), big);
    put(text, float(p.z), big);
    for (const int c : {255, 0, 188}) put(text, std::uint8_t(c), big);
    put(text, std::uint8_t(1), big);
    put(text, 0.5f, big);
    put(text, 0.25f, big);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    put(text, std::int32_t(10 + f), big);
    put(text, std::uint8_t(faces[f].size()), big);
    for (const int v : faces[f]) put(text, std::uint32_t(v), big);
  }
  return text;
}

TEST(MeshReaders, PlyMeansTheSameInAllEncodings) {
  const sample::Folder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Surface s = read_text(folder, "a.ply", house_ply(format)).surface;
    EXPECT_EQ(s.position_m, kHouse) << format;
    EXPECT_EQ(s.triangles, kHouseTriangles) << format;
    EXPECT_EQ(s.field("water").values, std::vector<float>(5, 0.25f)) << format;
    EXPECT_EQ(s.field("kernel_id").values, (std::vector<float>{10, 10, 11, 12, 13, 14})) << format;
    EXPECT_EQ(s.field("diffuse").values[0], 1);
    EXPECT_EQ(s.field("diffuse").values[1], 0);
    EXPECT_NEAR(s.field("diffuse").values[2], 0.5, 0.003);  // 188 is encoded half
  }
}

TEST(MeshReaders, Off) {
  const sample::Folder folder;
  const Surface s = read_text(folder, "a.off",
                              "# a house\nOFF # text\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n\n0 1 0\n0.5 0.5 0.75\n"
                              "4 3 2 1 0 255 0 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4")
                        .surface;
  EXPECT_EQ(s.position_m, kHouse);
  EXPECT_EQ(s.triangles, kHouseTriangles);
  EXPECT_EQ(read_text(folder, "b.off", "COFF 3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n")
                .surface.triangles,
            (Triangles{{0, 1, 2}}));
}

std::string house_stl(bool text) {
  std::string out = text ? "solid house\n" : std::string("solid but binary");
  if (!text) {
    out.resize(80, ' ');
    put(out, std::uint32_t(kHouseTriangles.size()), false);
  }
  for (const auto& t : kHouseTriangles) {
    if (text)
      out += " facet normal 0 0 0\n  outer loop\n";
    else
      out.append(12, '\0');
    for (const int v : t)
      for (int c = 0; c < 3; ++c) {
        const double x = kHouse[std::size_t(v)][c] == 0 && v % 2 ? -0.0 : kHouse[std::size_t(v)][c];
        if (text)
          out += (c == 0 ? "   vertex " : " ") + std::to_string(x) + (c == 2 ? "\n" : "");
        else
          put(out, float(x), false);
      }
    if (text)
      out += "  endloop\n endfacet\n";
    else
      out.append(2, '\0');
  }
  return text ? out + "endsolid house\n" : out;
}

TEST(MeshReaders, StlCornersAreJoined) {
  const sample::Folder folder;
  for (const bool text : {true, false}) {
    const Surface s = read_text(folder, "a.stl", house_stl(text)).surface;
    ASSERT_EQ(s.position_m.size(), 5u) << text;
    ASSERT_EQ(s.triangles.size(), 6u);
    for (std::size_t f = 0; f < 6; ++f)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(s.position_m[std::size_t(s.triangles[f][k])], kHouse[std::size_t(kHouseTriangles[f][k])]);
  }
}

TEST(MeshReaders, VtpOfOthersWithVerticesQuadsAndStrips) {
  const sample::Folder folder;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  for (const auto& p : kHouse) points->InsertNextPoint(p.x, p.y, p.z);
  data->SetPoints(points);
  vtkNew<vtkCellArray> verts, polys, strips;
  verts->InsertNextCell({vtkIdType(2)});
  polys->InsertNextCell({3, 2, 1, 0});
  polys->InsertNextCell({0, 1, 4});
  strips->InsertNextCell({1, 2, 4, 3});
  data->SetVerts(verts);
  data->SetPolys(polys);
  data->SetStrips(strips);
  vtkNew<vtkFloatArray> kernel, odd;
  kernel->SetName("kernel_id");
  for (const float x : {5.f, 6.f, 7.f, 8.f}) kernel->InsertNextValue(x);
  data->GetCellData()->AddArray(kernel);
  odd->SetName("somebody else's");
  for (int i = 0; i < 5; ++i) odd->InsertNextValue(1);
  data->GetPointData()->AddArray(odd);
  for (const bool text : {true, false}) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    text ? writer->SetDataModeToAscii() : writer->SetDataModeToAppended();
    writer->SetInputData(data);
    writer->SetFileName((folder / "a.vtp").c_str());
    writer->Write();
    const Surface s = read_mesh(folder / "a.vtp");
    EXPECT_EQ(s.triangles, (Triangles{{3, 2, 1}, {3, 1, 0}, {0, 1, 4}, {1, 2, 4}, {4, 2, 3}}));
    ASSERT_EQ(s.fields.size(), 1u);
    EXPECT_EQ(s.field("kernel_id").values, (std::vector<float>{6, 6, 7, 8, 8}));
  }
}

// ---- broken files

struct Broken {
  const char* name;
  std::string content;
  std::vector<const char*> says;
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::vector<Broken> broken_files() {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ply = house_ply("ascii");
  return {
      {"empty.obj", "", {"empty"}},
      {"empty.vtp", "", {"empty"}},
      {"a.obj", obj + "f 1 2 4\n", {"line 4", "vertex index 4", "there are 3"}},
      {"a.obj", obj + "f 1 2 -4\n", {"line 4", "vertex index -4"}},
      {"a.obj", obj + "f 1 2 0\n", {"line 4", "'0'"}},
      {"a.obj", obj + "f 1 2 99999999999\n", {"line 4", "out of range"}},
      {"a.obj", obj + "f 1 2 x\n", {"line 4", "'x'"}},
      {"a.obj", obj + "f 1/1 2/1 3/1\n", {"line 4", "texture index 1", "there are 0"}},
      {"a.obj", obj + "f 1 2\n", {"line 4", "2 corners"}},
      {"a.obj", obj, {"no faces"}},
      {"a.obj", "v 0 0\n", {"line 1", "coordinate is expected"}},
      {"a.obj", "v 0 nan 0\n", {"line 1", "'nan' is not finite"}},
      {"a.obj", "v 0 0 1e999\n", {"line 1", "'1e999' is not finite"}},
      {"a.obj", "v 0 0 1,5\n", {"line 1", "'1,5' is not a number"}},
      {"a.obj", "hello world\n", {"line 1", "'hello' is no statement"}},
      {"a.obj",
       std::string("\x7f"
                   "ELF\x01\x02\0\0",
                   8),
       {"no statement"}},
      {"a.obj", "# only a comment\n", {"no vertices"}},
      {"a.ply", "plain\n", {"not a PLY file"}},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 5\n", {"end_header", "truncated"}},
      {"a.ply", replaced(ply, "format ascii", "format morse"), {"line 2", "'morse'"}},
      {"a.ply", replaced(ply, "property double x", "property quad x"), {"line 9", "'quad'"}},
      {"a.ply", replaced(ply, "property double x", "property double q"), {"no x, y and z"}},
      {"a.ply", replaced(ply, "vertex_index", "corners"), {"vertex_indices"}},
      {"a.ply", replaced(ply, "element vertex 5", "element vertex 4000000000"), {"4000000000", "room"}},
      {"a.ply", replaced(ply, "element vertex 5", "element vertex -5"), {"line 8", "-5"}},
      {"a.ply", replaced(ply, "element face 5", "element face 6"), {"ends after line 31", "face 5"}},
      {"a.ply", replaced(ply, "4 3 2 1 0\n", "4 3 2 1 5\n"), {"face 0", "vertex index 5", "there are 5"}},
      {"a.ply", replaced(ply, "4 3 2 1 0\n", "4 3 2 1 -1\n"), {"line 27", "face 0", "-1"}},
      {"a.ply", replaced(ply, "4 3 2 1 0\n", "2 3 2\n"), {"line 27", "2 corners"}},
      {"a.ply", replaced(ply, "0.750000", "inf"), {"line 26", "vertex 4", "z = inf"}},
      {"a.ply", house_ply("binary_big_endian").substr(0, 600), {"ends at byte 600", "truncated"}},
      {"a.off", "OF\n", {"not an OFF file", "'OF'"}},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", {"ends after line 4", "vertex 2"}},
      {"a.off",
       "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       {"line 6", "vertex index 3 of face 0", "there are 3"}},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", {"line 6", "2 corners"}},
      {"a.off", "OFF\n3 99999999999 0\n", {"line 2", "99999999999"}},
      {"a.off", "OFF BINARY\n", {"binary OFF"}},
      {"a.stl", "solid", {"not an STL file"}},
      {"a.stl", house_stl(false).substr(0, 200), {"truncated", "6 facets need 384 bytes", "200"}},
      {"a.stl",
       replaced(house_stl(true), "endloop", "vertex 1 2 3"),
       {"line 7", "'vertex' instead of 'endloop'"}},
      {"a.stl", replaced(house_stl(true), "0.750000", "inf"), {"'inf' is not finite"}},
      {"a.stl", house_stl(true).substr(0, 253), {"file ends after line"}},
      {"a.vtp", "<VTKFile type=\"PolyData\"><PolyData>", {"damaged"}},
      {"a.vtp", "hello", {"not a VTK XML file"}},
      {"a.gltf", "{}", {".obj, .ply, .off, .stl or .vtp"}},
  };
}

TEST(MeshReaders, BrokenFilesAreNamedWithPlaceAndFault) {
  const sample::Folder folder;
  for (const Broken& b : broken_files()) {
    const std::string message = failure(folder, b.name, b.content);
    for (const char* text : b.says)
      EXPECT_NE(message.find(text), std::string::npos) << message << "\n  must say: " << text;
  }
}

TEST(MeshReaders, BinaryNanNamesItsPlace) {
  const sample::Folder folder;
  std::string stl = house_stl(false);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(stl.data() + 84 + 2 * 50 + 12 + 12, &nan, 4);
  EXPECT_NE(failure(folder, "a.stl", stl).find("facet 2"), std::string::npos);
  std::string ply = house_ply("binary_little_endian");
  const auto body = ply.find("end_header\n") + 11 + 11;  // after the camera
  std::memcpy(ply.data() + body + 8, &nan, 4);
  EXPECT_NE(failure(folder, "a.ply", ply).find("vertex 0: y = nan"), std::string::npos);
}

TEST(MeshReaders, VtpIndicesAreChecked) {
  const sample::Folder folder;
  const auto vtp = [](const char* corners, const char* offsets, const char* x) {
    return std::string(
               "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"3\" "
               "NumberOfPolys=\"1\">"
               "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 "
               "0 ") +
           x +
           " 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" +
           corners + "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" + offsets +
           "</DataArray></Polys></Piece></PolyData></VTKFile>";
  };
  EXPECT_EQ(read_text(folder, "a.vtp", vtp("0 1 2", "3", "1")).surface.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1 3", "3", "1")).find("names point 3, there are 3"),
            std::string::npos);
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1 -1", "3", "1")).find("names point -1"), std::string::npos);
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1 2", "7", "1")).find("a.vtp"), std::string::npos);
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1 2", "-3", "1")).find("a.vtp"), std::string::npos);
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1", "2", "1")).find("no faces"), std::string::npos);
  EXPECT_NE(failure(folder, "a.vtp", vtp("0 1 2", "3", "nan")).find("point 2"), std::string::npos);
}

TEST(MeshReaders, AbsentFilesAndFolders) {
  const sample::Folder folder;
  for (const auto* name : {"none.obj", "none.vtp", "none.stl"})
    EXPECT_THROW(read_mesh(folder / name), IoFailure);
  std::filesystem::create_directory(folder / "folder.ply");
  EXPECT_THROW(read_mesh(folder / "folder.ply"), IoFailure);
}

/// Reads what may be damaged: a mesh whose indices are good, or an Error; anything else fails the test.
void read_or_refuse(const sample::Folder& folder, const std::string& name, const std::string& content) {
  try {
    read_text(folder, name, content).surface.validate();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
  }
}

TEST(MeshReaders, DamageAnywhereNeverCrashes) {
  const sample::Folder folder;
  write_obj(folder / "a.obj", sample::sheet(2));
  write_ply(folder / "a.ply", sample::sheet(2));
  const std::vector<std::pair<std::string, std::string>> good{
      {"a.obj", sample::content(folder / "a.obj")},
      {"a.ply", sample::content(folder / "a.ply")},
      {"b.ply", house_ply("ascii")},
      {"c.ply", house_ply("binary_big_endian")},
      {"a.stl", house_stl(true)},
      {"b.stl", house_stl(false)},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}};
  for (const auto& [name, content] : good) {
    for (std::size_t size = 1; size < content.size(); size += 17)
      read_or_refuse(folder, name, content.substr(0, size));
    Random random(3, Stream::test, 1);
    for (int k = 0; k < 120; ++k) {
      std::string bad = content;
      for (int flips = 0; flips < 3; ++flips) bad[random.bits() % bad.size()] = char(random.bits());
      read_or_refuse(folder, name, bad);
    }
  }
}

TEST(MeshReaders, TruncatedVtpIsRefused) {
  const sample::Folder folder;
  write_surface_vtp(folder / "a.vtp", sample::sheet(6), {});
  const std::string content = sample::content(folder / "a.vtp");
  for (std::size_t size = 1; size < content.size() - 60; size += content.size() / 40)
    EXPECT_NE(failure(folder, "a.vtp", content.substr(0, size)), "it was read") << size;
}

}  // namespace
}  // namespace witherfield::vis
