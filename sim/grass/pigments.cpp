#include "sim/grass/pigments.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/colour.hpp"

namespace witherfield::grass {
namespace {

// Chlorophyll a and b in diethyl ether (Strain et al. 1963 and Vernon & Seely 1966, as published by PhotochemCAD: Du et al. 1998),
// beta-carotene in methanol (LipidBank; zero beyond 540 nm), each with its peak at 1.
constexpr Spectrum kChlA{0.5698, 0.6418, 0.7525, 0.9661, 0.2004, 0.0276, 0.0113, 0.0087, 0.0105, 0.0156, 0.0169,
                         0.0173, 0.0267, 0.034,  0.0292, 0.025,  0.0404, 0.0608, 0.0602, 0.046,  0.0827, 0.1172,
                         0.1109, 0.0781, 0.1081, 0.3439, 0.7607, 0.2878, 0.0313, 0.0089, 0.0037};
constexpr Spectrum kChlB{0.0936, 0.1254, 0.2643, 0.3598, 0.4386, 0.9371, 0.7407, 0.2177, 0.0441, 0.024,  0.0237,
                         0.0238, 0.0265, 0.0341, 0.043,  0.0454, 0.0481, 0.0497, 0.053,  0.0695, 0.065,  0.0547,
                         0.0522, 0.1097, 0.3331, 0.1947, 0.0336, 0.0114, 0.007,  0.0039, 0.003};
constexpr Spectrum kBetaCarotene{0.3555, 0.4941, 0.6553, 0.7421, 0.9116, 0.9981, 0.8973, 0.8736, 0.8551, 0.6019, 0.253,
                                 0.0873, 0.0281, 0.0068, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
// Specific absorption of chlorophyll in the leaf, cm2/ug: PROSPECT-D (Feret et al. 2017).
constexpr Spectrum kKab{0.06488, 0.07149, 0.06982, 0.07245, 0.07379, 0.05877, 0.04387, 0.03973, 0.03678, 0.02966, 0.01905,
                        0.0097,  0.00433, 0.00407, 0.00679, 0.00931, 0.01105, 0.0136,  0.01695, 0.01942, 0.02085, 0.02318,
                        0.02653, 0.02798, 0.03125, 0.03901, 0.04749, 0.06611, 0.06892, 0.03367, 0.01224};
constexpr double kKabMax = 0.07469;  // its maximum over 400..700 nm at 1 nm
// Dry long grass: USGS spectral library 7 (Kokaly et al. 2017), mixture AMX32 less its tenth of lawn grass GDS91.
constexpr Spectrum kDryGrass{0.0414,  0.05854, 0.07801, 0.09881, 0.11778, 0.13396, 0.14641, 0.16008, 0.17231, 0.18248, 0.19312,
                             0.20161, 0.2109,  0.21851, 0.22861, 0.23494, 0.2427,  0.25136, 0.26024, 0.26726, 0.27158, 0.27701,
                             0.28472, 0.29044, 0.29648, 0.30317, 0.30796, 0.31178, 0.31613, 0.32164, 0.32508};
// CIE 1931 2-degree colour matching functions and illuminant D65 (CIE 15).
constexpr Spectrum kX{0.01431, 0.04351, 0.13438, 0.2839, 0.34828, 0.3362, 0.2908, 0.19536, 0.09564, 0.03201, 0.0049,
                      0.0093,  0.06327, 0.1655,  0.2904, 0.43345, 0.5945, 0.7621, 0.9163,  1.0263,  1.0622,  1.0026,
                      0.85445, 0.6424,  0.4479,  0.2835, 0.1649,  0.0874, 0.04677, 0.0227, 0.01136};
constexpr Spectrum kY{0.0004, 0.00121, 0.004, 0.0116, 0.023, 0.038, 0.06,  0.09098, 0.13902, 0.20802, 0.323,
                      0.503,  0.71,    0.862, 0.954,  0.99495, 0.995, 0.952, 0.87,  0.757,   0.631,   0.503,
                      0.381,  0.265,   0.175, 0.107,  0.061, 0.032, 0.017, 0.00821, 0.0041};
constexpr Spectrum kZ{0.06785, 0.2074,  0.6456, 1.3856,  1.74706, 1.77211, 1.6692,  1.28764, 0.81295, 0.46518, 0.272,
                      0.1582,  0.07825, 0.04216, 0.0203, 0.00875, 0.0039,  0.0021,  0.00165, 0.0011,  0.0008,  0.00034,
                      0.00019, 5e-05,   2e-05,  0,       0,       0,       0,       0,       0};
constexpr Spectrum kD65{82.755,  91.486, 93.432,  86.682,  104.865, 117.008, 117.812, 114.861, 115.923, 108.811, 109.354,
                        107.802, 104.79, 107.689, 104.405, 104.046, 100,     96.334,  95.788,  88.686,  90.006,  89.599,
                        87.699,  83.289, 83.699,  80.027,  80.215,  82.278,  78.284,  69.721,  71.609};

/// Kubelka-Munk: absorption over scattering of an opaque layer of reflectance r.
double ks_of(double r) { return (1 - r) * (1 - r) / (2 * r); }
double reflectance_of(double ks) { return 1 + ks - std::sqrt(ks * ks + 2 * ks); }

glm::dvec3 integrate(const Spectrum& reflectance) {
  glm::dvec3 xyz(0);
  double white = 0;
  for (std::size_t i = 0; i < kBands; ++i) {
    xyz += kD65[i] * reflectance[i] * glm::dvec3(kX[i], kY[i], kZ[i]);
    white += kD65[i] * kY[i];
  }
  return xyz / white;
}

}  // namespace

Pigments paper_pigments(double c) { return {27 * c / 40, 9 * c / 40, 4.0 / 40}; }

const Spectrum& absorption_chl_a() { return kChlA; }
const Spectrum& absorption_chl_b() { return kChlB; }
const Spectrum& absorption_beta_carotene() { return kBetaCarotene; }
const Spectrum& absorption_chl_in_vivo() {
  static const Spectrum s = [] {
    Spectrum r;
    for (std::size_t i = 0; i < kBands; ++i) r[i] = kKab[i] / kKabMax;
    return r;
  }();
  return s;
}
const Spectrum& reflectance_dry_grass() { return kDryGrass; }

Spectrum reflectance_kubelka_munk(double c) {
  // Dry matter (which holds the residual carotenoids) plus in-vivo chlorophyll. The two coefficients are fitted so
  // that c = 1 is USGS lawn grass GDS91 (rmse 0.0099 over 400..700 nm) and c = 0 is dry long grass exactly.
  const double dry_factor = 1 + 1.965 * c, chlorophyll_factor = 13.44;
  const Spectrum& chl = absorption_chl_in_vivo();
  Spectrum r;
  for (std::size_t i = 0; i < kBands; ++i)
    r[i] = reflectance_of(dry_factor * ks_of(kDryGrass[i]) + chlorophyll_factor * c * chl[i]);
  return r;
}

Spectrum reflectance_paper(double c) {
  const Pigments p = paper_pigments(c);
  Spectrum r;
  for (std::size_t i = 0; i < kBands; ++i)
    r[i] = std::clamp(1.0 - (p.carotenoid * kBetaCarotene[i] + p.chl_a * kChlA[i] + p.chl_b * kChlB[i]), 0.0, 1.0);
  return r;
}

glm::dvec3 spectrum_to_xyz(const Spectrum& reflectance) { return integrate(reflectance); }

glm::dvec3 spectrum_to_linear_srgb(const Spectrum& reflectance) {
  // Cutting the integral at 400..700 nm tints white by 0.3 %: divide by what a perfect diffuser gives.
  static const glm::dvec3 white = [] {
    Spectrum one;
    one.fill(1.0);
    return xyz_to_linear_srgb(integrate(one));
  }();
  return xyz_to_linear_srgb(integrate(reflectance)) / white;
}

PigmentTable::PigmentTable(PigmentModel model) {
  constexpr int n = 1024;
  for (int i = 0; i <= n; ++i) {
    const double c = double(i) / n;
    const glm::dvec3 rgb = spectrum_to_linear_srgb(model == PigmentModel::paper ? reflectance_paper(c)
                                                                                : reflectance_kubelka_munk(c));
    table_.push_back(glm::vec3(std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)));
  }
}

glm::vec3 PigmentTable::operator()(double c) const {
  const double x = std::clamp(c, 0.0, 1.0) * double(table_.size() - 1);
  const std::size_t i = std::min(std::size_t(x), table_.size() - 2);
  const float t = float(x - double(i));
  return table_[i] * (1 - t) + table_[i + 1] * t;
}

}  // namespace witherfield::grass
