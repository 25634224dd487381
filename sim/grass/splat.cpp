// Points -> texel, voxel-centric: points are sorted into the bricks that their windows touch, and each brick
// sums its points in local arrays and is written once. Nothing sweeps the empty space, no two threads write
// to one place.
//
// The Gaussian is separable and the window a cube, so weights are made per axis and normalised per axis; the
// sum over the cube is then the product of three sums that are 1. On an axis the weight at voxel own + k is
//   exp(-(k - d)^2 / (2 s^2)) ~ exp(-k^2 / (2 s^2)) * q^k,  q = exp(d / s^2),  d = the point from the centre
//   of its own voxel
// (the factor exp(-d^2 / (2 s^2)) cancels in the normalisation): one exponential per axis and point, none per
// voxel.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/points.hpp"
#include "sim/grass/splat_brick.hpp"

namespace witherfield::grass {
namespace {

constexpr int kEdge = TexelGrid::kEdge;
constexpr int kReachMax = 12;  // sigma <= 4
constexpr std::size_t kPointGrain = 512, kBrickGrain = 16;

/// Points of each touched brick, in ascending order: brick b has order[start[b]] .. order[start[b + 1] - 1].
struct Bins {
  std::vector<int> cells;
  std::vector<std::uint32_t> start, order;
};

/// exp(x) for |x| < 6, to 1e-14: Taylor series of x / 64, squared six times. Unlike the library's, the same
/// bits everywhere.
double small_exp(double x) {
  const double t = x / 64;
  double y = 1;
  for (int n = 9; n > 0; --n) y = 1 + t * y * (1.0 / n);
  for (int n = 0; n < 6; ++n) y *= y;
  return y;
}

struct Kernel {
  int reach;                 ///< voxels on each side of the point's own
  double inverse_variance;   ///< 1 / sigma^2
  std::vector<double> bell;  ///< exp(-k^2 / (2 sigma^2)), k = 0..reach

  explicit Kernel(double sigma)
      : reach(splat_reach(sigma)), inverse_variance(1 / (sigma * sigma)) {
    const double step = small_exp(-0.5 * inverse_variance);
    double value = 1, ratio = step;  // (k + 1)^2 = k^2 + (2 k + 1)
    for (int k = 0; k <= reach; ++k, value *= ratio, ratio *= step * step) bell.push_back(value);
  }
};

/// Voxel coordinate of x along an axis with n voxels, brought into the grid.
double wrapped(double x, int n, int margin) {
  if (x >= 0 && x < n) return x;
  const double tile = n - 2.0 * margin;
  x -= std::floor((x - margin) / tile) * tile;
  return std::clamp(x, 0.0, std::nextafter(double(n), 0.0));
}

/// One axis of a point: its window, and the row of weights (sum = scale) that starts at the window's first
/// brick.
void weigh_axis(const Kernel& kernel, double x, int n, double scale, float* row, int row_length,
                std::int16_t& window_lo, std::int16_t& window_hi) {
  const int own = static_cast<int>(x);
  const int lo = std::max(own - kernel.reach, 0), hi = std::min(own + kernel.reach, n - 1);
  window_lo = static_cast<std::int16_t>(lo), window_hi = static_cast<std::int16_t>(hi);
  const double q = small_exp((x - own - 0.5) * kernel.inverse_variance), inverse_q = 1 / q;
  double weights[kReachMax + 1 + kReachMax];
  double* at_own = weights + kReachMax;
  const double* bell = kernel.bell.data();
  at_own[0] = 1;
  double sum = 1, power = q;
  for (int k = 1; k <= hi - own; ++k, power *= q) sum += at_own[k] = bell[k] * power;
  power = inverse_q;
  for (int k = 1; k <= own - lo; ++k, power *= inverse_q) sum += at_own[-k] = bell[k] * power;
  const double factor = scale / sum;
  std::fill_n(row, row_length, 0.0f);
  for (int v = lo; v <= hi; ++v) row[v - lo / kEdge * kEdge] = float(at_own[v - own] * factor);
}

void put_dyad(float* at, const glm::vec3& v) {
  at[0] = v.x * v.x, at[1] = v.x * v.y, at[2] = v.x * v.z;
  at[3] = v.y * v.y, at[4] = v.y * v.z, at[5] = v.z * v.z;
}

void pack_point(const PointSet& points, std::size_t i, const GridShape& shape, const Kernel& kernel,
                SplatRecords& records) {
  const glm::dvec3 p = (points.position_m[i] - shape.origin_m) / shape.spacing_m;
  const double weight = points.mass_kg[i] / points.point_mass_kg;
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(weight))
    throw SolverFailure("splat_points: position or mass of point " + std::to_string(i) + " is not finite");
  float* record = records.floats.get() + i * records.stride;
  record[kWeight] = 1;
  record[kWater] = points.water[i];
  record[kChlorophyll] = points.chlorophyll_ug_cm2[i];
  record[kStressVein] = points.stress_vein_MPa[i];
  record[kStressMesophyll] = points.stress_mesophyll_MPa[i];
  record[kStrain] = points.strain_shrink[i];
  record[kSpecular] = points.specular[i];
  record[kRed] = points.diffuse[i].r, record[kGreen] = points.diffuse[i].g,
  record[kBlue] = points.diffuse[i].b;
  put_dyad(record + kTangent, points.tangent[i]);
  put_dyad(record + kNormal, points.normal[i]);
  for (int n = kSplatSums; n < kSplatRecord; ++n) record[n] = 0;
  float* row = record + kSplatRecord;
  SplatWindow& w = records.windows[i];
  weigh_axis(kernel, wrapped(p.x, shape.nx, shape.margin), shape.nx, 1, row, records.row, w.lo[0], w.hi[0]);
  row += records.row;
  weigh_axis(kernel, wrapped(p.y, shape.ny, shape.margin), shape.ny, 1, row, records.row, w.lo[1], w.hi[1]);
  row += records.row;
  const double z = std::clamp(p.z, 0.0, std::nextafter(double(shape.nz), 0.0));
  weigh_axis(kernel, z, shape.nz, weight, row, records.row, w.lo[2], w.hi[2]);
}

SplatRecords pack(const PointSet& points, const GridShape& shape, const Kernel& kernel) {
  SplatRecords records;
  records.row = (2 * kernel.reach + 1 + 2 * (kEdge - 1)) / kEdge * kEdge;
  records.stride = kSplatRecord + 3 * std::size_t(records.row);
  records.floats = std::make_unique_for_overwrite<float[]>(points.size() * records.stride);
  records.windows.resize(points.size());
  parallel_for(points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pack_point(points, i, shape, kernel, records);
  });
  return records;
}

/// Calls visit(cell) for every brick cell that a window touches.
template <class Visit>
void for_cells(const SplatWindow& w, int bricks_x, int bricks_y, const Visit& visit) {
  for (int z = w.lo[2] / kEdge; z <= w.hi[2] / kEdge; ++z)
    for (int y = w.lo[1] / kEdge; y <= w.hi[1] / kEdge; ++y)
      for (int x = w.lo[0] / kEdge; x <= w.hi[0] / kEdge; ++x)
        visit(std::size_t((z * bricks_y + y) * bricks_x + x));
}

/// Counting sort of the points by brick.
Bins sort_into_bricks(const std::vector<SplatWindow>& windows, const GridShape& shape) {
  const int bx = shape.nx / kEdge, by = shape.ny / kEdge, bz = shape.nz / kEdge;
  std::vector<std::uint32_t> at(std::size_t(bx) * by * bz, 0);
  for (const SplatWindow& w : windows) for_cells(w, bx, by, [&](std::size_t cell) { ++at[cell]; });
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

void check(const PointSet& points, double sigma_voxels) {
  if (!(sigma_voxels >= 0.3 && sigma_voxels <= 4))
    throw InvalidInput("splat_points: sigma must be within 0.3..4 voxels, got " +
                       std::to_string(sigma_voxels));
  if (!(points.proportion > 0))
    throw InvalidInput("splat_points: proportion must be > 0 points per unit of density, got " +
                       std::to_string(points.proportion));
  if (points.size() && !(points.point_mass_kg > 0))
    throw InvalidInput("splat_points: point_mass_kg must be > 0 kg, got " +
                       std::to_string(points.point_mass_kg));
}

}  // namespace

void splat_points(const PointSet& points, const GridShape& shape, double sigma_voxels, TexelGrid& out) {
  check(points, sigma_voxels);
  if (out.shape() != shape) out = TexelGrid(shape);
  const Kernel kernel(sigma_voxels);
  const SplatRecords records = pack(points, shape, kernel);
  const Bins bins = sort_into_bricks(records.windows, shape);
  out.reset_bricks(bins.cells, true);
  parallel_for(bins.cells.size(), kBrickGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const glm::ivec3 base = out.brick_base(int(b));
      splat_brick(points, records, bins.order.data() + bins.start[b], bins.start[b + 1] - bins.start[b],
                  {base.x / kEdge, base.y / kEdge, base.z / kEdge},
                  out.channel(int(b), TexelChannel::density));
    }
  });
}

}  // namespace witherfield::grass
