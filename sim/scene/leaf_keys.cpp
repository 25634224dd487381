// Keys of a leaf: the top, [margin], [mesh], [veins], [pose], [edit], [wilt], [view], [[still]], [output].
#include "sim/scene/leaf_keys.hpp"

#include "sim/scene/fruit_keys.hpp"
#include "sim/scene/head_keys.hpp"
#include "sim/scene/object_keys.hpp"

namespace witherfield::scene {
namespace {

using namespace leaf;

constexpr Named<LeafSource> kSources[] = {
    {"veins", LeafSource::veins}, {"points", LeafSource::points}, {"mesh", LeafSource::mesh}};
constexpr Named<EditMode> kModes[] = {{"linear", EditMode::linear},
                                      {"rotation_aware", EditMode::rotation_aware}};
const ObjectChoices kChoices{{"whole", "stages", "handles"}, {"blade", "petiole", "stem"}};

void describe_top(KeyVisitor& v, LeafScene& s) {
  LeafOptions& o = s.leaf;
  v.preset({"species", "Proportions of the veins, margin, mesh and pose to start from"}, species_names(), "",
           [&](const std::string& name) {
             const std::uint64_t seed = o.seed;
             o = species_preset(name);
             o.seed = seed;
           });
  choice(v, {"source", "Where the outline comes from: the veins' proportions, measured points, or any mesh"},
         o.source, kSources);
  v.number({"main_vein_m", "Length of the main vein: the one number that the veins' proportions need"},
           o.main_vein_m, {0.01, 1, "m"});
  v.number({"variation", "Share of the reconstructed intervals of ratios and angles that is drawn from"},
           o.variation, {0, 1});
  v.number({"asymmetry", "0: both halves alike, 1: drawn apart"}, o.asymmetry, {0, 1});
  v.text({"points",
          "CSV of group,x,y[,z] with group = left, right, midrib, or JSON; source = \"veins\": an outline set by hand"},
         o.points_file, {});
  v.text({"points_unit", "Unit of its numbers (a JSON file may state its own)"}, s.points_unit, {"m", "cm", "mm"});
  v.text({"mesh_file", "source = \"mesh\": OBJ, PLY, OFF, STL or VTP"}, o.mesh_file, {});
  v.check("points", o.source != LeafSource::points || !o.points_file.empty(),
          [] { return "source = \"points\" needs the name of a file"; });
  v.check("mesh_file", o.source != LeafSource::mesh || !o.mesh_file.empty(),
          [] { return "source = \"mesh\" needs the name of a file"; });
  v.number({"mesh_unit_mm", "Length of the mesh file's unit, where the file does not state one"},
           s.mesh_unit_mm, {1e-6, 1e6, "mm"});
  v.number({"reference_area_m2", "Area to report the error against; 0 = none"}, o.reference_area_m2,
           {0, 10, "m2"});
  v.number({"petiole_m", "Length of the petiole; 0 = none"}, o.petiole_m, {0, 1, "m"});
  v.number({"petiole_radius_m", "Radius of the petiole"}, o.petiole_radius_m, {1e-4, 0.05, "m"});
  v.number({"petiole_angle_deg", "Below the direction of the blade's base"}, o.petiole_angle_deg,
           {-90, 170, "deg"});
  v.number({"chlorophyll_fresh_ug_cm2", "Chlorophyll a + b"}, o.chlorophyll_fresh_ug_cm2, {1, 120, "ug/cm2"});
}

void describe_mesh(KeyVisitor& v, MeshOptions& m) {
  v.number({"outline_spacing_m", "Between the samples of the splines"}, m.outline_spacing_m,
           {1e-4, 0.05, "m"});
  v.number({"edge_m", "Longest edge wanted inside the blade"}, m.edge_m, {2e-4, 0.05, "m"});
  v.number({"vein_edge_m", "Longest edge wanted near veins"}, m.vein_edge_m, {1e-4, 0.05, "m"});
  v.number({"growth", "How fast edges may grow away from what is fine"}, m.growth, {0.05, 2, "m/m"});
  v.whole({"max_vertices", "More is an error"}, m.max_vertices, {100, 2000000, "vertices"});
}

void describe_pose(KeyVisitor& v, PoseOptions& p) {
  v.flag({"apply", "false: the flat leaf"}, p.apply);
  v.number({"midrib_rise_deg", "Slope of the midrib where the petiole ends"}, p.midrib_rise_deg,
           {-80, 80, "deg"});
  v.number({"midrib_bend_deg", "By how much the midrib turns downward"}, p.midrib_bend_deg,
           {-180, 180, "deg"});
  v.number({"fold_deg", "By how much each half rises from the midrib"}, p.fold_deg, {-80, 80, "deg"});
  v.number({"droop_deg", "By how much each half bends down toward the margin"}, p.droop_deg,
           {-180, 180, "deg"});
  v.number({"waviness", "Height of the margin's waves over the main vein's length"}, p.waviness, {0, 0.3});
  v.whole({"waves", "Around the margin"}, p.waves, {0, 40});
  v.number({"pucker_m", "Bulge of the blade between side veins"}, p.pucker_m, {0, 0.02, "m"});
  v.number({"fine_pucker_m", "Bulge between the veins of the net"}, p.fine_pucker_m, {0, 0.01, "m"});
  v.number({"vein_groove_m", "Depth of the main vein's groove"}, p.vein_groove_m, {0, 0.005, "m"});
}

void describe_edit(KeyVisitor& v, EditOptions& e) {
  choice(v, {"mode", "Miao et al.'s linear Laplacian editing, or with rotations"}, e.mode, kModes);
  v.number({"smoothness", "Resistance of the rotation-aware mode against bending"}, e.smoothness, {0, 10});
  v.whole({"max_iterations", "Of the rotation-aware mode for each key"}, e.max_iterations, {1, 100000});
  v.number({"tolerance", "Ends it: largest movement in an iteration over the leaf's size"}, e.tolerance,
           {1e-14, 0.1});
  v.tables(
      {"handle", "A place of the leaf that is held or dragged"}, e.handles.size(),
      [&](std::size_t n) { e.handles.resize(n); },
      [&](KeyVisitor& k, std::size_t i) {
        HandleOptions& h = e.handles[i];
        k.text({"name", "For messages"}, h.name, {});
        k.flag({"by_uv", "Picked by texture coordinates; false: by the vertex nearest to point_m"}, h.by_uv);
        k.numbers({"uv", "Texture coordinates"}, {&h.uv.x, 2}, {0, 1}, Order::any);
        k.numbers({"point_m", "A place in the natural pose"}, {&h.point_m.x, 3}, {-10, 10, "m"}, Order::any);
        k.number({"radius_m", "What of the leaf moves with it; 0 = one vertex"}, h.radius_m, {0, 1, "m"});
        k.number({"weight", "How hard it is held, linear mode"}, h.weight, {0.01, 1e6});
      });
  v.tables(
      {"key", "A key frame of the edit"}, e.keys.size(), [&](std::size_t n) { e.keys.resize(n); },
      [&](KeyVisitor& k, std::size_t i) {
        EditKey& key = e.keys[i];
        k.text({"name", "For messages"}, key.name, {});
        std::vector<double> flat;
        for (const glm::dvec3& m : key.move_m) flat.insert(flat.end(), {m.x, m.y, m.z});
        k.list({"move_m", "x, y, z of each handle's displacement from the natural pose, one after the other"},
               flat, {-10, 10, "m"}, Order::any);
        k.check("move_m", !k.reading() || flat.size() == 3 * e.handles.size(), [&] {
          return "must have 3 numbers for each of the " + std::to_string(e.handles.size()) + " handles";
        });
        key.move_m.clear();
        for (std::size_t m = 0; m + 2 < flat.size(); m += 3)
          key.move_m.push_back({flat[m], flat[m + 1], flat[m + 2]});
      });
}

}  // namespace

void describe_leaf_scene(KeyVisitor& v, LeafTables& t) {
  LeafScene& s = t.scene;
  LeafOptions& o = s.leaf;
  v.text({"kind", "What is simulated"}, t.kind, {"leaf"});
  describe_head(v, s.name, o.seed);
  describe_top(v, s);
  v.table({"margin", "Teeth of the outline"}, [&](KeyVisitor& k) {
    k.number({"tooth_spacing_m", "Along the outline"}, o.margin.tooth_spacing_m, {0.001, 0.1, "m"});
    k.number({"tooth_depth_m", "From sinus to tip; 0 = entire margin"}, o.margin.tooth_depth_m,
             {0, 0.02, "m"});
    k.number({"tooth_lean", "0 symmetric, 1 sawtooth toward the lobe's tip"}, o.margin.tooth_lean, {0, 1});
    k.number({"irregularity", "Spread of spacing and depth"}, o.margin.irregularity, {0, 0.9});
  });
  v.table({"mesh", "Triangles"}, [&](KeyVisitor& k) { describe_mesh(k, o.mesh); });
  v.table({"veins", "Veins"}, [&](KeyVisitor& k) {
    k.number({"main_width_m", "Of the main vein at its base"}, o.veins.main_width_m, {1e-4, 0.02, "m"});
    k.number({"side_spacing", "Of side veins, over the main vein's length"}, o.veins.side_spacing,
             {0.03, 0.5});
    k.number({"side_angle_deg", "Between a side vein and its main vein"}, o.veins.side_angle_deg,
             {15, 85, "deg"});
    k.number({"net_spacing_m", "Cells of the net of fine veins; 0 = no net"}, o.veins.net_spacing_m,
             {0, 0.05, "m"});
  });
  v.table({"pose", "The pose of the living leaf"}, [&](KeyVisitor& k) { describe_pose(k, o.pose); });
  v.table({"edit", "Deformed by hand: handles and where they go"},
          [&](KeyVisitor& k) { describe_edit(k, o.edit); });
  v.optional_table(
      {"wilt", "The leaf wilts by itself"}, o.wilts, [&] { o.wilts = true; },
      [&](KeyVisitor& k) { describe_wilt(k, o.wilt); });
  t.view.wd = {v.reading() ? 0.0 : t.view.wd.front()};
  v.table({"view", "Camera, light and size that all stills start from"},
          [&](KeyVisitor& k) { describe_object_view(k, t.view, kChoices, {}); });
  v.tables(
      {"still", "A picture. What an entry leaves out is as in [view]"}, s.stills.size(),
      [&](std::size_t n) { s.stills.resize(n, t.view); },
      [&](KeyVisitor& k, std::size_t i) { describe_object_still(k, s.stills, i, kChoices, {}); });
  v.table({"output", "What a run writes"}, [&](KeyVisitor& k) { describe_object_output(k, s.output); });
}

}  // namespace witherfield::scene
