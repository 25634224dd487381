// Keys of the terrain and the pictures: [terrain], [view], [[still]], [output]; and the whole scene.
#include <algorithm>
#include <cmath>

#include "sim/scene/head_keys.hpp"
#include "sim/scene/scene_keys.hpp"

namespace witherfield::scene {
namespace {

constexpr double kFarAway = 1e6;  // metres; nothing in a scene is farther

std::string frames_text(const std::vector<double>& frames) {
  std::string text = "[";
  for (const double wd : frames) text += (text.size() > 1 ? ", " : "") + number_text(wd);
  return text + "]";
}

bool contains(const std::vector<double>& frames, double wd) {
  return std::any_of(frames.begin(), frames.end(), [&](double f) { return std::abs(f - wd) < 1e-9; });
}

bool ends_with_png(std::string path) {
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return path.size() > 4 && path.compare(path.size() - 4, 4, ".png") == 0;
}

void describe_dem(KeyVisitor& v, terrain::TerrainOptions& t) {
  v.text({"dem", "Elevation model: GeoTIFF, ESRI ASCII grid or 16-bit PNG; relative to this file's folder"},
         t.dem, {});
  v.text({"mesh", "A mesh instead of a dem: OBJ or PLY, z up"}, t.mesh, {});
  v.check(t.dem.empty() ? "mesh" : "dem", t.dem.empty() != t.mesh.empty(), [&] {
    return t.dem.empty() ? "[terrain] needs a dem or a mesh" : "[terrain] takes a dem or a mesh, not both";
  });
  v.number({"png_elevation_per_unit_m", "Metres per grey level of a PNG"}, t.png_elevation_per_unit_m,
           {0, 1000, "m"});
  v.number({"png_cell_m", "Metres between the pixels of a PNG"}, t.png_cell_m, {0, 1e5, "m"});
  v.check("dem", !ends_with_png(t.dem) || (t.png_elevation_per_unit_m > 0 && t.png_cell_m > 0), [] {
    return "a PNG has no scale of its own: png_elevation_per_unit_m and png_cell_m must be greater than 0 m";
  });
  v.numbers({"crop", "Part used: x0, y0, x1, y1 as fractions of width and height, south = 0"}, t.crop, {0, 1},
            Order::any);
  v.check("crop", t.crop[0] < t.crop[2] && t.crop[1] < t.crop[3],
          [] { return "must be [x0, y0, x1, y1] with x0 < x1, y0 < y1"; });
}

}  // namespace

void describe_terrain(KeyVisitor& v, TerrainTable& table, const grass::TexelOptions& texel) {
  terrain::TerrainOptions& t = table.terrain;
  terrain::PlacementOptions& p = table.placement;
  describe_dem(v, t);
  int texels[2] = {p.cells_x, p.cells_y};
  v.wholes({"texels", "Texels east-west and north-south"}, texels, {1, 1000, "texels"});
  p.cells_x = texels[0];
  p.cells_y = texels[1];
  const double tiled_width = p.cells_x * texel.size_m;
  if (v.reading() && !v.given("width_m")) t.width_m = tiled_width;
  v.number({"width_m",
            "East-west extent in the scene: texels[0] * texel.size_m if left out; 0 = true size (which must "
            "then be that)"},
           t.width_m, {0, 1e5, "m"});
  v.check("width_m", t.width_m == 0 || std::abs(t.width_m - tiled_width) <= 1e-6 * tiled_width, [&] {
    return "must be texels[0] * texel.size_m = " + number_text(tiled_width) +
           " m, or 0 for true size; leave it out to get that";
  });
  v.number({"vertical_exaggeration", "On top of the horizontal scale"}, t.vertical_exaggeration, {0.01, 100});
  v.numbers({"lod_distance_m",
             "Texels nearer to the camera than these are shown at full, half, quarter resolution; beyond: an "
             "eighth"},
            p.lod_distance_m, {0, kFarAway, "m"}, Order::ascending);
  double heights[2] = {p.height_scale_lo, p.height_scale_hi};
  v.numbers({"height_scale", "Heights of the texels are stretched at random between these"}, heights,
            {0.1, 3}, Order::not_falling);
  p.height_scale_lo = heights[0];
  p.height_scale_hi = heights[1];
  v.number({"patchiness", "0 = variants stand at random, 1 = in patches of the same variant"}, p.patchiness,
           {0, 1});
  v.number({"patch_m", "Size of the patches"}, p.patch_m, {0, 1e5, "m", true});
}

void describe_view(KeyVisitor& v, Still& still, bool terrain) {
  v.texts({"looks", "\"texel\" = volume of the texels, \"blades\" = the blades themselves"}, still.looks,
          {"texel", "blades"});
  v.check("looks", !still.looks.empty(), [] { return "at least one look is needed"; });
  int size[2] = {still.width_px, still.height_px};
  v.wholes({"size_px", "Width and height of the picture"}, size, {16, 16384, "pixels"});
  still.width_px = size[0];
  still.height_px = size[1];
  Camera& c = still.camera;
  const Limits place{-kFarAway, kFarAway, "m"};
  v.numbers({"camera_m", "Position of the camera: x east, y north, z up from the terrain's lowest point"},
            {&c.position_m.x, 3}, place, Order::any);
  v.optional_number({"camera_height_above_ground_m",
                     "If given, replaces camera_m's z: height above the terrain below the camera"},
                    c.height_above_ground_m, {0, kFarAway, "m", true}, 1.7);
  v.check("camera_height_above_ground_m", terrain || !c.height_above_ground_m,
          [] { return "needs a [terrain]; without one the ground is z = 0 m, so state z in camera_m"; });
  v.numbers({"look_at_m", "Point in the middle of the picture"}, {&c.look_at_m.x, 3}, place, Order::any);
  v.check("look_at_m", c.position_m != c.look_at_m || c.height_above_ground_m.has_value(),
          [] { return "must differ from camera_m"; });
  v.number({"fov_deg", "Horizontal field of view"}, c.fov_deg, {5, 120, "deg"});
  v.number({"aperture_m", "Aperture for depth of field (blades only); 0 = all sharp"}, c.aperture_m,
           {0, 1, "m"});
  v.number({"focus_m", "Distance of sharpness; 0 = that of look_at_m"}, c.focus_m, {0, kFarAway, "m"});
  v.number({"sun_azimuth_deg", "Direction of the sun, counter-clockwise from east"}, still.sun.azimuth_deg,
           {0, 360, "deg"});
  v.number({"sun_elevation_deg", "Height of the sun"}, still.sun.elevation_deg, {5, 90, "deg"});
  v.number({"turbidity", "Haze of the sky: 2 = clear, 8 = hazy"}, still.sun.turbidity, {2, 8});
  v.number({"exposure", "Factor on the light before tone mapping"}, still.exposure, {0.05, 20});
}

void describe_still(KeyVisitor& v, std::vector<Still>& stills, std::size_t index, const SceneTables& s) {
  Still& still = stills[index];
  v.text({"name", "File name of the picture: letters a-z, digits and _"}, still.name, {});
  check_still_name(v, still.name);
  v.check("name",
          std::none_of(stills.begin(), stills.begin() + std::ptrdiff_t(index),
                       [&](const Still& o) { return o.name == still.name; }),
          [] { return "two stills must not have the same name"; });
  v.number({"wd", "Key frame shown, one of season.wd_frames"}, still.wd, {0, 1});
  const std::vector<double>& others = s.grass.wd_frames_other_variants;
  v.check("wd", contains(s.grass.wd_frames, still.wd),
          [&] { return "must be one of season.wd_frames = " + frames_text(s.grass.wd_frames); });
  v.check("wd", s.grass.variants == 1 || others.empty() || contains(others, still.wd),
          [&] { return "must be one of season.wd_frames_other_variants = " + frames_text(others); });
  describe_view(v, still, s.terrain.has_value());
}

void describe_output(KeyVisitor& v, OutputOptions& o) {
  v.flag({"fields", "Write texel/*.vti and grass.pvd (water, chlorophyll, stress, strain ...)"}, o.fields);
  v.flag({"optics", "Write optics/*.vti and grass_optics.pvd (normal, tangent, diffuse, specular)"},
         o.optics);
  v.flag({"points", "Write points/*.vtp and grass_points.pvd"}, o.points);
  v.flag({"blades", "Write blades/*.vtp and grass_blades.pvd: the blades as meshes"}, o.blades);
  v.text({"other_variants", "Which of these are written of the texel's variants but the first"}, o.other_variants,
         {"all", "fields", "none"});
  v.flag({"pov", "Write the POV-Ray scenes of the stills"}, o.pov);
  v.text({"compression", "Of the VTK files: fast, or small"}, o.compression, {"lz4", "zlib"});
}

void describe_scene(KeyVisitor& v, SceneTables& s) {
  v.text({"kind", "What is simulated"}, s.kind, {"grass"});
  describe_head(v, s.name, s.seed);
  v.table({"season", "Time: the season, and how water and chlorophyll fall"},
          [&](KeyVisitor& t) { describe_season(t, s.grass); });
  v.table({"texel", "The 3-D array that the grass of one tile of ground is put into"},
          [&](KeyVisitor& t) { describe_texel(t, s.grass); });
  v.table({"model", "Mechanics, tissue, pigments, points"}, [&](KeyVisitor& t) { describe_model(t, s); });
  v.table({"blades", "The grass blades"}, [&](KeyVisitor& t) { describe_blades(t, s.blades); });
  v.tables(
      {"mingle",
       "Samples that share the tile, each with its own blades and ageing. What an entry leaves out is as in "
       "[blades] and [season]"},
      s.mingle.size(),
      [&](std::size_t n) {
        s.mingle.resize(n, {s.blades, s.grass.season, {}});
      },
      [&](KeyVisitor& t, std::size_t i) { describe_sample(t, s.mingle[i]); });
  v.optional_table(
      {"terrain", "Ground that the texels stand on; without it a single texel stands on flat ground"},
      s.terrain.has_value(), [&] { s.terrain.emplace(); },
      [&](KeyVisitor& t) { describe_terrain(t, *s.terrain, s.grass.texel); });
  v.table({"view", "Camera, sun and size that all stills start from"},
          [&](KeyVisitor& t) { describe_view(t, s.view, s.terrain.has_value()); });
  v.tables(
      {"still", "A picture. What an entry leaves out is as in [view]"}, s.stills.size(),
      [&](std::size_t n) { s.stills.resize(n, s.view); },
      [&](KeyVisitor& t, std::size_t i) { describe_still(t, s.stills, i, s); });
  v.table({"output", "What a run writes"}, [&](KeyVisitor& t) { describe_output(t, s.output); });
}

}  // namespace witherfield::scene
