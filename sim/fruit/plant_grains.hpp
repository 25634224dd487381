// Planting grains on a surface (Liu et al. 2007, sec. 2.2, 3): every cell gives its centre and its outward
// normal, and the grain is turned and moved onto it. Serves maize, the generic planted fruit and users' own
// meshes.
#pragma once
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "sim/fruit/model.hpp"

namespace witherfield::fruit {

/// A place for one grain. Lengths in the unit of the input.
struct Cell {
  glm::dvec3 centre{0};
  glm::dvec3 normal{0, 0, 1};    ///< unit, outward
  glm::dvec3 up{0, 1, 0};        ///< unit, in the surface, towards the fruit's upper end
  double width = 1, height = 1;  ///< across and along `up`
};

/// From corner points, counter-clockwise seen from outside, lower edge first. @pre not all on one line.
Cell cell_of_quad(const std::array<glm::dvec3, 4>& corner);
/// Up is the z axis drawn into the face (the x axis where the face looks along z). Width and height: sides of
/// the square of equal area.
Cell cell_of_triangle(const std::array<glm::dvec3, 3>& corner);

/// Cells on a body of revolution about z, given as (height, radius): equal area per cell along a golden-angle
/// spiral, or in whorls turned by half a cell against each other. Rows may yield a few cells more or less
/// than `count`.
std::vector<Cell> cells_on_profile(const std::vector<std::pair<double, double>>& profile,
                                   Arrangement arrangement, int count);

/// Moves the cell's centre within the surface, in shares of its width and height.
Cell shifted(Cell cell, double across, double along);

/// Grain coordinates (z outward, y along `up`) -> space; the grain's origin lies `depth` below the surface.
/// lean_rad tilts the grain's axis towards `up`; the planted axis is the normal when it is 0.
Frame seat_on(const Cell& cell, double depth, double lean_rad = 0);

}  // namespace witherfield::fruit
