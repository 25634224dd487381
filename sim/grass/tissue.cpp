#include <algorithm>
#include <cmath>

#include "sim/grass/mechanics.hpp"

namespace witherfield::grass {
namespace {

double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

double turgor_MPa(const TissueOptions& t, double water) {
  return std::max(0.0, -t.osmotic_potential_MPa - t.wall_elasticity_MPa * (1 - water));
}

double limpness(const TissueOptions& t, double water) {
  const double soft = 1 - turgor_MPa(t, water) / -t.osmotic_potential_MPa;
  return soft * smooth((water - 0.05) / 0.25);  // a dry blade is set: it creeps no more
}

double bending_modulus_MPa(const TissueOptions& t, double water) {
  const double firm = turgor_MPa(t, water) / -t.osmotic_potential_MPa;
  const double dry = smooth((0.45 - water) / 0.40);
  return t.bending_limp_MPa + (t.bending_fresh_MPa - t.bending_limp_MPa) * firm +
         (t.bending_dry_MPa - t.bending_limp_MPa) * dry;
}

double modulus_vein_MPa(const TissueOptions& t, double water) {
  return t.modulus_vein_fresh_MPa + (t.modulus_vein_dry_MPa - t.modulus_vein_fresh_MPa) * (1 - water);
}

double modulus_mesophyll_MPa(const TissueOptions& t, double water) {
  return t.modulus_mesophyll_fresh_MPa + (t.modulus_mesophyll_dry_MPa - t.modulus_mesophyll_fresh_MPa) * (1 - water);
}

double shrink_progress(const TissueOptions& t, double water) {
  // The integral of E_fresh / E(w) dw with E linear in w is a logarithm; scaled to 1 when all water is gone.
  return std::log(modulus_mesophyll_MPa(t, water) / t.modulus_mesophyll_fresh_MPa) /
         std::log(t.modulus_mesophyll_dry_MPa / t.modulus_mesophyll_fresh_MPa);
}

TissueState tissue_state(const TissueOptions& t, double water) {
  const double g = shrink_progress(t, water);
  TissueState s;
  s.strain_vein = t.volume_strain_vein * g;            // eps0_v = k_v dw ..., Jiao et al. 2010, sec. 3.1
  s.strain_mesophyll = t.volume_strain_mesophyll * g;  // eps0_m, |k_v| < |k_m|
  // Volumetric -> linear (the paper puts a volumetric strain into a uniaxial law).
  const double free_vein = std::cbrt(1 + s.strain_vein) - 1, free_mesophyll = std::cbrt(1 + s.strain_mesophyll) - 1;
  const double e_vein = modulus_vein_MPa(t, water), e_mesophyll = modulus_mesophyll_MPa(t, water);
  const double a_vein = t.vein_fraction, a_mesophyll = 1 - t.vein_fraction;
  const double bonded = (e_vein * a_vein * free_vein + e_mesophyll * a_mesophyll * free_mesophyll) /
                        (e_vein * a_vein + e_mesophyll * a_mesophyll);
  s.stress_vein_MPa = e_vein * (bonded - free_vein);
  s.stress_mesophyll_MPa = e_mesophyll * (bonded - free_mesophyll);
  return s;
}

}  // namespace witherfield::grass
