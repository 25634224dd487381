// Keys of a leaf that wilts: [wilt] with its water, tissue and solver.
#include "sim/scene/leaf_keys.hpp"

namespace witherfield::scene {
namespace {

using namespace leaf;

void describe_water(KeyVisitor& v, WiltWaterOptions& w) {
  v.pairs({"supply_curve",
           "Openness of the supply through the petiole, [[hour, 0..1], ...]; 1 = well watered; empty = it "
           "closes within "
           "half an hour"},
          w.supply_curve, {0, 1e4, "h"}, {0, 1});
  v.number({"blade_water_kg_m2", "Water of the turgid blade per area"}, w.blade_water_kg_m2,
           {0.01, 5, "kg/m2"});
  v.number({"petiole_water_kg_m3", "Water of the turgid petiole per volume"}, w.petiole_water_kg_m3,
           {50, 1000, "kg/m3"});
  v.number({"transpiration_kg_m2_s", "With open stomata"}, w.transpiration_kg_m2_s, {0, 1e-3, "kg/m2/s"});
  v.number({"cuticular_share", "Of it that goes on with closed stomata"}, w.cuticular_share, {0, 1});
  v.number({"margin_gain", "Transpiration is 1 + gain times as strong at the margin"}, w.margin_gain, {0, 5});
  v.number({"margin_width_m", "Over which that fades"}, w.margin_width_m, {1e-4, 1, "m"});
  v.number({"diffusivity_blade_m2_s", "Of relative water content in the blade, its fine veins included"},
           w.diffusivity_blade_m2_s, {1e-12, 1e-3, "m2/s"});
  v.number({"vein_conductivity_kg_m_s", "Flow along a vein per section and gradient of relative water content"},
           w.vein_conductivity_kg_m_s, {0, 1e3, "kg/(m s)"});
  v.number({"conductance_loss", "Share of both that goes with the turgor"}, w.conductance_loss, {0, 0.999});
  v.number({"petiole_conductance_kg_s", "Flow through the petiole per unit of relative water content"},
           w.petiole_conductance_kg_s, {1e-12, 1, "kg/s"});
  v.number({"steps_per_hour", "Backward Euler steps"}, w.steps_per_hour, {0.01, 1e5, "1/h"});
}

void describe_moduli(KeyVisitor& v, WiltTissueOptions& t) {
  const Limits modulus{1e-4, 1e5, "MPa"};
  v.number({"blade_bending_turgid_MPa", "Modulus of the blade in bending"}, t.blade_bending_turgid_MPa,
           modulus);
  v.number({"blade_bending_limp_MPa", "The same without turgor"}, t.blade_bending_limp_MPa, modulus);
  v.number({"blade_membrane_turgid_MPa", "Modulus in the plane of the blade"}, t.blade_membrane_turgid_MPa,
           modulus);
  v.number({"blade_membrane_limp_MPa", "The same without turgor"}, t.blade_membrane_limp_MPa, modulus);
  v.number({"vein_turgid_MPa", "Modulus of the veins; against stretching it stays"}, t.vein_turgid_MPa, modulus);
  v.number({"vein_limp_MPa", "In bending without turgor"}, t.vein_limp_MPa, modulus);
  v.number({"petiole_turgid_MPa", "Modulus of the petiole"}, t.petiole_turgid_MPa, modulus);
  v.number({"petiole_limp_MPa", "The same without turgor"}, t.petiole_limp_MPa, modulus);
}

void describe_tissue(KeyVisitor& v, WiltTissueOptions& t) {
  v.number({"osmotic_potential_MPa", "Osmotic potential at full turgor"}, t.osmotic_potential_MPa,
           {-5, -0.1, "MPa"});
  v.number(
      {"wall_elasticity_MPa", "Elasticity of the cell walls; turgor is lost at 1 + osmotic potential / this"},
      t.wall_elasticity_MPa, {0.2, 50, "MPa"});
  v.number({"turgor_exponent", "Stiffness goes with turgor to this power"}, t.turgor_exponent, {0.1, 3});
  describe_moduli(v, t);
  v.number({"softening_exponent", "Below the loss of turgor bending moduli fall on with water to this power"},
           t.softening_exponent, {0, 4});
  v.number({"poisson", "Poisson's ratio"}, t.poisson, {0, 0.49});
  v.number({"thickness_m", "Of the turgid blade"}, t.thickness_m, {2e-5, 0.005, "m"});
  v.number({"dry_mass_kg_m2", "Dry mass per area"}, t.dry_mass_kg_m2, {0, 2, "kg/m2"});
  v.number({"shrink_thickness", "Relative change of thickness, fresh to dry"}, t.shrink_thickness,
           {-0.95, 0});
  v.number({"shrink_blade", "Linear strain in the plane of the blade, fresh to dry"}, t.shrink_blade,
           {-0.5, 0});
  v.number({"shrink_vein", "The same of veins, less than that"}, t.shrink_vein, {-0.5, 0});
  v.number({"curl_1_m", "Curvature that the blade would take on when dry; < 0: margins downward"}, t.curl_1_m,
           {-500, 500, "1/m"});
  v.number({"chlorophyll_fresh_ug_cm2", "Chlorophyll a + b of the fresh leaf"}, t.chlorophyll_fresh_ug_cm2,
           {1, 120, "ug/cm2"});
  v.number({"chlorophyll_loss_hours", "e-folding time of chlorophyll in tissue without water"},
           t.chlorophyll_loss_hours, {0.1, 1e5, "h"});
}

}  // namespace

void describe_wilt(KeyVisitor& v, WiltOptions& w) {
  v.number({"length_hours", "Time simulated; wd = hours / this"}, w.length_hours, {0.01, 1e4, "h"});
  v.whole({"frames", "Key frames, evenly in time from hour 0"}, w.frames, {2, 10000});
  v.list({"frame_hours", "Key frames instead, in hours; empty = evenly"}, w.frame_hours, {0, 1e4, "h"},
         Order::ascending);
  describe_water(v, w.water);
  describe_tissue(v, w.tissue);
  WiltSolverOptions& s = w.solver;
  v.number({"gravity_m_s2", "Downward"}, s.gravity_m_s2, {0, 100, "m/s2"});
  v.whole({"max_iterations", "Newton steps for one moment"}, s.max_iterations, {1, 10000});
  v.number({"tolerance", "Ends a solve: what one more step would gain, over the leaf's weight times its size"}, s.tolerance,
           {1e-20, 0.1});
  v.number(
      {"contact_gap", "Distance at which parts of the blade repel each other, in mean edges; 0 = no contact"},
      s.contact_gap, {0, 3});
  v.whole({"moments_per_frame", "Equilibria between two key frames"}, s.moments_per_frame, {1, 100});
}

}  // namespace witherfield::scene
