#include "sim/fruit/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace witherfield::fruit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double rad(double deg) {
  return deg * kPi / 180;
}

/// Ring of n points at height z; half axes rx, ry; vertex 0 at -y.
std::vector<glm::dvec3> ellipse_ring(int n, double rx, double ry, double z) {
  std::vector<glm::dvec3> ring;
  for (int k = 0; k < n; ++k) {
    const double a = 2 * kPi * k / n - kPi / 2;
    ring.push_back({rx * std::cos(a), ry * std::sin(a), z});
  }
  return ring;
}

}  // namespace

ShapeMesh close_rings(const RingStack& stack) {
  const int n = int(stack.rings.front().size()), rings = int(stack.rings.size());
  ShapeMesh shape;
  auto& position = shape.mesh.position_m;
  auto& faces = shape.mesh.triangles;
  position.push_back(stack.bottom);
  for (const auto& ring : stack.rings) position.insert(position.end(), ring.begin(), ring.end());
  position.push_back(stack.top);
  const int last = int(position.size()) - 1;
  for (int k = 0; k < n; ++k) faces.push_back({0, ring_vertex(0, (k + 1) % n, n), ring_vertex(0, k, n)});
  for (int r = 0; r + 1 < rings; ++r)
    for (int k = 0; k < n; ++k) {
      const int a = ring_vertex(r, k, n), b = ring_vertex(r, (k + 1) % n, n);
      const int c = ring_vertex(r + 1, (k + 1) % n, n), d = ring_vertex(r + 1, k, n);
      const bool inside = stack.diagonals == Diagonals::crescent && 4 * k > n && 4 * (k + 1) < 3 * n;
      if (stack.diagonals == Diagonals::one_way || (2 * k < n) != inside) {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      } else {
        faces.push_back({a, b, d});
        faces.push_back({b, c, d});
      }
    }
  for (int k = 0; k < n; ++k)
    faces.push_back({ring_vertex(rings - 1, k, n), ring_vertex(rings - 1, (k + 1) % n, n), last});

  double lo = position.front().z, hi = lo, half = 0;
  for (const glm::dvec3& p : position) {
    lo = std::min(lo, p.z);
    hi = std::max(hi, p.z);
    half = std::max(half, std::abs(p.x));
  }
  for (const glm::dvec3& p : position)
    shape.paint.push_back({float(p.x / half), float((p.z - lo) / (hi - lo)), 0.0f});
  return shape;
}

void crease_ring(ControlMesh& mesh, int ring, int n) {
  for (int k = 0; k < n; ++k)
    mesh.crease_edges.push_back({ring_vertex(ring, k, n), ring_vertex(ring, (k + 1) % n, n)});
}

ShapeMesh wheat_kernel_shape() {
  // "bulging middle, thinner towards both ends, the upper end sharper, the lower end rounder" (Liu et al.
  // 2007, sec. 2.1)
  constexpr int n = 8;
  constexpr struct {
    double z, r;
  } profile[] = {{0.05, 0.52}, {0.22, 0.88}, {0.46, 1.0}, {0.70, 0.86}, {0.90, 0.46}};
  RingStack stack{{0, 0, 0}, {0, 0, 1.0}, {}, Diagonals::mirrored};
  for (const auto& p : profile) {
    auto ring = ellipse_ring(n, p.r, p.r, p.z);
    // The ventral groove: the vertex at +y sinks in, its neighbours form the two cheeks.
    const double depth = 0.46 * std::sin(kPi * p.z);
    ring[n / 2].y *= 1 - depth;
    for (const int k : {n / 2 - 1, n / 2 + 1}) ring[std::size_t(k)] *= glm::dvec3(0.86, 1.1, 1);
    stack.rings.push_back(std::move(ring));
  }
  ShapeMesh shape = close_rings(stack);
  for (std::size_t r = 0; r < std::size(profile); ++r)
    shape.paint[std::size_t(ring_vertex(int(r), n / 2, n))].z = 1;
  for (int r = 0; r + 1 < int(std::size(profile));
       ++r)  // its bottom is a crease, or subdivision would iron it out
    shape.mesh.crease_edges.push_back({ring_vertex(r, n / 2, n), ring_vertex(r + 1, n / 2, n)});
  shape.mesh.sharp_vertices = {int(shape.mesh.position_m.size()) - 1};  // valence 8: a true cusp
  return shape;
}

ShapeMesh boat_shape(const BoatOptions& o) {
  // A crescent for a ring: five points outside, five inside. The poles join inside and outside, so the scale
  // is closed.
  constexpr struct {
    double s, wrap, r;
  } profile[] = {
      {0.06, 0.62, 0.62}, {0.24, 0.95, 0.95}, {0.46, 1.0, 1.0}, {0.68, 0.92, 0.84}, {0.87, 0.72, 0.48}};
  const double z0 = -o.below, length = 1 + o.below + o.above;
  const auto axis_y = [&](double s) { return o.tip_in * std::max(0.0, s - 0.45) * (s - 0.45) / 0.3; };
  RingStack stack;
  stack.diagonals = Diagonals::crescent;
  for (const auto& p : profile) {
    const double outer = (1 + o.clearance + o.thickness) * p.r,
                 inner = outer - o.thickness * (0.4 + 0.6 * p.r);
    const auto at = [&](double radius, double share, double keel) {
      const double a = rad(o.wrap_deg) * p.wrap * share;
      return glm::dvec3(radius * std::sin(a), -(radius + keel) * std::cos(a) + axis_y(p.s),
                        z0 + length * p.s);
    };
    const double keel = o.keel * p.r;
    // Counter-clockwise from above, from the middle of the outside (at -y).
    stack.rings.push_back({at(outer, 0, keel), at(outer, 0.5, 0), at(outer, 1, 0), at(inner, 1, 0),
                           at(inner, 0.5, 0), at(inner, 0, keel), at(inner, -0.5, 0), at(inner, -1, 0),
                           at(outer, -1, 0), at(outer, -0.5, 0)});
  }
  const double end = (1 + o.clearance) * 0.35;
  stack.bottom = {0, -end, z0};
  stack.top = {0, -0.12 + axis_y(1.0), z0 + length};
  ShapeMesh shape = close_rings(stack);
  shape.mesh.sharp_vertices = {int(shape.mesh.position_m.size()) - 1};
  for (int r = 0; r < int(std::size(profile)); ++r)
    for (const int k : {2, 3, 7, 8}) shape.paint[std::size_t(ring_vertex(r, k, 10))].z = 1;  // the papery rim
  return shape;
}

ShapeMesh tube_shape(int rings, bool flat_ends) {
  constexpr int n = 6;
  RingStack stack{{0, 0, 0}, {0, 0, 1}, {}, Diagonals::one_way};
  for (int r = 0; r < rings; ++r) {
    const double margin = flat_ends ? 0 : 0.02;
    stack.rings.push_back(ellipse_ring(n, 1, 1, margin + (1 - 2 * margin) * r / (rings - 1)));
  }
  ShapeMesh shape = close_rings(stack);
  if (flat_ends) {
    crease_ring(shape.mesh, 0, n);
    crease_ring(shape.mesh, rings - 1, n);
  } else {
    shape.mesh.sharp_vertices = {int(shape.mesh.position_m.size()) - 1};
  }
  return shape;
}

std::vector<glm::dvec3> sweep_tube(const std::vector<glm::dvec3>& points, const std::vector<double>& radii) {
  constexpr int n = 6;
  std::vector<glm::dvec3> control{points.front()};
  // A frame that does not turn about the curve: the cross direction is carried along.
  glm::dvec3 across(1, 0, 0);
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const glm::dvec3 along = glm::normalize(points[std::min(i + 1, last)] - points[i > 0 ? i - 1 : 0]);
    if (i == 0 && std::abs(along.x) > 0.9) across = {0, 1, 0};
    across = glm::normalize(across - along * glm::dot(across, along));
    const glm::dvec3 other = glm::cross(along, across);
    for (int k = 0; k < n; ++k) {
      const double a = 2 * kPi * k / n - kPi / 2;
      control.push_back(points[i] + radii[i] * (across * std::cos(a) + other * std::sin(a)));
    }
  }
  control.push_back(points.back());
  return control;
}

double tube_gain(const ShapeMesh& tube, const Refinement& refinement) {
  std::vector<glm::dvec3> refined(refinement.vertices());
  refinement.evaluate(std::span<const glm::dvec3>(tube.mesh.position_m), std::span<glm::dvec3>(refined));
  double sum = 0;
  int count = 0;
  for (const glm::dvec3& p : refined)
    if (p.z > 0.3 && p.z < 0.7) {
      sum += std::hypot(p.x, p.y);
      ++count;
    }
  return sum / count;
}

ShapeMesh wedge_shape() {
  // Fig. 3(b) of the paper: thin below, a square ledge above. Here z is up and the front row looks to -y.
  ShapeMesh shape;
  shape.mesh.position_m = {{-0.6, 0.05, 0},  {0.6, 0.05, 0},  {0.6, -0.25, 0},  {-0.6, -0.25, 0},
                           {-0.95, 0.05, 1}, {0.95, 0.05, 1}, {0.95, -1.85, 1}, {-0.95, -1.85, 1}};
  constexpr std::array<std::array<int, 4>, 6> quads{
      {{0, 1, 2, 3}, {7, 6, 5, 4}, {3, 2, 6, 7}, {1, 0, 4, 5}, {2, 1, 5, 6}, {0, 3, 7, 4}}};
  for (const auto& q : quads) {
    // Each face is a fan round its own centre, so that the body keeps its mirror symmetry.
    const int centre = int(shape.mesh.position_m.size());
    glm::dvec3 sum(0);
    for (const int v : q) sum += shape.mesh.position_m[std::size_t(v)];
    shape.mesh.position_m.push_back(sum / 4.0);
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = q[k], b = q[(k + 1) % 4];
      shape.mesh.triangles.push_back({a, b, centre});
      if (a < b) shape.mesh.crease_edges.push_back({a, b});
    }
  }
  shape.mesh.sharp_vertices = {0, 1, 2, 3, 4, 5, 6, 7};
  for (const glm::dvec3& p : shape.mesh.position_m) shape.paint.push_back({float(p.x), float(p.z), 0});
  return shape;
}

ShapeMesh maize_kernel_shape(double ratio, double cut, double dent) {
  constexpr int n = 8;
  // Half width of the cylinder, which narrows towards the cob because the cells do, and of the cap above 0.9.
  // `fill`: control points near the crown stand out, so that the refined kernel keeps its girth up to there.
  constexpr struct {
    double z, a, fill;
  } profile[] = {
      {0.03, 0.52, 0.80}, {0.42, 0.84, 0.93}, {0.80, 1.0, 1.0}, {0.955, 1.04, 1.25}, {1.0, 0.62, 1.08}};
  constexpr int crown = 3;  // first ring of the cap
  RingStack stack{{0, 0, 0}, {0, 0, 1.01 - 1.7 * dent}, {}, Diagonals::mirrored};
  for (const auto& p : profile) {
    const double a = p.a, b = a / ratio, c = p.fill * std::min(cut, b);
    // The polygon round the cut ellipse: its ends, the cut planes, and where the tangent at 30 degrees from
    // the end meets the plane y = c; drawn out a little, because the refined section lies inside of its
    // corners.
    const double tangent = a * (1 - 0.5 * std::min(1.0, c / b)) / std::cos(rad(30));
    const double corner = std::min(1.3 * tangent, 0.97 * a), side = 1.03 * c;
    const double sink = p.z > 0.99 ? 0.45 * dent : 0;
    std::vector<glm::dvec3> ring{{0, -c, p.z}, {corner, -side, p.z}, {a, 0, p.z},  {corner, side, p.z},
                                 {0, c, p.z},  {-corner, side, p.z}, {-a, 0, p.z}, {-corner, -side, p.z}};
    for (glm::dvec3& v : ring) v.z -= sink;
    stack.rings.push_back(std::move(ring));
  }
  ShapeMesh shape = close_rings(stack);
  const int last = int(shape.mesh.position_m.size()) - 1;
  for (int k = 0; k < n; ++k) {
    shape.paint[std::size_t(ring_vertex(crown, k, n))] = {
        shape.paint[std::size_t(ring_vertex(crown, k, n))].x, 0.93f, 0.2f};
    shape.paint[std::size_t(ring_vertex(crown + 1, k, n))] = {
        shape.paint[std::size_t(ring_vertex(crown + 1, k, n))].x, 0.98f, 0.8f};
  }
  shape.paint[std::size_t(last)] = {0, 1, 1};
  return shape;
}

ShapeMesh grain_shape(bool pointed) {
  constexpr int n = 8;
  RingStack stack{{0, 0, 0}, {0, 0, 1}, {}, Diagonals::mirrored};
  for (const double z : {0.06, 0.27, 0.55, 0.81}) {
    const double s = 2 * z - 1;
    const double taper = pointed && z > 0.5 ? 1 - 0.5 * (z - 0.5) : 1;
    const double r = std::sqrt(std::max(0.05, 1 - 0.9 * s * s)) * taper;
    stack.rings.push_back(ellipse_ring(n, r, r, z));
  }
  ShapeMesh shape = close_rings(stack);
  if (pointed) shape.mesh.sharp_vertices = {int(shape.mesh.position_m.size()) - 1};
  return shape;
}

Extent extent_of(const Refinement& refinement, const std::vector<glm::dvec3>& control) {
  std::vector<glm::dvec3> refined(refinement.vertices());
  refinement.evaluate(std::span<const glm::dvec3>(control), std::span<glm::dvec3>(refined));
  Extent e{refined.front(), refined.front()};
  for (const glm::dvec3& p : refined) {
    e.lo = glm::dvec3(std::min(e.lo.x, p.x), std::min(e.lo.y, p.y), std::min(e.lo.z, p.z));
    e.hi = glm::dvec3(std::max(e.hi.x, p.x), std::max(e.hi.y, p.y), std::max(e.hi.z, p.z));
  }
  return e;
}

void normalise(ShapeMesh& shape, const Refinement& refinement) {
  const Extent e = extent_of(refinement, shape.mesh.position_m);
  const glm::dvec3 centre = 0.5 * (e.lo + e.hi), size = e.hi - e.lo;
  for (glm::dvec3& p : shape.mesh.position_m) {
    p = (p - glm::dvec3(centre.x, centre.y, e.lo.z)) / size;
  }
}

}  // namespace witherfield::fruit
