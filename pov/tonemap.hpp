// Scene radiance -> display: exposure, a filmic curve, sRGB levels.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pov/hdr.hpp"

namespace witherfield::pov {

/// Filmic curve in a wide working space: ACES reference rendering and sRGB display transform as fitted by S.
/// Hill (2015). Linear sRGB in, display-linear [0, 1] out. Greys stay grey; monotone in exposure.
glm::dvec3 tone_map(const glm::dvec3& linear);

/// POV-Ray loses a box of media now and then where a ray meets an edge: single pixels that are brighter
/// than 1.6 times, or darker than 0.6 times, all eight neighbours become their mean. Media pictures are
/// smooth at this scale, so nothing else is touched.
/// @returns how many pixels were mended.
int mend_specks(HdrImage& image);

/// 8-bit sRGB, 3 bytes a pixel, row by row from the top; dithered by half a level so that skies do not band.
/// @param sharpen 0 none .. 1: unsharp mask of one pixel's radius, in log radiance so that bright edges do
/// not ring; media are softer than a lens would be.
std::vector<std::uint8_t> develop(const HdrImage& image, double exposure, double sharpen = 0);

}  // namespace witherfield::pov
