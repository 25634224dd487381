// Small pictures, rendered without a display.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "tests/vis/sample.hpp"
#include "vis/colour_map.hpp"
#include "vis/mesh_files.hpp"
#include "vis/volume.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<glm::dvec3> pixels;  // from the lower left, encoded 0..1
  const glm::dvec3& at(int x, int y) const { return pixels[std::size_t(y * width + x)]; }
};

Picture load(const std::filesystem::path& png) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Picture p{image->GetDimensions()[0], image->GetDimensions()[1], {}};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      glm::dvec3 c;
      for (int k = 0; k < 3; ++k) c[k] = image->GetScalarComponentAsDouble(x, y, 0, k) / 255;
      p.pixels.push_back(c);
    }
  return p;
}

constexpr int kWidth = 480, kHeight = 270, kStrip = 408;  // the legend's strip begins at kStrip

VolumeOptions small(const std::string& field) {
  VolumeOptions o;
  o.field = field;
  o.width_px = kWidth;
  o.height_px = kHeight;
  return o;
}

double saturation(const glm::dvec3& c) {
  return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b});
}

/// Share of the data's part that is drawn in colour (background, ground and ink are grey).
double coloured_share(const Picture& p, int from, int to) {
  double n = 0;
  for (int y = 0; y < p.height; ++y)
    for (int x = from; x < to; ++x) n += saturation(p.at(x, y)) > 0.15;
  return n / (double(p.height) * (to - from));
}

class Render : public testing::Test {
 protected:
  void SetUp() override {
    // Unless the test is about the X display, no display may be needed.
    if (!std::getenv("WITHERFIELD_TEST_X")) unsetenv("DISPLAY");
  }
  Picture picture(const std::string& file, const VolumeOptions& options) {
    render_volume(folder / file, folder / "out.png", options);
    return load(folder / "out.png");
  }
  void write(double wd, double scale = 1) {
    TexelGrid grid = sample::texel(96, 40, wd);
    if (scale != 1) {
      GridShape shape = grid.shape();
      shape.spacing_m *= scale;
      shape.origin_m *= scale;
      TexelGrid other(shape);
      std::vector<int> cells;
      for (int b = 0; b < grid.brick_count(); ++b) cells.push_back(grid.brick_cell(b));
      other.reset_bricks(cells);
      for (int b = 0; b < grid.brick_count(); ++b)
        std::copy_n(grid.channel(b, TexelChannel::density), kTexelChannels * TexelGrid::kVoxels,
                    other.channel(b, TexelChannel::density));
      grid = std::move(other);
    }
    write_texel_vti(folder / "a.vti", grid, sample::box_of(grid), false, {30 * wd, wd});
    write_texel_vti(folder / "o.vti", grid, sample::box_of(grid), true, {30 * wd, wd});
  }
  sample::Folder folder;
};

TEST_F(Render, VolumeShowsGrassAndALegend) {
  write(0.4);
  VolumeOptions options = small("water");
  options.range = {{0.0, 1.0}};
  const Picture p = picture("a.vti", options);
  ASSERT_EQ(p.width, kWidth);
  ASSERT_EQ(p.height, kHeight);
  const double share = coloured_share(p, 0, kStrip);
  EXPECT_GT(share, 0.03);
  EXPECT_LT(share, 0.6);
  // The bar: from bottom to top the map's colours, each once, in order.
  const ColourMap map = colour_map("water", 0, 1);
  const int x = kStrip + 27, bottom = int(0.17 * kHeight), top = int(0.72 * kHeight);
  for (int y = bottom + 3; y < top - 3; ++y)
    EXPECT_LT(glm::length(p.at(x, y) - map.at((y + 0.5 - 0.17 * kHeight) / (0.55 * kHeight))), 0.05) << y;
  // Caption, numbers of the scale, title.
  const auto has_ink = [&](int x0, int x1, int y0, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int i = x0; i < x1; ++i)
        if (std::max({p.at(i, y).r, p.at(i, y).g, p.at(i, y).b}) < 0.45) return true;
    return false;
  };
  EXPECT_TRUE(has_ink(4, 90, kHeight - 20, kHeight - 4));
  EXPECT_TRUE(has_ink(kStrip + 36, kWidth, bottom, top));
  EXPECT_TRUE(has_ink(kStrip + 5, kWidth - 5, top + 6, top + 30));
}

TEST_F(Render, OtherWaterGivesOtherColoursButTheSameLegend) {
  VolumeOptions options = small("water");
  options.range = {{0.0, 1.0}};
  for (const bool surface : {false, true}) {
    options.surface = surface;
    write(0.1);
    const Picture wet = picture("a.vti", options);
    write(0.8);
    const Picture dry = picture("a.vti", options);
    int data = 0, legend = 0;
    double green_wet = 0, green_dry = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        (x < kStrip ? data : legend) += glm::length(wet.at(x, y) - dry.at(x, y)) > 0.1;
        if (x < kStrip && saturation(wet.at(x, y)) > 0.15) green_wet += wet.at(x, y).g - wet.at(x, y).b;
        if (x < kStrip && saturation(dry.at(x, y)) > 0.15) green_dry += dry.at(x, y).g - dry.at(x, y).b;
      }
    EXPECT_GT(data, 1000);
    EXPECT_EQ(legend, 0);
    EXPECT_GT(green_dry, green_wet);  // viridis runs from purple (wet) to yellow (dry)
  }
}

TEST_F(Render, SameFileSamePicture) {
  write(0.4);
  render_volume(folder / "a.vti", folder / "one.png", small("water"));
  render_volume(folder / "a.vti", folder / "two.png", small("water"));
  EXPECT_TRUE(sample::content(folder / "one.png") == sample::content(folder / "two.png"));
}

TEST_F(Render, SmallUnitsAreNotInvisible) {
  write(0.4);
  const double share = coloured_share(picture("a.vti", small("water")), 0, kStrip);
  write(0.4, 1e-3);  // as if in metres: VTK's opacity per unit of length must follow the voxels
  EXPECT_NEAR(coloured_share(picture("a.vti", small("water")), 0, kStrip), share, 0.1 * share);
}

TEST_F(Render, BladesHaveNoFalseDryRim) {
  TexelGrid grid = sample::texel(96, 40, 0.4);
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v)
      if (grid.channel(b, TexelChannel::density)[v] > 0) grid.channel(b, TexelChannel::water)[v] = 0.6f;
  write_texel_vti(folder / "a.vti", grid, sample::box_of(grid), false, {12, 0.4});
  VolumeOptions options = small("water");
  options.range = {{0.0, 1.0}};
  const glm::dvec3 dry = colour_map("water", 0, 1).at(0.15);  // yellow-green
  for (const bool surface : {false, true}) {
    options.surface = surface;
    const Picture p = picture("a.vti", options);
    int yellow = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kStrip; ++x) yellow += p.at(x, y).r - p.at(x, y).b > 0.5 * (dry.r - dry.b);
    EXPECT_EQ(yellow, 0);
    EXPECT_GT(coloured_share(p, 0, kStrip), 0.03);
  }
}

TEST_F(Render, EveryFieldOfEveryFileCanBeShown) {
  write(0.4);
  write_points_vtp(folder / "p.vtp", sample::points(sample::texel(64, 20, 0.4)), {12, 0.4});
  const sample::Hill hill = sample::hill(10);
  write_terrain_vtp(folder / "t.vtp", hill.mesh, hill.elevation_m, hill.placement);
  const std::vector<std::pair<const char*, std::vector<const char*>>> all{
      {"a.vti", {"density", "chlorophyll_ug_cm2", "stress_vein_MPa", "strain_shrink", "tissue", "blade_id"}},
      {"o.vti", {"diffuse", "normal", "tangent", "specular"}},
      {"p.vtp", {"water", "diffuse", "velocity_m_s", "radius_m"}},
      {"t.vtp", {"elevation_m", "texel_id", "lod"}}};
  for (const auto& [file, fields] : all)
    for (const char* field : fields) {
      VolumeOptions options = small(field);
      options.surface = true;
      const Picture p = picture(file, options);
      double drawn = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kStrip; ++x) drawn += glm::length(p.at(x, y) - p.at(2, 2)) > 0.2;
      EXPECT_GT(drawn / (kHeight * kStrip), 0.01) << file << ' ' << field;
    }
}

TEST_F(Render, ScaleComesFromTheRun) {
  write(0.1);
  std::filesystem::create_directories(folder / "texel");
  std::filesystem::rename(folder / "a.vti", folder / "texel/a.vti");
  const Picture own = picture("texel/a.vti", small("water"));
  std::ofstream(folder / "run.json") << R"({"value_ranges": {"water": [0.0, 1.0]}})";
  const Picture run = picture("texel/a.vti", small("water"));
  VolumeOptions options = small("water");
  options.range = {{0.0, 1.0}};
  const Picture fixed = picture("texel/a.vti", options);
  EXPECT_TRUE(run.pixels == fixed.pixels);
  EXPECT_FALSE(run.pixels == own.pixels);
  std::ofstream(folder / "run.json") << "{ damaged";
  EXPECT_THROW(picture("texel/a.vti", small("water")), IoFailure);
}

TEST_F(Render, BadRequestsAreNamed) {
  write(0.4);
  const auto message = [&](const std::string& file, const VolumeOptions& options) -> std::string {
    try {
      render_volume(folder / file, folder / "out.png", options);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  const std::string unknown = message("a.vti", small("watr"));
  EXPECT_NE(unknown.find("watr"), std::string::npos);
  EXPECT_NE(unknown.find("chlorophyll_ug_cm2"), std::string::npos);  // says what there is
  VolumeOptions options = small("water");
  options.surface = true;
  options.iso_density = 1000;
  EXPECT_NE(message("a.vti", options).find("1000"), std::string::npos);
  options = small("water");
  options.range = {{1.0, 0.0}};
  EXPECT_FALSE(message("a.vti", options).empty());
  options = small("water");
  options.width_px = 10;
  EXPECT_NE(message("a.vti", options).find("width_px"), std::string::npos);
  EXPECT_THROW(render_volume(folder / "none.vti", folder / "out.png", small("water")), IoFailure);
  EXPECT_THROW(render_volume(folder / "a.vti", folder / "none/out.png", small("water")), IoFailure);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

/// A floor lies as a sheet, seen from above: east right, north up, without gaps.
TEST_F(Render, AFloorIsASheetWithNorthUp) {
  FloorField floor(40, 20, {0, 0}, 0.1);
  auto& gloss = floor.make("gloss");
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 40; ++i) gloss[std::size_t(j * 40 + i)] = i >= 20 && j >= 10 ? 1.0f : 0.0f;
  write_floor_vti(folder / "floor.vti", floor, {0, 0});
  VolumeOptions options = small("gloss");
  options.azimuth_deg = -90;
  options.elevation_deg = 89;
  options.range = {{0.0, 1.0}};
  const Picture p = picture("floor.vti", options);
  // In the colours of the ends of the scale; only the north-east quarter has the upper one.
  const ColourMap map = colour_map("gloss", 0, 1);
  std::array<int, 4> high{};
  int low = 0;
  glm::dvec2 middle(0.0);
  std::vector<glm::dvec2> where;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kStrip; ++x) {
      const bool is_high = glm::distance(p.at(x, y), map.at(1)) < 0.05, is_low = glm::distance(p.at(x, y), map.at(0)) < 0.05;
      low += is_low;
      if (!is_high && !is_low) continue;
      middle += glm::dvec2(x, y);
      where.emplace_back(x, y);
    }
  middle /= double(where.size());
  for (const glm::dvec2& w : where)
    if (glm::distance(p.at(int(w.x), int(w.y)), map.at(1)) < 0.05) ++high[std::size_t((w.x > middle.x) + 2 * (w.y > middle.y))];
  const int all = high[0] + high[1] + high[2] + high[3];
  EXPECT_NEAR(double(low) / all, 3.0, 0.3);
  EXPECT_GT(high[3], 0.95 * all);
  EXPECT_THROW(picture("floor.vti", small("wear_depth_um")), InvalidInput);
}

TEST_F(Render, ALeafIsDrawnInTheColoursOfItsField) {
  Surface s;
  for (int j = 0; j <= 1; ++j)
    for (int i = 0; i <= 1; ++i) s.position_m.emplace_back(0.1 * i, 0.1 * j, 0.02 * i);
  s.triangles = {{0, 1, 3}, {0, 3, 2}};
  for (float& w : s.make_field("water").values) w = 0.5f;
  write_surface_vtp(folder / "leaf.vtp", s, {0, 0}, "mm");
  VolumeOptions options = small("water");
  options.elevation_deg = 60;
  options.range = {{0.0, 1.0}};
  EXPECT_GT(coloured_share(picture("leaf.vtp", options), 0, kStrip), 0.08);
}

/// Exits with 0 when rendering ends in an IoFailure that says what to do.
[[noreturn]] void render_without_any_context(const std::filesystem::path& vti, const char* display) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
  if (display)
    setenv("DISPLAY", display, 1);
  else
    unsetenv("DISPLAY");
  int code = 1;
  try {
    render_volume(vti, vti.parent_path() / "out.png", small("water"));
  } catch (const IoFailure& e) {
    code = std::string(e.what()).find("xvfb-run") != std::string::npos ? 0 : 2;
  }
  std::filesystem::remove_all(vti.parent_path());  // no destructor runs after this
  std::_Exit(code);
}

TEST_F(Render, NoContextIsAnErrorNotAnAbort) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  write(0.4);
  EXPECT_EXIT(render_without_any_context(folder / "a.vti", nullptr), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(render_without_any_context(folder / "a.vti", ":4711"), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace witherfield::vis
