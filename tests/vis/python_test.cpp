// The files as VTK's Python module sees them: names, components, values, FieldData, extents.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/vis/sample.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

nlohmann::json arrays_of(const TexelGrid& grid, int series) {  // 0 texel, 1 optics, 2 both
  nlohmann::json arrays;
  for (const TexelField& f : texel_fields()) {
    if (series != 2 && f.optics != (series == 1) && f.first != TexelChannel::density) continue;
    double sum = 0, magnitude = 0;
    for (int b = 0; b < grid.brick_count(); ++b)
      for (int v = 0; v < TexelGrid::kVoxels; ++v)
        if (grid.channel(b, TexelChannel::density)[v] > 0)
          for (int c = 0; c < f.components; ++c) {
            const double x = grid.channel(b, TexelChannel(int(f.first) + c))[v];
            sum += x;
            magnitude += std::abs(x);
          }
    arrays[std::string(f.name)] = {{"components", f.components}, {"sum", sum}, {"magnitude", magnitude}};
  }
  return arrays;
}

TEST(Python, VtkReadsWhatWasWritten) {
  if (std::system(WITHERFIELD_VTK_PYTHON " -c 'import vtkmodules.vtkIOXML, numpy' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "VTK's Python module is not installed";
  const sample::Folder folder;
  const TexelGrid grid = sample::texel(96, 40, 0.4);
  const VoxelBox box = sample::box_of(grid);
  const glm::ivec3 size = box.hi - box.lo;
  const double h = grid.shape().spacing_m * 1e3;
  nlohmann::json expected;
  for (const bool optics : {false, true})
    for (const Compression compression : {Compression::lz4, Compression::zlib}) {
      const std::string name = std::string(optics ? "optics" : "texel") +
                               (compression == Compression::lz4 ? "_lz4" : "_zlib") + ".vti";
      write_texel_vti(folder / name, grid, box, optics, {12.5, 0.4}, compression);
      nlohmann::json& e = expected[name];
      e["arrays"] = arrays_of(grid, optics);
      e["points"] = std::int64_t(size.x) * size.y * size.z;
      e["extent"] = {0, size.x - 1, 0, size.y - 1, 0, size.z - 1};
      e["spacing"] = {h, h, h};
      for (int a = 0; a < 3; ++a)
        e["origin"].push_back(grid.shape().origin_m[a] * 1e3 + (box.lo[a] + 0.5) * h);
    }
  const PointSet points = sample::points(grid);
  write_points_vtp(folder / "points.vtp", points, {12.5, 0.4});
  nlohmann::json& e = expected["points.vtp"];
  e["points"] = points.size();
  e["arrays"] = arrays_of(grid, 2);
  double mass = 0, velocity = 0, speed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    mass += points.mass_kg[i];
    for (int c = 0; c < 3; ++c) {
      velocity += double(points.velocity_m_s[i][c]);
      speed += std::abs(double(points.velocity_m_s[i][c]));
    }
  }
  const double radii = points.radius_m * double(points.size());
  e["arrays"]["mass_kg"] = {{"components", 1}, {"sum", mass}, {"magnitude", mass}};
  e["arrays"]["radius_m"] = {{"components", 1}, {"sum", radii}, {"magnitude", radii}};
  e["arrays"]["velocity_m_s"] = {{"components", 3}, {"sum", velocity}, {"magnitude", speed}};
  for (auto& entry : expected) {
    entry["days"] = 12.5;
    entry["wd"] = 0.4;
    entry["filled"] = grid.occupied_voxels();
  }
  std::ofstream(folder / "expected.json") << expected;
  const std::string command =
      std::string(WITHERFIELD_VTK_PYTHON " " WITHERFIELD_TEST_SOURCES "/read_back.py ") +
      folder.path().string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace witherfield::vis
