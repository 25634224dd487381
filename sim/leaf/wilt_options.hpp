// What the wilting simulation is told: time, water, tissue, mechanics. Default, unit and range on every field.
// Relative water content (RWC) is 1 at full turgor, 0 when dry. Sources: docs/physics.md; figures without one there are estimates.
#pragma once
#include <utility>
#include <vector>

namespace witherfield::leaf {

/// Water: what comes through the petiole, what the blade loses, how it spreads.
struct WiltWaterOptions {
  std::vector<std::pair<double, double>> supply_curve;  ///< (hour, openness of the supply 0..1), 1 = well watered; empty = it closes within half an hour
  double blade_water_kg_m2 = 0.22;         ///< water of the turgid blade per area, 0.01..5
  double petiole_water_kg_m3 = 900;        ///< water of the turgid petiole per volume, 50..1000
  double transpiration_kg_m2_s = 4e-5;     ///< with open stomata, 0..1e-3 (4e-5 = 2.2 mmol m-2 s-1)
  double cuticular_share = 0.15;           ///< of it that goes on with closed stomata (wind, heat, damage add to it), 0..1
  double margin_gain = 0.5;                ///< transpiration is (1 + gain) times as strong at the margin (thin boundary layer), 0..5
  double margin_width_m = 0.012;           ///< over which that gain fades, 1e-4..1
  double diffusivity_blade_m2_s = 6e-7;    ///< of relative water content in the blade, its fine veins included, 1e-12..1e-3
  double vein_conductivity_kg_m_s = 0.25;  ///< flow along a main or side vein per section and gradient of RWC, 0..1e3
  double conductance_loss = 0.98;          ///< share of both that goes with the turgor, 0..0.999
  double petiole_conductance_kg_s = 2e-5;  ///< flow through the petiole per unit of RWC, 1e-12..1
  double steps_per_hour = 12;              ///< backward Euler steps, 0.01..1e5; the error falls with the first power of the step
};

/// How tissue answers to water. Moduli in MPa.
struct WiltTissueOptions {
  double osmotic_potential_MPa = -0.9;     ///< pi_0 at full turgor, -5..-0.1
  double wall_elasticity_MPa = 3.0;        ///< epsilon, 0.2..50; turgor is lost at RWC = 1 + pi_0 / epsilon
  double turgor_exponent = 0.6;            ///< stiffness ~ (P / P_0)^exponent: below 1 it holds out long, then goes fast; 0.1..3
  double blade_bending_turgid_MPa = 25;    ///< modulus in bending, 1e-3..1e5
  double blade_bending_limp_MPa = 1.0;     ///< without turgor, 1e-4..1e5
  double blade_membrane_turgid_MPa = 10;   ///< modulus in the plane of the blade, 1e-2..1e5
  double blade_membrane_limp_MPa = 3;      ///< without turgor (mesophyll softens with it), 1e-2..1e5
  double compression_share = 0.05;         ///< of it against compression: fine wrinkles give way, 1e-3..1
  double vein_turgid_MPa = 500;            ///< and along the vein with and without turgor, 1e-2..1e5
  double vein_limp_MPa = 70;               ///< in bending without turgor, 1e-2..1e5
  double petiole_turgid_MPa = 120;         ///< 1e-2..1e5
  double petiole_limp_MPa = 14;            ///< 1e-2..1e5
  double softening_exponent = 1.0;         ///< below the turgor-loss point bending moduli fall on as (w / w_tlp)^exponent, to a fifth; 0..4
  double poisson = 0.3;                    ///< 0..0.49
  double thickness_m = 0.00028;            ///< of the turgid blade, 2e-5..0.005
  double dry_mass_kg_m2 = 0.03;            ///< 0..2
  double shrink_thickness = -0.5;          ///< relative change, fresh -> dry, -0.95..0
  double shrink_blade = -0.095;            ///< linear strain in the plane, fresh -> dry, -0.5..0
  double shrink_vein = -0.008;             ///< the same of veins: |shrink_vein| < |shrink_blade|, -0.5..0
  double curl_1_m = -14;                   ///< curvature that the blade would take on when dry (upper and lower side shrink differently); < 0: margins downward; -500..500
  double chlorophyll_fresh_ug_cm2 = 42;    ///< 1..120
  double chlorophyll_loss_hours = 60;      ///< e-folding time of chlorophyll in tissue without water, 0.1..1e5; none is lost above the turgor-loss point
};

struct WiltSolverOptions {
  double gravity_m_s2 = 9.81;              ///< 0..100, along -z
  int max_iterations = 60;                 ///< Newton steps for one moment, 1..10000
  double tolerance = 2e-5;                 ///< energy that one more step would gain, over weight times size, that ends a solve; 1e-20..0.1
  double contact_gap = 0.9;                ///< distance at which two parts of the blade repel each other, over the mean edge, 0 (no contact)..3
  int moments_per_frame = 1;               ///< equilibria between two key frames, 1..100
};

struct WiltOptions {
  double length_hours = 6;                 ///< 0.01..10000
  int frames = 20;                         ///< key frames, evenly in time, the first at 0; 2..10000
  std::vector<double> frame_hours;         ///< instead: key frames, ascending, the first >= 0, the last <= length_hours
  WiltWaterOptions water;
  WiltTissueOptions tissue;
  WiltSolverOptions solver;
};

/// @throws InvalidInput naming the field, its value, the range and the unit.
void validate(const WiltOptions& options);
/// The key frames in hours.
std::vector<double> frame_times_hours(const WiltOptions& options);

}  // namespace witherfield::leaf
