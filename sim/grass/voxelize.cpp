#include "sim/grass/voxelize.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/blade_cutter.hpp"
#include "sim/grass/half_strips.hpp"

namespace witherfield::grass {
namespace {

constexpr std::size_t kBladesPerItem = 2;  // fixed, so that the pieces' order does not depend on the threads

/// What is interpolated along a blade, side by side: one cache line per node.
struct alignas(64) NodeValues {
  float mean[10];  // as kMeans, then the other tissue's strain
  glm::vec3 tangent;
};
/// Channels that are plain means, in the order of NodeValues::mean. strain_shrink is the vein's at 4 and the
/// mesophyll's at 9.
constexpr int kMeans = 9;
constexpr TexelChannel kMeanChannel[kMeans] = {
    TexelChannel::water,           TexelChannel::chlorophyll_ug_cm2,
    TexelChannel::stress_vein_MPa, TexelChannel::stress_mesophyll_MPa,
    TexelChannel::strain_shrink,   TexelChannel::specular,
    TexelChannel::diffuse_r,       TexelChannel::diffuse_g,
    TexelChannel::diffuse_b};
constexpr int kStrain = 4, kMesophyllStrain = 9;

std::vector<NodeValues> node_values(const BladeState& s) {
  std::vector<NodeValues> values(s.node_m.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::vec3 d = s.diffuse[i];
    values[i] = {
        {s.water[i], float(s.chlorophyll[i] * s.chlorophyll_fresh_ug_cm2), s.stress_vein_MPa[i],
         s.stress_mesophyll_MPa[i], s.strain_vein[i], s.specular[i], d.x, d.y, d.z, s.strain_mesophyll[i]},
        glm::vec3(s.tangent[i])};
  }
  return values;
}

/// Running sums of one voxel.
struct VoxelSum {
  double area, vein_area, mean[kMeans];
  float tangent_dyad[6], normal_dyad[6];
  glm::vec3 tangent, normal;  // of the largest piece
  float largest;
  int pieces;
  int blade, best_blade;  // the blade whose pieces come now; the one with the largest area of those before
  double blade_area, blade_arc, best_area, best_arc;

  /// Pieces come in ascending order of blades: closes the account of the present one. On a tie the first
  /// stays.
  void close_blade() {
    if (blade_area > best_area) best_blade = blade, best_area = blade_area, best_arc = blade_arc;
  }
};

class BrickReducer {
 public:
  BrickReducer(const BladeState& state, const std::vector<NodeValues>& values, int first_blade_id)
      : values_(values),
        nodes_(state.nodes_per_blade()),
        segments_(state.segments),
        first_blade_id_(first_blade_id) {}

  void reduce(const Piece* begin, const Piece* end, TexelGrid& grid, int brick) {
    std::uint64_t touched = 0;
    for (const Piece* p = begin; p != end; ++p) {
      const int v = int(p->voxel % TexelGrid::kVoxels);
      if (!(touched >> v & 1)) sums_[v] = VoxelSum{}, sums_[v].blade = -1;
      touched |= std::uint64_t(1) << v;
      add(*p, sums_[v]);
    }
    float* out = grid.channel(brick, TexelChannel::density);
    std::fill(out, out + kTexelChannels * TexelGrid::kVoxels, 0.0f);
    for (int v = 0; v < TexelGrid::kVoxels; ++v)
      if (touched >> v & 1) write(sums_[v], out + v);
  }

 private:
  void add(const Piece& p, VoxelSum& s) const {
    const int node = int(p.node >> 1), blade = node / nodes_;
    const bool vein = p.node & 1;
    const double area = p.area, upper = area * p.along, lower = area - upper;
    const NodeValues &a = values_[std::size_t(node)], &b = values_[std::size_t(node) + 1];
    s.area += area;
    if (vein) s.vein_area += area;
    for (int i = 0; i < kMeans; ++i) {
      const int from = i == kStrain && !vein ? kMesophyllStrain : i;
      s.mean[i] += lower * a.mean[from] + upper * b.mean[from];
    }
    const glm::vec3 tangent = (1 - p.along) * a.tangent + p.along * b.tangent;
    add_dyad(s.tangent_dyad, p.area, tangent);
    add_dyad(s.normal_dyad, p.area, p.normal);
    ++s.pieces;
    if (p.area > s.largest) s.largest = p.area, s.tangent = tangent, s.normal = p.normal;
    if (blade != s.blade) {
      s.close_blade();
      s.blade = blade, s.blade_area = 0, s.blade_arc = 0;
    }
    s.blade_area += area;
    s.blade_arc += area * (node - blade * nodes_ + double(p.along)) / segments_;
  }

  /// `out` is the voxel's place in the brick's first channel.
  void write(VoxelSum& s, float* out) const {
    using C = TexelChannel;
    const auto put = [out](C c, float value, int component = 0) {
      out[(int(c) + component) * TexelGrid::kVoxels] = value;
    };
    s.close_blade();
    put(C::density, float(s.area));
    for (int i = 0; i < kMeans; ++i) put(kMeanChannel[i], float(s.mean[i] / s.area));
    put(C::tissue, s.vein_area > s.area - s.vein_area ? kVein : kMesophyll);
    put(C::blade_id, float(s.best_blade + first_blade_id_));
    put(C::arc, float(s.best_arc / s.best_area));
    const glm::vec3 tangent =
        s.pieces == 1 ? glm::normalize(s.tangent) : principal_axis(s.tangent_dyad, s.tangent);
    const glm::vec3 normal = s.pieces == 1 ? s.normal : principal_axis(s.normal_dyad, s.normal);
    for (int k = 0; k < 3; ++k) put(C::tangent_x, tangent[k], k), put(C::normal_x, normal[k], k);
  }

  const std::vector<NodeValues>& values_;
  int nodes_, segments_, first_blade_id_;
  VoxelSum sums_[TexelGrid::kVoxels];
};

void check(const BladeState& s) {
  const std::size_t n = s.node_m.size();
  const auto same = [n](const auto&... array) { return ((array.size() == n) && ...); };
  if (s.segments < 1 || n % std::size_t(s.nodes_per_blade()) != 0)
    throw InvalidInput("voxelize: " + std::to_string(n) + " nodes are not whole blades of " +
                       std::to_string(s.segments) + " segments (>= 1)");
  if (!same(s.tangent, s.side, s.half_width_m, s.fold_rad, s.water, s.chlorophyll, s.stress_vein_MPa,
            s.stress_mesophyll_MPa, s.strain_vein, s.strain_mesophyll, s.diffuse, s.specular))
    throw InvalidInput("voxelize: every array of a blade state must have one value per node (" +
                       std::to_string(n) + ")");
  const auto extent = [](const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 p = s.node_m[i];
    const double width = s.half_width_m[i];
    // Written so that a NaN anywhere fails.
    const bool good = extent(p) < 1e3 && width >= 0 && width < 1e3 && extent(s.tangent[i]) < 2 &&
                      extent(s.side[i]) < 2 && std::abs(s.fold_rad[i]) < 2;
    if (good) continue;
    throw InvalidInput("voxelize: node " + std::to_string(int(i) % s.nodes_per_blade()) + " of blade " +
                       std::to_string(int(i) / s.nodes_per_blade()) + " at (" + std::to_string(p.x) + ", " +
                       std::to_string(p.y) + ", " + std::to_string(p.z) + ") m with half width " +
                       std::to_string(width) + " m and fold " + std::to_string(s.fold_rad[i]) +
                       " rad: must be finite, within 1000 m, width >= 0, tangent and side unit");
  }
}

/// Pieces of all blades; element i holds those of blades [i, i + 1) * kBladesPerItem.
std::vector<std::vector<Piece>> cut_blades(const BladeState& state, const GridShape& shape,
                                           double vein_fraction) {
  const std::size_t blades = std::size_t(state.blade_count());
  std::vector<std::vector<Piece>> lists((blades + kBladesPerItem - 1) / kBladesPerItem);
  parallel_for(lists.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t item = begin; item < end; ++item) {
      const std::size_t last = std::min(blades, (item + 1) * kBladesPerItem);
      Cutter cutter(state, shape, vein_fraction, lists[item]);
      for (std::size_t blade = item * kBladesPerItem; blade < last; ++blade)
        visit_half_strips(state, int(blade), [&](const HalfStrip& h) {
          const std::size_t node = std::size_t(h.node);
          cutter.add(h, blade_normal(state.tangent[node], state.side[node]));
        });
    }
  });
  return lists;
}

}  // namespace

GridShape texel_shape(const TexelOptions& options) {
  const int n = options.resolution, margin = n * options.margin_sixteenths / 16;
  if (n < 32 || n > 512 || n % 32 != 0)
    throw InvalidInput("texel_shape: resolution must be a multiple of 32 in 32..512 voxels, got " +
                       std::to_string(n));
  if (options.margin_sixteenths < 0 || options.margin_sixteenths > 6)
    throw InvalidInput("texel_shape: margin_sixteenths must lie in 0..6, got " +
                       std::to_string(options.margin_sixteenths));
  if (!(options.size_m > 0))
    throw InvalidInput("texel_shape: size must be > 0 m, got " + std::to_string(options.size_m));
  const double spacing = options.size_m / (n - 2 * margin);
  return {n, n, n, glm::dvec3(-margin * spacing, -margin * spacing, 0.0), spacing, margin};
}

TexelGrid voxelize(const BladeState& state, const GridShape& shape, double vein_fraction,
                   int first_blade_id) {
  check(state);
  if (!(vein_fraction >= 0 && vein_fraction <= 1))
    throw InvalidInput("voxelize: vein_fraction must lie in 0..1, got " + std::to_string(vein_fraction));
  if (shape.margin < 0 || 2 * shape.margin >= std::min(shape.nx, shape.ny))
    throw InvalidInput("voxelize: the margin must leave a tile, got " + std::to_string(shape.margin) +
                       " voxels on each side of " + std::to_string(std::min(shape.nx, shape.ny)));
  TexelGrid grid(shape);
  std::vector<std::vector<Piece>> lists = cut_blades(state, shape, vein_fraction);

  // Stable counting sort by brick: pieces stay in the order (blade, cut) within each.
  const std::size_t cells = std::size_t(grid.bricks_x()) * grid.bricks_y() * grid.bricks_z();
  std::vector<std::uint32_t> place(cells + 1, 0);
  for (const auto& list : lists)
    for (const Piece& p : list) ++place[p.voxel / TexelGrid::kVoxels];
  std::vector<int> used;
  std::vector<std::uint32_t> start;
  std::uint32_t total = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t n = place[cell];
    place[cell] = total;
    if (n) used.push_back(int(cell)), start.push_back(total);
    total += n;
  }
  start.push_back(total);
  std::vector<Piece> pieces(total);
  for (auto& list : lists) {
    for (const Piece& p : list) pieces[place[p.voxel / TexelGrid::kVoxels]++] = p;
    std::vector<Piece>().swap(list);
  }

  grid.reset_bricks(used, true);
  const std::vector<NodeValues> values = node_values(state);
  parallel_for(used.size(), 64, [&](std::size_t begin, std::size_t end) {
    BrickReducer reducer(state, values, first_blade_id);
    for (std::size_t b = begin; b < end; ++b)
      reducer.reduce(pieces.data() + start[b], pieces.data() + start[b + 1], grid, int(b));
  });
  return grid;
}

double total_blade_area_m2(const BladeState& state) {
  double total = 0;
  for (int blade = 0; blade < state.blade_count(); ++blade)
    visit_half_strips(state, blade, [&](const HalfStrip& h) { total += area(h); });
  return total * area_share(state.form);
}

}  // namespace witherfield::grass
