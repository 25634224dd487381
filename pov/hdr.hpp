// Radiance HDR (RGBE) pictures: read what POV-Ray renders, write the sky. Linear sRGB.
// Format: G. Ward, "Real Pixels", Graphics Gems II (1991), and the Radiance file format notes.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace witherfield::pov {

struct HdrImage {
  int width = 0, height = 0;
  std::vector<glm::vec3> pixel;  ///< row by row from the top
};

/// Decodes flat and run-length encoded pictures. @throws IoFailure naming `what` when the data are not such a
/// picture.
HdrImage decode_hdr(std::string_view bytes, const std::string& what);
/// Run-length encoded where the width allows (8..32767), else flat.
std::string encode_hdr(const HdrImage& image);

}  // namespace witherfield::pov
