#include "sim/scene/fruit_keys.hpp"

#include <algorithm>
#include <cmath>

#include "sim/scene/head_keys.hpp"
#include "sim/scene/object_keys.hpp"

namespace witherfield::scene {
namespace {

using namespace fruit;

constexpr Named<Scheme> kSchemes[] = {{"liu2007", Scheme::liu2007}, {"hoppe1994", Scheme::hoppe1994}};
constexpr Named<Crown> kCrowns[] = {{"dent", Crown::dent}, {"flint", Crown::flint}};
constexpr Named<Arrangement> kArrangements[] = {
    {"spiral", Arrangement::spiral}, {"rows", Arrangement::rows}, {"cells", Arrangement::cells}};

const ObjectChoices kChoices{{"whole", "subdivision"},
                             {"stem", "wedge", "kernel", "glume", "lemma", "awn", "cob", "cob_bump", "shank",
                              "body", "sepal", "style"}};

constexpr Limits mm(double lo, double hi) {
  return {lo, hi, "mm"};
}

void describe_wheat(KeyVisitor& v, WheatOptions& w) {
  v.whole({"spikelets", "Alternately in the front and the back row; 17 to 24 in the field"}, w.spikelets,
          {2, 60});
  v.whole({"kernels_per_spikelet", "In the order 0, 1, 3, 2, 4 from the middle outwards"},
          w.kernels_per_spikelet, {1, 5});
  v.number({"ear_length_mm", "Of the stepped part of the shank"}, w.ear_length_mm, mm(20, 300));
  v.number({"stem_length_mm", "Of the cylinder below the ear"}, w.stem_length_mm, mm(1, 300));
  v.number({"stem_radius_mm", "Radius of the stem"}, w.stem_radius_mm, mm(0.2, 5));
  v.number({"kernel_length_mm", "Harvest-dry kernel, along its axis"}, w.kernel_length_mm, mm(2, 15));
  v.number({"kernel_width_mm", "Harvest-dry kernel, across"}, w.kernel_width_mm, mm(1, 8));
  v.number({"kernel_thickness_mm", "Harvest-dry kernel, front to back"}, w.kernel_thickness_mm, mm(1, 8));
  v.flag({"husks", "Glumes and lemmas around the kernels"}, w.husks);
  v.number({"gape_deg", "How far the ripe husks open"}, w.gape_deg, {0, 30, "deg"});
  v.flag({"awns", "The bristles of bearded wheat"}, w.awns);
  v.number({"awn_length_mm", "Of the longest awns; typically 40 to 100"}, w.awn_length_mm, mm(1, 200));
  v.number({"awn_root_radius_mm", "Typically 0.15 to 0.3; Liu et al. 2007: 0.7"}, w.awn_root_radius_mm,
           mm(0.02, 2));
  v.number({"awn_tip_radius_mm", "Typically 0.02; Liu et al. 2007: 0.07"}, w.awn_tip_radius_mm, mm(0.002, 2));
  v.number({"awn_start", "Radii of the awns at wd 0 over those at wd 1: below 1 they thicken in time"},
           w.awn_start, {0.05, 1});
  v.number({"nod_deg", "How far the ripe ear hangs over sideways"}, w.nod_deg, {0, 60, "deg"});
  v.number({"variation", "Scale of the differences between kernels; 0 = all alike"}, w.variation, {0, 2});
}

void describe_maize(KeyVisitor& v, MaizeOptions& m) {
  v.whole({"rows", "Even; 14 to 20 in the field"}, m.rows, {4, 40});
  v.check("rows", m.rows % 2 == 0, [] { return "rows stand in pairs: must be even"; });
  v.whole({"kernels_per_row", "40 to 44 in the field"}, m.kernels_per_row, {4, 80});
  v.number({"ear_length_mm", "Of the ear"}, m.ear_length_mm, mm(40, 400));
  v.number({"cob_diameter_mm", "Of the bare cob at its widest"}, m.cob_diameter_mm, mm(8, 80));
  v.number({"kernel_length_mm", "Swollen kernel, from the cob outwards"}, m.kernel_length_mm, mm(3, 25));
  v.number({"ratio_upper", "Length over width of a kernel's cross-section near the tip (UPSEEDSCALE)"},
           m.ratio_upper, {1, 3});
  v.number({"ratio_middle", "The same half-way up (MIDSEEDSCALE)"}, m.ratio_middle, {1, 3});
  v.number({"ratio_lower", "The same near the base (LOWSEEDSCALE)"}, m.ratio_lower, {1, 3});
  choice(v, {"crown", "The kernel's outer end: sinks in as it dries, or stays round"}, m.crown, kCrowns);
  v.flag({"kernels", "false: the bare cob"}, m.kernels);
  v.number({"variation", "Scale of the differences between kernels; 0 = all alike"}, m.variation, {0, 2});
}

void colour(KeyVisitor& v, const Key& key, Srgb& c) {
  double levels[3] = {c.r, c.g, c.b};
  v.numbers(key, levels, {0, 255, "sRGB levels"}, Order::any);
  c = {levels[0], levels[1], levels[2]};
}

void describe_planted(KeyVisitor& v, PlantedOptions& p) {
  v.pairs({"body_profile_mm", "Outline of the body: [height, radius] from the base up; not used with a mesh"},
          p.body_profile_mm, mm(0, 1000), mm(0, 500));
  choice(v, {"arrangement", "Golden-angle spiral, whorls, or one grain per face of the mesh"}, p.arrangement,
         kArrangements);
  v.whole({"grains", "Number of grains; the arrangement \"cells\" takes one per face"}, p.grains, {1, 20000});
  v.number({"grain_length_mm", "Of a grain, outward"}, p.grain_length_mm, mm(0.1, 100));
  v.number({"grain_width_mm", "Of a grain, around the fruit"}, p.grain_width_mm, mm(0.1, 100));
  v.number({"grain_thickness_mm", "Of a grain, along the fruit"}, p.grain_thickness_mm, mm(0.1, 100));
  v.flag({"grain_pointed", "The grain's outer end is a sharp vertex"}, p.grain_pointed);
  v.number({"sink", "Share of a grain's length below the body's surface"}, p.sink, {0, 0.95});
  v.number({"lean_deg", "Of the grains toward the upper end"}, p.lean_deg, {-80, 80, "deg"});
  v.number({"shrink_dry", "Linear shrinkage of the grains at wd 1"}, p.shrink_dry, {0, 0.5});
  v.flag({"calyx", "Five sepals and a stalk at the base"}, p.calyx);
  v.number({"style_length_mm", "Of the dry hair on each grain; 0 = none"}, p.style_length_mm, mm(0, 50));
  colour(v, {"unripe", "Grains at wd 0"}, p.unripe);
  colour(v, {"turning", "Grains at turning_wd"}, p.turning);
  colour(v, {"ripe", "Grains at wd 1"}, p.ripe);
  v.number({"turning_wd", "wd of the colour `turning`"}, p.turning_wd, {0.05, 0.95});
  colour(v, {"body", "The body between the grains"}, p.body);
  v.number({"variation", "Scale of the differences between grains; 0 = all alike"}, p.variation, {0, 2});
}

void describe_ripening(KeyVisitor& v, RipeningOptions& r, std::vector<double>& frames) {
  v.number({"length_days", "From wd 0 (milk stage) to wd 1 (harvest-dry)"}, r.length_days, {1, 365, "days"});
  v.number({"start_day", "Days after flowering at wd 0"}, r.start_day, {0, 200, "days"});
  v.list({"wd_frames", "Key frames that are written"}, frames, {0, 1}, Order::ascending);
  v.check("wd_frames", !frames.empty(), [] { return "at least one key frame is needed"; });
  v.pairs({"moisture_curve",
           "Own course of the kernels' moisture (wet basis) over days after flowering; empty = the crop's"},
          r.moisture_curve, {0, 600, "days"}, {0, 0.95});
  v.curve({"pigment_curve",
           "Own course of ripeness, 0 = green, 1 = ripe, [[wd, ripeness], ...]; empty = default"},
          r.pigment_curve, {0, 1}, Shape::rising);
  v.number({"spread", "Between kernels, a standard deviation in wd"}, r.spread, {0, 0.3});
  v.flag({"shrink", "Kernels change their size with their moisture, as measured"}, r.shrink);
}

void describe_mesh(KeyVisitor& v, FruitScene& s) {
  v.text({"mesh",
          "A control mesh of your own (OBJ, PLY, OFF, STL, VTP), relative to this file's folder: the fruit "
          "of crop "
          "= \"mesh\", the body of crop = \"planted\""},
         s.mesh_file, {});
  v.check("mesh", s.fruit.crop != "mesh" || !s.mesh_file.empty(),
          [] { return "crop = \"mesh\" needs the name of a mesh file"; });
  v.number({"mesh_unit_mm", "Length of the mesh file's unit, where the file does not state one"},
           s.mesh_unit_mm, {1e-6, 1e6, "mm"});
  v.number({"mesh_crease_angle_deg", "Edges of the mesh sharper than this become creases; 0 = none"},
           s.fruit.mesh_crease_angle_deg, {0, 180, "deg"});
  CurveKeys edges(s.mesh_creases.begin(), s.mesh_creases.end());
  v.pairs({"mesh_creases", "Crease edges of the mesh as pairs of vertex numbers, from 0"}, edges, {0, 1e9},
          {0, 1e9});
  const auto whole = [](double x) { return x == std::floor(x); };
  v.check("mesh_creases",
          std::all_of(edges.begin(), edges.end(),
                      [&](const auto& e) { return whole(e.first) && whole(e.second); }),
          [] { return "vertex numbers must be whole numbers"; });
  s.mesh_creases.assign(edges.begin(), edges.end());
  std::vector<double> sharp(s.mesh_sharp.begin(), s.mesh_sharp.end());
  v.list({"mesh_sharp", "Sharp vertices of the mesh, numbered from 0"}, sharp, {0, 1e9}, Order::any);
  v.check("mesh_sharp", std::all_of(sharp.begin(), sharp.end(), whole),
          [] { return "vertex numbers must be whole numbers"; });
  s.mesh_sharp.assign(sharp.begin(), sharp.end());
}

}  // namespace

void describe_object_output(KeyVisitor& v, ObjectOutput& o) {
  v.flag({"fields", "Write .vtp files of every key frame and their series, .pvd"}, o.fields);
  v.flag({"obj", "Write .obj files, for modelling programs"}, o.obj);
  v.flag({"ply", "Write .ply files, with colours and all fields"}, o.ply);
  v.flag({"every_frame", "Write .obj and .ply of every key frame, not of the last one only: they are large"},
         o.every_frame);
  v.flag({"pov", "Write the POV-Ray scenes of the stills"}, o.pov);
  v.text({"compression", "Of the VTK files: fast, or small"}, o.compression, {"lz4", "zlib"});
}

void describe_fruit_scene(KeyVisitor& v, FruitTables& t) {
  FruitScene& s = t.scene;
  FruitOptions& o = s.fruit;
  v.text({"kind", "What is simulated"}, t.kind, {"fruit"});
  describe_head(v, s.name, o.seed);
  const std::string before = o.crop;
  v.text({"crop", "Which fruit"}, o.crop, crop_names());
  if (v.reading() && o.crop != before) {
    const std::uint64_t seed = o.seed;
    o = crop_preset(o.crop);
    o.seed = seed;
  }
  choice(v, {"scheme", "Rules of subdivision: Liu et al. 2007, or the complete ones of Hoppe et al. 1994"},
         o.scheme, kSchemes);
  v.whole({"steps", "Of subdivision: each makes four triangles of one"}, o.steps, {0, 4});
  describe_mesh(v, s);
  v.table({"ripening", "Time: days, water, pigments"},
          [&](KeyVisitor& k) { describe_ripening(k, o.ripening, o.frames); });
  v.table({"wheat", "The wheat ear, crop = \"wheat\""}, [&](KeyVisitor& k) { describe_wheat(k, o.wheat); });
  v.table({"maize", "The maize ear, crop = \"maize\""}, [&](KeyVisitor& k) { describe_maize(k, o.maize); });
  v.table(
      {"planted", "Any fruit of many grains on a body, crop = \"planted\"; the defaults make a raspberry"},
      [&](KeyVisitor& k) { describe_planted(k, o.planted); });
  if (v.reading()) t.view.wd = {o.frames.back()};
  v.table({"view", "Camera, light and size that all stills start from"},
          [&](KeyVisitor& k) { describe_object_view(k, t.view, kChoices, o.frames); });
  v.tables(
      {"still", "A picture. What an entry leaves out is as in [view]"}, s.stills.size(),
      [&](std::size_t n) { s.stills.resize(n, t.view); },
      [&](KeyVisitor& k, std::size_t i) { describe_object_still(k, s.stills, i, kChoices, o.frames); });
  v.table({"output", "What a run writes"}, [&](KeyVisitor& k) { describe_object_output(k, s.output); });
}

}  // namespace witherfield::scene
