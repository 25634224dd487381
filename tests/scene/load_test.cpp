// What a scene file says arrives in the options; what it does not say has its default.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "scene_file.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::scene {
namespace {

std::string with_name(GrassScene scene, const std::string& name) {
  scene.name = name;
  return resolved_json(scene);
}

/// The printed defaults with their commented-out tables and keys made live.
std::string uncommented(const std::string& text) {
  static const std::regex code("^# (#? ?)(\\[+[a-z]+\\]+|[a-z][A-Za-z0-9_]* = .*)$");
  static const std::regex inner("^# ([a-z][A-Za-z0-9_]* = .*)$");
  std::istringstream in(text);
  std::string line, out;
  while (std::getline(in, line)) {
    line = std::regex_replace(line, code, "$2");
    out += std::regex_replace(line, inner, "$1") + "\n";
  }
  return out;
}

std::string without_kind(const std::string& text) {
  return std::regex_replace(text, std::regex("\nkind = [^\n]*"), "\n");
}

TEST(SceneDefaults, AnEmptySceneIsTheDefaultStructs) {
  const GrassScene scene = load_text("");
  const grass::GrassOptions o;
  GrassScene plain;
  plain.grass = o;
  plain.grass.samples.resize(1);
  EXPECT_EQ(resolved_json(scene), with_name(plain, "scene"));
  EXPECT_EQ(scene.name, "scene");  // the file's stem
  EXPECT_EQ(scene.grass.samples.size(), 1u);
  EXPECT_FALSE(scene.terrain);
  EXPECT_TRUE(scene.stills.empty());
}

TEST(SceneDefaults, PrintedDefaultsLoadBackToTheDefaults) {
  const GrassScene scene = load_text(without_kind(print_defaults("grass")));
  EXPECT_EQ(with_name(scene, "x"), with_name(load_text(""), "x"));
}

TEST(SceneDefaults, EveryCommentedKeyOfThePrintedDefaultsIsValidToo) {
  std::string text = without_kind(uncommented(print_defaults("grass")));
  text = std::regex_replace(text, std::regex("\nmesh = [^\n]*"), "\n");
  text = std::regex_replace(text, std::regex("\ncamera_height_above_ground_m = [^\n]*"), "\n");
  text = std::regex_replace(text, std::regex("species = [^\n]*"), "species = \"perennial_ryegrass\"");
  const GrassScene scene = load_text(text);
  ASSERT_TRUE(scene.terrain);
  EXPECT_EQ(scene.terrain->width_m, 8);
  ASSERT_EQ(scene.stills.size(), 1u);
  EXPECT_EQ(scene.stills[0].name, "wd_030");
  GrassScene same = load_text("");  // the example tables hold defaults
  EXPECT_EQ(resolved_json(GrassScene{"grass", "x", scene.grass, {}, {}, {}, scene.output}),
            resolved_json(GrassScene{"grass", "x", same.grass, {}, {}, {}, same.output}));
}

TEST(SceneDefaults, EveryPrintedKeyIsDocumented) {
  std::istringstream in(print_defaults("grass"));
  std::string line, before;
  int keys = 0;
  const std::regex key("^(# )?(# )?[A-Za-z0-9_]+ = .*");
  while (std::getline(in, line)) {
    if (std::regex_match(line, key) && line.find(" = ") < 45) {
      ++keys;
      EXPECT_EQ(before.rfind("# ", 0), 0u) << line;
      EXPECT_GT(before.size(), 12u) << line;
    }
    before = line;
  }
  EXPECT_GT(keys, 100);
}

TEST(SceneLoad, WritesEachTableToItsOptions) {
  const GrassScene s = load_text(R"(
name = "meadow"
seed = 42
[season]
length_days = 30
climate = "cold"
wd_frames = [0.1, 0.2]
water_curve = [[0, 1], [1, 0.1]]
[texel]
size_m = 0.4
resolution = 96
variants = 3
variant_spread = 0.5
[model]
proportion = 4
motion = "paper"
[blades]
count = 7
length_m = [0.1, 0.2]
form = "cone"
[output]
points = false
compression = "zlib"
)");
  EXPECT_EQ(s.name, "meadow");
  EXPECT_EQ(s.grass.seed, 42u);
  EXPECT_EQ(s.placement.seed, 42u);
  EXPECT_EQ(s.grass.season.length_days, 30);
  EXPECT_EQ(s.grass.season.climate, grass::Climate::cold);
  EXPECT_EQ(s.grass.wd_frames, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(s.grass.season.water_curve.back().second, 0.1);
  EXPECT_EQ(s.grass.texel.resolution, 96);
  EXPECT_EQ(s.placement.variants, 3);
  EXPECT_EQ(s.grass.points.proportion, 4);
  EXPECT_EQ(s.grass.tissue.motion, grass::Motion::paper);
  EXPECT_EQ(s.grass.colour.model, grass::PigmentModel::kubelka_munk);
  ASSERT_EQ(s.grass.samples.size(), 1u);
  EXPECT_EQ(s.grass.samples[0].blades.count, 7);
  EXPECT_EQ(s.grass.samples[0].blades.length_m.hi, 0.2);
  EXPECT_EQ(s.grass.samples[0].blades.form, grass::BladeForm::cone);
  EXPECT_EQ(s.grass.samples[0].season.length_days, 30);
  EXPECT_FALSE(s.output.points);
  EXPECT_EQ(s.output.compression, "zlib");
}

TEST(SceneLoad, ModelPaperNamesTheWholeSetAndStatedKeysWin) {
  const GrassScene paper = load_text("[model]\nname = \"paper\"\n");
  EXPECT_EQ(paper.grass.tissue.motion, grass::Motion::paper);
  EXPECT_EQ(paper.grass.colour.model, grass::PigmentModel::paper);
  EXPECT_EQ(paper.grass.samples[0].blades.form, grass::BladeForm::cone);
  const GrassScene mixed =
      load_text("[blades]\nform = \"ribbon\"\n[model]\nmotion = \"rod\"\nname = \"paper\"\n");
  EXPECT_EQ(mixed.grass.tissue.motion, grass::Motion::rod);
  EXPECT_EQ(mixed.grass.colour.model, grass::PigmentModel::paper);
  EXPECT_EQ(mixed.grass.samples[0].blades.form, grass::BladeForm::ribbon);
}

TEST(SceneLoad, SpeciesComesFirstWhereverItStands) {
  const grass::BladeOptions fescue = grass::species_preset("tall_fescue");
  const grass::BladeOptions b = load_text(
                                    "[model]\nname = \"paper\"\n[blades]\ncount = 9\nwidth_m = [0.003, "
                                    "0.003]\nspecies = \"tall_fescue\"\n")
                                    .grass.samples[0]
                                    .blades;
  EXPECT_EQ(b.length_m.hi, fescue.length_m.hi);
  EXPECT_NE(b.length_m.hi, grass::BladeOptions{}.length_m.hi);
  EXPECT_EQ(b.width_m.lo, 0.003);
  EXPECT_EQ(b.count, 9);
  EXPECT_EQ(b.form, grass::BladeForm::cone);  // a species does not change how blades are modelled
}

TEST(SceneLoad, SamplesStartFromBladesAndSeason) {
  const GrassScene s = load_text(R"(
[season]
length_days = 40
onset_sd = 0.05
water_curve = [[0, 1], [1, 0.2]]
[blades]
count = 100
length_m = [0.1, 0.2]
[[mingle]]
[[mingle]]
count = 50
climate = "cold"
ageing = [[0, 0.2], [1, 0.9]]
onset_mean = 0.4
[[mingle]]
species = "zoysia"
)");
  ASSERT_EQ(s.grass.samples.size(), 3u);
  const auto& [a, b, c] = std::tie(s.grass.samples[0], s.grass.samples[1], s.grass.samples[2]);
  EXPECT_EQ(a.blades.count, 100);
  EXPECT_EQ(a.season.water_curve.size(), 2u);
  EXPECT_TRUE(a.ageing.empty());
  EXPECT_EQ(b.blades.count, 50);
  EXPECT_EQ(b.blades.length_m.hi, 0.2);
  EXPECT_EQ(b.season.length_days, 40);
  EXPECT_EQ(b.season.onset_sd, 0.05);
  EXPECT_EQ(b.season.onset_mean, 0.4);
  EXPECT_EQ(b.season.climate, grass::Climate::cold);
  EXPECT_TRUE(b.season.water_curve.empty());  // its own climate replaces the inherited curve
  EXPECT_EQ(b.ageing[0].second, 0.2);
  EXPECT_EQ(c.blades.count, 100);
  EXPECT_EQ(c.blades.length_m.hi, grass::species_preset("zoysia").length_m.hi);
}

TEST(SceneLoad, StillsStartFromTheView) {
  const GrassScene s = load_text(R"(
[view]
camera_m = [1, 2, 3]
size_px = [320, 180]
sun_elevation_deg = 25
looks = ["texel", "blades"]
[[still]]
name = "a"
wd = 0.3
[[still]]
name = "b"
wd = 0.917
fov_deg = 20
camera_m = [0, 0, 9]
)");
  ASSERT_EQ(s.stills.size(), 2u);
  EXPECT_EQ(s.stills[0].camera.position_m, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.stills[0].width_px, 320);
  EXPECT_EQ(s.stills[0].sun.elevation_deg, 25);
  EXPECT_EQ(s.stills[0].looks.size(), 2u);
  EXPECT_EQ(s.stills[1].camera.position_m, glm::dvec3(0, 0, 9));
  EXPECT_EQ(s.stills[1].camera.fov_deg, 20);
  EXPECT_EQ(s.stills[1].wd, 0.917);
  EXPECT_EQ(s.stills[0].camera.fov_deg, Camera{}.fov_deg);
}

TEST(SceneLoad, TerrainPathsAreRelativeToTheSceneFile) {
  const SceneFile file(
      "[terrain]\ndem = \"data/hill.tif\"\n[view]\ncamera_height_above_ground_m = "
      "1.5\n[[still]]\nname=\"a\"\n");
  const GrassScene s = load_grass_scene(file.path());
  EXPECT_EQ(s.terrain->dem, (std::filesystem::path(file.path()).parent_path() / "data/hill.tif").string());
  EXPECT_EQ(s.stills[0].camera.height_above_ground_m.value(), 1.5);
  const GrassScene absolute = load_text("[terrain]\ndem = \"/data/hill.tif\"\n");
  EXPECT_EQ(absolute.terrain->dem, "/data/hill.tif");
}

TEST(SceneLoad, TerrainWidthFollowsFromTheTexels) {
  const std::string hill = "[texel]\nsize_m = 0.25\n[terrain]\ndem = \"h.tif\"\ntexels = [12, 8]\n";
  EXPECT_EQ(load_text(hill).terrain->width_m, 3);
  EXPECT_EQ(load_text(hill + "width_m = 3\n").terrain->width_m, 3);
  EXPECT_EQ(load_text(hill + "width_m = 0\n").terrain->width_m, 0);  // true size
}

TEST(SceneJson, DiffersWhenAnyKeyDiffers) {
  const std::string base = resolved_json(load_text(""));
  for (const char* text :
       {"seed = 2\n", "[season]\nsteps_per_day = 5\n", "[season]\nwater_curve = [[0, 1], [1, 0]]\n",
        "[texel]\nresolution = 128\n", "[model]\nmotion = \"paper\"\n", "[blades]\nfold_deg = [1, 2]\n",
        "[[mingle]]\nageing = [[0, 0], [1, 1]]\n", "[terrain]\ndem = \"/h.tif\"\n",
        "[[still]]\nname = \"a\"\n", "[output]\noptics = false\n"})
    EXPECT_NE(resolved_json(load_text(text)), base) << text;
}

}  // namespace
}  // namespace witherfield::scene
