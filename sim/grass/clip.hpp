// Convex polygons cut along the planes of a voxel grid, slab by slab in z, y and x. Both sides of a cut share
// the new corners, so the pieces' areas add up to the polygon's area to rounding error.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace witherfield::grass {

/// Corner of a polygon: position in voxel units (voxel (i, j, k) is [i, i+1] x [j, j+1] x [k, k+1]) and one
/// more value that is affine over the polygon (here: place along the blade's segment) and carried through the
/// cuts.
using Corner = std::array<double, 4>;

struct Polygon {
  static constexpr int kMax = 24;  ///< a quadrilateral cut by the six faces of a voxel has at most 10 corners
  int count = 0;
  Corner corner[kMax];
  void add(const Corner& c) {
    if (count < kMax) corner[count++] = c;
  }
};

/// Cuts `p` at coordinate[axis] = plane. Corners on the plane belong to both parts.
template <int axis>
inline void cut(const Polygon& p, double plane, Polygon& below, Polygon& above) {
  below.count = above.count = 0;
  const Corner* a = &p.corner[p.count - 1];
  double da = (*a)[axis] - plane;
  for (int i = 0; i < p.count; ++i) {
    const Corner* b = &p.corner[i];
    const double db = (*b)[axis] - plane;
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const double t = da / (da - db);
      Corner c;
      for (int k = 0; k < 4; ++k)
        c[std::size_t(k)] = (*a)[std::size_t(k)] + t * ((*b)[std::size_t(k)] - (*a)[std::size_t(k)]);
      c[axis] = plane;
      below.add(c);
      above.add(c);
    }
    if (db <= 0) below.add(*b);
    if (db >= 0) above.add(*b);
    a = b;
    da = db;
  }
}

/// Calls emit(polygon, x, y, z) for the piece of `p` in each voxel it meets, in ascending z, y, x. Layers
/// below 0 and from `layers` on count as part of the first and the last layer; x and y are not limited. A
/// polygon that lies in a plane between two voxels belongs to the upper one. `p` is used up.
template <int axis, class Emit>
inline void cut_to_voxels(Polygon& p, int layers, std::array<int, 3>& voxel, const Emit& emit) {
  double lo = p.corner[0][axis], hi = lo;
  for (int i = 1; i < p.count; ++i) {
    lo = std::min(lo, p.corner[i][axis]);
    hi = std::max(hi, p.corner[i][axis]);
  }
  int first = int(std::floor(lo)), last = std::max(first, int(std::ceil(hi)) - 1);
  if constexpr (axis == 2) first = std::clamp(first, 0, layers - 1), last = std::clamp(last, 0, layers - 1);
  const auto pass_on = [&](Polygon& piece, int index) {
    if (piece.count < 3) return;
    voxel[axis] = index;
    if constexpr (axis == 0)
      emit(piece, voxel[0], voxel[1], voxel[2]);
    else
      cut_to_voxels<axis - 1>(piece, layers, voxel, emit);
  };
  if (first == last) return pass_on(p, first);
  Polygon below, rest[2];
  Polygon* present = &p;
  for (int s = first; s < last; ++s) {
    Polygon* next = &rest[s & 1];
    cut<axis>(*present, s + 1.0, below, *next);
    pass_on(below, s);
    present = next;
  }
  pass_on(*present, last);
}

}  // namespace witherfield::grass
