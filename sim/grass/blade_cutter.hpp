// Half strips of blades -> pieces that lie in one voxel each and are of one tissue each.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <vector>

#include "sim/core/texel_grid.hpp"
#include "sim/grass/clip.hpp"
#include "sim/grass/half_strips.hpp"

namespace witherfield::grass {

constexpr int kVein = 1, kMesophyll = 2;  // values of TexelChannel::tissue

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
  /// dividing line runs straight from node to node and meets the diagonal at D = axis0 + diag (rim1 - axis0),
  /// where diag w1 = vein ((1 - diag) w0 + diag w1).
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
  /// Of a voxel's face; thinner slivers are rounding noise of the cuts.
  static constexpr double kLeastArea = 1e-12;

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

}  // namespace witherfield::grass
