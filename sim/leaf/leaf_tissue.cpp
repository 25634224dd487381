#include "sim/leaf/leaf_tissue.hpp"

#include <algorithm>
#include <cmath>

namespace witherfield::leaf {
namespace {
double between(double limp, double turgid, double share) { return limp + (turgid - limp) * share; }
}  // namespace

double turgor_MPa(const WiltTissueOptions& t, double water) {
  return std::max(0.0, -t.osmotic_potential_MPa - t.wall_elasticity_MPa * (1 - water));
}

double turgor_loss_point(const WiltTissueOptions& t) {
  return std::max(0.0, 1 + t.osmotic_potential_MPa / t.wall_elasticity_MPa);
}

double turgor_stiffening(const WiltTissueOptions& t, double water) {
  const double p = turgor_MPa(t, water) / -t.osmotic_potential_MPa;
  return p > 0 ? std::pow(std::min(p, 1.0), t.turgor_exponent) : 0.0;
}

double limp_softening(const WiltTissueOptions& t, double water) {
  const double tlp = turgor_loss_point(t);
  if (tlp <= 0 || water >= tlp) return 1;
  return 0.2 + 0.8 * std::pow(std::max(water, 0.0) / tlp, t.softening_exponent);
}

double blade_bending_MPa(const WiltTissueOptions& t, double water) {
  return limp_softening(t, water) * between(t.blade_bending_limp_MPa, t.blade_bending_turgid_MPa, turgor_stiffening(t, water));
}
double blade_membrane_MPa(const WiltTissueOptions& t, double water) {
  return between(t.blade_membrane_limp_MPa, t.blade_membrane_turgid_MPa, turgor_stiffening(t, water));
}
double vein_modulus_MPa(const WiltTissueOptions& t, double water) {
  return limp_softening(t, water) * between(t.vein_limp_MPa, t.vein_turgid_MPa, turgor_stiffening(t, water));
}
double petiole_modulus_MPa(const WiltTissueOptions& t, double water) {
  return limp_softening(t, water) * between(t.petiole_limp_MPa, t.petiole_turgid_MPa, turgor_stiffening(t, water));
}

double thickness_m(const WiltTissueOptions& t, double water) {
  return t.thickness_m * (1 + t.shrink_thickness * std::clamp(1 - water, 0.0, 1.0));
}

double shrink_strain(const WiltTissueOptions& t, double water, double vein) {
  return between(t.shrink_blade, t.shrink_vein, vein) * std::clamp(1 - water, 0.0, 1.0);
}

double shrink_curvature_1_m(const WiltTissueOptions& t, double water, double vein) {
  return t.curl_1_m * (1 - vein) * std::clamp(1 - water, 0.0, 1.0);
}

double turgor_share(const WiltTissueOptions& t, double water) {
  const double p = std::clamp(turgor_MPa(t, water) / (-0.5 * t.osmotic_potential_MPa), 0.0, 1.0);
  return p * p * (3 - 2 * p);
}

double transpiration_share(const WiltTissueOptions& t, double cuticular_share, double water) {
  const double w = std::max(water, 0.0);
  return between(cuticular_share, 1.0, turgor_share(t, water)) * 1.05 * w / (w + 0.05);
}

}  // namespace witherfield::leaf
