// Mesh files: what is written reads back, by ourselves, by OpenMesh and by VTK's Python module.
#include "vis/mesh_files.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "tests/vis/mesh_sample.hpp"
#include "tests/vis/sample.hpp"
#include "vis/block_codec.hpp"
#include "vis/info.hpp"

namespace witherfield::vis {
namespace {

float mm(double metres) {
  return float(metres * 1e3);
}

/// Float32 millimetres as they come back in metres.
void expect_positions_as_float(const Surface& got, const Surface& want) {
  ASSERT_EQ(got.position_m.size(), want.position_m.size());
  for (std::size_t i = 0; i < want.position_m.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_EQ(mm(got.position_m[i][c]), mm(want.position_m[i][c])) << i;
}

template <class Vector>
void expect_as_float(const std::vector<Vector>& got, const std::vector<Vector>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < Vector::length(); ++c) ASSERT_EQ(float(got[i][c]), float(want[i][c])) << i;
}

TEST(MeshFiles, ObjGivesBackTheSameBits) {
  const sample::Folder folder;
  Surface s = sample::sheet(9);
  s.position_m[3] = {1e-320, -1.7e300, 0.1};  // exponents at the ends
  s.position_m[4] = {-0.0, 1.0, 123456789.125};
  write_obj(folder / "a.obj", s);
  const MeshFile back = read_mesh_file(folder / "a.obj");
  EXPECT_EQ(back.length_unit, "mm");
  EXPECT_EQ(back.surface.position_m, s.position_m);
  EXPECT_EQ(back.surface.triangles, s.triangles);
  EXPECT_EQ(back.surface.uv, s.uv);
  expect_as_float(back.surface.normal, s.normal);
  const std::string text = sample::content(folder / "a.obj");
  EXPECT_NE(text.find("# length_unit mm\n"), std::string::npos);
  EXPECT_NE(text.find("\nv -0 1000 123456789125\n"), std::string::npos);
}

TEST(MeshFiles, PlyGivesBackEverythingAsFloat) {
  const sample::Folder folder;
  const Surface s = sample::sheet(9);
  write_ply(folder / "a.ply", s);
  const MeshFile back = read_mesh_file(folder / "a.ply");
  EXPECT_EQ(back.length_unit, "mm");
  expect_positions_as_float(back.surface, s);
  EXPECT_EQ(back.surface.triangles, s.triangles);
  expect_as_float(back.surface.uv, s.uv);
  expect_as_float(back.surface.normal, s.normal);
  ASSERT_EQ(back.surface.fields.size(), s.fields.size());
  for (const SurfaceField& f : s.fields) {
    EXPECT_EQ(back.surface.field(f.name).values, f.values) << f.name;
    EXPECT_EQ(back.surface.field(f.name).on_faces, f.on_faces) << f.name;
  }
}

TEST(MeshFiles, WrittenAgainTheFilesAreTheSame) {
  const sample::Folder folder;
  for (const auto* name : {"a.obj", "a.ply"}) {
    const auto write = std::string(name) == "a.obj" ? write_obj : write_ply;
    write(folder / name, sample::sheet(5));
    const std::string once = sample::content(folder / name);
    write(folder / name, read_mesh(folder / name));
    EXPECT_EQ(sample::content(folder / name), once) << name;
  }
}

TEST(MeshFiles, VtpGivesBackEverythingAsDeclared) {
  const sample::Folder folder;
  const Surface s = sample::sheet(9);
  for (const Compression compression : {Compression::lz4, Compression::zlib})
    for (const std::string unit : {"mm", "m"}) {
      const ValueRanges ranges = write_surface_vtp(folder / "a.vtp", s, {12, 0.4}, unit, compression);
      const MeshFile back = read_mesh_file(folder / "a.vtp");
      EXPECT_EQ(back.length_unit, unit);
      if (unit == "mm")
        expect_positions_as_float(back.surface, s);
      else
        expect_as_float(back.surface.position_m, s.position_m);
      EXPECT_EQ(back.surface.triangles, s.triangles);
      expect_as_float(back.surface.uv, s.uv);
      for (std::size_t i = 0; i < s.normal.size(); ++i)
        EXPECT_LT(glm::length(back.surface.normal[i] - s.normal[i]), 1e-3);
      ASSERT_EQ(back.surface.fields.size(), s.fields.size());
      for (const SurfaceField& f : s.fields) {
        const SurfaceField& got = back.surface.field(f.name);
        EXPECT_EQ(got.on_faces, f.on_faces);
        ASSERT_EQ(got.values.size(), f.values.size());
        const bool label = f.name == "organ_id" || f.name == "kernel_id";
        for (std::size_t k = 0; k < f.values.size(); ++k) {
          EXPECT_EQ(got.values[k], label ? f.values[k] : round_mantissa(f.values[k])) << f.name;
          EXPECT_GE(got.values[k], ranges.at(f.name).lo);
          EXPECT_LE(got.values[k], ranges.at(f.name).hi);
        }
      }
      EXPECT_EQ(ranges.size(), s.fields.size() + 2);  // and normal, uv
      EXPECT_EQ(ranges.at("kernel_id").hi, double(s.triangles.size()) - 2);
    }
}

TEST(MeshFiles, VtpHasTheAttributesThatParaViewLooksFor) {
  const sample::Folder folder;
  write_surface_vtp(folder / "a.vtp", sample::sheet(4), {12.5, 0.4});
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "a.vtp").c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  ASSERT_TRUE(data.GetPointData()->GetNormals());
  EXPECT_STREQ(data.GetPointData()->GetNormals()->GetName(), "normal");
  ASSERT_TRUE(data.GetPointData()->GetTCoords());
  EXPECT_EQ(data.GetPointData()->GetTCoords()->GetNumberOfComponents(), 2);
  EXPECT_EQ(data.GetCellData()->GetArray("kernel_id")->GetDataType(), VTK_INT);
  const FileInfo info = file_info(folder / "a.vtp");
  EXPECT_EQ(info.type, "mesh");
  EXPECT_EQ(info.length_unit, "mm");
  EXPECT_EQ(info.time_days, 12.5);
  for (const ArrayInfo& a : info.arrays) {
    EXPECT_EQ(a.components, field_spec(a.name).components) << a.name;
    EXPECT_EQ(a.unit, field_spec(a.name).unit) << a.name;
  }
}

TEST(MeshFiles, WithoutNormalsTheyAreComputed) {
  const sample::Folder folder;
  Surface s = sample::sheet(6);
  s.normal.clear();
  s.uv.clear();
  s.fields.clear();
  write_obj(folder / "a.obj", s);
  write_ply(folder / "a.ply", s);
  write_surface_vtp(folder / "a.vtp", s, {});
  for (const auto* name : {"a.obj", "a.ply", "a.vtp"}) {
    const Surface back = read_mesh(folder / name);
    ASSERT_EQ(back.normal.size(), s.position_m.size()) << name;
    const auto want = vertex_normals(s);
    for (std::size_t i = 0; i < want.size(); ++i)
      EXPECT_LT(glm::length(back.normal[i] - want[i]), 1e-3) << name;
    EXPECT_TRUE(back.uv.empty());
    EXPECT_TRUE(back.fields.empty()) << name;
  }
}

TEST(MeshFiles, OpenMeshReadsTheSame) {
  const sample::Folder folder;
  const Surface s = sample::sheet(7);
  write_obj(folder / "a.obj", s);
  write_ply(folder / "a.ply", s);
  for (const auto* name : {"a.obj", "a.ply"}) {
    TriMesh mesh;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, (folder / name).string())) << name;
    const Surface back = to_surface(mesh);
    ASSERT_EQ(back.position_m.size(), s.position_m.size());
    ASSERT_EQ(back.triangles.size(), s.triangles.size());
    for (std::size_t i = 0; i < s.position_m.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(float(back.position_m[i][c]), mm(s.position_m[i][c])) << name;
    for (std::size_t f = 0; f < s.triangles.size(); ++f) {
      auto t = back.triangles[f];
      std::rotate(t.begin(), std::find(t.begin(), t.end(), s.triangles[f][0]), t.end());
      EXPECT_EQ(t, s.triangles[f]) << name;
    }
  }
}

TEST(MeshFiles, VtkInPythonReadsTheSame) {
  if (std::system(WITHERFIELD_VTK_PYTHON " -c 'import vtkmodules.vtkIOGeometry, numpy' > /dev/null 2>&1") !=
      0)
    GTEST_SKIP() << "VTK's Python module is not installed";
  const sample::Folder folder;
  const Surface s = sample::sheet(7);
  write_obj(folder / "a.obj", s);
  write_ply(folder / "a.ply", s);
  write_surface_vtp(folder / "a.vtp", s, {12.5, 0.4});
  nlohmann::json want;
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      want["positions"].push_back(mm(s.position_m[i][c]));
      want["normals"].push_back(s.normal[i][c]);
      if (c < 2) want["uv"].push_back(s.uv[i][c]);
    }
  for (const auto& t : s.triangles)
    for (const int v : t) want["triangles"].push_back(v);
  for (const SurfaceField& f : s.fields) want["fields"][f.name] = f.values;
  std::ofstream(folder / "expected.json") << want;
  const std::string command =
      std::string(WITHERFIELD_VTK_PYTHON " " WITHERFIELD_TEST_SOURCES "/read_mesh_back.py ") +
      folder.path().string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(MeshFiles, WritersLeaveNothingOnAFullDevice) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Surface s = sample::sheet(40);
  using Write = std::function<void(const std::filesystem::path&)>;
  for (const auto& [name, write] : std::vector<std::pair<std::string, Write>>{
           {"a.obj", [&](const auto& f) { write_obj(f, s); }},
           {"a.ply", [&](const auto& f) { write_ply(f, s); }},
           {"a.vtp", [&](const auto& f) { write_surface_vtp(f, s, {}); }}}) {
    const sample::Folder folder;
    std::filesystem::create_symlink("/dev/full", folder / (name + ".part"));
    EXPECT_THROW(write(folder / name), IoFailure) << name;
    EXPECT_TRUE(folder.names().empty()) << name;
  }
}

TEST(MeshFiles, WhatIsNotASurfaceIsNotWritten) {
  const sample::Folder folder;
  Surface s = sample::sheet(2);
  s.uv.pop_back();
  EXPECT_THROW(write_ply(folder / "a.ply", s), InvalidInput);
  s = sample::sheet(2);
  s.triangles[0][1] = 99;
  EXPECT_THROW(write_obj(folder / "a.obj", s), InvalidInput);
  EXPECT_THROW(write_surface_vtp(folder / "a.vtp", s, {}), InvalidInput);
  EXPECT_THROW(write_surface_vtp(folder / "a.vtp", sample::sheet(2), {}, "inch"), InvalidInput);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace witherfield::vis
