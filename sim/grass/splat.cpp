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
#include <cstring>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/points.hpp"

// Hot loops are compiled for several instruction sets and chosen at start (not under sanitizers, whose
// runtime is not up yet when the choice is made). No contraction to FMA, so each gives the same bits.
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
constexpr std::size_t kPointGrain = 512, kBrickGrain = 16;

/// What is summed per voxel: sum of w, of w * scalar, of w * dyads (xx, xy, xz, yy, yz, zz).
enum Sum {
  kWeight,
  kWater,
  kChlorophyll,
  kStressVein,
  kStressMesophyll,
  kStrain,
  kSpecular,
  kRed,
  kGreen,
  kBlue,
  kTangent,
  kNormal = kTangent + 6,
  kSums = kNormal + 6
};
constexpr int kRecord = 24;    // floats of a point's record before its rows of weights: kSums, padded
constexpr int kReachMax = 12;  // sigma <= 4

/// Where a point's window lies, in bricks.
struct Window {
  std::array<std::int16_t, 3> first;
  std::array<std::int16_t, 3> count;
};

/// Points prepared for summing: a record each (values to be summed, then three rows of weights aligned to
/// bricks).
struct Packed {
  int row = 0;             ///< floats of a row of weights
  std::size_t stride = 0;  ///< floats of a record
  std::unique_ptr<float[]> records;
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
  std::vector<double> bell;  ///< exp(-k^2 / (2 sigma^2)), k = 0..reach

  explicit Kernel(double sigma)
      : reach(std::max(1, int(std::ceil(3 * sigma)))), inverse_variance(1 / (sigma * sigma)) {
    for (int k = 0; k <= reach; ++k) bell.push_back(std::exp(-0.5 * k * k * inverse_variance));
  }
};

/// Voxel coordinate of x along an axis with n voxels, brought into the grid.
double wrapped(double x, int n, int margin) {
  if (x >= 0 && x < n) return x;
  const double tile = n - 2.0 * margin;
  x -= std::floor((x - margin) / tile) * tile;
  return std::clamp(x, 0.0, std::nextafter(double(n), 0.0));
}

/// exp(x) for |x| < 6, to 1e-14: Taylor series of x / 64, squared six times. Unlike the library's, the same
/// bits everywhere.
double small_exp(double x) {
  const double t = x / 64;
  double y = 1;
  for (int n = 9; n > 0; --n) y = 1 + t * y * (1.0 / n);
  for (int n = 0; n < 6; ++n) y *= y;
  return y;
}

/// One axis of a point: bricks touched, and the row of weights (sum = scale) that starts at the first brick.
void weigh_axis(const Kernel& kernel, double x, int n, double scale, float* row, int row_length,
                std::int16_t& first_brick, std::int16_t& bricks) {
  const int own = static_cast<int>(x);
  const int lo = std::max(own - kernel.reach, 0), hi = std::min(own + kernel.reach, n - 1);
  first_brick = static_cast<std::int16_t>(lo / kEdge);
  bricks = static_cast<std::int16_t>(hi / kEdge - lo / kEdge + 1);
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
  for (int v = lo; v <= hi; ++v) row[v - first_brick * kEdge] = float(at_own[v - own] * factor);
}

void put_dyad(float* at, const glm::vec3& v) {
  at[0] = v.x * v.x, at[1] = v.x * v.y, at[2] = v.x * v.z;
  at[3] = v.y * v.y, at[4] = v.y * v.z, at[5] = v.z * v.z;
}

void pack_point(const PointSet& points, std::size_t i, const GridShape& shape, const Kernel& kernel,
                Packed& packed) {
  const glm::dvec3 p = (points.position_m[i] - shape.origin_m) / shape.spacing_m;
  const double weight = points.mass_kg[i] / points.point_mass_kg;
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(weight))
    throw SolverFailure("splat_points: position or mass of point " + std::to_string(i) + " is not finite");
  float* record = packed.records.get() + i * packed.stride;
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
  for (int n = kSums; n < kRecord; ++n) record[n] = 0;
  float* row = record + kRecord;
  Window& w = packed.windows[i];
  weigh_axis(kernel, wrapped(p.x, shape.nx, shape.margin), shape.nx, 1, row, packed.row, w.first[0],
             w.count[0]);
  row += packed.row;
  weigh_axis(kernel, wrapped(p.y, shape.ny, shape.margin), shape.ny, 1, row, packed.row, w.first[1],
             w.count[1]);
  row += packed.row;
  const double z = std::clamp(p.z, 0.0, std::nextafter(double(shape.nz), 0.0));
  weigh_axis(kernel, z, shape.nz, weight, row, packed.row, w.first[2], w.count[2]);
}

Packed pack(const PointSet& points, const GridShape& shape, const Kernel& kernel) {
  Packed packed;
  packed.row = (2 * kernel.reach + 1 + 2 * (kEdge - 1)) / kEdge * kEdge;
  packed.stride = kRecord + 3 * std::size_t(packed.row);
  packed.records = std::make_unique_for_overwrite<float[]>(points.size() * packed.stride);
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

using Four = float __attribute__((vector_size(16)));
using FourInt = std::int32_t __attribute__((vector_size(16)));

/// A brick while it is summed. The sums of a voxel lie together: a point adds to them in two to six vector
/// additions, and only where its window is.
struct alignas(64) Sums {
  float of[kVoxels][kRecord];
  Four heaviest_weight[kVoxels / kEdge];
  FourInt heaviest[kVoxels / kEdge];  ///< point with the largest weight in the voxel, -1 where there is none
};

/// Part of a brick that a point's window covers, and the point's weights there.
struct Patch {
  const float *wx, *wy, *wz;
  int x, y_begin, y_end, z_begin, z_end;
};

/// First and one past the last non-zero of four.
inline std::pair<int, int> extent(const float* w) {
  int begin = 0, end = kEdge;
  while (begin < kEdge && w[begin] == 0) ++begin;
  while (end > begin && w[end - 1] == 0) --end;
  return {begin, end};
}

/// Adds a point to the `Width` voxels from x on in each row of its patch. (A fixed width: the loop over a row
/// has no branch to guess wrong.)
template <int Width>
[[gnu::always_inline]] inline void add_rows(const Patch& p, const float* __restrict values,
                                            std::int32_t point, Sums& __restrict sums) {
  const Four wx = {p.wx[0], p.wx[1], p.wx[2], p.wx[3]};
  const FourInt points = {point, point, point, point};
  for (int z = p.z_begin; z < p.z_end; ++z)
    for (int y = p.y_begin; y < p.y_end; ++y) {
      const int row = z * kEdge + y;
      const Four w = wx * (p.wz[z] * p.wy[y]);
      const FourInt heavier = w > sums.heaviest_weight[row];
      sums.heaviest_weight[row] = heavier ? w : sums.heaviest_weight[row];
      sums.heaviest[row] = heavier ? points : sums.heaviest[row];
      float* sum = sums.of[row * kEdge + p.x];
      alignas(16) float weight[kEdge];
      std::memcpy(weight, &w, sizeof w);
      for (int x = 0; x < Width; ++x)
        for (int s = 0; s < kRecord; ++s) sum[x * kRecord + s] += weight[p.x + x] * values[s];
    }
}

/// Sums the points of one brick. Their order is fixed, so the rounding is.
WITHERFIELD_EVERY_ISA
void gather(const float* records, std::size_t stride, int row, const Window* windows,
            const std::uint32_t* order, std::size_t count, int bx, int by, int bz, Sums& __restrict sums) {
  std::memset(sums.of, 0, sizeof sums.of);
  std::memset(sums.heaviest_weight, 0, sizeof sums.heaviest_weight);
  std::memset(sums.heaviest, 0xFF, sizeof sums.heaviest);
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t point = static_cast<std::int32_t>(order[n]);
    const Window& window = windows[point];
    const float* record = records + std::size_t(point) * stride;
    Patch patch;
    patch.wx = record + kRecord + (bx - window.first[0]) * kEdge;
    patch.wy = record + kRecord + row + (by - window.first[1]) * kEdge;
    patch.wz = record + kRecord + 2 * row + (bz - window.first[2]) * kEdge;
    const auto [x_begin, x_end] = extent(patch.wx);
    std::tie(patch.y_begin, patch.y_end) = extent(patch.wy);
    std::tie(patch.z_begin, patch.z_end) = extent(patch.wz);
    patch.x = x_begin;
    switch (x_end - x_begin) {
      case 1:
        add_rows<1>(patch, record, point, sums);
        break;
      case 2:
        add_rows<2>(patch, record, point, sums);
        break;
      case 3:
        add_rows<3>(patch, record, point, sums);
        break;
      case 4:
        add_rows<4>(patch, record, point, sums);
        break;
    }
  }
}

/// Dyad sums of the occupied voxels of a brick, packed, and the axes found from them.
struct alignas(64) Axes {
  float dyads[6][kVoxels];
  float x[kVoxels], y[kVoxels], z[kVoxels];  ///< guess, then axis

  void set(int n, const float* sum, const glm::vec3& guess) {
    for (int d = 0; d < 6; ++d) dyads[d][n] = sum[d];
    x[n] = guess.x, y[n] = guess.y, z[n] = guess.z;
  }
};

WITHERFIELD_EVERY_ISA
void principal_axes(Axes& __restrict a, int count) {
  for (int n = 0; n < count; ++n) {
    const float m[6] = {a.dyads[0][n], a.dyads[1][n], a.dyads[2][n],
                        a.dyads[3][n], a.dyads[4][n], a.dyads[5][n]};
    const glm::vec3 axis = principal_axis(m, glm::vec3(a.x[n], a.y[n], a.z[n]));
    a.x[n] = axis.x, a.y[n] = axis.y, a.z[n] = axis.z;
  }
}

/// Sums -> means, written to the brick.
void write_brick(const PointSet& points, const Sums& sums, float* brick) {
  const auto channel = [&](C c) { return brick + std::size_t(c) * kVoxels; };
  constexpr std::pair<C, Sum> kMeans[] = {{C::water, kWater},
                                          {C::chlorophyll_ug_cm2, kChlorophyll},
                                          {C::stress_vein_MPa, kStressVein},
                                          {C::stress_mesophyll_MPa, kStressMesophyll},
                                          {C::strain_shrink, kStrain},
                                          {C::specular, kSpecular},
                                          {C::diffuse_r, kRed},
                                          {C::diffuse_g, kGreen},
                                          {C::diffuse_b, kBlue}};
  const float per_weight = static_cast<float>(1 / points.proportion);
  std::memset(brick, 0, sizeof(float) * kTexelChannels * kVoxels);
  int voxels[kVoxels], count = 0;
  Axes tangents, normals;
  for (int v = 0; v < kVoxels; ++v) {
    const std::int32_t heaviest = sums.heaviest[v / kEdge][v % kEdge];
    if (heaviest < 0) continue;
    const float* sum = sums.of[v];
    const float inverse = 1 / sum[kWeight];
    channel(C::density)[v] = sum[kWeight] * per_weight;
    for (const auto& [c, s] : kMeans) channel(c)[v] = sum[s] * inverse;
    const std::size_t i = std::size_t(heaviest);
    channel(C::tissue)[v] = points.tissue[i];
    channel(C::blade_id)[v] = float(points.blade_id[i]);
    channel(C::arc)[v] = points.arc[i];
    tangents.set(count, sum + kTangent, points.tangent[i]);
    normals.set(count, sum + kNormal, points.normal[i]);
    voxels[count++] = v;
  }
  principal_axes(tangents, count);
  principal_axes(normals, count);
  for (int n = 0; n < count; ++n) {
    const int v = voxels[n];
    const float sign = tangents.z[n] < 0 ? -1.0f : 1.0f;
    channel(C::tangent_x)[v] = sign * tangents.x[n];
    channel(C::tangent_y)[v] = sign * tangents.y[n];
    channel(C::tangent_z)[v] = sign * tangents.z[n];
    channel(C::normal_x)[v] = normals.x[n];
    channel(C::normal_y)[v] = normals.y[n];
    channel(C::normal_z)[v] = normals.z[n];
  }
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
  const Packed packed = pack(points, shape, kernel);
  const Bins bins = sort_into_bricks(packed.windows, shape);
  out.reset_bricks(bins.cells, true);
  parallel_for(bins.cells.size(), kBrickGrain, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t b = begin; b < end; ++b) {
      const glm::ivec3 base = out.brick_base(int(b));
      gather(packed.records.get(), packed.stride, packed.row, packed.windows.data(),
             bins.order.data() + bins.start[b], bins.start[b + 1] - bins.start[b], base.x / kEdge,
             base.y / kEdge, base.z / kEdge, sums);
      write_brick(points, sums, out.channel(int(b), C::density));
    }
  });
}

}  // namespace witherfield::grass
