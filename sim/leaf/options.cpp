#include "sim/leaf/options.hpp"

#include <cmath>
#include <sstream>

#include "sim/core/errors.hpp"

namespace witherfield::leaf {
namespace {

void require(const std::string& name, double value, double lo, double hi, const char* unit = "") {
  if (value >= lo && value <= hi) return;
  std::ostringstream s;
  s << name << " = " << value << " is outside " << lo << ".." << hi;
  if (*unit) s << ' ' << unit;
  throw InvalidInput(s.str());
}

[[noreturn]] void unknown_species(const std::string& name) {
  std::string known;
  for (const std::string& n : species_names()) known += (known.empty() ? "" : ", ") + n;
  throw InvalidInput("species = '" + name + "' is unknown; known: " + known);
}

void validate(const MarginOptions& m) {
  require("margin.tooth_spacing_m", m.tooth_spacing_m, 0.001, 0.1, "m");
  require("margin.tooth_depth_m", m.tooth_depth_m, 0, 0.02, "m");
  require("margin.tooth_lean", m.tooth_lean, 0, 1);
  require("margin.irregularity", m.irregularity, 0, 0.9);
  if (m.tooth_depth_m > 0.7 * m.tooth_spacing_m)
    throw InvalidInput("margin.tooth_depth_m = " + std::to_string(m.tooth_depth_m) +
                       " m is more than 0.7 of margin.tooth_spacing_m = " + std::to_string(m.tooth_spacing_m) +
                       " m: such teeth would cross");
}

void validate(const MeshOptions& m) {
  require("mesh.outline_spacing_m", m.outline_spacing_m, 1e-4, 0.05, "m");
  require("mesh.edge_m", m.edge_m, 2e-4, 0.05, "m");
  require("mesh.vein_edge_m", m.vein_edge_m, 1e-4, 0.05, "m");
  require("mesh.growth", m.growth, 0.05, 2, "m/m");
  require("mesh.max_vertices", m.max_vertices, 100, 2000000);
}

void validate(const PoseOptions& p) {
  require("pose.midrib_rise_deg", p.midrib_rise_deg, -80, 80, "deg");
  require("pose.midrib_bend_deg", p.midrib_bend_deg, -180, 180, "deg");
  require("pose.fold_deg", p.fold_deg, -80, 80, "deg");
  require("pose.droop_deg", p.droop_deg, -180, 180, "deg");
  require("pose.waviness", p.waviness, 0, 0.3);
  require("pose.waves", p.waves, 0, 40);
  require("pose.pucker_m", p.pucker_m, 0, 0.02, "m");
  require("pose.fine_pucker_m", p.fine_pucker_m, 0, 0.01, "m");
  require("pose.vein_groove_m", p.vein_groove_m, 0, 0.005, "m");
}

void validate(const EditOptions& e) {
  require("edit.smoothness", e.smoothness, 0, 10);
  require("edit.max_iterations", e.max_iterations, 1, 100000);
  require("edit.tolerance", e.tolerance, 1e-14, 0.1);
  for (std::size_t i = 0; i < e.handles.size(); ++i) {
    const std::string at = "edit.handles[" + std::to_string(i) + "].";
    require(at + "uv[0]", e.handles[i].uv.x, 0, 1);
    require(at + "uv[1]", e.handles[i].uv.y, 0, 1);
    require(at + "radius_m", e.handles[i].radius_m, 0, 1, "m");
    require(at + "weight", e.handles[i].weight, 0.01, 1e6);
  }
  if (!e.keys.empty() && e.handles.empty())
    throw InvalidInput("edit.keys: there are key frames, but edit.handles names no handle");
  for (std::size_t i = 0; i < e.keys.size(); ++i) {
    const std::string at = "edit.keys[" + std::to_string(i) + "].move_m";
    if (e.keys[i].move_m.size() != e.handles.size())
      throw InvalidInput(at + " has " + std::to_string(e.keys[i].move_m.size()) + " moves for " +
                         std::to_string(e.handles.size()) + " handles");
    for (const glm::dvec3& m : e.keys[i].move_m)
      for (int a = 0; a < 3; ++a) require(at, m[a], -10, 10, "m");
  }
}

}  // namespace

LeafOptions species_preset(const std::string& name, double main_vein_m) {
  LeafOptions o;
  o.species = name;
  if (name == "watermelon") {
    o.main_vein_m = 0.14;
    o.margin = {0.011, 0.0007, 0.3, 0.5};  // nearly entire: shallow, far between
    o.pose = {true, 22, 62, 14, 34, 0.045, 9, 0.0011, 0.00022, 0.00035};
    o.veins = {0.0019, 0.13, 46, 0.0056};
    o.petiole_m = 0.07;
    o.petiole_radius_m = 0.0016;
    o.chlorophyll_fresh_ug_cm2 = 46;
  } else if (name != "cucumber") {
    unknown_species(name);
  }
  if (main_vein_m > 0) {
    // What is a length in the plant grows with the leaf; teeth and net cells grow more slowly (there are more of them).
    const double scale = main_vein_m / o.main_vein_m, half = std::sqrt(scale);
    o.main_vein_m = main_vein_m;
    o.petiole_m *= scale;
    o.petiole_radius_m *= half;
    o.margin.tooth_spacing_m *= half;
    o.margin.tooth_depth_m *= half;
    o.veins.main_width_m *= half;
    o.veins.net_spacing_m *= half;
    o.pose.pucker_m *= half;
    o.pose.fine_pucker_m *= half;
    o.pose.vein_groove_m *= half;
    o.mesh.outline_spacing_m *= half;
    o.mesh.edge_m *= half;
    o.mesh.vein_edge_m *= half;
  }
  return o;
}

std::vector<std::string> species_names() { return {"cucumber", "watermelon"}; }

void validate(const LeafOptions& o) {
  bool known = false;
  for (const std::string& n : species_names()) known = known || n == o.species;
  if (!known) unknown_species(o.species);
  require("main_vein_m", o.main_vein_m, 0.01, 1, "m");
  require("variation", o.variation, 0, 1);
  require("asymmetry", o.asymmetry, 0, 1);
  require("reference_area_m2", o.reference_area_m2, 0, 10, "m2");
  validate(o.margin);
  validate(o.mesh);
  validate(o.pose);
  require("veins.main_width_m", o.veins.main_width_m, 1e-4, 0.02, "m");
  require("veins.side_spacing", o.veins.side_spacing, 0.03, 0.5);
  require("veins.side_angle_deg", o.veins.side_angle_deg, 15, 85, "deg");
  if (o.veins.net_spacing_m != 0) require("veins.net_spacing_m", o.veins.net_spacing_m, 0.001, 0.05, "m (or 0)");
  require("petiole_m", o.petiole_m, 0, 1, "m");
  require("petiole_radius_m", o.petiole_radius_m, 1e-4, 0.05, "m");
  require("petiole_angle_deg", o.petiole_angle_deg, -90, 170, "deg");
  require("chlorophyll_fresh_ug_cm2", o.chlorophyll_fresh_ug_cm2, 1, 120, "ug/cm2");
  validate(o.edit);
  if (o.wilts) validate(o.wilt);
}

}  // namespace witherfield::leaf
