// From the reflectance of a thick canopy (what the simulation's `diffuse` is) to one blade's reflectance and
// transmittance.
#pragma once
#include <glm/vec3.hpp>

namespace witherfield::pov {

struct LeafOptics {
  glm::vec3 reflectance{0.0f}, transmittance{0.0f};
};

/// Kubelka-Munk layer of finite thickness (Kubelka 1948): with R_inf of the thick stack, a = (1/R_inf +
/// R_inf)/2, b = sqrt(a^2 - 1) and scattering power S,
///   R = sinh(bS) / (a sinh(bS) + b cosh(bS)),   T = b / (a sinh(bS) + b cosh(bS)).
/// S = 0.37 for fresh and 0.75 for dry tissue: with them lawn grass transmits about as much as it reflects
/// (as measured blades do) and the light through a fresh blade is a saturated yellow-green.
/// @param canopy linear reflectance R_inf, clamped to [0.002, 0.95]; @param freshness 0 dry .. 1 fresh,
/// clamped.
LeafOptics leaf_optics(const glm::vec3& canopy, double freshness);

/// Chlorophyll content at which a blade counts as fresh (lawn grass has 44 ug/cm2).
inline constexpr double kFreshChlorophyll = 40.0;

}  // namespace witherfield::pov
