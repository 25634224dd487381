// Colour space helpers. Colours are linear sRGB (Rec. 709 primaries, D65) everywhere; encoding happens only for PNGs
// and for comparing with published 8-bit colours.
#pragma once
#include <glm/vec3.hpp>

namespace witherfield {

/// IEC 61966-2-1 transfer function, linear [0,1] -> encoded [0,1].
double srgb_encode(double linear);
double srgb_decode(double encoded);
/// Linear sRGB -> 8-bit levels 0..255 as doubles (not rounded, clamped to [0, 255]).
glm::dvec3 srgb_levels(const glm::dvec3& linear);
/// CIE 1931 XYZ (Y of white = 1, D65) <-> linear sRGB.
glm::dvec3 xyz_to_linear_srgb(const glm::dvec3& xyz);
glm::dvec3 linear_srgb_to_xyz(const glm::dvec3& rgb);
/// CIELAB hue angle h* in degrees [0, 360) of a linear sRGB colour under D65.
double lab_hue_deg(const glm::dvec3& linear);

}  // namespace witherfield
