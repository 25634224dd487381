// Control meshes of the organs. All are built of rings between two poles, so that the valence of a pole is
// the number of vertices in a ring: 8 or more where the organ shall be pointed. (Below valence 8 the
// sharp-vertex rule of Liu et al. is smooth in the limit, and at 3 and 4 even blunter than Loop's own rule:
// its second eigenvalue 5/8 - n/2^(n-1) exceeds the tangents' 3/8 + 1/4 cos(2 pi/n) only for n >= 8.)
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sim/fruit/organ.hpp"

namespace witherfield::fruit {

/// How the quads between two rings are cut in two.
enum class Diagonals {
  one_way,   ///< all alike: every vertex sees as much of the ring above as of that below; no mirror symmetry
  mirrored,  ///< the halves x > 0 and x < 0 are mirror images; vertices 0 and n/2 lie in the plane x = 0
  crescent   ///< mirrored, for thin crescents, outside on vertices 3n/4 .. n/4, inside on the others: both
             ///< sides are cut along the same lines, so that they keep their distance where the quads are
             ///< twisted
};

/// Rings from the lower to the upper end, each with the same even number of vertices, counter-clockwise seen
/// from above. Every vertex but the poles and their neighbours gets valence 6.
struct RingStack {
  glm::dvec3 bottom{0}, top{0};
  std::vector<std::vector<glm::dvec3>> rings;
  Diagonals diagonals = Diagonals::mirrored;
};
/// Vertex 0 is the lower pole, then the rings in order, last the upper pole. paint.y runs from 0 to 1 along
/// z.
ShapeMesh close_rings(const RingStack& stack);
/// Ring r, vertex k of a closed stack with n vertices in a ring.
inline int ring_vertex(int ring, int k, int n) {
  return 1 + ring * n + k;
}
/// Tags the edges of one ring as a crease.
void crease_ring(ControlMesh& mesh, int ring, int n);

/// Wheat kernel, z along its length, x its width, y its thickness; the groove looks to -y. Blunt below, cusp
/// above.
ShapeMesh wheat_kernel_shape();
/// Boat-shaped scale round the +y side of a kernel of half axes 1 x 1 (x, y) and length 1 (z): glume or
/// lemma.
struct BoatOptions {
  double wrap_deg = 100;              ///< half of the angle that it embraces, widest place
  double below = 0.10, above = 0.30;  ///< how far it reaches beyond the kernel's ends, in lengths
  double clearance = 0.10;            ///< between kernel and scale, in half axes
  double thickness = 0.12;            ///< in half axes
  double keel = 0.08;                 ///< how far the middle is drawn out
  double tip_in = 0.35;               ///< how far the tip bends back over the kernel
};
ShapeMesh boat_shape(const BoatOptions& options);
/// Straight unit tube, radius 1, length 1 along z, with `rings` rings of 6: an awn ends thinner than any
/// cusp.
ShapeMesh tube_shape(int rings, bool flat_ends);
/// Control points for tube_shape(points.size()) along a curve, with the given radius of the control hexagon
/// at each point.
/// @pre at least 2 points, all different.
std::vector<glm::dvec3> sweep_tube(const std::vector<glm::dvec3>& points, const std::vector<double>& radii);
/// Radius of the refined tube over that of its control hexagon.
double tube_gain(const ShapeMesh& tube, const Refinement& refinement);
/// The paper's wedge: vertices 0..3 below, 4-5-6-7 the square on which a segment stands (all edges creases,
/// corners sharp).
ShapeMesh wedge_shape();
/// Maize kernel: spherical cap on a cylinder whose cross-section has the given ratio length : width, both cut
/// by two planes y = +-cut (all over the half width). z outward from the cob, x across the row, y along the
/// row. dent: depth of the crown's hollow over the kernel's length.
ShapeMesh maize_kernel_shape(double ratio, double cut, double dent);
/// Grain of n = 8 around: ellipsoid, or pointed.
ShapeMesh grain_shape(bool pointed);

/// Size of the box round the refined shape.
struct Extent {
  glm::dvec3 lo{0}, hi{0};
};
Extent extent_of(const Refinement& refinement, const std::vector<glm::dvec3>& control);
/// Scales and shifts the control mesh so that the refined shape is 1 x 1 x 1, centred in x and y (x keeps its
/// symmetry), with z from 0.
void normalise(ShapeMesh& shape, const Refinement& refinement);

}  // namespace witherfield::fruit
