// Points -> texel, voxel-centric: points are sorted into the bricks that their windows touch, and each brick sums its
// points in local arrays and is written once. Nothing sweeps the empty space, no two threads write to one place.
//
// The Gaussian is separable and the window a cube, so weights are made per axis and normalised per axis; the sum over
// the cube is then the product of three sums that are 1. On an axis the weight at voxel own + k is
//   exp(-(d0 + k)^2 / (2 s^2)) ~ exp(-k^2 / (2 s^2)) * q^k,  q = exp(-d0 / s^2),
// (the factor exp(-d0^2 / (2 s^2)) cancels in the normalisation): one exponential per axis and point, none per voxel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/points.hpp"

// Hot loops are compiled for several instruction sets and chosen at start (not under sanitizers, whose runtime is not up
// yet when the choice is made). No contraction to FMA, so each gives the same bits.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WITHERFIELD_EVERY_ISA __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WITHERFIELD_EVERY_ISA
#endif

namespace witherfield::grass {
namespace {

using C = TexelChannel;
constexpr int kEdge = TexelGrid::kEdge, kVoxels = TexelGrid::kVoxels, kSlab = kEdge * kEdge;
constexpr std::size_t kPointGrain = 1024, kBrickGrain = 16;

/// What is summed per voxel: sum of w, of w * scalar, of w * dyads (xx, xy, xz, yy, yz, zz).
enum Sum {
  kWeight, kWater, kChlorophyll, kStressVein, kStressMesophyll, kStrain, kSpecular,
  kRed, kGreen, kBlue, kTangent, kNormal = kTangent + 6, kSums = kNormal + 6
};
constexpr int kRecord = 24;  // floats of a point's record before its rows of weights: kSums, padded

/// Where a point's window lies, in bricks.
struct Window {
  std::array<std::int16_t, 3> first;
  std::array<std::int16_t, 3> count;
};

/// Points prepared for summing: a record each (values to be summed, then three rows of weights aligned to bricks).
struct Packed {
  int row = 0;             ///< floats of a row of weights
  std::size_t stride = 0;  ///< floats of a record
  std::vector<float> records;
  std::vector<Window> windows;
};

/// Points of each touched brick, in ascending order: brick b has order[start[b]] .. order[start[b + 1] - 1].
struct Bins {
  std::vector<int> cells;
  std::vector<std::uint32_t> start, order;
};

struct Kernel {
  int reach;                 ///< voxels on each side of the point's own
  double inverse_variance;   ///< 1 / sigma^2
  std::vector<double> bell;  ///< exp(-k^2 / (2 sigma^2)), k = -reach..reach

  explicit Kernel(double sigma)
      : reach(std::max(1, int(std::ceil(3 * sigma)))), inverse_variance(1 / (sigma * sigma)) {
    for (int k = -reach; k <= reach; ++k) bell.push_back(std::exp(-0.5 * k * k * inverse_variance));
  }
};

/// Voxel coordinate of x along an axis with n voxels, brought into the grid.
double wrapped(double x, int n, int margin) {
  if (x >= 0 && x < n) return x;
  const double tile = n - 2.0 * margin;
  x -= std::floor((x - margin) / tile) * tile;
  return std::clamp(x, 0.0, std::nextafter(double(n), 0.0));
}

/// One axis of a point: bricks touched, and the row of weights (sum = scale) that starts at the first brick.
void weigh_axis(const Kernel& kernel, double x, int n, double scale, float* row, int row_length,
                std::int16_t& first_brick, std::int16_t& bricks) {
  const int own = static_cast<int>(x);
  const int lo = std::max(own - kernel.reach, 0), hi = std::min(own + kernel.reach, n - 1);
  first_brick = static_cast<std::int16_t>(lo / kEdge);
  bricks = static_cast<std::int16_t>(hi / kEdge - lo / kEdge + 1);
  std::fill_n(row, row_length, 0.0f);
  const double d0 = own + 0.5 - x, q = std::exp(-d0 * kernel.inverse_variance);
  double power = std::pow(q, lo - own), sum = 0;
  double weights[2 * 12 + 1];  // reach <= 12: sigma <= 4
  for (int v = lo; v <= hi; ++v, power *= q) {
    weights[v - lo] = kernel.bell[std::size_t(v - own + kernel.reach)] * power;
    sum += weights[v - lo];
  }
  for (int v = lo; v <= hi; ++v) row[v - first_brick * kEdge] = float(weights[v - lo] * (scale / sum));
}

void put_dyad(float* at, const glm::vec3& v) {
  at[0] = v.x * v.x, at[1] = v.x * v.y, at[2] = v.x * v.z;
  at[3] = v.y * v.y, at[4] = v.y * v.z, at[5] = v.z * v.z;
}

void pack_point(const PointSet& points, std::size_t i, const GridShape& shape, const Kernel& kernel, Packed& packed) {
  const glm::dvec3 p = (points.position_m[i] - shape.origin_m) / shape.spacing_m;
  const double weight = points.mass_kg[i] / points.point_mass_kg;
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(weight))
    throw SolverFailure("splat_points: position or mass of point " + std::to_string(i) + " is not finite");
  float* record = packed.records.data() + i * packed.stride;
  record[kWeight] = 1;
  record[kWater] = points.water[i];
  record[kChlorophyll] = points.chlorophyll_ug_cm2[i];
  record[kStressVein] = points.stress_vein_MPa[i];
  record[kStressMesophyll] = points.stress_mesophyll_MPa[i];
  record[kStrain] = points.strain_shrink[i];
  record[kSpecular] = points.specular[i];
  record[kRed] = points.diffuse[i].r, record[kGreen] = points.diffuse[i].g, record[kBlue] = points.diffuse[i].b;
  put_dyad(record + kTangent, points.tangent[i]);
  put_dyad(record + kNormal, points.normal[i]);
  float* row = record + kRecord;
  Window& w = packed.windows[i];
  weigh_axis(kernel, wrapped(p.x, shape.nx, shape.margin), shape.nx, 1, row, packed.row, w.first[0], w.count[0]);
  row += packed.row;
  weigh_axis(kernel, wrapped(p.y, shape.ny, shape.margin), shape.ny, 1, row, packed.row, w.first[1], w.count[1]);
  row += packed.row;
  const double z = std::clamp(p.z, 0.0, std::nextafter(double(shape.nz), 0.0));
  weigh_axis(kernel, z, shape.nz, weight, row, packed.row, w.first[2], w.count[2]);
}

Packed pack(const PointSet& points, const GridShape& shape, const Kernel& kernel) {
  Packed packed;
  packed.row = (2 * kernel.reach + 1 + 2 * (kEdge - 1)) / kEdge * kEdge;
  packed.stride = kRecord + 3 * std::size_t(packed.row);
  packed.records.resize(points.size() * packed.stride);
  packed.windows.resize(points.size());
  parallel_for(points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pack_point(points, i, shape, kernel, packed);
  });
  return packed;
}

/// Calls visit(cell) for every brick cell that a window touches.
template <class Visit>
void for_cells(const Window& w, int bricks_x, int bricks_y, const Visit& visit) {
  for (int z = w.first[2]; z < w.first[2] + w.count[2]; ++z)
    for (int y = w.first[1]; y < w.first[1] + w.count[1]; ++y)
      for (int x = w.first[0]; x < w.first[0] + w.count[0]; ++x)
        visit(std::size_t((z * bricks_y + y) * bricks_x + x));
}

/// Counting sort of the points by brick.
Bins sort_into_bricks(const std::vector<Window>& windows, const GridShape& shape) {
  const int bx = shape.nx / kEdge, by = shape.ny / kEdge, bz = shape.nz / kEdge;
  std::vector<std::uint32_t> at(std::size_t(bx) * by * bz, 0);
  for (const Window& w : windows) for_cells(w, bx, by, [&](std::size_t cell) { ++at[cell]; });
  Bins bins;
  std::uint32_t total = 0;
  for (std::size_t cell = 0; cell < at.size(); ++cell) {
    if (at[cell] == 0) continue;
    bins.cells.push_back(int(cell));
    bins.start.push_back(total);
    total += std::exchange(at[cell], total);
  }
  bins.start.push_back(total);
  bins.order.resize(total);
  for (std::size_t i = 0; i < windows.size(); ++i)
    for_cells(windows[i], bx, by, [&](std::size_t cell) { bins.order[at[cell]++] = std::uint32_t(i); });
  return bins;
}

struct alignas(64) Sums {
  float of[kSums][kVoxels];
  float heaviest_weight[kVoxels];
  std::int32_t heaviest[kVoxels];  ///< point with the largest weight in the voxel, -1 where there is none
};

/// Sums the points of one brick. Their order is fixed, so the rounding is.
WITHERFIELD_EVERY_ISA
void gather(const float* records, std::size_t stride, int row, const Window* windows, const std::uint32_t* order,
            std::size_t count, int bx, int by, int bz, Sums& __restrict sums) {
  std::memset(sums.of, 0, sizeof sums.of);
  std::memset(sums.heaviest_weight, 0, sizeof sums.heaviest_weight);
  std::memset(sums.heaviest, 0xFF, sizeof sums.heaviest);
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t point = static_cast<std::int32_t>(order[n]);
    const Window& window = windows[point];
    const float* record = records + std::size_t(point) * stride;
    const float* wx = record + kRecord + (bx - window.first[0]) * kEdge;
    const float* wy = record + kRecord + row + (by - window.first[1]) * kEdge;
    const float* wz = record + kRecord + 2 * row + (bz - window.first[2]) * kEdge;
    alignas(64) float layer[kSlab];
    for (int v = 0; v < kSlab; ++v) layer[v] = wy[v / kEdge] * wx[v % kEdge];
    for (int z = 0; z < kEdge; ++z) {
      if (wz[z] == 0) continue;
      alignas(64) float w[kSlab];
#pragma GCC unroll 1
      for (int v = 0; v < kSlab; ++v) w[v] = layer[v] * wz[z];
      for (int s = 0; s < kSums; ++s) {
        float* sum = sums.of[s] + z * kSlab;
        const float value = record[s];
#pragma GCC unroll 1
        for (int v = 0; v < kSlab; ++v) sum[v] += w[v] * value;
      }
      float* heaviest_weight = sums.heaviest_weight + z * kSlab;
      std::int32_t* heaviest = sums.heaviest + z * kSlab;
#pragma GCC unroll 1
      for (int v = 0; v < kSlab; ++v) {
        const bool heavier = w[v] > heaviest_weight[v];
        heaviest_weight[v] = heavier ? w[v] : heaviest_weight[v];
        heaviest[v] = heavier ? point : heaviest[v];
      }
    }
  }
}

/// Principal axes of 64 dyad sums; `guess` in, axis out (see principal_axis).
WITHERFIELD_EVERY_ISA
void principal_axes(const float (*__restrict dyads)[kVoxels], float* __restrict x, float* __restrict y,
                    float* __restrict z) {
  for (int v = 0; v < kVoxels; ++v) {
    const float m[6] = {dyads[0][v], dyads[1][v], dyads[2][v], dyads[3][v], dyads[4][v], dyads[5][v]};
    const glm::vec3 axis = principal_axis(m, glm::vec3(x[v], y[v], z[v]));
    x[v] = axis.x, y[v] = axis.y, z[v] = axis.z;
  }
}

/// Sums -> means, written to the brick.
void write_brick(const PointSet& points, const Sums& sums, TexelGrid& out, int brick) {
  const auto channel = [&](C c) { return out.channel(brick, c); };
  float inverse[kVoxels];
  float* density = channel(C::density);
  const float per_weight = static_cast<float>(1 / points.proportion);
  for (int v = 0; v < kVoxels; ++v) {
    const float weight = sums.of[kWeight][v];
    density[v] = weight * per_weight;
    inverse[v] = weight > 0 ? 1 / weight : 0.0f;
  }
  constexpr std::pair<C, Sum> kMeans[] = {
      {C::water, kWater}, {C::chlorophyll_ug_cm2, kChlorophyll}, {C::stress_vein_MPa, kStressVein},
      {C::stress_mesophyll_MPa, kStressMesophyll}, {C::strain_shrink, kStrain}, {C::specular, kSpecular},
      {C::diffuse_r, kRed}, {C::diffuse_g, kGreen}, {C::diffuse_b, kBlue}};
  for (const auto& [c, sum] : kMeans) {
    float* mean = channel(c);
    for (int v = 0; v < kVoxels; ++v) mean[v] = sums.of[sum][v] * inverse[v];
  }
  float *tissue = channel(C::tissue), *blade = channel(C::blade_id), *arc = channel(C::arc);
  float *tx = channel(C::tangent_x), *ty = channel(C::tangent_y), *tz = channel(C::tangent_z);
  float *nx = channel(C::normal_x), *ny = channel(C::normal_y), *nz = channel(C::normal_z);
  for (int v = 0; v < kVoxels; ++v) {
    const std::int32_t h = sums.heaviest[v];
    const std::size_t i = h < 0 ? 0 : std::size_t(h);
    const glm::vec3 t = h < 0 ? glm::vec3(0) : points.tangent[i], n = h < 0 ? glm::vec3(0) : points.normal[i];
    tissue[v] = h < 0 ? 0.0f : float(points.tissue[i]);
    blade[v] = h < 0 ? 0.0f : float(points.blade_id[i]);
    arc[v] = h < 0 ? 0.0f : points.arc[i];
    tx[v] = t.x, ty[v] = t.y, tz[v] = t.z;
    nx[v] = n.x, ny[v] = n.y, nz[v] = n.z;
  }
  principal_axes(sums.of + kTangent, tx, ty, tz);
  principal_axes(sums.of + kNormal, nx, ny, nz);
  for (int v = 0; v < kVoxels; ++v) {
    const float sign = tz[v] < 0 ? -1.0f : 1.0f;
    tx[v] *= sign, ty[v] *= sign, tz[v] *= sign;
  }
}

void check(const PointSet& points, double sigma_voxels) {
  if (!(sigma_voxels >= 0.3 && sigma_voxels <= 4))
    throw InvalidInput("splat_points: sigma must be within 0.3..4 voxels, got " + std::to_string(sigma_voxels));
  if (!(points.proportion > 0))
    throw InvalidInput("splat_points: proportion must be > 0 points per unit of density, got " +
                       std::to_string(points.proportion));
  if (points.size() && !(points.point_mass_kg > 0))
    throw InvalidInput("splat_points: point_mass_kg must be > 0 kg, got " + std::to_string(points.point_mass_kg));
}

}  // namespace

void splat_points(const PointSet& points, const GridShape& shape, double sigma_voxels, TexelGrid& out) {
  check(points, sigma_voxels);
  if (out.shape() != shape) out = TexelGrid(shape);
  const Kernel kernel(sigma_voxels);
  const Packed packed = pack(points, shape, kernel);
  const Bins bins = sort_into_bricks(packed.windows, shape);
  out.reset_bricks(bins.cells, true);
  parallel_for(bins.cells.size(), kBrickGrain, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t b = begin; b < end; ++b) {
      const glm::ivec3 base = out.brick_base(int(b));
      gather(packed.records.data(), packed.stride, packed.row, packed.windows.data(),
             bins.order.data() + bins.start[b], bins.start[b + 1] - bins.start[b], base.x / kEdge, base.y / kEdge,
             base.z / kEdge, sums);
      write_brick(points, sums, out, int(b));
    }
  });
}

}  // namespace witherfield::grass
