// Daylight: the Preetham sky and the sun's colour for one position of the sun.
#pragma once
#include <glm/vec3.hpp>

#include "pov/hdr.hpp"
#include "sim/core/view.hpp"

namespace witherfield::pov {

struct Daylight {
  glm::dvec3 sun_rgb{0.0};      ///< radiance of a white diffuser turned to the sun (no factor pi)
  glm::dvec3 sky_rgb{0.0};      ///< radiance of a white diffuser that sees the whole sky
  glm::dvec3 horizon_rgb{0.0};  ///< mean radiance of the haze at the horizon
  HdrImage map;                 ///< latitude-longitude picture for sky_sphere map_type 1, as POV-Ray lays it
};

/// Radiance of the sky toward `direction` (unit, z up) relative to the zenith scale of Preetham, Shirley &
/// Smits 1999, "A practical analytic model for daylight": Perez distribution of Y, x, y, as linear sRGB. Not
/// below the horizon.
glm::dvec3 preetham_radiance(const Sun& sun, const glm::dvec3& direction);

/// Sun : sky = 6 : 1 in luminance for a sun at 40 degrees and turbidity 3 (clear to slightly hazy daylight),
/// the sun dimmed and reddened by air mass (Kasten & Young 1989; Rayleigh and Angstrom aerosol as in
/// Preetham's appendix).
Daylight make_daylight(const Sun& sun);

}  // namespace witherfield::pov
