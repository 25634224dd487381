// Points, terrain and series files, read back with VTK.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <set>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "tests/vis/sample.hpp"
#include "vis/block_codec.hpp"
#include "vis/info.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  return reader->GetOutput();
}

TEST(CurvesVtp, PointsAndPolylinesReadBack) {
  const sample::Folder folder;
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0.01, 0, 0}, {0.02, 0.005, 0}, {0, 0, 0.03}};
  for (const Compression compression : {Compression::lz4, Compression::zlib}) {
    write_curves_vtp(folder / "c.vtp", points, {{0, 1, 2}, {3, 0}}, {2, 0.5}, compression);
    const auto data = read(folder / "c.vtp");
    ASSERT_EQ(data->GetNumberOfPoints(), 4);
    EXPECT_EQ(data->GetNumberOfVerts(), 4);
    ASSERT_EQ(data->GetNumberOfLines(), 2);
    EXPECT_NEAR(data->GetPoint(2)[1], 5, 1e-6);  // millimetres
    vtkNew<vtkIdList> ids;
    data->GetLines()->GetCellAtId(0, ids);
    ASSERT_EQ(ids->GetNumberOfIds(), 3);
    EXPECT_EQ(ids->GetId(2), 2);
    data->GetLines()->GetCellAtId(1, ids);
    EXPECT_EQ(ids->GetId(0), 3);
  }
  EXPECT_THROW(write_curves_vtp(folder / "d.vtp", points, {{0, 4}}, {}), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(folder / "d.vtp"));
}

TEST(PointsVtp, EveryPointReadsBack) {
  const sample::Folder folder;
  const PointSet points = sample::points(sample::texel(64, 12, 0.4));
  for (const Compression compression : {Compression::lz4, Compression::zlib}) {
    const ValueRanges ranges = write_points_vtp(folder / "p.vtp", points, {12, 0.4}, compression);
    const auto data = read(folder / "p.vtp");
    const auto n = static_cast<vtkIdType>(points.size());
    ASSERT_EQ(data->GetNumberOfPoints(), n);
    ASSERT_EQ(data->GetNumberOfVerts(), n);
    const auto array = [&](const char* name) {
      vtkDataArray* a = data->GetPointData()->GetArray(name);
      EXPECT_TRUE(a) << name;
      return a;
    };
    for (vtkIdType i = 0; i < n; ++i) {
      const auto s = static_cast<std::size_t>(i);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(data->GetPoint(i)[c], points.position_m[s][c] * 1e3, 2e-5);  // a float's share of 0.2 m
        EXPECT_EQ(array("normal")->GetComponent(i, c), round_mantissa(points.normal[s][c]));
        EXPECT_EQ(array("tangent")->GetComponent(i, c), round_mantissa(points.tangent[s][c]));
        EXPECT_EQ(array("diffuse")->GetComponent(i, c), round_mantissa(points.diffuse[s][c]));
        EXPECT_EQ(array("velocity_m_s")->GetComponent(i, c), round_mantissa(points.velocity_m_s[s][c]));
      }
      EXPECT_EQ(array("blade_id")->GetComponent(i, 0), points.blade_id[s]);
      EXPECT_EQ(array("tissue")->GetComponent(i, 0), points.tissue[s]);
      EXPECT_EQ(array("water")->GetComponent(i, 0), round_mantissa(points.water[s]));
      EXPECT_EQ(array("chlorophyll_ug_cm2")->GetComponent(i, 0),
                round_mantissa(points.chlorophyll_ug_cm2[s]));
      EXPECT_EQ(array("stress_vein_MPa")->GetComponent(i, 0), round_mantissa(points.stress_vein_MPa[s]));
      EXPECT_EQ(array("stress_mesophyll_MPa")->GetComponent(i, 0),
                round_mantissa(points.stress_mesophyll_MPa[s]));
      EXPECT_EQ(array("strain_shrink")->GetComponent(i, 0), round_mantissa(points.strain_shrink[s]));
      EXPECT_EQ(array("specular")->GetComponent(i, 0), round_mantissa(points.specular[s]));
      EXPECT_NEAR(array("mass_kg")->GetComponent(i, 0) / points.mass_kg[s], 1, 0x1p-11 + 1e-7);
      EXPECT_NEAR(array("radius_m")->GetComponent(i, 0) / points.radius_m, 1, 0x1p-11 + 1e-7);
      vtkNew<vtkIdList> corner;
      data->GetCellPoints(i, corner);
      ASSERT_EQ(corner->GetNumberOfIds(), 1);
      EXPECT_EQ(corner->GetId(0), i);
    }
    EXPECT_EQ(ranges.size(), std::size_t(data->GetPointData()->GetNumberOfArrays()));
    for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i)
      EXPECT_NO_THROW(field_spec(data->GetPointData()->GetArrayName(i)));
  }
}

TEST(PointsVtp, DensityOfThePointsIsThatOfTheTexel) {
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(64, 12, 0.4);
  write_points_vtp(folder / "p.vtp", sample::points(grid), {});
  const auto data = read(folder / "p.vtp");
  double sum = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    sum += data->GetPointData()->GetArray("density")->GetComponent(i, 0);
  EXPECT_NEAR(sum / grid.total_density(), 1, 1e-4);  // each is rounded, without bias
}

TEST(PointsVtp, NoPointsIsAValidFile) {
  const sample::Folder folder;
  write_points_vtp(folder / "p.vtp", {}, {1, 0.5});
  EXPECT_EQ(read(folder / "p.vtp")->GetNumberOfPoints(), 0);
  EXPECT_EQ(file_info(folder / "p.vtp").type, "points");
}

TEST(PointsVtp, FieldOfAnotherSizeIsInvalid) {
  const sample::Folder folder;
  PointSet points = sample::points(sample::texel(32, 2, 0));
  points.water.pop_back();
  EXPECT_THROW(write_points_vtp(folder / "p.vtp", points, {}), InvalidInput);
  EXPECT_TRUE(folder.names().empty());
}

TEST(TerrainVtp, TrianglesKnowTheirTexel) {
  const sample::Folder folder;
  const sample::Hill hill = sample::hill(10);
  write_terrain_vtp(folder / "t.vtp", hill.mesh, hill.elevation_m, hill.placement);
  const auto data = read(folder / "t.vtp");
  ASSERT_EQ(data->GetNumberOfPoints(), 121);
  ASSERT_EQ(data->GetNumberOfPolys(), 200);
  double area = 0;
  for (vtkIdType f = 0; f < 200; ++f) {
    vtkNew<vtkIdList> corners;
    data->GetCellPoints(f, corners);
    double p[3][3], middle[2] = {0, 0};
    for (int c = 0; c < 3; ++c) {
      data->GetPoint(corners->GetId(c), p[c]);
      for (int a = 0; a < 2; ++a) middle[a] += p[c][a] / 3;
    }
    const double twice =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    EXPECT_GT(twice, 0);  // oriented up
    area += twice / 2;
    const int i = int(middle[0] / 2), j = int(middle[1] / 2);
    const TexelInstance& t = hill.placement.instances[std::size_t(j * 5 + i)];
    EXPECT_EQ(data->GetCellData()->GetArray("texel_id")->GetComponent(f, 0), t.variant);
    EXPECT_EQ(data->GetCellData()->GetArray("lod")->GetComponent(f, 0), t.lod);
    EXPECT_EQ(data->GetCellData()->GetArray("rotation")->GetComponent(f, 0),
              t.mirrored ? -1 - t.quarter_turns : t.quarter_turns);
  }
  EXPECT_NEAR(area, 100, 1e-4);
  for (vtkIdType v = 0; v < 121; ++v)
    EXPECT_EQ(data->GetPointData()->GetArray("elevation_m")->GetComponent(v, 0),
              float(hill.elevation_m[std::size_t(v)]));
  EXPECT_EQ(file_info(folder / "t.vtp").length_unit, "m");
}

TEST(TerrainVtp, TrianglesBesideThePlacementAreMarked) {
  const sample::Folder folder;
  sample::Hill hill = sample::hill(10);
  hill.placement.cells_y = 4;  // the last row of texels does not fit
  hill.placement.instances.resize(20);
  write_terrain_vtp(folder / "t.vtp", hill.mesh, hill.elevation_m, hill.placement);
  const auto data = read(folder / "t.vtp");
  int outside = 0;
  for (vtkIdType f = 0; f < 200; ++f)
    outside += data->GetCellData()->GetArray("texel_id")->GetComponent(f, 0) == -1;
  EXPECT_EQ(outside, 40);
}

TEST(TerrainVtp, ElevationsMustMatchTheVertices) {
  const sample::Folder folder;
  sample::Hill hill = sample::hill(4);
  hill.elevation_m.pop_back();
  EXPECT_THROW(write_terrain_vtp(folder / "t.vtp", hill.mesh, hill.elevation_m, hill.placement),
               InvalidInput);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Pvd, EntriesReadBack) {
  const sample::Folder folder;
  const std::vector<std::pair<double, std::string>> entries{
      {0, "texel/texel_0000.vti"}, {18.1, "texel/texel_0001.vti"}, {55.02, "a <odd> & \"quoted\" name.vti"}};
  write_pvd(folder / "grass.pvd", entries);
  const FileInfo info = file_info(folder / "grass.pvd");
  EXPECT_EQ(info.type, "series");
  EXPECT_EQ(info.series, entries);
}

}  // namespace
}  // namespace witherfield::vis
