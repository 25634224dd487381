#include "pov/transport.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

int wrap(int i, int n) {
  return ((i % n) + n) % n;
}

/// Shift of a layer by a constant fraction of a voxel: four cubic Lagrange weights, so that a hundred shifts
/// in a row blur far less than linear interpolation would.
struct Shift {
  int whole;
  std::array<float, 4> weight;
  explicit Shift(double d) : whole(int(std::floor(d))) {
    const double f = d - whole;
    weight = {float(-f * (f - 1) * (f - 2) / 6), float((f + 1) * (f - 1) * (f - 2) / 2),
              float(-(f + 1) * f * (f - 2) / 2), float((f + 1) * f * (f - 1) / 6)};
  }
};

struct Layer {
  int nx, ny;
  bool periodic;
  std::vector<float> value, half;  // half: after the shift in x
  std::vector<float> padded;       // one row with its neighbours, per row

  Layer(int nx_in, int ny_in, bool periodic_in)
      : nx(nx_in), ny(ny_in), periodic(periodic_in), value(std::size_t(nx) * ny, 0.0f), half(value) {}

  /// value(x, y) <- value(x + sx, y + sy), never negative.
  void shift(const Shift& sx, const Shift& sy) {
    parallel_for(std::size_t(ny), 64, [&](std::size_t begin, std::size_t end) {
      std::vector<float> row(std::size_t(nx) + 3);
      for (std::size_t y = begin; y < end; ++y) {
        const float* in = value.data() + y * std::size_t(nx);
        for (int x = 0; x < nx + 3; ++x) {
          const int i = x + sx.whole - 1;
          row[std::size_t(x)] = periodic ? in[wrap(i, nx)] : (i >= 0 && i < nx ? in[i] : 0.0f);
        }
        float* out = half.data() + y * std::size_t(nx);
        for (int x = 0; x < nx; ++x)
          out[x] = sx.weight[0] * row[std::size_t(x)] + sx.weight[1] * row[std::size_t(x) + 1] +
                   sx.weight[2] * row[std::size_t(x) + 2] + sx.weight[3] * row[std::size_t(x) + 3];
      }
    });
    const std::vector<float> zero(std::size_t(nx), 0.0f);
    parallel_for(std::size_t(ny), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        std::array<const float*, 4> in;
        for (int a = 0; a < 4; ++a) {
          const int j = int(y) + sy.whole + a - 1;
          in[std::size_t(a)] = periodic
                                   ? half.data() + std::size_t(wrap(j, ny)) * nx
                                   : (j >= 0 && j < ny ? half.data() + std::size_t(j) * nx : zero.data());
        }
        float* out = value.data() + y * std::size_t(nx);
        for (int x = 0; x < nx; ++x)
          out[x] = std::max(0.0f, sy.weight[0] * in[0][x] + sy.weight[1] * in[1][x] +
                                      sy.weight[2] * in[2][x] + sy.weight[3] * in[3][x]);
      }
    });
  }

  /// value += a * upper + b * lower.
  void add(const float* upper, float a, const float* lower, float b) {
    parallel_for(value.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) value[i] += a * (upper ? upper[i] : 0.0f) + b * lower[i];
    });
  }
};

}  // namespace

DenseDensity densify(const TexelGrid& grid, bool periodic) {
  const GridShape& s = grid.shape();
  DenseDensity d;
  d.periodic = periodic;
  d.spacing_m = s.spacing_m;
  const int margin = periodic ? s.margin : 0;
  d.nx = s.nx - 2 * margin;
  d.ny = s.ny - 2 * margin;
  d.nz = std::max(1, grid.occupied_box().hi.z);
  d.origin_m = s.origin_m + glm::dvec3(margin, margin, 0) * s.spacing_m;
  d.rho.assign(std::size_t(d.nx) * d.ny * d.nz, 0.0f);
  for (int b = 0; b < grid.brick_count(); ++b) {
    const float* density = grid.channel(b, TexelChannel::density);
    const glm::ivec3 base = grid.brick_base(b);
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      if (!(density[v] > 0)) continue;
      const int i = wrap(base.x + (v & 3) - margin, d.nx), j = wrap(base.y + ((v >> 2) & 3) - margin, d.ny);
      d.rho[(std::size_t(base.z + (v >> 4)) * d.ny + j) * d.nx + i] += density[v];
    }
  }
  return d;
}

namespace {

/// 0 where a voxel is much wider than a blade, 1 where much narrower.
double resolved(double blade_width_m, double spacing_m) {
  const double r = blade_width_m / spacing_m;
  return r * r / (r * r + 4);
}

}  // namespace

double depth_per_density(double blade_width_m, double spacing_m) {
  return 0.5 * (1 + 5.5 * resolved(blade_width_m, spacing_m));
}

double ray_start_m(double blade_width_m, double spacing_m) {
  return 1.8 * spacing_m * resolved(blade_width_m, spacing_m);
}

OpticalDepth::OpticalDepth(const DenseDensity& block, const glm::dvec3& to_light, double per_density)
    : nx_(block.nx),
      ny_(block.ny),
      nz_(block.nz),
      periodic_(block.periodic),
      origin_m_(block.origin_m),
      direction_(to_light),
      spacing_m_(block.spacing_m),
      depth_(block.rho.size()) {
  sweep(block, per_density);
}

void OpticalDepth::sweep(const DenseDensity& block, double per_density) {
  const double dx = direction_.x / direction_.z, dy = direction_.y / direction_.z;
  const int steps =
      std::max(1, int(std::ceil(std::max(std::abs(dx), std::abs(dy)))));  // at most a voxel sideways
  const float part = float(per_density / direction_.z / steps);
  const Shift sx(dx / steps), sy(dy / steps);
  const std::size_t n = std::size_t(nx_) * ny_;
  Layer layer(nx_, ny_, periodic_);
  for (int k = nz_ - 1; k >= 0; --k) {
    const float* upper = k + 1 < nz_ ? block.rho.data() + (k + 1) * n : nullptr;
    const float* lower = block.rho.data() + k * n;
    for (int s = 0; s < steps; ++s) {
      // Trapezium over the part of the way from height f0 to f1 (0 = upper layer, 1 = lower), density linear
      // in height.
      const float f0 = float(s) / float(steps), f1 = float(s + 1) / float(steps);
      layer.add(upper, part / 2 * (1 - f0), lower, part / 2 * f0);
      layer.shift(sx, sy);
      layer.add(upper, part / 2 * (1 - f1), lower, part / 2 * f1);
    }
    std::copy(layer.value.begin(), layer.value.end(), depth_.begin() + std::ptrdiff_t(k * n));
  }
}

double OpticalDepth::sample(double x, double y, double z) const {
  const int i = int(std::floor(x)), j = int(std::floor(y)), k = int(std::floor(z));
  const double f[3] = {x - i, y - j, z - k};
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    int a = i + (c & 1), b = j + ((c >> 1) & 1);
    const int h = std::max(0, k + (c >> 2));
    if (h >= nz_) continue;  // above the grass: nothing more in the way
    if (periodic_) {
      a = wrap(a, nx_);
      b = wrap(b, ny_);
    } else {
      a = std::clamp(a, 0, nx_ - 1);
      b = std::clamp(b, 0, ny_ - 1);
    }
    const double w =
        ((c & 1) ? f[0] : 1 - f[0]) * (((c >> 1) & 1) ? f[1] : 1 - f[1]) * ((c >> 2) ? f[2] : 1 - f[2]);
    sum += w * depth_[(std::size_t(h) * ny_ + b) * nx_ + a];
  }
  return sum;
}

double OpticalDepth::at(const glm::dvec3& p_m) const {
  glm::dvec3 p = (p_m - origin_m_) / spacing_m_ - glm::dvec3(0.5);
  if (!periodic_) {
    const double size[2] = {double(nx_ - 1), double(ny_ - 1)};
    double enter = 0, leave = 1e30;
    for (int a = 0; a < 2; ++a) {
      if (std::abs(direction_[a]) < 1e-12) {
        if (p[a] < 0 || p[a] > size[a]) return 0;
        continue;
      }
      const double t0 = (0 - p[a]) / direction_[a], t1 = (size[a] - p[a]) / direction_[a];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    if (enter > leave) return 0;
    p += direction_ * enter;
  }
  return p.z >= nz_ ? 0.0 : sample(p.x, p.y, p.z);
}

const std::vector<DomeSample>& sky_dome() {
  static const std::vector<DomeSample> dome = [] {
    std::vector<DomeSample> d{{{0, 0, 1}, 0.10}};
    const auto ring = [&](int count, double elevation_deg, double weight, double offset) {
      const double el = elevation_deg * std::numbers::pi / 180;
      for (int i = 0; i < count; ++i) {
        const double az = 2 * std::numbers::pi * (i + offset) / count;
        d.push_back(
            {{std::cos(az) * std::cos(el), std::sin(az) * std::cos(el), std::sin(el)}, weight / count});
      }
    };
    ring(4, 55, 0.38, 0.5);
    ring(8, 25, 0.52, 0.5);
    return d;
  }();
  return dome;
}

}  // namespace witherfield::pov
