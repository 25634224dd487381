#include "sim/fruit/maize_ear.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "sim/core/random.hpp"
#include "sim/fruit/palettes.hpp"

namespace witherfield::fruit {
namespace {

constexpr double kMm = 1e-3;
constexpr double kFullMoisture = 0.25;  // from here on the kernel fills its cell
constexpr double kDentDepth = 0.16;     // of a dry dent kernel, in lengths
constexpr double kCobShrinkage = 0.05;  // of the cob, linear, swollen to dry (estimate)
// The free kernel is a little larger than its cell: swollen kernels press on one another.
constexpr double kPackingAcross = 1.06, kPackingAlong = 1.16;

struct Draws {
  double length, width, thickness, roll, lean, side, across, along, bright, phase, ripe;
};

Draws draw(std::uint64_t seed, double variation, int index) {
  Random r(seed, Stream::kernels, std::uint64_t(index));
  const auto n = [&](double sd) { return variation * r.truncated_normal(0, sd, -2.5 * sd, 2.5 * sd); };
  Draws d{};
  d.length = 1 + n(0.022);
  d.width = 1 + n(0.02);
  d.thickness = 1 + n(0.025);
  d.roll = n(radians(2));
  d.lean = n(radians(1.4));
  d.side = n(radians(1.4));
  d.across = n(0.015);
  d.along = n(0.018);
  d.bright = 1 + n(0.075);
  d.phase = variation * r.uniform(0, 6.28);
  d.ripe = n(1);
  return d;
}

class MaizeEar final : public FruitModel {
 public:
  explicit MaizeEar(const FruitOptions& options);
  Fruit at(double wd) const override;
  Organ kernel_at_rest() const override;
  int rows() const override { return options_.maize.rows; }

 private:
  /// 0 swollen .. 1 as dry as the measured kernels (9 %).
  double dryness(double moisture) const;
  Organ kernel(double wd, int row, int i, double shrunk) const;
  std::vector<glm::dvec3> kernel_control(CobPart part, double dent) const;
  glm::dvec3 swelling(double moisture) const;
  void add_cob(Fruit& fruit, double wd, double shrunk) const;

  CobPlan plan_;
  int cob_, bump_, shank_;
  int kernel_[3];                        ///< template of the lower, middle, upper part
  std::vector<glm::dvec3> dented_[3];    ///< control points of the same with the full dent
  std::vector<glm::dvec3> refined_cob_;  ///< swollen, mm
  double shank_gain_;
};

MaizeEar::MaizeEar(const FruitOptions& options)
    : FruitModel(options), plan_(plan_cob(options.maize, options.seed)) {
  const MaizeOptions& m = options.maize;
  cob_ = add_shape(plan_.shape, false);
  const Refinement& refinement = refinements()[std::size_t(cob_)];
  refined_cob_.resize(refinement.vertices());
  refinement.evaluate(std::span<const glm::dvec3>(plan_.shape.mesh.position_m),
                      std::span<glm::dvec3>(refined_cob_));

  const double ratios[3] = {m.ratio_lower, m.ratio_middle, m.ratio_upper};
  const int typical[3] = {0, m.kernels_per_row / 2, m.kernels_per_row - 1};
  for (int part = 0; part < 3; ++part) {
    const Cell cell = maize_cell(plan_, refined_cob_, 0, typical[part]);
    const double cut = std::min(1.0, cell.height / (cell.width * 1.5));
    kernel_[part] = add_shape(maize_kernel_shape(ratios[part], cut, 0), true);
    ShapeMesh dented = maize_kernel_shape(ratios[part], cut, kDentDepth);
    normalise(dented, Refinement(dented.mesh, options.scheme, std::max(options.steps, 2)));
    dented_[part] = std::move(dented.mesh.position_m);
  }
  bump_ = add_shape(grain_shape(false), true);
  shank_ = add_shape(tube_shape(5, true), false);
  shank_gain_ = tube_gain(shapes()[std::size_t(shank_)], refinements()[std::size_t(shank_)]);
}

double MaizeEar::dryness(double moisture) const {
  return std::clamp((kFullMoisture - moisture) / (kFullMoisture - 0.09), 0.0, 1.0);
}

/// Width, thickness, length over those of the swollen kernel.
glm::dvec3 MaizeEar::swelling(double moisture) const {
  if (!options_.ripening.shrink) return glm::dvec3(1);
  const Swelling now = maize_swelling(moisture), full = maize_swelling(kFullMoisture);
  return {now.width / full.width, now.thickness / full.thickness, now.length / full.length};
}

std::vector<glm::dvec3> MaizeEar::kernel_control(CobPart part, double dent) const {
  std::vector<glm::dvec3> control = control_of(kernel_[int(part)]);
  if (options_.maize.crown == Crown::dent)
    for (std::size_t i = 0; i < control.size(); ++i)
      control[i] = glm::mix(control[i], dented_[int(part)][i], dent);
  return control;
}

Organ MaizeEar::kernel(double wd, int row, int i, double shrunk) const {
  const MaizeOptions& m = options_.maize;
  const int running = row * m.kernels_per_row + i;
  const Draws d = draw(options_.seed, m.variation, running);
  const CobPart part = plan_.part(i);
  Cell cell = maize_cell(plan_, refined_cob_, row, i);
  // Spikelets stand in pairs: two rows close together and level, the next pair half a kernel higher.
  const double partner = row % 2 == 0 ? 1 : -1, level = (row / 2) % 2 == 0 ? 0.25 : -0.25;
  cell = shifted(cell, 0.018 * partner + d.across, level + d.along);
  const double radius = std::hypot(cell.centre.x, cell.centre.y), slender = 2 * radius / m.cob_diameter_mm;

  Organ organ{.shape = kernel_[int(part)],
              .kind = OrganKind::kernel,
              .kernel = running,
              .name = "row " + std::to_string(row + 1) + " kernel " + std::to_string(i + 1)};
  const double own_wd = course_.of_kernel(wd, d.ripe), moisture = course_.moisture_wb(own_wd);
  organ.coat = maize_kernel_palette().coat(course_.ripeness(own_wd), d.bright, 0.05, d.phase);
  organ.coat.moisture_wb = float(moisture);
  organ.coat.water = float(course_.water(own_wd));

  const double length = m.kernel_length_mm * (0.42 + 0.58 * std::min(1.0, slender));
  const double widest = radius + kWidestShare * length * std::hypot(cell.normal.x, cell.normal.y);
  const glm::dvec3 full(cell.width * widest / radius, cell.height, length);
  const glm::dvec3 size =
      full * glm::dvec3(kPackingAcross * d.width, kPackingAlong * d.thickness, d.length) * swelling(moisture);
  Frame seat = seat_on(cell, 0.06 * length, d.lean);
  seat.origin *= shrunk;
  seat.axes = seat.axes * rotation_y(d.side) * rotation_z(d.roll);
  organ.control_m = kernel_control(part, dryness(moisture));
  for (glm::dvec3& p : organ.control_m) p = seat(p * size) * kMm;
  return organ;
}

void MaizeEar::add_cob(Fruit& fruit, double wd, double shrunk) const {
  const double ripe = course_.ripeness(wd);
  const auto finish = [&](Organ organ, const Palette& palette, int shape) {
    organ.shape = shape;
    organ.coat = palette.coat(ripe, 1, 0.05, 0.7);
    organ.coat.moisture_wb = float(course_.moisture_wb(wd));
    organ.coat.water = float(course_.water(wd));
    for (glm::dvec3& p : organ.control_m) p *= kMm;
    fruit.organs.push_back(std::move(organ));
  };
  Organ cob{.kind = OrganKind::cob, .name = "cob", .control_m = control_of(cob_)};
  for (glm::dvec3& p : cob.control_m) p *= shrunk;
  finish(std::move(cob), cob_palette(), cob_);

  // "the small block on top ... is subdivided apart from the cob's body" (sec. 2.2, 1)
  Organ bump{.kind = OrganKind::cob_bump, .name = "cob bump", .control_m = control_of(bump_)};
  const double r = plan_.top_radius_mm;
  for (glm::dvec3& p : bump.control_m)
    p = shrunk * (p * glm::dvec3(2.3 * r, 2.3 * r, 1.5 * r) + glm::dvec3(0, 0, plan_.top_mm - 0.75 * r));
  finish(std::move(bump), cob_palette(), bump_);

  const double girth = 0.5 * options_.maize.cob_diameter_mm / shank_gain_;
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  constexpr struct { double z, r; } profile[] = {{0, 0.52}, {4, 0.49}, {8, 0.52}, {12, 0.60}, {15, 0.62}};
  for (const auto& p : profile) {
    points.push_back({0, 0, p.z});
    radii.push_back(p.r * girth);
  }
  finish({.kind = OrganKind::shank, .name = "shank", .control_m = sweep_tube(points, radii)},
         maize_shank_palette(), shank_);
}

Fruit MaizeEar::at(double wd) const {
  const MaizeOptions& m = options_.maize;
  Fruit fruit = empty_fruit();
  const double shrunk = options_.ripening.shrink ? 1 - kCobShrinkage * dryness(course_.moisture_wb(wd)) : 1;
  add_cob(fruit, wd, shrunk);
  if (m.kernels)
    for (int row = 0; row < m.rows; ++row)
      for (int i = 0; i < m.kernels_per_row; ++i) fruit.organs.push_back(kernel(wd, row, i, shrunk));
  return fruit;
}

Organ MaizeEar::kernel_at_rest() const {
  const MaizeOptions& m = options_.maize;
  const Cell cell = maize_cell(plan_, refined_cob_, 0, m.kernels_per_row / 2);
  const double radius = std::hypot(cell.centre.x, cell.centre.y), moisture = course_.moisture_wb(1);
  const double widest = radius + kWidestShare * m.kernel_length_mm;
  const glm::dvec3 full(kPackingAcross * cell.width * widest / radius, kPackingAlong * cell.height,
                        m.kernel_length_mm);
  Organ organ{.shape = kernel_[1], .kind = OrganKind::kernel, .kernel = 0, .name = "kernel"};
  organ.coat = maize_kernel_palette().coat(course_.ripeness(1), 1, 0, 0);
  organ.coat.moisture_wb = float(moisture);
  organ.coat.water = float(course_.water(1));
  organ.control_m = kernel_control(CobPart::middle, dryness(moisture));
  for (glm::dvec3& p : organ.control_m) p *= full * swelling(moisture) * kMm;
  return organ;
}

}  // namespace

std::unique_ptr<FruitModel> make_maize_ear(const FruitOptions& options) {
  return std::make_unique<MaizeEar>(options);
}

}  // namespace witherfield::fruit
