// Any fruit of many grains: a body, grains planted on it, sepals and dry styles. And the user's mesh as it
// is.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/random.hpp"
#include "sim/fruit/palettes.hpp"
#include "sim/fruit/plant_grains.hpp"

namespace witherfield::fruit {
namespace {

constexpr double kMm = 1e-3;
constexpr double kStalk_mm = 7;  // height of the body's lower end above the foot of the stalk
constexpr int kStyleRings = 4;
constexpr BoatOptions kSepal{
    .wrap_deg = 60, .below = 0, .above = 0, .clearance = 0, .thickness = 0.22, .keel = 0.05, .tip_in = 0.5};

ShapeMesh body_of_revolution(const std::vector<std::pair<double, double>>& profile) {
  constexpr int n = 12;
  RingStack stack;
  stack.diagonals = Diagonals::one_way;
  for (const auto& [z, r] : profile) {
    std::vector<glm::dvec3> ring;
    for (int k = 0; k < n; ++k) {
      const double a = radians(30.0 * k - 90);
      ring.push_back({r * std::cos(a), r * std::sin(a), z});
    }
    stack.rings.push_back(std::move(ring));
  }
  // The control mesh ends a little inside of flat caps, so that they bulge.
  stack.bottom = {0, 0, profile.front().first - 0.1 * profile.front().second};
  stack.top = {0, 0, profile.back().first + 0.3 * profile.back().second};
  return close_rings(stack);
}

/// The user's mesh: painted by its own uv, or by place when it has none.
ShapeMesh with_paint(ControlMesh mesh, const std::vector<glm::dvec2>& uv) {
  ShapeMesh shape{std::move(mesh), {}};
  for (const glm::dvec2& c : uv) shape.paint.push_back({float(2 * c.x - 1), float(c.y), 0.0f});
  if (!uv.empty()) return shape;
  glm::dvec3 lo = shape.mesh.position_m.front(), hi = lo;
  for (const glm::dvec3& p : shape.mesh.position_m) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  const glm::dvec3 size = glm::max(hi - lo, glm::dvec3(1e-12));
  for (const glm::dvec3& p : shape.mesh.position_m)
    shape.paint.push_back({float(2 * (p.x - lo.x) / size.x - 1), float((p.z - lo.z) / size.z), 0.0f});
  return shape;
}

Coat one_colour(const glm::vec3& c) {
  return {.along = {c, c, c}, .mark = c};
}

class PlantedFruit final : public FruitModel {
 public:
  explicit PlantedFruit(const FruitOptions& options);
  Fruit at(double wd) const override;
  Organ kernel_at_rest() const override;

 private:
  void finish(Fruit& fruit, Organ organ, int shape, double wd) const;
  void add_grain(Fruit& fruit, double wd, int index) const;
  void add_calyx(Fruit& fruit, double wd) const;
  Coat grain_coat(double ripeness, double bright, double phase) const;
  glm::dvec3 grain_size(double wd) const;

  std::vector<Cell> cells_;  ///< mm
  std::vector<glm::dvec3> body_control_mm_;
  ColourRamp colours_;
  int grain_, body_, sepal_ = -1, stalk_ = -1, style_ = -1;
  double tube_gain_ = 1;
};

PlantedFruit::PlantedFruit(const FruitOptions& options)
    : FruitModel(options),
      colours_({{0, options.planted.unripe},
                {options.planted.turning_wd, options.planted.turning},
                {1, options.planted.ripe}}) {
  const PlantedOptions& p = options.planted;
  grain_ = add_shape(grain_shape(p.grain_pointed), true);
  const bool own_body = options.mesh.triangles.empty();
  ControlMesh mesh = options.mesh;
  if (own_body) {
    auto profile = p.body_profile_mm;
    if (p.calyx)
      for (auto& [z, r] : profile) z += kStalk_mm;
    body_ = add_shape(body_of_revolution(profile), false);
    cells_ = cells_on_profile(profile, p.arrangement, p.grains);
    body_control_mm_ = control_of(body_);
  } else {
    if (options.mesh_crease_angle_deg > 0) add_creases_by_angle(mesh, options.mesh_crease_angle_deg);
    body_ = add_shape(with_paint(std::move(mesh), options.mesh_uv), false);
    body_control_mm_ = control_of(body_);
    for (glm::dvec3& v : body_control_mm_) v /= kMm;
    const Refinement& refinement = refinements()[std::size_t(body_)];
    std::vector<glm::dvec3> refined(refinement.vertices());
    refinement.evaluate(std::span<const glm::dvec3>(body_control_mm_), std::span<glm::dvec3>(refined));
    for (const auto& t : shapes()[std::size_t(body_)].mesh.triangles)
      cells_.push_back(cell_of_triangle(
          {refined[std::size_t(t[0])], refined[std::size_t(t[1])], refined[std::size_t(t[2])]}));
  }
  if (p.calyx && own_body) {
    sepal_ = add_shape(boat_shape(kSepal), true);
    stalk_ = add_shape(tube_shape(5, true), false);
    tube_gain_ = tube_gain(shapes()[std::size_t(stalk_)], refinements()[std::size_t(stalk_)]);
  }
  if (p.style_length_mm > 0) {
    style_ = add_shape(tube_shape(kStyleRings, false), false);
  }
}

void PlantedFruit::finish(Fruit& fruit, Organ organ, int shape, double wd) const {
  organ.shape = shape;
  organ.coat.moisture_wb = float(course_.moisture_wb(wd));
  organ.coat.water = float(course_.water(wd));
  for (glm::dvec3& v : organ.control_m) v *= kMm;
  fruit.organs.push_back(std::move(organ));
}

Coat PlantedFruit::grain_coat(double ripeness, double bright, double phase) const {
  const glm::vec3 c = colours_(ripeness) * float(bright);
  Coat coat{.along = {c * 0.8f, c, c}, .mark = c, .mottle = 0.06f, .mottle_phase = float(phase)};
  return coat;
}

glm::dvec3 PlantedFruit::grain_size(double wd) const {
  const PlantedOptions& p = options_.planted;
  const double shrunk = options_.ripening.shrink ? 1 - p.shrink_dry * wd : 1;
  return glm::dvec3(p.grain_width_mm, p.grain_thickness_mm, p.grain_length_mm) * shrunk;
}

void PlantedFruit::add_grain(Fruit& fruit, double wd, int index) const {
  const PlantedOptions& p = options_.planted;
  Random r(options_.seed, Stream::kernels, std::uint64_t(index));
  const auto n = [&](double sd) { return p.variation * r.truncated_normal(0, sd, -2.5 * sd, 2.5 * sd); };
  const glm::dvec3 own(1 + n(0.04), 1 + n(0.04), 1 + n(0.04));
  const double lean = n(radians(4)), side = n(radians(4)), roll = n(radians(30)), across = n(0.05),
               along = n(0.05);
  const double bright = 1 + n(0.06), ripe = n(1), phase = p.variation * r.uniform(0, 6.28);

  const Cell cell = shifted(cells_[std::size_t(index)], across, along);
  const glm::dvec3 size = own * grain_size(wd);
  Frame seat = seat_on(cell, p.sink * size.z, radians(p.lean_deg) + lean);
  seat.axes = seat.axes * rotation_y(side) * rotation_z(roll);
  Organ grain{.kind = OrganKind::kernel, .kernel = index, .name = "grain " + std::to_string(index + 1)};
  const double own_wd = course_.of_kernel(wd, ripe);
  grain.coat = grain_coat(course_.ripeness(own_wd), bright, phase);
  for (const glm::dvec3& v : control_of(grain_)) grain.control_m.push_back(seat(v * size));
  finish(fruit, std::move(grain), grain_, own_wd);

  if (style_ < 0) return;
  // The dry style on the drupelet's top: a hair that bends at random.
  Organ style{.kind = OrganKind::style, .name = "style " + std::to_string(index + 1)};
  const auto any = [&] { return r.truncated_normal(0, 1, -1.5, 1.5); };
  // Down by at most a third of its reach: a hair that came back to its root would cut itself.
  const double bend_x = any(), bend_y = any(), bend_z = 0.5 * any() - 0.3;
  const glm::dvec3 bend(bend_x, bend_y, bend_z);
  const double reach = p.style_length_mm * r.uniform(0.6, 1.1);
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  for (int i = 0; i < kStyleRings; ++i) {
    const double s = double(i) / (kStyleRings - 1), up = reach * (s - 0.06);
    points.push_back(seat({0, 0, size.z + up}) + bend * (0.3 * reach * s * s));
    radii.push_back(0.065 - 0.025 * s);
  }
  style.control_m = sweep_tube(points, radii);
  style.coat = one_colour(ColourRamp({{0, {206, 196, 130}}, {1, {150, 98, 60}}})(course_.ripeness(wd)));
  finish(fruit, std::move(style), style_, wd);
}

void PlantedFruit::add_calyx(Fruit& fruit, double wd) const {
  const double radius = options_.planted.body_profile_mm.front().second;
  const Coat green = sepal_palette().coat(course_.ripeness(wd), 1, 0.08, 0.4);
  for (int k = 0; k < 5; ++k) {
    // The sepal's back looks down, its tip out and a little up.
    const Frame seat{rotation_z(radians(72.0 * k + 20)) * rotation_x(radians(80 + 7 * ((k * 2) % 5 - 2))),
                     glm::dvec3(0, 0, kStalk_mm - 0.9)};
    Organ sepal{.kind = OrganKind::sepal, .name = "sepal " + std::to_string(k + 1), .coat = green};
    for (const glm::dvec3& v : control_of(sepal_))
      sepal.control_m.push_back(seat(v * glm::dvec3(1.05 * radius, 0.42 * radius, 2.1 * radius)));
    finish(fruit, std::move(sepal), sepal_, wd);
  }
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  for (int i = 0; i < 5; ++i) {
    points.push_back({0, 0, (kStalk_mm + 0.5) * i / 4.0});
    radii.push_back((0.14 + 0.05 * i * i / 4.0) * radius / tube_gain_);
  }
  finish(fruit,
         {.kind = OrganKind::stem, .name = "stalk", .control_m = sweep_tube(points, radii), .coat = green},
         stalk_, wd);
}

Fruit PlantedFruit::at(double wd) const {
  Fruit fruit = empty_fruit();
  finish(fruit,
         {.kind = OrganKind::body,
          .name = "body",
          .control_m = body_control_mm_,
          .coat = one_colour(glm::vec3(linear_of(options_.planted.body)))},
         body_, wd);
  if (sepal_ >= 0) add_calyx(fruit, wd);
  for (int i = 0; i < int(cells_.size()); ++i) add_grain(fruit, wd, i);
  return fruit;
}

Organ PlantedFruit::kernel_at_rest() const {
  Organ grain{.shape = grain_, .kind = OrganKind::kernel, .kernel = 0, .name = "grain"};
  grain.coat = grain_coat(1, 1, 0);
  for (const glm::dvec3& v : control_of(grain_)) grain.control_m.push_back(v * grain_size(1) * kMm);
  return grain;
}

/// The user's control mesh, refined.
class MeshFruit final : public FruitModel {
 public:
  explicit MeshFruit(const FruitOptions& options) : FruitModel(options) {
    ControlMesh mesh = options.mesh;
    if (options.mesh_crease_angle_deg > 0) add_creases_by_angle(mesh, options.mesh_crease_angle_deg);
    add_shape(with_paint(std::move(mesh), options.mesh_uv), false);
  }
  Fruit at(double wd) const override {
    Fruit fruit = empty_fruit();
    Organ organ = kernel_at_rest();
    const PlantedOptions& p = options_.planted;
    organ.coat =
        one_colour(ColourRamp({{0, p.unripe}, {p.turning_wd, p.turning}, {1, p.ripe}})(course_.ripeness(wd)));
    organ.coat.moisture_wb = float(course_.moisture_wb(wd));
    organ.coat.water = float(course_.water(wd));
    fruit.organs.push_back(std::move(organ));
    return fruit;
  }
  Organ kernel_at_rest() const override {
    return {.shape = 0,
            .kind = OrganKind::user_mesh,
            .name = "mesh",
            .control_m = control_of(0),
            .coat = one_colour(glm::vec3(linear_of(options_.planted.ripe)))};
  }
};

}  // namespace

std::unique_ptr<FruitModel> make_planted_fruit(const FruitOptions& options) {
  return std::make_unique<PlantedFruit>(options);
}
std::unique_ptr<FruitModel> make_mesh_fruit(const FruitOptions& options) {
  return std::make_unique<MeshFruit>(options);
}

}  // namespace witherfield::fruit
