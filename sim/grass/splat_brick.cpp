#include "sim/grass/splat_brick.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "sim/grass/axial.hpp"

// The hot loops are compiled for several instruction sets and chosen at start (not under sanitizers, whose
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
constexpr int kEdge = TexelGrid::kEdge, kVoxels = TexelGrid::kVoxels, kRows = kVoxels / kEdge;

// A row of four voxels along x.
using Four = float __attribute__((vector_size(16)));
using FourInt = std::int32_t __attribute__((vector_size(16)));

/// A brick while it is summed. The sums of a voxel lie together: a point adds to them in two to six vector
/// additions, and only where its window is.
struct alignas(64) Sums {
  float of[kVoxels][kSplatRecord];
  Four heaviest_weight[kRows];
  FourInt heaviest[kRows];  ///< point with the largest weight in the voxel, -1 where there is none
};

/// Part of a brick that a point's window covers, and the point's weights there.
struct Patch {
  const float *wx, *wy, *wz;
  int begin[3], end[3];
};

/// Adds a point to the `Width` voxels of each row of its patch. (A fixed width: the loop over a row has no
/// branch to guess wrong.)
template <int Width>
[[gnu::always_inline]] inline void add_rows(const Patch& p, const float* __restrict values,
                                            std::int32_t point, Sums& __restrict sums) {
  const Four wx = {p.wx[0], p.wx[1], p.wx[2], p.wx[3]};
  const FourInt points = {point, point, point, point};
  for (int z = p.begin[2]; z < p.end[2]; ++z)
    for (int y = p.begin[1]; y < p.end[1]; ++y) {
      const int row = z * kEdge + y;
      const Four w = wx * (p.wz[z] * p.wy[y]);
      const FourInt heavier = w > sums.heaviest_weight[row];
      sums.heaviest_weight[row] = heavier ? w : sums.heaviest_weight[row];
      sums.heaviest[row] = heavier ? points : sums.heaviest[row];
      float* sum = sums.of[row * kEdge + p.begin[0]];
      alignas(16) float weight[kEdge];
      std::memcpy(weight, &w, sizeof w);
      for (int x = 0; x < Width; ++x)
        for (int s = 0; s < kSplatRecord; ++s)
          sum[x * kSplatRecord + s] += weight[p.begin[0] + x] * values[s];
    }
}

Patch patch_of(const SplatWindow& window, const float* rows, int row, const std::array<int, 3>& brick) {
  Patch p;
  const float** weights[3] = {&p.wx, &p.wy, &p.wz};
  for (std::size_t a = 0; a < 3; ++a) {
    *weights[a] = rows + int(a) * row + (brick[a] - window.lo[a] / kEdge) * kEdge;
    p.begin[a] = std::max(window.lo[a] - brick[a] * kEdge, 0);
    p.end[a] = std::min(window.hi[a] + 1 - brick[a] * kEdge, kEdge);
  }
  return p;
}

/// Sums the points of one brick. Their order is fixed, so the rounding is.
WITHERFIELD_EVERY_ISA
void gather(const SplatRecords& records, const std::uint32_t* order, std::size_t count,
            const std::array<int, 3>& brick, Sums& __restrict sums) {
  std::memset(sums.of, 0, sizeof sums.of);
  std::memset(sums.heaviest_weight, 0, sizeof sums.heaviest_weight);
  std::memset(sums.heaviest, 0xFF, sizeof sums.heaviest);
  for (std::size_t n = 0; n < count; ++n) {
    const std::int32_t point = static_cast<std::int32_t>(order[n]);
    const float* record = records.floats.get() + std::size_t(point) * records.stride;
    const Patch patch =
        patch_of(records.windows[std::size_t(point)], record + kSplatRecord, records.row, brick);
    switch (patch.end[0] - patch.begin[0]) {
      case 1:
        add_rows<1>(patch, record, point, sums);
        break;
      case 2:
        add_rows<2>(patch, record, point, sums);
        break;
      case 3:
        add_rows<3>(patch, record, point, sums);
        break;
      default:
        add_rows<4>(patch, record, point, sums);
    }
  }
}

Four load(const float* at) {
  Four v;
  std::memcpy(&v, at, sizeof v);
  return v;
}
void store(float* at, const Four& v) {
  std::memcpy(at, &v, sizeof v);
}

/// Sums of a row's four voxels, turned around: one vector per sum.
struct RowSums {
  Four of[kSplatRecord];

  explicit RowSums(const float (*voxels)[kSplatRecord]) {
    for (int s = 0; s < kSplatRecord; s += 4) {
      const Four a = load(voxels[0] + s), b = load(voxels[1] + s), c = load(voxels[2] + s),
                 d = load(voxels[3] + s);
      const Four ab01 = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 ab23 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
      const Four cd01 = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 cd23 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
      of[s] = __builtin_shufflevector(ab01, cd01, 0, 1, 4, 5);
      of[s + 1] = __builtin_shufflevector(ab01, cd01, 2, 3, 6, 7);
      of[s + 2] = __builtin_shufflevector(ab23, cd23, 0, 1, 4, 5);
      of[s + 3] = __builtin_shufflevector(ab23, cd23, 2, 3, 6, 7);
    }
  }
};

/// Dyad sums of the occupied rows of a brick, packed, and the axes found from them.
struct alignas(64) Axes {
  float dyads[6][kVoxels];
  float axis[3][kVoxels];  ///< first the guess

  void set_row(int n, const Four* sums) {
    for (int d = 0; d < 6; ++d) store(dyads[d] + n * kEdge, sums[d]);
  }
};

WITHERFIELD_EVERY_ISA
void find_axes(Axes& __restrict a, int count) {
  for (int n = 0; n < count; ++n) {
    const float m[6] = {a.dyads[0][n], a.dyads[1][n], a.dyads[2][n],
                        a.dyads[3][n], a.dyads[4][n], a.dyads[5][n]};
    const glm::vec3 axis = principal_axis(m, glm::vec3(a.axis[0][n], a.axis[1][n], a.axis[2][n]));
    a.axis[0][n] = axis.x, a.axis[1][n] = axis.y, a.axis[2][n] = axis.z;
  }
}

/// What the heaviest points of a row decide: blade, arc, tissue, and which way the axes point.
void lead(const PointSet& points, const FourInt& heaviest, int row, int packed, float* channels,
          Axes& tangents, Axes& normals) {
  const auto at = [&](C c) { return channels + int(c) * kVoxels + row * kEdge; };
  for (int x = 0; x < kEdge; ++x) {
    const bool none = heaviest[x] < 0;
    const std::size_t i = none ? 0 : std::size_t(heaviest[x]);
    const glm::vec3 zero(0), t = none ? zero : points.tangent[i], n = none ? zero : points.normal[i];
    at(C::tissue)[x] = none ? 0.0f : float(points.tissue[i]);
    at(C::blade_id)[x] = none ? 0.0f : float(points.blade_id[i]);
    at(C::arc)[x] = none ? 0.0f : points.arc[i];
    const int v = packed * kEdge + x;
    tangents.axis[0][v] = t.x, tangents.axis[1][v] = t.y, tangents.axis[2][v] = t.z;
    normals.axis[0][v] = n.x, normals.axis[1][v] = n.y, normals.axis[2][v] = n.z;
  }
}

/// Sums -> means.
void write(const PointSet& points, const Sums& sums, float* channels) {
  constexpr std::pair<C, SplatSum> kMeans[] = {{C::water, kWater},
                                               {C::chlorophyll_ug_cm2, kChlorophyll},
                                               {C::stress_vein_MPa, kStressVein},
                                               {C::stress_mesophyll_MPa, kStressMesophyll},
                                               {C::strain_shrink, kStrain},
                                               {C::specular, kSpecular},
                                               {C::diffuse_r, kRed},
                                               {C::diffuse_g, kGreen},
                                               {C::diffuse_b, kBlue}};
  const auto at = [&](C c, int row) { return channels + int(c) * kVoxels + row * kEdge; };
  const float per_weight = static_cast<float>(1 / points.proportion);
  std::memset(channels, 0, sizeof(float) * kTexelChannels * kVoxels);
  int rows[kRows], count = 0;
  Axes tangents, normals;
  for (int row = 0; row < kRows; ++row) {
    const FourInt heaviest = sums.heaviest[row];
    if ((heaviest[0] & heaviest[1] & heaviest[2] & heaviest[3]) < 0) continue;  // all -1
    const RowSums sum(sums.of + row * kEdge);
    const Four weight = sum.of[kWeight], zero = {}, one = {1, 1, 1, 1};
    const Four inverse = weight > zero ? one / (weight > zero ? weight : one) : zero;
    store(at(C::density, row), weight * per_weight);
    for (const auto& [c, s] : kMeans) store(at(c, row), sum.of[s] * inverse);
    tangents.set_row(count, sum.of + kTangent);
    normals.set_row(count, sum.of + kNormal);
    lead(points, heaviest, row, count, channels, tangents, normals);
    rows[count++] = row;
  }
  find_axes(tangents, count * kEdge);
  find_axes(normals, count * kEdge);
  for (int n = 0; n < count; ++n) {
    const Four height = load(tangents.axis[2] + n * kEdge);
    for (int a = 0; a < 3; ++a) {
      const Four t = load(tangents.axis[a] + n * kEdge);
      store(at(C(int(C::tangent_x) + a), rows[n]), height < 0 ? -t : t);
      store(at(C(int(C::normal_x) + a), rows[n]), load(normals.axis[a] + n * kEdge));
    }
  }
}

}  // namespace

void splat_brick(const PointSet& points, const SplatRecords& records, const std::uint32_t* order,
                 std::size_t count, const std::array<int, 3>& brick, float* channels) {
  Sums sums;
  gather(records, order, count, brick, sums);
  write(points, sums, channels);
}

}  // namespace witherfield::grass
