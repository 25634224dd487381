// Every kind of wrong input: the message names file, line, key, value, range and unit.
#include "sim/core/errors.hpp"

#include <gtest/gtest.h>

#include "scene_file.hpp"

namespace witherfield::scene {
namespace {

const std::string kStill = "[[still]]\nname = \"a\"\nwd = 0\n";
const std::string kHill = "[terrain]\ndem = \"hill.tif\"\n";

TEST(SceneErrors, NumberOutOfRangeNamesLineKeyValueRangeAndUnit) {
  EXPECT_EQ(error_of("\n[season]\nlength_days = -3\n"),
            "scene.toml:4: season.length_days = -3: must be 1..1000 days");
  EXPECT_EQ(error_of("[season]\nonset_mean = nan\n"),
            "scene.toml:3: season.onset_mean = nan: must be 0.1..0.9");
  EXPECT_EQ(error_of("[season]\nlength_days = inf\n"),
            "scene.toml:3: season.length_days = inf: must be 1..1000 days");
}

TEST(SceneErrors, ProportionZeroIsOutsideAnOpenRange) {
  EXPECT_EQ(
      error_of("[model]\nproportion = 0\n"),
      "scene.toml:3: model.proportion = 0: must be greater than 0, at most 1000 points per unit of density");
  EXPECT_EQ(error_of("[model]\nproportion = -1.5\n"),
            "scene.toml:3: model.proportion = -1.5: must be greater than 0, at most 1000 points per unit of "
            "density");
}

TEST(SceneErrors, NegativeLengths) {
  EXPECT_EQ(error_of("[blades]\nlength_m = [-0.07, 0.15]\n"),
            "scene.toml:3: blades.length_m[0] = -0.07: must be 0.005..2 m");
  EXPECT_EQ(error_of("[texel]\nsize_m = -0.2\n"), "scene.toml:3: texel.size_m = -0.2: must be 0.01..10 m");
}

TEST(SceneErrors, RangeUpsideDown) {
  EXPECT_EQ(error_of("[blades]\nwidth_m = [0.004,\n  0.003]\n"),
            "scene.toml:4: blades.width_m[1] = 0.003: must not be less than the one before it, 0.004");
}

TEST(SceneErrors, WrongTypes) {
  EXPECT_EQ(error_of("[season]\nlength_days = \"60\"\n"),
            "scene.toml:3: season.length_days = \"60\": must be a number, 1..1000 days");
  EXPECT_EQ(error_of("[blades]\ncount = 3.5\n"),
            "scene.toml:3: blades.count = 3.5: must be a whole number, 1..100000 blades");
  EXPECT_EQ(error_of("[blades]\nlength_m = 0.1\n"),
            "scene.toml:3: blades.length_m = 0.1: must be a list of 2 numbers");
  EXPECT_EQ(error_of("[blades]\nlength_m = [0.1]\n"),
            "scene.toml:3: blades.length_m = [0.1]: must be a list of 2 numbers");
  EXPECT_EQ(error_of("[output]\npov = 1\n"), "scene.toml:3: output.pov = 1: must be true or false");
  EXPECT_EQ(error_of("seed = -1\n"),
            "scene.toml:2: seed = -1: must be a whole number, 0..9223372036854775807");
  EXPECT_EQ(error_of("season = 5\n"), "scene.toml:2: season = 5: must be a table, [season]");
  EXPECT_EQ(error_of("[still]\nname = \"a\"\n"),
            "scene.toml:2: still: must be a list of tables, each starting with [[still]]");
}

TEST(SceneErrors, UnknownKeySuggestsTheNearest) {
  EXPECT_EQ(error_of("[season]\nlenght_days = 60\n"),
            "scene.toml:3: season.lenght_days: unknown key; did you mean 'length_days'?");
  EXPECT_EQ(error_of("[saeson]\nlength_days = 60\n"),
            "scene.toml:2: saeson: unknown key; did you mean 'season'?");
  EXPECT_EQ(error_of(kStill + "fov = 30\n"),
            "scene.toml:5: still[0].fov: unknown key; did you mean 'fov_deg'?");
}

TEST(SceneErrors, UnknownKeyOfAnotherTableIsSentThere) {
  EXPECT_EQ(error_of("[blades]\nlength_days = 60\n"),
            "scene.toml:3: blades.length_days: unknown key; it belongs in [season]");
  EXPECT_EQ(error_of("[season]\nseed = 3\n"),
            "scene.toml:3: season.seed: unknown key; it belongs in the top of the file");
}

TEST(SceneErrors, TheFirstUnknownKeyInTheFileIsReported) {
  EXPECT_EQ(error_of("[season]\nzzz = 1\naaa = 2\n").rfind("scene.toml:3: season.zzz: unknown key", 0), 0u);
}

TEST(SceneErrors, UnknownWordSuggestsTheNearest) {
  EXPECT_EQ(error_of("[season]\nclimate = \"wet\"\n")
                .rfind("scene.toml:3: season.climate = \"wet\": must be \"standard\", \"water_rich\" or "
                       "\"cold\"; did you mean",
                       0),
            0u);
  EXPECT_NE(error_of("[blades]\nspecies = \"tall_fescu\"\n").find("did you mean \"tall_fescue\"?"),
            std::string::npos);
  EXPECT_NE(error_of("[view]\nlooks = [\"blade\"]\n")
                .find("view.looks[0] = \"blade\": must be \"texel\" or \"blades\""),
            std::string::npos);
}

TEST(SceneErrors, CurveNotMonotoneInTime) {
  EXPECT_EQ(error_of("[season]\nwater_curve = [[0, 1],\n [0.5, 0.6],\n [0.4, 0.3], [1, 0]]\n"),
            "scene.toml:5: season.water_curve[2] = [0.4, 0.3]: a curve's time must increase from key to "
            "key, but wd 0.4 comes after 0.5");
  EXPECT_NE(error_of("[season]\nwater_curve = [[0, 1], [0, 0.5]]\n").find("time must increase"),
            std::string::npos);
}

TEST(SceneErrors, CurveNotMonotoneInValue) {
  EXPECT_EQ(error_of("[season]\nchlorophyll_curve = [[0, 0.5], [1, 0.6]]\n"),
            "scene.toml:3: season.chlorophyll_curve[1] = [1, 0.6]: the curve must not rise, but 0.6 comes "
            "after 0.5");
  EXPECT_EQ(error_of("[[mingle]]\nageing = [[0, 0.5], [1, 0.4]]\n"),
            "scene.toml:3: mingle[0].ageing[1] = [1, 0.4]: the curve must not fall, but 0.4 comes after 0.5");
}

TEST(SceneErrors, CurveMalformed) {
  EXPECT_NE(error_of("[season]\nwater_curve = [[0, 1]]\n").find("at least 2 keys"), std::string::npos);
  EXPECT_NE(
      error_of("[season]\nwater_curve = [[0, 1], 3]\n").find("season.water_curve[1] = 3: must be a pair"),
      std::string::npos);
  EXPECT_NE(error_of("[season]\nwater_curve = [[0, 1.5], [1, 0]]\n")
                .find("season.water_curve[0][1] = 1.5: must be 0..1"),
            std::string::npos);
  EXPECT_NE(error_of("[season]\nwater_curve = [[0, 1], [2, 0]]\n")
                .find("season.water_curve[1][0] = 2: must be 0..1"),
            std::string::npos);
}

TEST(SceneErrors, FramesMustAscend) {
  EXPECT_EQ(error_of("[season]\nwd_frames = [0, 0.5, 0.5]\n"),
            "scene.toml:3: season.wd_frames[2] = 0.5: must be greater than the one before it, 0.5");
  EXPECT_EQ(error_of("[season]\nwd_frames = []\n"),
            "scene.toml:3: season.wd_frames = []: at least one key frame is needed");
}

TEST(SceneErrors, StillMustShowAKeyFrame) {
  EXPECT_EQ(error_of("[[still]]\nname = \"a\"\nwd = 0.5\n"),
            "scene.toml:4: still[0].wd = 0.5: must be one of season.wd_frames = [0, 0.3, 0.917]");
  EXPECT_EQ(error_of("[season]\nwd_frames = [0.5]\n[[still]]\nname = \"a\"\n"),
            "scene.toml:4: still[0].wd: must be one of season.wd_frames = [0.5]");
  EXPECT_EQ(error_of("[season]\nwd_frames_other_variants = [0.3]\n[texel]\nvariants = 2\n" + kStill),
            "scene.toml:8: still[0].wd = 0: must be one of season.wd_frames_other_variants = [0.3]");
}

TEST(SceneErrors, StillNames) {
  EXPECT_NE(error_of("[[still]]\nname = \"A b\"\n").find("scene.toml:3: still[0].name = \"A b\""),
            std::string::npos);
  EXPECT_NE(error_of("[[still]]\nwd = 0\n").find("scene.toml:2: still[0].name: a still needs a name"),
            std::string::npos);
  EXPECT_EQ(error_of(kStill + kStill),
            "scene.toml:6: still[1].name = \"a\": two stills must not have the same name");
}

TEST(SceneErrors, RunNameIsAFileName) {
  EXPECT_NE(error_of("name = \"../x\"\n").find("scene.toml:2: name = \"../x\""), std::string::npos);
}

TEST(SceneErrors, Terrain) {
  EXPECT_EQ(error_of("[terrain]\ntexels = [4, 4]\n"),
            "scene.toml:2: terrain.mesh: [terrain] needs a dem or a mesh");
  EXPECT_NE(error_of(kHill + "mesh = \"a.obj\"\n").find("not both"), std::string::npos);
  EXPECT_NE(error_of("[terrain]\ndem = \"a.PNG\"\n")
                .find("scene.toml:3: terrain.dem = \"a.PNG\": a PNG has no scale"),
            std::string::npos);
  EXPECT_NE(error_of(kHill + "crop = [0, 0.5, 1, 0.5]\n").find("scene.toml:4: terrain.crop"),
            std::string::npos);
  EXPECT_EQ(error_of(kHill + "lod_distance_m = [1, 1, 2]\n"),
            "scene.toml:4: terrain.lod_distance_m[1] = 1: must be greater than the one before it, 1");
  EXPECT_EQ(error_of(kHill + "texels = [10, 0]\n"),
            "scene.toml:4: terrain.texels[1] = 0: must be 1..1000 texels");
}

TEST(SceneErrors, TerrainWidthMustFitTheTexels) {
  EXPECT_EQ(error_of(kHill + "texels = [10, 10]\nwidth_m = 3\n"),
            "scene.toml:5: terrain.width_m = 3: must be texels[0] * texel.size_m = 2 m, or 0 for true size; "
            "leave it out to get that");
}

TEST(SceneErrors, ViewWithoutTerrainHasNoGroundHeight) {
  EXPECT_NE(error_of("[view]\ncamera_height_above_ground_m = 1.7\n")
                .find("scene.toml:3: view.camera_height_above_ground_m = 1.7: needs a [terrain]"),
            std::string::npos);
  EXPECT_NE(
      error_of("[view]\ncamera_m = [1, 2, 3]\nlook_at_m = [1, 2, 3]\n").find("scene.toml:4: view.look_at_m"),
      std::string::npos);
}

TEST(SceneErrors, TissueMustStiffenAsItDries) {
  EXPECT_EQ(error_of("[model]\nmodulus_vein_dry_MPa = 400\n"),
            "scene.toml:3: model.modulus_vein_dry_MPa = 400: tissue stiffens as it dries: must be greater "
            "than modulus_vein_fresh_MPa");
  EXPECT_NE(
      error_of("[model]\nvolume_strain_vein = -0.8\n").find("scene.toml:3: model.volume_strain_vein = -0.8"),
      std::string::npos);
}

TEST(SceneErrors, ResolutionMustBeAMultipleOf32) {
  EXPECT_EQ(error_of("[texel]\nresolution = 100\n"),
            "scene.toml:3: texel.resolution = 100: must be a multiple of 32 voxels");
}

TEST(SceneErrors, NotToml) {
  EXPECT_EQ(error_of("[season\n").rfind("scene.toml:2: not valid TOML: ", 0), 0u) << error_of("[season\n");
  EXPECT_EQ(error_of("seed = 1\nseed = 2\n").rfind("scene.toml:3: not valid TOML: ", 0), 0u)
      << error_of("seed = 1\nseed = 2\n");
}

TEST(SceneErrors, MissingFileIsAnIoFailure) {
  try {
    load_grass_scene("/nowhere/scene.toml");
    FAIL();
  } catch (const IoFailure& e) {
    EXPECT_EQ(std::string(e.what()).rfind("/nowhere/scene.toml: cannot open", 0), 0u);
  }
}

TEST(SceneErrors, Kind) {
  const SceneFile grass("");
  EXPECT_EQ(scene_kind(grass.path()), "grass");
  const SceneFile twice("kind = \"leaf\"\n");  // a key given twice is not TOML
  EXPECT_THROW(scene_kind(twice.path()), InvalidInput);
  EXPECT_THROW(print_defaults("leek"), InvalidInput);
}

}  // namespace
}  // namespace witherfield::scene
