// Floors by name. H and K: estimates, K by the order of three-body wear with grit between sole and floor (Rabinowicz 1995); K is good to a factor of
// five. Hardness: Janka of oak 6 kN, of pine 1.9 kN, as pressure; stones by indentation. Gloss and colours: estimates by
// eye against photographs.
#include "sim/core/errors.hpp"
#include "sim/floor/options.hpp"

namespace witherfield::floor {
namespace {

Layer layer(const char* name, double hardness_Pa, double wear_coefficient, double gloss_new, double gloss_worn,
            double gloss_hits, glm::dvec3 colour, glm::dvec3 colour_worn, double dirt_hold) {
  Layer l;
  l.name = name;
  l.hardness_Pa = hardness_Pa;
  l.wear_coefficient = wear_coefficient;
  l.gloss_new = gloss_new;
  l.gloss_worn = gloss_worn;
  l.gloss_hits = gloss_hits;
  l.colour = colour;
  l.colour_worn = colour_worn;
  l.dirt_hold = dirt_hold;
  return l;
}

FloorPattern laid(Laying laying, double length_m, double width_m, double joint_m) {
  FloorPattern p;
  p.laying = laying;
  p.length_m = length_m;
  p.width_m = width_m;
  p.joint_m = joint_m;
  return p;
}

MaterialOptions made(std::vector<Layer> layers, FloorPattern pattern, double hardness_sd, double brightness_sd,
                     double joint_depth_m, double level_sd_m) {
  MaterialOptions m;
  m.layers = std::move(layers);
  m.pattern = pattern;
  m.piece_hardness_sd = hardness_sd;
  m.piece_brightness_sd = brightness_sd;
  m.joint_depth_m = joint_depth_m;
  m.piece_level_sd_m = level_sd_m;
  return m;
}

/// Film of polyurethane varnish: gone after some 3e4 steps on one spot, dull long before.
Layer varnish(glm::dvec3 over, glm::dvec3 worn) {
  Layer l = layer("varnish", 1.2e8, 5e-4, 0.85, 0.22, 4000, over, worn, 0.25);
  l.thickness_um = 80;
  return l;
}

MaterialOptions boards(std::vector<Layer> layers) {
  return made(std::move(layers), laid(Laying::boards, 1.8, 0.14, 0.0012), 0.12, 0.14, 0.0015, 1e-4);
}
MaterialOptions slabs(Layer stone, double length_m, double width_m) {
  return made({std::move(stone)}, laid(Laying::slabs, length_m, width_m, 0.004), 0.10, 0.10, 0.003, 4e-4);
}

}  // namespace

std::vector<std::string> material_names() {
  return {"oak", "varnished_oak", "pine", "varnished_pine", "marble", "limestone", "granite", "concrete", "porcelain",
          "pvc", "linoleum"};
}

MaterialOptions material_preset(const std::string& name) {
  const Layer oak = layer("oak", 6e7, 1e-4, 0.14, 0.10, 5000, {0.36, 0.25, 0.15}, {0.40, 0.31, 0.21}, 0.75);
  const Layer pine = layer("pine", 1.9e7, 1e-4, 0.14, 0.09, 4000, {0.52, 0.36, 0.19}, {0.50, 0.39, 0.26}, 0.80);
  if (name == "oak") return boards({oak});
  if (name == "pine") return boards({pine});
  if (name == "varnished_oak") return boards({varnish({0.30, 0.145, 0.052}, {0.315, 0.165, 0.068}), oak});
  if (name == "varnished_pine") return boards({varnish({0.47, 0.25, 0.085}, {0.47, 0.27, 0.105}), pine});
  if (name == "marble")
    return slabs(layer("marble", 1.4e9, 3e-4, 0.35, 0.70, 20000, {0.66, 0.64, 0.60}, {0.60, 0.575, 0.53}, 0.45), 0.6, 0.6);
  if (name == "limestone")
    return slabs(layer("limestone", 6e8, 3e-4, 0.08, 0.50, 30000, {0.47, 0.42, 0.33}, {0.42, 0.365, 0.275}, 0.60), 0.66, 0.45);
  if (name == "granite")
    return slabs(layer("granite", 6.5e9, 3e-4, 0.20, 0.55, 80000, {0.33, 0.32, 0.31}, {0.29, 0.28, 0.27}, 0.40), 0.9, 0.5);
  if (name == "concrete")
    return made({layer("concrete", 8e8, 3e-4, 0.08, 0.30, 20000, {0.36, 0.35, 0.33}, {0.33, 0.32, 0.295}, 0.65)},
                laid(Laying::seamless, 1, 1, 0), 0, 0, 0, 0);
  if (name == "porcelain") {
    Layer glaze = layer("glaze", 6e9, 1e-4, 0.90, 0.35, 30000, {0.58, 0.55, 0.49}, {0.55, 0.52, 0.46}, 0.25);
    glaze.thickness_um = 300;
    const Layer body = layer("body", 3e9, 2e-4, 0.20, 0.15, 20000, {0.50, 0.44, 0.36}, {0.47, 0.41, 0.33}, 0.60);
    return made({glaze, body}, laid(Laying::tiles, 0.3, 0.3, 0.003), 0.05, 0.04, 0.0015, 1e-4);
  }
  if (name == "pvc") {
    Layer top = layer("coating", 5e7, 3e-5, 0.55, 0.20, 4000, {0.22, 0.25, 0.24}, {0.24, 0.265, 0.25}, 0.45);
    top.thickness_um = 30;
    const Layer body = layer("pvc", 5e7, 3e-5, 0.18, 0.12, 6000, {0.25, 0.275, 0.26}, {0.27, 0.28, 0.26}, 0.60);
    return made({top, body}, laid(Laying::seamless, 1, 1, 0), 0, 0, 0, 0);
  }
  if (name == "linoleum") {
    Layer top = layer("wax", 2e7, 4e-4, 0.50, 0.20, 2500, {0.30, 0.15, 0.085}, {0.31, 0.165, 0.10}, 0.40);
    top.thickness_um = 20;
    const Layer body = layer("linoleum", 2.5e7, 6e-5, 0.18, 0.12, 5000, {0.33, 0.18, 0.11}, {0.36, 0.215, 0.145}, 0.60);
    return made({top, body}, laid(Laying::seamless, 1, 1, 0), 0, 0, 0, 0);
  }
  std::string known;
  for (const std::string& n : material_names()) known += (known.empty() ? "" : ", ") + n;
  throw InvalidInput("unknown floor material '" + name + "'; known: " + known);
}

}  // namespace witherfield::floor
