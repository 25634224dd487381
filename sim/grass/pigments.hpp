// Pigments -> spectrum -> linear sRGB (Jiao et al. 2010, sec. 3.2; docs/physics.md).
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/grass/options.hpp"

namespace witherfield::grass {

/// Wavelengths of all spectra here: 400, 410 ... 700 nm.
inline constexpr int kBands = 31;
inline double band_nm(int i) { return 400.0 + 10.0 * i; }
using Spectrum = std::array<double, kBands>;

/// Relative amounts of the paper's pigments for a chlorophyll fraction c: chl a : chl b : carotenoid = 27 c : 9 c : 4
/// (carotenoid constant), as shares of 40 (Jiao et al. 2010, sec. 3.2).
struct Pigments { double chl_a, chl_b, carotenoid; };
Pigments paper_pigments(double chlorophyll_fraction);

/// In-vitro absorption spectra, peak 1, and the spectra used for colour.
const Spectrum& absorption_chl_a();
const Spectrum& absorption_chl_b();
const Spectrum& absorption_beta_carotene();
const Spectrum& absorption_chl_in_vivo();   ///< PROSPECT-D kab / its 400..700 nm maximum
const Spectrum& reflectance_dry_grass();    ///< USGS dry long grass

/// Reflectance by Kubelka-Munk mixing, the default. @pre 0 <= c <= 1.
Spectrum reflectance_kubelka_munk(double chlorophyll_fraction);
/// The paper's subtraction R = L - sum P A, with L = 1 at all wavelengths (equal-energy, so that R is a reflectance), clamped
/// to [0, 1] (Jiao et al. 2010, sec. 3.2; erratum E0.9: near-white, kept for comparison).
Spectrum reflectance_paper(double chlorophyll_fraction);

/// CIE 1931 2-degree under D65, 400..700 nm, white of a perfect diffuser scaled to linear (1,1,1).
glm::dvec3 spectrum_to_linear_srgb(const Spectrum& reflectance);
/// XYZ under D65 with Y of white = 1, not white-scaled.
glm::dvec3 spectrum_to_xyz(const Spectrum& reflectance);

/// Colour of a blade for a chlorophyll fraction: 1025-entry table of the whole chain, linear interpolation.
class PigmentTable {
 public:
  explicit PigmentTable(PigmentModel model);
  glm::vec3 operator()(double chlorophyll_fraction) const;

 private:
  std::vector<glm::vec3> table_;
};

}  // namespace witherfield::grass
