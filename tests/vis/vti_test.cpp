// Texel -> .vti, read back with VTK's own reader and compared voxel by voxel with the grid.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/core/parallel.hpp"
#include "sim/core/random.hpp"
#include "tests/vis/sample.hpp"
#include "vis/block_codec.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

vtkSmartPointer<vtkImageData> read(const std::filesystem::path& file) {
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  return reader->GetOutput();
}

/// Voxels strewn over a grid that is no cube, some of them at its faces and corners.
TexelGrid strewn(double share) {
  GridShape shape;
  shape.nx = 16;
  shape.ny = 12;
  shape.nz = 20;
  shape.spacing_m = 0.0025;
  shape.origin_m = {-0.01, 0.02, 0};
  TexelGrid grid(shape);
  std::vector<int> all(std::size_t(grid.bricks_x()) * grid.bricks_y() * grid.bricks_z());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  std::erase_if(all, [](int cell) { return cell % 7 == 3; });  // some bricks are not there
  grid.reset_bricks(all);
  Random r(3, Stream::test, 0);
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const glm::ivec3 p = grid.brick_base(b) + glm::ivec3(v % 4, v / 4 % 4, v / 16);
      const bool corner = (p.x == 0 || p.x == 15) && (p.y == 0 || p.y == 11) && (p.z == 0 || p.z == 19);
      if (!corner && r.uniform() >= share) continue;
      for (int c = 0; c < kTexelChannels; ++c) grid.channel(b, TexelChannel(c))[v] = float(r.uniform(-2, 2));
      grid.channel(b, TexelChannel::density)[v] = float(1 + int(r.uniform(0, 40))) / 16;  // with ties
      grid.channel(b, TexelChannel::blade_id)[v] = std::floor(float(r.uniform(0, 9000)));
      grid.channel(b, TexelChannel::tissue)[v] = r.uniform() < 0.5 ? 1 : 2;
    }
  return grid;
}

/// The filled voxel that gives voxel p its attributes: itself, else the densest of the 26 around it. {-1, ..}
/// if none.
glm::ivec3 source_of(const TexelGrid& grid, glm::ivec3 p) {
  if (grid.at(p.x, p.y, p.z, TexelChannel::density) > 0) return p;
  glm::ivec3 best{-1};
  float most = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const float d = grid.at(p.x + dx, p.y + dy, p.z + dz, TexelChannel::density); d > most) {
          most = d;
          best = p + glm::ivec3(dx, dy, dz);
        }
  return best;
}

/// Compares all arrays of the file with the grid over the box.
void expect_same(const TexelGrid& grid, const VoxelBox& box, bool optics, vtkImageData& image) {
  int arrays = 0;
  for (const TexelField& f : texel_fields()) {
    if (f.optics != optics && f.first != TexelChannel::density) continue;
    ++arrays;
    vtkDataArray* array = image.GetPointData()->GetArray(std::string(f.name).c_str());
    ASSERT_TRUE(array) << f.name;
    ASSERT_EQ(array->GetDataType(), VTK_FLOAT) << f.name;
    ASSERT_EQ(array->GetNumberOfComponents(), f.components) << f.name;
    const bool label = f.name == "blade_id" || f.name == "tissue";
    vtkIdType n = 0;
    for (int k = box.lo.z; k < box.hi.z; ++k)
      for (int j = box.lo.y; j < box.hi.y; ++j)
        for (int i = box.lo.x; i < box.hi.x; ++i, ++n) {
          const glm::ivec3 from = f.name == "density" ? glm::ivec3(i, j, k) : source_of(grid, {i, j, k});
          for (int c = 0; c < f.components; ++c) {
            const auto channel = TexelChannel(int(f.first) + c);
            const float value = from.x < 0 ? 0.0f : grid.at(from.x, from.y, from.z, channel);
            ASSERT_EQ(float(array->GetComponent(n, c)), label ? value : round_mantissa(value))
                << f.name << " component " << c << " at " << i << ' ' << j << ' ' << k;
          }
        }
    ASSERT_EQ(n, array->GetNumberOfTuples());
  }
  EXPECT_EQ(image.GetPointData()->GetNumberOfArrays(), arrays);
}

TEST(RoundMantissa, KeepsTenBitsToNearestEven) {
  Random r(1, Stream::test, 1);
  for (int n = 0; n < 20000; ++n) {
    const float x = float(std::ldexp(r.uniform(-1, 1), int(r.uniform(-60, 60))));
    const float y = round_mantissa(x);
    EXPECT_LE(std::abs(double(y) - x), std::abs(double(x)) * 0x1p-11);
    std::uint32_t bits;
    std::memcpy(&bits, &y, 4);
    EXPECT_EQ(bits & 0x1FFFu, 0u);
    EXPECT_EQ(round_mantissa(y), y);
    EXPECT_EQ(round_mantissa(-x), -y);
  }
  EXPECT_EQ(round_mantissa(1 + 0x1p-11f), 1.0f);                  // a tie goes to the even neighbour:
  EXPECT_EQ(round_mantissa(1 + 3 * 0x1p-11f), 1 + 2 * 0x1p-10f);  // down here, up there
  EXPECT_EQ(round_mantissa(2 - 0x1p-20f), 2.0f);                  // carries into the exponent
  EXPECT_EQ(round_mantissa(2048 + 1), 2048.0f + 0.0f);            // why labels are not rounded
  EXPECT_EQ(round_mantissa(0.0f), 0.0f);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(round_mantissa(inf), inf);
  EXPECT_TRUE(std::isnan(round_mantissa(std::numeric_limits<float>::quiet_NaN())));
}

TEST(TexelVti, EveryVoxelOfStrewnGridsReadsBack) {
  const sample::Folder folder;
  for (const double share : {0.0, 0.004, 0.05, 0.5, 1.0}) {
    const TexelGrid grid = strewn(share);
    for (const VoxelBox& box : {VoxelBox{{0, 0, 0}, {16, 12, 20}}, VoxelBox{{1, 2, 3}, {15, 11, 18}},
                                VoxelBox{{5, 5, 5}, {6, 6, 6}}})
      for (const bool optics : {false, true})
        for (const Compression compression : {Compression::lz4, Compression::zlib}) {
          write_texel_vti(folder / "a.vti", grid, box, optics, {12, 0.4}, compression);
          expect_same(grid, box, optics, *read(folder / "a.vti"));
          if (HasFatalFailure()) return;
        }
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vti"});
}

TEST(TexelVti, ManyBlocksReadBack) {
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(96, 40, 0.4);
  const VoxelBox box = sample::box_of(grid);
  for (const bool optics : {false, true}) {
    write_texel_vti(folder / "a.vti", grid, box, optics, {});
    expect_same(grid, box, optics, *read(folder / "a.vti"));
  }
}

TEST(TexelVti, GeometryIsInMillimetresAtVoxelCentres) {
  const sample::Folder folder;
  const VoxelBox box{{1, 2, 3}, {15, 11, 18}};
  write_texel_vti(folder / "a.vti", strewn(0.1), box, false, {});
  const auto image = read(folder / "a.vti");
  const int* size = image->GetDimensions();
  EXPECT_EQ(std::vector<int>(size, size + 3), (std::vector<int>{14, 9, 15}));
  const double expected[] = {-10 + 1.5 * 2.5, 20 + 2.5 * 2.5, 3.5 * 2.5};
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(image->GetOrigin()[a], expected[a], 1e-12);
    EXPECT_DOUBLE_EQ(image->GetSpacing()[a], 2.5);
  }
}

TEST(TexelVti, FieldDataCarriesTimeAndUnits) {
  const sample::Folder folder;
  write_texel_vti(folder / "a.vti", strewn(0.1), {{0, 0, 0}, {16, 12, 20}}, false, {12.25, 0.417});
  const auto image = read(folder / "a.vti");
  vtkFieldData* fields = image->GetFieldData();
  ASSERT_TRUE(fields->GetArray("TimeValue") && fields->GetArray("wd"));
  EXPECT_EQ(fields->GetArray("TimeValue")->GetComponent(0, 0), 12.25);
  EXPECT_EQ(fields->GetArray("wd")->GetComponent(0, 0), 0.417);
  auto* length = vtkStringArray::SafeDownCast(fields->GetAbstractArray("length_unit"));
  auto* units = vtkStringArray::SafeDownCast(fields->GetAbstractArray("units"));
  ASSERT_TRUE(length && units);
  EXPECT_EQ(std::string(length->GetValue(0)), "mm");
  ASSERT_EQ(units->GetNumberOfValues(), image->GetPointData()->GetNumberOfArrays());
  for (int i = 0; i < units->GetNumberOfValues(); ++i) {
    const std::string name = image->GetPointData()->GetArrayName(i);
    EXPECT_EQ(std::string(units->GetValue(i)), name + "=" + std::string(field_spec(name).unit));
  }
}

TEST(TexelVti, RangesAreThoseOfFilledVoxels) {
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(64, 12, 0.4);
  ValueRanges ranges = write_texel_vti(folder / "a.vti", grid, sample::box_of(grid), false, {});
  merge_ranges(ranges, write_texel_vti(folder / "b.vti", grid, sample::box_of(grid), true, {}));
  for (const TexelField& f : texel_fields()) {
    float lo = 1e9f, hi = -1e9f;
    for (int b = 0; b < grid.brick_count(); ++b)
      for (int v = 0; v < TexelGrid::kVoxels; ++v)
        for (int c = 0; c < f.components; ++c)
          if (grid.channel(b, TexelChannel::density)[v] > 0) {
            lo = std::min(lo, grid.channel(b, TexelChannel(int(f.first) + c))[v]);
            hi = std::max(hi, grid.channel(b, TexelChannel(int(f.first) + c))[v]);
          }
    ASSERT_TRUE(ranges.contains(std::string(f.name))) << f.name;
    const bool label = f.name == "blade_id" || f.name == "tissue";
    EXPECT_EQ(ranges[std::string(f.name)].lo, label ? lo : round_mantissa(lo)) << f.name;
    EXPECT_EQ(ranges[std::string(f.name)].hi, label ? hi : round_mantissa(hi)) << f.name;
  }
  EXPECT_GT(ranges["water"].lo, 0.1);  // the zeros of the air are not among them
}

TEST(TexelVti, MergedRangesSpanBoth) {
  ValueRanges a{{"water", {0.2, 0.5}}, {"tissue", {1, 2}}};
  merge_ranges(a, {{"water", {0.4, 0.9}}, {"density", {0, 3}}});
  EXPECT_EQ(a.at("water").lo, 0.2);
  EXPECT_EQ(a.at("water").hi, 0.9);
  EXPECT_EQ(a.at("tissue").hi, 2);
  EXPECT_EQ(a.at("density").hi, 3);
}

TEST(TexelVti, SameBytesForAnyNumberOfThreads) {
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(96, 40, 0.4);
  for (const bool optics : {false, true}) {
    std::string one;
    for (const int threads : {1, 2, 4, 0}) {
      const ThreadLimit limit(threads);
      write_texel_vti(folder / "a.vti", grid, sample::box_of(grid), optics, {3, 0.1});
      const std::string bytes = sample::content(folder / "a.vti");
      if (one.empty()) one = bytes;
      EXPECT_TRUE(bytes == one) << threads << " threads";
    }
  }
}

TEST(TexelVti, BlocksAreLaidOutAsVtkWritesThem) {
  const sample::Folder folder;
  write_texel_vti(folder / "a.vti", TexelGrid({64, 64, 64, {}, 0.001, 0}), {{0, 0, 0}, {64, 64, 64}}, false,
                  {});
  const std::string bytes = sample::content(folder / "a.vti");
  EXPECT_NE(bytes.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(bytes.find("compressor=\"vtkLZ4DataCompressor\""), std::string::npos);
  const std::size_t start = bytes.find("encoding=\"raw\">\n   _");
  ASSERT_NE(start, std::string::npos);
  std::uint64_t header[7];
  std::memcpy(header, bytes.data() + start + std::strlen("encoding=\"raw\">\n   _"), sizeof header);
  // One array is 64^3 floats = 1 MiB: four whole blocks, no partial one, and empty blocks are all alike.
  EXPECT_EQ(header[0], 4u);
  EXPECT_EQ(header[1], 256u * 1024);
  EXPECT_EQ(header[2], 0u);
  EXPECT_EQ(header[3], header[6]);
  EXPECT_LT(header[3], 2000u);
}

TEST(TexelVti, AnEmptyTexelIsAllZero) {
  const sample::Folder folder;
  const TexelGrid grid({16, 16, 16, {}, 0.001, 0});
  const ValueRanges ranges = write_texel_vti(folder / "a.vti", grid, {{0, 0, 0}, {16, 16, 16}}, true, {});
  expect_same(grid, {{0, 0, 0}, {16, 16, 16}}, true, *read(folder / "a.vti"));
  EXPECT_EQ(ranges.at("normal").lo, 0);
  EXPECT_EQ(ranges.at("normal").hi, 0);
}

TEST(TexelVti, BoxOutsideTheGridIsInvalid) {
  const sample::Folder folder;
  const TexelGrid grid = strewn(0.1);
  for (const VoxelBox& box : {VoxelBox{{-1, 0, 0}, {4, 4, 4}}, VoxelBox{{0, 0, 0}, {17, 4, 4}},
                              VoxelBox{{3, 3, 3}, {3, 8, 8}}, VoxelBox{}})
    EXPECT_THROW(write_texel_vti(folder / "a.vti", grid, box, false, {}), InvalidInput);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace witherfield::vis
