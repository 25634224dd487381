// Keys of people and material: [crowd], [gait], [material].
#include "sim/scene/floor_keys.hpp"

#include <algorithm>

namespace witherfield::scene {
namespace {

using namespace floor;

constexpr Named<Laying> kLayings[] = {{"seamless", Laying::seamless},
                                      {"boards", Laying::boards},
                                      {"tiles", Laying::tiles},
                                      {"slabs", Laying::slabs}};

void describe_layer(KeyVisitor& v, Layer& l) {
  v.text({"name", "What it is"}, l.name, {});
  v.number({"thickness_um", "Of the layer; the last one has no end"}, l.thickness_um, {0, 1e7, "um"});
  v.number({"hardness_Pa", "H of Archard's law"}, l.hardness_Pa, {1e5, 1e11, "Pa"});
  v.number({"wear_coefficient", "K of Archard's law with grit under the sole; known to a factor of five"},
           l.wear_coefficient, {0, 0.1});
  v.number({"gloss_new", "Gloss, new"}, l.gloss_new, {0, 1});
  v.number({"gloss_worn", "Gloss after many steps; stone may gain"}, l.gloss_worn, {0, 1});
  v.number({"gloss_hits", "Steps on one spot after which 63 % of that change is done"}, l.gloss_hits,
           {1, 1e9, "steps"});
  v.numbers({"colour", "Linear sRGB, new"}, {&l.colour.x, 3}, {0, 1}, Order::any);
  v.numbers({"colour_worn", "Linear sRGB, worn"}, {&l.colour_worn.x, 3}, {0, 1}, Order::any);
  v.number({"dirt_hold", "How dark dirt makes it"}, l.dirt_hold, {0, 1});
}

}  // namespace

void spread(KeyVisitor& v, const Key& key, Spread& s, const Limits& limits) {
  double four[4] = {s.mean, s.sd, s.lo, s.hi};
  // The standard deviation may be smaller than the least value.
  v.numbers(key, four, {std::min(0.0, limits.lo), limits.hi, limits.unit}, Order::any);
  s = {four[0], four[1], four[2], four[3]};
  v.check(key.name, s.lo >= limits.lo, [&] { return "mean, least and greatest must be " + limits_text(limits); });
  v.check(key.name, s.sd >= 0 && s.lo <= s.mean && s.mean <= s.hi, [] {
    return "must be [mean, standard deviation, least, greatest] with least <= mean <= greatest";
  });
}

void describe_crowd(KeyVisitor& v, FloorOptions& o) {
  CrowdOptions& c = o.crowd;
  int visits = int(c.visits);
  v.whole({"visits", "People who come and go, walked one by one"}, visits, {1, 1e8, "visits"});
  c.visits = visits;
  v.number({"days", "Time over which they come"}, c.days, {0.01, 1e6, "days"});
  v.number({"visits_each", "Real visits that a walked one stands for"}, c.visits_each, {1e-6, 1e6});
  v.number(
      {"patrol_share", "Once round the walls and out by the same door; relative to the other behaviours"},
      c.patrol_share, {0, 1e6});
  v.number({"round_trip_share", "To a place, stay, and back"}, c.round_trip_share, {0, 1e6});
  v.number({"pass_share", "In by one door, out by another"}, c.pass_share, {0, 1e6});
  v.check("patrol_share", c.patrol_share + c.round_trip_share + c.pass_share > 0,
          [] { return "one of the shares must be greater than 0"; });
  v.number({"clockwise_share", "Of the patrols"}, c.clockwise_share, {0, 1});
  v.number({"women_share", "Of the people"}, c.women_share, {0, 1});
  // The least of the four may be the standard deviation; the rest is checked by the simulator.
  const Limits speed{0.1, 4, "m/s"}, mass{1, 400, "kg"}, foot{0.1, 0.5, "m"};
  spread(v, {"speed_men_m_s", "Free walking: mean, standard deviation, least, greatest"}, c.speed_men_m_s,
         speed);
  spread(v, {"speed_women_m_s", "The same of women"}, c.speed_women_m_s, speed);
  v.number({"patrol_speed_factor", "People who look around are slower"}, c.patrol_speed_factor, {0.1, 1});
  spread(v, {"mass_men_kg", "Mass: mean, standard deviation, least, greatest"}, c.mass_men_kg, mass);
  spread(v, {"mass_women_kg", "The same of women"}, c.mass_women_kg, mass);
  spread(v, {"foot_men_m", "Length of the foot"}, c.foot_men_m, foot);
  spread(v, {"foot_women_m", "The same of women"}, c.foot_women_m, foot);
  v.number({"toe_slide_share", "Share of the steps that end with a slide of the toe"}, c.toe_slide_share,
           {0, 1});
  CurveKeys absent;
  for (const auto& [first, last] : c.absent) absent.emplace_back(double(first), double(last));
  v.pairs({"absent", "Visits [first, last) that do not take place"}, absent, {0, 1e8, "visits"}, {0, 1e8, "visits"});
  c.absent.clear();
  for (const auto& [first, last] : absent) c.absent.emplace_back(std::int64_t(first), std::int64_t(last));
}

void describe_gait(KeyVisitor& v, GaitOptions& g) {
  v.number({"step_base_m", "Length of a step = base + per speed * speed (Seitz & Koester 2012)"},
           g.step_base_m, {0.05, 1, "m"});
  v.number({"step_per_speed_s", "See step_base_m"}, g.step_per_speed_s, {0, 1, "s"});
  v.number({"step_sd_m", "Spread of the steps"}, g.step_sd_m, {0, 0.1, "m"});
  spread(v, {"side_m", "Foot to the line of walking: mean, standard deviation, least, greatest"}, g.side_m,
         {-0.2, 0.3, "m"});
  spread(v, {"toe_out_deg", "Foot turned outward"}, g.toe_out_deg, {-30, 45, "deg"});
  v.number({"heading_sd_deg", "Heading about the orientation field"}, g.heading_sd_deg, {0, 45, "deg"});
  v.number({"heading_memory_m", "Way after which a deviation is forgotten"}, g.heading_memory_m,
           {0.1, 20, "m"});
  v.number({"turn_radius_m", "Tightest walked curve"}, g.turn_radius_m, {0.05, 2, "m"});
  v.number({"clearance_m", "Middle of the body to wall or desk"}, g.clearance_m, {0.1, 0.6, "m"});
  v.number({"reach_m", "How early walls and desks are given way"}, g.reach_m, {0.1, 2, "m"});
  v.number({"stance_share", "Share of a stride that a foot stands"}, g.stance_share, {0.3, 0.9});
  spread(v, {"slip_m", "Sliding of the sole in a step"}, g.slip_m, {0, 0.2, "m"});
  spread(v, {"toe_slide_m", "Sliding of a step with toe slide"}, g.toe_slide_m, {0, 0.3, "m"});
  v.number({"pivot_m_per_rad", "Sliding added by turning on the foot"}, g.pivot_m_per_rad, {0, 0.2, "m/rad"});
  spread(v, {"view_distance_m", "Patrols: wall to line of walking"}, g.view_distance_m, {0, 10, "m"});
  v.number({"look_share", "Of the pictures passed that are stopped at"}, g.look_share, {0, 1});
  spread(v, {"look_s", "Standing before a picture"}, g.look_s, {0, 3600, "s"});
  v.whole({"steps_max", "After which a walker counts as stuck"}, g.steps_max, {10, 1e6, "steps"});
}

void describe_material(KeyVisitor& v, MaterialOptions& m) {
  v.preset({"preset", "A floor whose layers and pattern the keys below then adjust"}, material_names(), "",
           [&](const std::string& name) { m = material_preset(name); });
  FloorPattern& p = m.pattern;
  choice(v, {"laying", "How the floor is laid"}, p.laying, kLayings);
  v.number({"piece_length_m", "Of a board, tile or slab, along the laying direction"}, p.length_m,
           {0.02, 20, "m"});
  v.number({"piece_width_m", "Across it"}, p.width_m, {0.02, 20, "m"});
  v.number({"joint_m", "Width of the joints"}, p.joint_m, {0, 0.1, "m"});
  v.number({"turn_deg", "Laying direction, counter-clockwise from x"}, p.turn_deg, {-360, 360, "deg"});
  v.number({"piece_hardness_sd", "Between boards or slabs, relative"}, m.piece_hardness_sd, {0, 0.5});
  v.number({"piece_brightness_sd", "Between boards or slabs, relative"}, m.piece_brightness_sd, {0, 0.5});
  v.number({"finish_sd", "Unevenness of the upper layers' thickness, relative"}, m.finish_sd, {0, 0.5});
  v.number({"joint_depth_m", "Depth of the joints"}, m.joint_depth_m, {0, 0.1, "m"});
  v.number({"piece_level_sd_m", "How unevenly the pieces lie"}, m.piece_level_sd_m, {0, 0.02, "m"});
  // Last: in a printed scene, keys that follow a table belong to it.
  v.tables(
      {"layer", "Layers from the top; the last one has no end"}, m.layers.size(),
      [&](std::size_t n) { m.layers.assign(n, Layer{}); },
      [&](KeyVisitor& k, std::size_t i) { describe_layer(k, m.layers[i]); });
}

}  // namespace witherfield::scene
