// How blades move, shrink and stiffen while they dry (Jiao et al. 2010, sec. 3.1; departures: docs/physics.md).
#pragma once
#include <memory>
#include <vector>

#include "sim/grass/blades.hpp"
#include "sim/grass/season.hpp"

namespace witherfield::grass {

/// Turgor pressure in MPa at relative water content w: max(0, -pi0 - eps (1 - w)) (loss point: Bartlett et al. 2012).
double turgor_MPa(const TissueOptions& t, double water);
/// How freely the shape flows: 0 at full turgor, 1 without, 0 again when dry (the shape is set). Drives creep and the paper's droop.
double limpness(const TissueOptions& t, double water);
/// Bending modulus of the whole blade in MPa: falls with turgor to limp, rises again as the tissue dries out.
double bending_modulus_MPa(const TissueOptions& t, double water);
/// Moduli of the tissues grow as water is lost: E(w) = E_fresh + (E_dry - E_fresh)(1 - w).
double modulus_vein_MPa(const TissueOptions& t, double water);
double modulus_mesophyll_MPa(const TissueOptions& t, double water);

/// Shrinkage done at water content w, 0 fresh .. 1 dry: g = ln(E(w)/E_fresh) / ln(E_dry/E_fresh) with the mesophyll's E: each
/// drop of water shrinks less the stiffer the walls have become, d eps = k dw E_fresh / E(w) (sec. 3.1: "shrinking slows down").
double shrink_progress(const TissueOptions& t, double water);

/// Strains and stresses of the bonded tissues at water content w. Free volumetric strains eps0 = k g(w); bonded along the blade they
/// share one axial strain, so that the axial forces balance: A_v sigma_v + A_m sigma_m = 0 (vein in compression,
/// mesophyll in tension). sigma = E (eps - eps0_axial).
struct TissueState { double strain_vein, strain_mesophyll, stress_vein_MPa, stress_mesophyll_MPa; };
TissueState tissue_state(const TissueOptions& t, double water);

/// Integrates the blades of one sample through the season. Step number independent up to O(dt^2).
class BladeMotion {
 public:
  BladeMotion(std::vector<Blade> blades, const BladeOptions& blade_options, const SeasonOptions& season,
              const TissueOptions& tissue, const ColourOptions& colour);
  ~BladeMotion();
  BladeMotion(BladeMotion&&) noexcept;
  BladeMotion& operator=(BladeMotion&&) noexcept;

  /// Advances to weathering degree wd (>= the present one). @throws InvalidInput when asked to go back,
  /// SolverFailure when a node is not finite.
  void advance_to(double wd);
  double wd() const;
  const std::vector<Blade>& blades() const;
  BladeState state() const;   ///< everything at the present moment

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::grass
