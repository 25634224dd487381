// Whole leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <set>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/repair.hpp"
#include "sim/leaf/splines.hpp"
#include "tests/leaf/shapes.hpp"

namespace witherfield::leaf {
namespace {

LeafOptions coarse(const std::string& species, std::uint64_t seed = 1) {
  LeafOptions o = species_preset(species);
  o.seed = seed;
  o.mesh = {0.002, 0.006, 0.004, 0.5, 50000};
  return o;
}

std::vector<glm::dvec2> outline_of(const LeafModel& m) {
  std::vector<glm::dvec2> p;
  for (const int v : m.border) p.emplace_back(m.flat.position_m[std::size_t(v)]);
  return p;
}

int place_in(const std::vector<int>& list, int v) { return int(std::find(list.begin(), list.end(), v) - list.begin()); }

TEST(BuildLeaf, HasFiveStagesAndNoEars) {
  for (const std::string& species : species_names()) {
    const LeafModel m = build_leaf(coarse(species));
    ASSERT_EQ(m.stages.size(), 5u);
    const char* names[] = {"points", "splines", "mesh", "subdivided", "repaired"};
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(m.stages[k].name, names[k]);
      EXPECT_NO_THROW(m.stages[k].surface.validate());
    }
    EXPECT_TRUE(m.stages[0].surface.triangles.empty());
    EXPECT_EQ(m.stages[1].lines.size(), 3u);
    // Every stage covers the same outline.
    const double area = polygon_area(outline_of(m));
    for (std::size_t k = 2; k < 5; ++k) EXPECT_NEAR(surface_area_m2(m.stages[k].surface), area, 1e-9 * area);
    EXPECT_GT(m.stages[3].surface.triangles.size(), 2 * m.stages[2].surface.triangles.size());
    EXPECT_GT(int(ear_vertices(m.stages[2].surface).size()), 0);
    EXPECT_TRUE(ear_vertices(m.natural).empty());
    EXPECT_EQ(border_loops(m.flat.triangles).size(), 1u);
    EXPECT_EQ(m.flat.triangles, m.natural.triangles);
    m.natural.validate();
    for (const glm::dvec3& p : m.flat.position_m) ASSERT_EQ(p.z, 0);
  }
}

TEST(BuildLeaf, SameSeedSameBitsOtherSeedOtherLeaf) {
  const LeafModel a = build_leaf(coarse("cucumber")), b = build_leaf(coarse("cucumber")), c = build_leaf(coarse("cucumber", 2));
  EXPECT_EQ(a.natural.position_m, b.natural.position_m);
  EXPECT_EQ(a.natural.triangles, b.natural.triangles);
  EXPECT_EQ(a.vein, b.vein);
  EXPECT_NE(outline_of(a), outline_of(c));
}

TEST(BuildLeaf, ProportionsAreThoseOfTheSpecies) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    LeafOptions o = coarse("cucumber", seed);
    const LeafModel m = build_leaf(o);
    // Five main veins from the base, lengths within their intervals; angles from the midrib likewise.
    int main_veins = 0;
    for (const Vein& v : m.veins) {
      if (v.order != 1) continue;
      ++main_veins;
      EXPECT_LT(glm::length(v.line_m.front()), 1e-12);
      const double length = polyline_length(v.line_m) / o.main_vein_m;
      EXPECT_TRUE(&v == &m.veins[0] ? std::abs(length - 1) < 1e-9 : length > 0.6 && length < 0.9) << length;
    }
    EXPECT_EQ(main_veins, 5);
    // Length and width of the blade give its area within the regressions' spread (Blanco & Folegatti 2005: 0.88 L W - 4.27 cm2,
    // L from petiole to tip).
    double width = 0, low = 0;
    for (const auto& p : m.flat.position_m) width = std::max(width, p.y), low = std::min(low, p.y);
    const double regression = (0.88 * 100 * o.main_vein_m * 100 * (width - low) - 4.27) * 1e-4;
    EXPECT_NEAR(m.area_m2 / regression, 1, 0.18);
  }
  const LeafModel w = build_leaf(coarse("watermelon"));
  double length = 0, wide = 0, behind = 0, right = 0;
  for (const auto& p : w.flat.position_m)
    length = std::max(length, p.x), behind = std::min(behind, p.x), wide = std::max(wide, p.y), right = std::min(right, p.y);
  const double fill = w.area_m2 / ((length - behind) * (wide - right));
  EXPECT_GT(fill, 0.40);  // deep lobes: well below a cucumber's 0.65
  EXPECT_LT(fill, 0.55);
}

TEST(BuildLeaf, MidribBaseAndBorderAreWhereTheyShouldBe) {
  for (const std::string& species : species_names()) {
    const LeafModel m = build_leaf(coarse(species));
    ASSERT_GT(m.midrib.size(), 10u);
    double before = -1;
    for (const int v : m.midrib) {
      EXPECT_NEAR(m.flat.position_m[std::size_t(v)].y, 0, species == "cucumber" ? 1e-9 : 2e-3);
      EXPECT_GT(m.flat.position_m[std::size_t(v)].x, before);
      before = m.flat.position_m[std::size_t(v)].x;
    }
    EXPECT_EQ(m.flat.position_m[std::size_t(m.midrib.front())], glm::dvec3(0.0));
    // Consecutive midrib vertices are joined by edges: it can bend like one rod.
    std::set<std::pair<int, int>> edges;
    for (const auto& t : m.flat.triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    for (std::size_t i = 0; i + 1 < m.midrib.size(); ++i) EXPECT_TRUE(edges.count(std::minmax(m.midrib[i], m.midrib[i + 1])));
    EXPECT_LT(place_in(m.border, m.midrib.front()), int(m.border.size()));
    EXPECT_LT(place_in(m.border, m.midrib.back()), int(m.border.size()));
    EXPECT_LT(place_in(m.base, m.midrib.front()), int(m.base.size()));
    EXPECT_GE(m.base.size(), 3u);
    EXPECT_GT(polygon_area(outline_of(m)), 0);
    ASSERT_FALSE(m.petiole.line_m.empty());
    EXPECT_LT(glm::distance(m.petiole.line_m.back(), m.natural.position_m[std::size_t(m.midrib.front())]), 1e-9);
    EXPECT_LT(m.petiole.line_m.front().z, m.petiole.line_m.back().z);
  }
}

TEST(BuildLeaf, VeinFieldIsOneOnMainVeinsAndFadesBetween) {
  const LeafModel m = build_leaf(coarse("cucumber"));
  for (const int v : m.midrib) EXPECT_NEAR(m.vein[std::size_t(v)], 1, 1e-6);
  double sum = 0;
  int wide = 0;
  for (std::size_t i = 0; i < m.vein.size(); ++i) {
    ASSERT_GE(m.vein[i], 0);
    ASSERT_LE(m.vein[i], 1);
    sum += m.vein[i];
    wide += m.vein_width_m[i] > 0;
  }
  EXPECT_LT(sum / double(m.vein.size()), 0.5);
  EXPECT_GT(wide, 100);
  // Side veins start on their parents, exactly.
  for (const Vein& v : m.veins)
    if (v.order == 2) {
      const auto& parent = m.veins[std::size_t(v.parent)].line_m;
      EXPECT_NE(std::find(parent.begin(), parent.end(), v.line_m.front()), parent.end());
    }
}

TEST(BuildLeaf, BendingKeepsLengthsAlongTheMidrib) {
  LeafOptions o = coarse("cucumber");
  o.pose.pucker_m = o.pose.fine_pucker_m = o.pose.vein_groove_m = o.pose.waviness = 0;
  const LeafModel m = build_leaf(o);
  double flat = 0, natural = 0;
  for (std::size_t i = 0; i + 1 < m.midrib.size(); ++i) {
    flat += glm::distance(m.flat.position_m[std::size_t(m.midrib[i])], m.flat.position_m[std::size_t(m.midrib[i + 1])]);
    natural += glm::distance(m.natural.position_m[std::size_t(m.midrib[i])], m.natural.position_m[std::size_t(m.midrib[i + 1])]);
  }
  EXPECT_NEAR(natural / flat, 1, 1e-3);
  EXPECT_NEAR(m.natural_area_m2 / m.area_m2, 1, 0.05);
  o.pose.apply = false;
  const LeafModel still = build_leaf(o);
  EXPECT_EQ(still.natural.position_m, still.flat.position_m);
}

TEST(BuildLeaf, MeasuredPointsInSpaceAreInterpolated) {
  // A saddle-like leaf, turned and shifted: the surface passes through its points wherever it stands.
  const auto lift = [](const glm::dvec2& p) { return glm::dvec3(p, 2.0 * p.x * p.x - 3.0 * p.y * p.y); };
  OutlinePoints flat, space;
  for (int i = 0; i < 20; ++i) {
    const double t = (i + 0.5) / 20, x = 0.1 * t, y = 0.03 * std::sin(3.14159265 * t) + 0.002;
    flat.left_m.push_back(lift({x, y}));
    flat.right_m.push_back(lift({x, -y}));
  }
  for (int i = 0; i < 5; ++i) flat.midrib_m.push_back(lift({0.1 * i / 4, 0}));
  const double a = 0.8;
  const auto place = [&](const glm::dvec3& p) {
    return glm::dvec3(1, 2, 3) + glm::dvec3(p.x * std::cos(a) - p.z * std::sin(a), p.y, p.x * std::sin(a) + p.z * std::cos(a));
  };
  space = flat;
  for (auto* group : {&space.left_m, &space.right_m, &space.midrib_m})
    for (auto& p : *group) p = place(p);
  LeafOptions o = coarse("cucumber");
  o.source = LeafSource::points;
  o.pose.apply = false;
  o.mesh = {0.001, 0.003, 0.002, 0.5, 50000};
  const LeafModel m = build_leaf(o, {flat, {}}), n = build_leaf(o, {space, {}});
  ASSERT_EQ(m.natural.position_m.size(), n.natural.position_m.size());
  for (std::size_t i = 0; i < m.natural.position_m.size(); ++i)
    ASSERT_LT(glm::distance(m.natural.position_m[i], n.natural.position_m[i]), 1e-8);
  EXPECT_NEAR(m.area_m2, n.area_m2, 1e-10);
  // Each measured point lies on the border of the surface, up to the samples' spacing.
  const glm::dvec3 base = m.stages[0].surface.position_m[0];
  EXPECT_LT(glm::length(base), 1e-12);
  for (const glm::dvec3& p : m.stages[0].surface.position_m) {
    double nearest = 1e9;
    for (const int v : m.border) nearest = std::min(nearest, glm::distance(m.natural.position_m[std::size_t(v)], p));
    for (const int v : m.midrib) nearest = std::min(nearest, glm::distance(m.natural.position_m[std::size_t(v)], p));
    EXPECT_LT(nearest, 0.0008);
  }
}

TEST(BuildLeaf, TakesAnyMeshAndSplitsItsEars) {
  LeafOptions o;
  o.source = LeafSource::mesh;
  o.reference_area_m2 = 4;
  const Surface sheet = test::sheet(6, 0);
  const LeafModel m = build_leaf(o, {{}, sheet});
  EXPECT_EQ(m.ears_split, 2);
  EXPECT_EQ(m.natural.position_m.size(), sheet.position_m.size() + 2);
  EXPECT_NEAR(m.area_m2, 4, 1e-12);
  EXPECT_NEAR(m.area_error, 0, 1e-12);
  EXPECT_EQ(m.natural.uv.size(), m.natural.position_m.size());
  EXPECT_EQ(m.border.size(), 20u);
  const auto reason = [&](const Surface& s) -> std::string {
    try {
      build_leaf(o, {{}, s});
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(reason({}).find("no triangle"), std::string::npos);
  Surface two = sheet;
  append(two, sheet);
  EXPECT_NE(reason(two).find("2 pieces"), std::string::npos);
}

TEST(BuildLeaf, SurfaceCarriesItsFields) {
  const LeafModel m = build_leaf(coarse("cucumber"));
  auto moved = m.natural.position_m;
  for (auto& p : moved) p = 1.1 * p + glm::dvec3(0, 0, 0.02);
  const Surface s = to_surface(m, moved);
  EXPECT_NO_THROW(s.validate());
  for (const float v : s.field("strain_area").values) ASSERT_NEAR(v, 0.21, 1e-5);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    ASSERT_NEAR(s.field("displacement_m").values[3 * i + 2], moved[i].z - m.natural.position_m[i].z, 1e-6);
    ASSERT_NEAR(glm::length(s.normal[i]), 1, 1e-9);
  }
  // Green, veins paler.
  const auto& diffuse = s.field("diffuse").values;
  const std::size_t rib = 3 * std::size_t(m.midrib[m.midrib.size() / 2]);
  std::size_t blade = 0;
  for (std::size_t i = 0; i < m.vein.size(); ++i)
    if (m.vein[i] < m.vein[blade]) blade = i;
  EXPECT_GT(diffuse[3 * blade + 1], 1.5 * diffuse[3 * blade]);
  EXPECT_GT(diffuse[rib + 1], 1.5 * diffuse[3 * blade + 1]);
  EXPECT_THROW(to_surface(m, std::vector<glm::dvec3>(3)), InvalidInput);
  const Surface stalk = petiole_surface(m.petiole);
  EXPECT_NO_THROW(stalk.validate());
  EXPECT_TRUE(border_loops(stalk.triangles).empty());  // closed
  EXPECT_NO_THROW(validate(wilt_body(m)));
}

TEST(VeinMap, ShowsTheVeinsWhereTheMeshHasThem) {
  const LeafModel m = build_leaf(coarse("cucumber"));
  const VeinMap map = rasterize_veins(m, 512);
  ASSERT_EQ(map.vein.size(), 512u * 512u);
  const auto at = [&](const std::vector<float>& f, const glm::dvec2& uv) {
    return f[std::size_t(uv.y * 511.99) * 512 + std::size_t(uv.x * 511.99)];
  };
  for (std::size_t i = 2; i + 2 < m.midrib.size(); ++i) {
    EXPECT_GT(at(map.vein, m.flat.uv[std::size_t(m.midrib[i])]), 0.6f);
    EXPECT_LT(at(map.height, m.flat.uv[std::size_t(m.midrib[i])]), 0.35f);
  }
  double sum = 0;
  for (const float v : map.vein) sum += v;
  EXPECT_LT(sum / double(map.vein.size()), 0.3);
  EXPECT_THROW(rasterize_veins(m, 4), InvalidInput);
}

// The references below are synthetic: leaves made by this program's own vein model, finely meshed.

TEST(LeafAreaFromPoints, TwentyTwoPointsASideComeWithinFourPercent) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LeafOptions o = coarse("cucumber", seed);
    o.variation = 1;
    o.asymmetry = 1;
    o.mesh = {0.0006, 0.004, 0.002, 0.5, 200000};
    o.pose.apply = false;
    const LeafModel reference = build_leaf(o);
    LeafOptions rebuilt = coarse("cucumber");
    rebuilt.source = LeafSource::points;
    rebuilt.pose.apply = false;
    rebuilt.reference_area_m2 = reference.area_m2;
    LeafInput input;
    input.points = sample_outline(outline_of(reference), place_in(reference.border, reference.midrib.front()),
                                  place_in(reference.border, reference.midrib.back()), 22, 5);
    const double error = build_leaf(rebuilt, input).area_error;
    worst = std::max(worst, std::abs(error));
    EXPECT_LT(std::abs(error), 0.04) << "seed " << seed;
  }
  RecordProperty("worst_percent", std::to_string(100 * worst));
  std::printf("[   INFO   ] area from 22 + 22 + 5 points, 10 synthetic lobed leaves: worst error %.2f %%\n", 100 * worst);
}

TEST(LeafAreaFromVeins, MainVeinLengthAloneComesWithinTenPercentOfItsOwnFamily) {
  for (const std::string& species : species_names()) {
    double worst = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      LeafOptions leaf = coarse(species, seed);
      leaf.variation = 1;
      leaf.asymmetry = 1;
      leaf.main_vein_m = 0.08 + 0.012 * double(seed);
      leaf.pose.apply = false;
      LeafOptions model = leaf;
      model.seed = 999;
      model.variation = 0;
      model.reference_area_m2 = build_leaf(leaf).area_m2;
      const double error = build_leaf(model).area_error;
      worst = std::max(worst, std::abs(error));
      EXPECT_LT(std::abs(error), 0.10) << species << " seed " << seed;
    }
    std::printf("[   INFO   ] area from the main vein alone, 10 synthetic %s leaves: worst error %.2f %%\n", species.c_str(), 100 * worst);
  }
}

TEST(LeafOptions, RefuseWhatIsOutOfRange) {
  const auto reason = [](auto change) -> std::string {
    LeafOptions o;
    change(o);
    try {
      validate(o);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(reason([](LeafOptions&) {}), "");
  EXPECT_NE(reason([](LeafOptions& o) { o.main_vein_m = 15; }).find("main_vein_m = 15 is outside 0.01..1 m"), std::string::npos);
  EXPECT_NE(reason([](LeafOptions& o) { o.species = "melon"; }).find("known: cucumber, watermelon"), std::string::npos);
  EXPECT_NE(reason([](LeafOptions& o) { o.margin.tooth_depth_m = 0.005; }).find("would cross"), std::string::npos);
  EXPECT_NE(reason([](LeafOptions& o) { o.mesh.edge_m = std::nan(""); }).find("mesh.edge_m"), std::string::npos);
  EXPECT_NE(reason([](LeafOptions& o) { o.edit.keys.resize(1); }).find("no handle"), std::string::npos);
  EXPECT_THROW(species_preset("melon"), InvalidInput);
  LeafOptions few = coarse("cucumber");
  few.mesh.max_vertices = 300;
  EXPECT_THROW(build_leaf(few), InvalidInput);
}

TEST(LeafOptions, PresetsGrowWithTheMainVein) {
  for (const std::string& species : species_names()) {
    const LeafOptions small = species_preset(species, 0.05), usual = species_preset(species), large = species_preset(species, 0.3);
    EXPECT_EQ(small.main_vein_m, 0.05);
    EXPECT_LT(small.margin.tooth_depth_m, usual.margin.tooth_depth_m);
    EXPECT_GT(large.petiole_m, usual.petiole_m);
    for (const LeafOptions& o : {small, usual, large}) EXPECT_NO_THROW(validate(o));
  }
}

}  // namespace
}  // namespace witherfield::leaf
