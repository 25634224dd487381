#include "sim/grass/voxelize.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/grass/axial.hpp"
#include "sim/grass/clip.hpp"

namespace witherfield::grass {
namespace {

constexpr int kVein = 1, kMesophyll = 2;
constexpr int kBladesPerItem = 4;     // fixed, so that the pieces' order does not depend on the threads
constexpr double kLeastArea = 1e-12;  // of a voxel's face; thinner slivers are rounding noise of the cuts

/// One segment of one half strip: from the centre line (axis) to the rim, nodes k (0) and k + 1 (1).
/// Its two triangles are (axis0, rim0, rim1) and (axis0, rim1, axis1).
struct HalfStrip {
  glm::dvec3 axis[2], rim[2], outward[2];
  double half_width[2];
  int node;  // k, counted over all blades
};

/// Half strips of a blade around its axis: 2 for the ribbon, 8 for the cone (4 silhouettes), and their share
/// of the area.
int half_strips(BladeForm form) {
  return form == BladeForm::ribbon ? 2 : 8;
}
double area_share(BladeForm form) {
  return form == BladeForm::ribbon ? 1.0 : 0.25;
}

/// Unit direction from the axis to the rim of half strip `strip` at a node.
glm::dvec3 outward(const BladeState& s, std::size_t node, int strip) {
  const glm::dvec3 normal = blade_normal(s.tangent[node], s.side[node]);
  if (s.form == BladeForm::ribbon) {
    const double fold = s.fold_rad[node];
    return (strip ? -std::cos(fold) : std::cos(fold)) * s.side[node] + std::sin(fold) * normal;
  }
  constexpr double r = 0.70710678118654752440;
  static constexpr double cosine[8] = {1, r, 0, -r, -1, -r, 0, r}, sine[8] = {0, r, 1, r, 0, -r, -1, -r};
  return cosine[strip] * s.side[node] + sine[strip] * normal;
}

/// Calls visit for every half strip of one blade, from root to tip. Voxelisation and total area both
/// see the blade through this, so they cannot disagree.
template <class Visit>
void visit_half_strips(const BladeState& s, int blade, const Visit& visit) {
  const int strips = half_strips(s.form);
  const std::size_t first = std::size_t(blade) * std::size_t(s.nodes_per_blade());
  for (int strip = 0; strip < strips; ++strip) {
    HalfStrip h{};
    for (int k = 0; k <= s.segments; ++k) {
      const std::size_t node = first + std::size_t(k);
      h.axis[0] = h.axis[1], h.rim[0] = h.rim[1], h.outward[0] = h.outward[1],
      h.half_width[0] = h.half_width[1];
      h.axis[1] = s.node_m[node];
      h.outward[1] = outward(s, node, strip);
      h.half_width[1] = s.half_width_m[node];
      h.rim[1] = h.axis[1] + h.half_width[1] * h.outward[1];
      h.node = int(node) - 1;
      if (k > 0) visit(h);
    }
  }
}

/// What one blade has in one voxel, from one triangle.
struct Piece {
  std::uint32_t voxel;  // brick cell * 64 + voxel in the brick
  std::uint32_t node;   // segment's lower node * 2 + (1 if vein)
  float area;           // in faces of a voxel
  float along;          // place in the segment, 0 lower node .. 1 upper node
  glm::vec3 normal;
};

/// Cuts half strips into pieces. One per thread item.
class Cutter {
 public:
  Cutter(const BladeState& state, const GridShape& shape, double vein_fraction, std::vector<Piece>& out)
      : shape_(shape),
        cone_(state.form == BladeForm::cone),
        share_(area_share(state.form)),
        vein_(vein_fraction),
        tile_x_(shape.nx - 2 * shape.margin),
        tile_y_(shape.ny - 2 * shape.margin),
        out_(out) {}

  /// Splits both triangles where |u| = vein_fraction * half width, so that each polygon is of one tissue. The
  /// dividing line runs straight from node to node and meets the diagonal at D, where diag * w1 = vein * ((1
  /// - diag) * w0 + diag * w1).
  void add(const HalfStrip& h, const glm::dvec3& blade_normal) {
    const double w0 = h.half_width[0], w1 = h.half_width[1];
    if (!(w0 > 0) && !(w1 > 0)) return;
    const double diag = vein_ * w0 / (vein_ * w0 + (1 - vein_) * w1 + 1e-300);
    const Corner axis0 = corner(h.axis[0], 0), axis1 = corner(h.axis[1], 1), rim0 = corner(h.rim[0], 0),
                 rim1 = corner(h.rim[1], 1);
    const Corner split0 = mix(axis0, rim0, vein_), split1 = mix(axis1, rim1, vein_),
                 d = mix(axis0, rim1, std::min(diag, 1.0));
    node_ = std::uint32_t(h.node);
    const glm::dvec3 radial = h.outward[0] + h.outward[1];
    radial_ = glm::vec3(glm::dot(radial, radial) > 1e-12 ? glm::normalize(radial) : h.outward[0]);
    if (face(axis0, rim0, rim1, blade_normal)) {
      polygon({axis0, split0, d}, kVein);
      polygon({split0, rim0, rim1, d}, kMesophyll);
    }
    if (face(axis0, rim1, axis1, blade_normal)) {
      polygon({axis0, d, split1, axis1}, kVein);
      polygon({d, rim1, split1}, kMesophyll);
    }
  }

 private:
  Corner corner(const glm::dvec3& p, double along) const {
    const glm::dvec3 q = (p - shape_.origin_m) / shape_.spacing_m;
    return {q.x, q.y, q.z, along};
  }
  static Corner mix(const Corner& a, const Corner& b, double t) {
    Corner c;
    for (std::size_t k = 0; k < 4; ++k) c[k] = a[k] + t * (b[k] - a[k]);
    return c;
  }

  /// Sets plane and normal of the triangle; false when it has no area.
  bool face(const Corner& a, const Corner& b, const Corner& c, const glm::dvec3& toward) {
    const glm::dvec3 u(b[0] - a[0], b[1] - a[1], b[2] - a[2]), v(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
    const glm::dvec3 cross = glm::cross(u, v);
    const double length = glm::length(cross);
    if (!(length > 2 * kLeastArea)) return false;
    const glm::dvec3 unit = cross * ((glm::dot(cross, toward) < 0 ? -1.0 : 1.0) / length),
                     size = glm::abs(unit);
    normal_ = glm::vec3(unit);
    drop_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    per_projected_ = 0.5 * share_ / size[drop_];
    return true;
  }

  void polygon(std::initializer_list<Corner> corners, int tissue) {
    Polygon p;
    for (const Corner& c : corners) p.add(c);
    Piece piece;
    piece.node = node_ * 2 + (tissue == kVein);
    // Cone: the frame's normal is the direction from the axis, none in the vein (Jiao et al. 2010, sec. 2.1).
    piece.normal = !cone_ ? normal_ : tissue == kVein ? glm::vec3(0) : radial_;
    std::array<int, 3> voxel;
    cut_to_voxels<2>(p, shape_.nz, voxel,
                     [&](const Polygon& part, int x, int y, int z) { emit(part, x, y, z, piece); });
  }

  void emit(const Polygon& p, int x, int y, int z, Piece& piece) {
    // Area and centroid by a fan of triangles, projected along the axis that the plane faces most.
    const std::size_t b = drop_ == 0 ? 1 : 0, c = drop_ == 2 ? 1 : 2;
    const Corner& o = p.corner[0];
    double area = 0, moment = 0;
    for (int i = 1; i + 1 < p.count; ++i) {
      const Corner &q = p.corner[i], &r = p.corner[i + 1];
      const double cross = (q[b] - o[b]) * (r[c] - o[c]) - (q[c] - o[c]) * (r[b] - o[b]);
      area += cross;
      moment += cross * (o[3] + q[3] + r[3]);
    }
    const double faces = std::abs(area) * per_projected_;
    if (!(faces > kLeastArea)) return;
    x = wrap(x, shape_.nx, tile_x_);
    y = wrap(y, shape_.ny, tile_y_);
    constexpr int e = TexelGrid::kEdge;
    const int cell = ((z / e) * (shape_.ny / e) + y / e) * (shape_.nx / e) + x / e;
    piece.voxel = std::uint32_t(cell) * TexelGrid::kVoxels + std::uint32_t(((z % e) * e + y % e) * e + x % e);
    piece.area = float(faces);
    piece.along = float(std::clamp(moment / (3 * area), 0.0, 1.0));
    out_.push_back(piece);
  }

  /// Nearest voxel inside the grid that is a whole number of tiles away.
  static int wrap(int i, int n, int tile) {
    if (i < 0) return i + (-i + tile - 1) / tile * tile;
    if (i >= n) return i - (i - n + tile) / tile * tile;
    return i;
  }

  const GridShape& shape_;
  bool cone_;
  double share_, vein_;
  int tile_x_, tile_y_;
  std::vector<Piece>& out_;
  std::uint32_t node_ = 0;
  glm::vec3 radial_{0}, normal_{0};
  int drop_ = 0;
  double per_projected_ = 0;
};

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
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 p = s.node_m[i];
    const double size = std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + std::abs(s.half_width_m[i]);
    if (!(size < 1e3) || s.half_width_m[i] < 0)
      throw InvalidInput("voxelize: node " + std::to_string(int(i) % s.nodes_per_blade()) + " of blade " +
                         std::to_string(int(i) / s.nodes_per_blade()) + " is at (" + std::to_string(p.x) +
                         ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ") m with half width " +
                         std::to_string(s.half_width_m[i]) + " m; must be finite, within 1000 m, width >= 0");
  }
}

double triangle_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
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
    visit_half_strips(state, blade, [&](const HalfStrip& h) {
      total += triangle_area(h.axis[0], h.rim[0], h.rim[1]) + triangle_area(h.axis[0], h.rim[1], h.axis[1]);
    });
  return total * area_share(state.form);
}

}  // namespace witherfield::grass
