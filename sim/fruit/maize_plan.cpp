#include <cmath>
#include <numbers>

#include "sim/core/curve.hpp"
#include "sim/core/random.hpp"
#include "sim/fruit/maize_ear.hpp"

namespace witherfield::fruit {
namespace {

constexpr double kBaseHeight_mm = 9;  // of the cob's lower end above the foot of the shank

/// Bare cob's radius over its largest, against the share of the kernel-bearing length.
const Curve& cob_outline() {
  static const Curve c({{0, 0.60},
                        {0.03, 0.80},
                        {0.12, 0.99},
                        {0.2, 1.0},
                        {0.55, 0.98},
                        {0.78, 0.86},
                        {0.92, 0.63},
                        {1, 0.36}},
                       "cob outline");
  return c;
}

/// Height of a cell over the tallest: kernels are crowded at the tip.
const Curve& cell_height() {
  static const Curve c({{0, 0.90}, {0.12, 1.0}, {0.6, 1.0}, {0.85, 0.86}, {1, 0.66}}, "cell height");
  return c;
}

}  // namespace

CobPart CobPlan::part(int kernel_in_row) const {
  const int ring = first_ring + kernel_in_row;
  return ring < joint[0] ? CobPart::lower : ring < joint[1] ? CobPart::middle : CobPart::upper;
}

int CobPlan::vertex(int ring, int column) const {
  return ring_vertex(ring, ((column % rows) + rows) % rows, rows);
}

CobPlan plan_cob(const MaizeOptions& o, std::uint64_t seed) {
  CobPlan plan;
  plan.rows = o.rows;
  plan.per_row = o.kernels_per_row;
  const double radius = 0.5 * o.cob_diameter_mm;
  Random random(seed, Stream::variant, 0);
  const double wave = o.variation * random.uniform(0.05, 0.09), phase = random.uniform(0, 6.28);
  const auto ring = [&](double r, double z) {
    std::vector<glm::dvec3> points;
    for (int k = 0; k < o.rows; ++k) {
      const double a = 2 * std::numbers::pi * k / o.rows - std::numbers::pi / 2 +
                       wave * std::sin(4.2 * z / o.ear_length_mm + phase);
      points.push_back({r * std::cos(a), r * std::sin(a), z});
    }
    return points;
  };
  double weight = 0;
  for (int i = 0; i < o.kernels_per_row; ++i) weight += cell_height()((i + 0.5) / o.kernels_per_row);
  const double foot = 0.45 * radius, tip = 0.34 * radius;  // bare ends
  const double length = o.ear_length_mm - kBaseHeight_mm - foot - 2 * tip;

  RingStack stack;
  stack.diagonals = Diagonals::one_way;
  double z = kBaseHeight_mm;
  stack.bottom = {0, 0, z};
  stack.rings.push_back(ring(0.45 * radius, z + 0.45 * foot));
  z += foot;
  plan.first_ring = 1;
  for (int i = 0; i <= o.kernels_per_row; ++i) {
    stack.rings.push_back(ring(radius * cob_outline()(double(i) / o.kernels_per_row), z));
    if (i < o.kernels_per_row) z += length * cell_height()((i + 0.5) / o.kernels_per_row) / weight;
  }
  stack.rings.push_back(ring(0.26 * radius, z + 0.7 * tip));
  plan.top_radius_mm = 0.26 * radius;
  plan.top_mm = z + 0.8 * tip;
  stack.top = {0, 0, plan.top_mm};

  plan.shape = close_rings(stack);
  plan.joint[0] = plan.first_ring + std::max(1, int(std::lround(0.16 * o.kernels_per_row)));
  plan.joint[1] =
      plan.first_ring + std::min(o.kernels_per_row - 1, int(std::lround(0.70 * o.kernels_per_row)));
  for (const int joint : plan.joint) crease_ring(plan.shape.mesh, joint, o.rows);
  plan.shape.mesh.sharp_vertices = {0};
  return plan;
}

Cell maize_cell(const CobPlan& plan, const std::vector<glm::dvec3>& cob, int row, int kernel_in_row) {
  const int ring = plan.first_ring + kernel_in_row;
  const auto at = [&](int r, int column) { return cob[std::size_t(plan.vertex(r, column))]; };
  return cell_of_quad({at(ring, row), at(ring, row + 1), at(ring + 1, row + 1), at(ring + 1, row)});
}

}  // namespace witherfield::fruit
