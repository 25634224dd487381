#include "pov/tonemap.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/colour.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

// Rows of the matrices sum to 1, which keeps greys grey: linear sRGB -> working primaries with the reference
// rendering's desaturation, and back to linear sRGB after the curve.
constexpr double kIn[3][3] = {
    {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
constexpr double kOut[3][3] = {
    {1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07603}};

glm::dvec3 apply(const double (&m)[3][3], const glm::dvec3& c) {
  return {m[0][0] * c.x + m[0][1] * c.y + m[0][2] * c.z, m[1][0] * c.x + m[1][1] * c.y + m[1][2] * c.z,
          m[2][0] * c.x + m[2][1] * c.y + m[2][2] * c.z};
}

double curve(double v) {
  v = std::max(v, 0.0);
  return std::max(0.0, (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
}

/// exp of the log radiance plus its difference from a 3 x 3 binomial mean.
HdrImage sharpened(const HdrImage& in, double amount) {
  HdrImage out = in;
  const auto luminance = [&](int x, int y) {
    const glm::vec3& c =
        in.pixel[std::size_t(std::clamp(y, 0, in.height - 1)) * in.width + std::clamp(x, 0, in.width - 1)];
    return std::log(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z + 1e-3);
  };
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      double mean = 0;
      for (int k = 0; k < 9; ++k)
        mean += luminance(x + k % 3 - 1, y + k / 3 - 1) * ((k % 3 == 1) + 1) * ((k / 3 == 1) + 1) / 16;
      const double gain = std::exp(std::clamp(amount * (luminance(x, y) - mean), -0.7, 0.7));
      out.pixel[std::size_t(y) * in.width + x] *= float(gain);
    }
  return out;
}

}  // namespace

glm::dvec3 tone_map(const glm::dvec3& linear) {
  const glm::dvec3 v = apply(kIn, linear);
  const glm::dvec3 out = apply(kOut, {curve(v.x), curve(v.y), curve(v.z)});
  return {std::clamp(out.x, 0.0, 1.0), std::clamp(out.y, 0.0, 1.0), std::clamp(out.z, 0.0, 1.0)};
}

int mend_specks(HdrImage& image) {
  const HdrImage in = image;
  const auto luminance = [](const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
  int mended = 0;
  for (int y = 1; y + 1 < in.height; ++y)
    for (int x = 1; x + 1 < in.width; ++x) {
      const auto at = [&](int k) -> const glm::vec3& {
        return in.pixel[std::size_t(y + k / 3 - 1) * in.width + std::size_t(x + k % 3 - 1)];
      };
      float low = 1e30f, high = 0;
      glm::vec3 sum(0.0f);
      for (int k = 0; k < 9; ++k) {
        if (k == 4) continue;
        low = std::min(low, luminance(at(k)));
        high = std::max(high, luminance(at(k)));
        sum += at(k);
      }
      const float own = luminance(at(4));
      if (own <= 1.6f * high && own >= 0.6f * low) continue;
      image.pixel[std::size_t(y) * in.width + x] = sum / 8.0f;
      ++mended;
    }
  return mended;
}

std::vector<std::uint8_t> develop(const HdrImage& picture, double exposure, double sharpen) {
  const HdrImage image = sharpen > 0 ? sharpened(picture, sharpen) : picture;
  std::vector<std::uint8_t> out;
  out.reserve(image.pixel.size() * 3);
  for (std::size_t i = 0; i < image.pixel.size(); ++i) {
    const glm::dvec3 level = srgb_levels(tone_map(glm::dvec3(image.pixel[i]) * exposure));
    const auto noise = philox4x32({std::uint32_t(i), 0, 0, 0}, {0, 0});
    for (int c = 0; c < 3; ++c) {
      const double dither = noise[static_cast<std::size_t>(c)] * 0x1p-32;
      out.push_back(static_cast<std::uint8_t>(std::clamp(level[c] + dither, 0.0, 255.0)));
    }
  }
  return out;
}

}  // namespace witherfield::pov
