// Leaf area from triangles.
#pragma once
#include "sim/core/surface.hpp"

namespace witherfield::leaf {

/// Sum of half the length of the cross product of two edges: exact to rounding for slivers, too, where the paper's
/// Heron formula loses all digits (Kahan 2014, "Miscalculating area and angles of a needle-like triangle").
double surface_area_m2(const Surface& surface);

/// (area - reference) / reference. @throws InvalidInput unless reference > 0.
double area_error(double area_m2, double reference_m2);

}  // namespace witherfield::leaf
