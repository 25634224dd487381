#include "vis/reconstruct.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.hpp"

namespace witherfield::vis {
namespace {

/// One axis of the spline: out[n] = (in[n - stride] + 4 in[n] + in[n + stride]) / 6 for the voxels of the
/// planes k.
void along(const ImageValues& image, const std::vector<float>& in, std::vector<float>& out, int axis) {
  const auto nx = image.size[0], ny = image.size[1], nz = image.size[2];
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? std::size_t(nx) : std::size_t(nx) * std::size_t(ny);
  parallel_for(static_cast<std::size_t>(nz), 1, [&](std::size_t begin, std::size_t end) {
    for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
      for (int j = 0; j < ny; ++j) {
        const std::size_t row = image.index(0, j, k);
        const bool has_before = axis == 0 || (axis == 1 ? j > 0 : k > 0);
        const bool has_after = axis == 0 || (axis == 1 ? j + 1 < ny : k + 1 < nz);
        for (int i = 0; i < nx; ++i) {
          const std::size_t n = row + std::size_t(i);
          const bool before = has_before && (axis != 0 || i > 0),
                     after = has_after && (axis != 0 || i + 1 < nx);
          out[n] = ((before ? in[n - stride] : 0.0f) + 4 * in[n] + (after ? in[n + stride] : 0.0f)) / 6;
        }
      }
  });
}

}  // namespace

std::vector<float> spline_at_voxels(const ImageValues& scalar) {
  std::vector<float> a(scalar.values.begin(), scalar.values.end()), b(a.size());
  along(scalar, a, b, 0);
  along(scalar, b, a, 1);
  along(scalar, a, b, 2);
  return b;
}

void value_near(const ImageValues& field, std::span<const float> density, const glm::dvec3& at, bool nearest,
                double* out) {
  constexpr double kReach = 2;
  std::fill_n(out, field.components, 0.0);
  double total = 0, largest = 0;
  int lo[3], hi[3];
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::max(0, static_cast<int>(std::ceil(at[a] - kReach)));
    hi[a] = std::min(field.size[std::size_t(a)] - 1, static_cast<int>(std::floor(at[a] + kReach)));
  }
  for (int k = lo[2]; k <= hi[2]; ++k)
    for (int j = lo[1]; j <= hi[1]; ++j)
      for (int i = lo[0]; i <= hi[0]; ++i) {
        const std::size_t n = field.index(i, j, k);
        if (!(density[n] > 0)) continue;
        const double dx = i - at.x, dy = j - at.y, dz = k - at.z;
        const double weight = density[n] * std::exp(-1.5 * (dx * dx + dy * dy + dz * dz));
        if (nearest && weight <= largest) continue;
        largest = weight;
        total += weight;
        const float* value = field.values.data() + n * std::size_t(field.components);
        for (int c = 0; c < field.components; ++c) out[c] = nearest ? value[c] : out[c] + weight * value[c];
      }
  if (!nearest && total > 0)
    for (int c = 0; c < field.components; ++c) out[c] /= total;
}

}  // namespace witherfield::vis
