#include "sim/fruit/wheat_ear.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/random.hpp"
#include "sim/fruit/palettes.hpp"

namespace witherfield::fruit {
namespace {

constexpr double kMm = 1e-3;
constexpr double kDryMoisture = 0.12;   // at which the kernel's dimensions are stated
constexpr double kHuskMoisture = 0.45;  // husks have the size of the kernel at about this water content
constexpr int kAwnRings = 9;
constexpr float kNerves = 0.10f;  // of husks
constexpr BoatOptions kLemma{.wrap_deg = 96,
                             .below = 0.10,
                             .above = 0.60,
                             .clearance = 0.10,
                             .thickness = 0.12,
                             .keel = 0.10,
                             .tip_in = 0.36};
constexpr BoatOptions kGlume{.wrap_deg = 88,
                             .below = 0.0,
                             .above = 0.40,
                             .clearance = 0.22,
                             .thickness = 0.14,
                             .keel = 0.30,
                             .tip_in = 0.34};

/// Draws of one floret, always made in this order.
struct Draws {
  double length, width, thickness, roll, lean, side, bright, phase, ripe, awn_length, awn_side, awn_out,
      awn_curve, warm;
};

Draws draw(std::uint64_t seed, double variation, int index) {
  Random r(seed, Stream::kernels, std::uint64_t(index));
  const auto n = [&](double sd) { return variation * r.truncated_normal(0, sd, -2.5 * sd, 2.5 * sd); };
  Draws d{};
  d.length = 1 + n(0.03);
  d.width = 1 + n(0.03);
  d.thickness = 1 + n(0.03);
  d.roll = n(radians(6));
  d.lean = n(radians(2.5));
  d.side = n(radians(2.5));
  d.bright = 1 + n(0.08);
  d.phase = variation * r.uniform(0, 6.28);
  d.ripe = n(1);
  d.awn_length = 1 + n(0.07);
  d.awn_side = n(radians(4.5));
  d.awn_out = n(radians(4));
  d.awn_curve = n(radians(5));
  d.warm = n(1);
  return d;
}

class WheatEar final : public FruitModel {
 public:
  explicit WheatEar(const FruitOptions& options);
  Fruit at(double wd) const override;
  Organ kernel_at_rest() const override;
  int spikelets() const override { return options_.wheat.spikelets; }

 private:
  struct Moment {
    double wd;
    NoddingAxis nod;
    Fruit fruit;
  };
  /// Kernel coordinates -> straight ear, mm.
  struct Seat {
    Frame spikelet, floret;
    double scale;
    bool mirrored;
    glm::dvec3 operator()(const glm::dvec3& p) const {
      glm::dvec3 q = floret(p);
      if (mirrored) q.x = -q.x;
      return spikelet(q * scale);
    }
  };
  void add(Moment& m, Organ organ, int shape, std::vector<glm::dvec3> control_mm) const;
  void add_shank(Moment& m) const;
  void add_floret(Moment& m, int segment, int kernel, const SpikeletPlace& at) const;
  void add_glume(Moment& m, int segment, int side, const SpikeletPlace& at) const;
  void add_awn(Moment& m, const std::string& name, const Seat& seat, const glm::dvec3& tip, double length,
               const Draws& d) const;
  glm::dvec3 kernel_size(double moisture) const;
  std::vector<glm::dvec3> husk(int shape, const Seat& seat, const glm::dvec3& half, double open_rad) const;
  Coat coat(const Palette& palette, double wd, const Draws& d, double mottle) const;

  std::vector<SpikeletPlace> spikelets_;
  int kernel_, lemma_, glume_, awn_, wedge_, stem_;
  double awn_gain_, stem_gain_;
};

WheatEar::WheatEar(const FruitOptions& options)
    : FruitModel(options), spikelets_(spikelet_places(options.wheat)) {
  kernel_ = add_shape(wheat_kernel_shape(), true);
  lemma_ = add_shape(boat_shape(kLemma), false);
  glume_ = add_shape(boat_shape(kGlume), false);
  awn_ = add_shape(tube_shape(kAwnRings, false), false);
  wedge_ = add_shape(wedge_shape(), false);
  stem_ = add_shape(tube_shape(5, true), false);
  awn_gain_ = tube_gain(shapes()[std::size_t(awn_)], refinements()[std::size_t(awn_)]);
  stem_gain_ = tube_gain(shapes()[std::size_t(stem_)], refinements()[std::size_t(stem_)]);
}

/// Width, thickness, length in mm.
glm::dvec3 WheatEar::kernel_size(double moisture) const {
  const WheatOptions& w = options_.wheat;
  const glm::dvec3 dry(w.kernel_width_mm, w.kernel_thickness_mm, w.kernel_length_mm);
  if (!options_.ripening.shrink) return dry;
  const Swelling now = wheat_swelling(moisture), stated = wheat_swelling(kDryMoisture);
  return dry *
         glm::dvec3(now.width / stated.width, now.thickness / stated.thickness, now.length / stated.length);
}

Coat WheatEar::coat(const Palette& palette, double wd, const Draws& d, double mottle) const {
  const double own = course_.of_kernel(wd, d.ripe);
  Coat c = palette.coat(course_.ripeness(own), d.bright, mottle, d.phase);
  const glm::vec3 tint(1 + 0.03 * d.warm, 1, 1 - 0.06 * d.warm);
  for (glm::vec3& colour : c.along) colour *= tint;
  c.moisture_wb = float(course_.moisture_wb(own));
  c.water = float(course_.water(own));
  return c;
}

void WheatEar::add(Moment& m, Organ organ, int shape, std::vector<glm::dvec3> control_mm) const {
  organ.shape = shape;
  for (glm::dvec3& p : control_mm) p = m.nod(p) * kMm;
  organ.control_m = std::move(control_mm);
  m.fruit.organs.push_back(std::move(organ));
}

Fruit WheatEar::at(double wd) const {
  const WheatOptions& w = options_.wheat;
  // A ripe ear hangs more than a green one: the neck dries and the grain is still heavy.
  Moment m{wd,
           NoddingAxis(w.stem_length_mm + w.ear_length_mm,
                       radians(w.nod_deg) * (0.3 + 0.7 * course_.ripeness(wd))),
           empty_fruit()};
  add_shank(m);
  constexpr int order[] = {0, 1, 3, 2, 4};
  for (int segment = 0; segment < w.spikelets; ++segment) {
    const SpikeletPlace& at = spikelets_[std::size_t(segment)];
    for (int i = 0; i < w.kernels_per_spikelet; ++i) add_floret(m, segment, order[i], at);
    if (w.husks)
      for (const int side : {-1, 1}) add_glume(m, segment, side, at);
  }
  return std::move(m.fruit);
}

void WheatEar::add_shank(Moment& m) const {
  const WheatOptions& w = options_.wheat;
  const double internode = w.ear_length_mm / w.spikelets;
  Draws d = draw(options_.seed, options_.wheat.variation, 1 << 20);
  d.ripe -= 0.8;  // the neck is the last to turn
  Organ stem{.kind = OrganKind::stem, .name = "stem", .coat = coat(straw_palette(), m.wd, d, 0.05)};
  auto control = shapes()[std::size_t(stem_)].mesh.position_m;
  for (glm::dvec3& p : control)
    p *= glm::dvec3(w.stem_radius_mm / stem_gain_, w.stem_radius_mm / stem_gain_,
                    w.stem_length_mm + internode);
  add(m, std::move(stem), stem_, std::move(control));
  for (int i = 0; i < w.spikelets; ++i) {
    const bool back = i % 2 == 1;
    const double top = w.stem_length_mm + (i + 0.8) * internode;
    const double height = std::min(2 * internode, top - 1);
    Organ wedge{.kind = OrganKind::wedge,
                .name = "wedge " + std::to_string(i + 1),
                .coat = coat(straw_palette(), m.wd, d, 0.08)};
    control = shapes()[std::size_t(wedge_)].mesh.position_m;
    for (glm::dvec3& p : control) {
      p.z = top - height + height * p.z;
      if (back) p = {-p.x, -p.y, p.z};
    }
    add(m, std::move(wedge), wedge_, std::move(control));
  }
}

std::vector<glm::dvec3> WheatEar::husk(int shape, const Seat& seat, const glm::dvec3& half,
                                       double open_rad) const {
  const glm::dmat3 open = rotation_x(open_rad);  // about the husk's foot: the tip goes to -y
  std::vector<glm::dvec3> control;
  for (const glm::dvec3& p : control_of(shape)) control.push_back(seat(open * (p * half)));
  return control;
}

void WheatEar::add_floret(Moment& m, int segment, int kernel, const SpikeletPlace& at) const {
  const WheatOptions& w = options_.wheat;
  const int running = segment * w.kernels_per_spikelet + (kernel == 0   ? 0
                                                          : kernel == 1 ? 1
                                                          : kernel == 3 ? 2
                                                          : kernel == 2 ? 3
                                                                        : 4);
  const Draws d = draw(options_.seed, w.variation, segment * 8 + kernel);
  const FloretPlace place = floret_place(kernel);
  Frame floret = place.frame;
  floret.axes = floret.axes * rotation_x(d.lean) * rotation_y(d.side) * rotation_z(d.roll);
  const Seat seat{at.frame, floret, at.size, place.mirrored};
  const glm::dvec3 own(d.width, d.thickness, d.length);
  const std::string name = "segment " + std::to_string(segment + 1) + " ", number = std::to_string(kernel);

  Organ grain{.kind = OrganKind::kernel,
              .kernel = running,
              .name = name + "kernel " + number,
              .mirrored = place.mirrored,
              .coat = coat(wheat_kernel_palette(), m.wd, d, 0.08)};
  const glm::dvec3 size = own * kernel_size(course_.moisture_wb(course_.of_kernel(m.wd, d.ripe)));
  std::vector<glm::dvec3> control;
  for (const glm::dvec3& p : control_of(kernel_)) control.push_back(seat(p * size));
  add(m, std::move(grain), kernel_, std::move(control));

  const glm::dvec3 full = own * kernel_size(kHuskMoisture), half(0.5 * full.x, 0.5 * full.y, full.z);
  const double open = radians(w.gape_deg) * course_.ripeness(m.wd);
  const glm::dvec3 lemma_tip = rotation_x(open) * (control_of(lemma_).back() * half);
  if (w.husks) {
    Organ lemma{.kind = OrganKind::lemma,
                .name = name + "lemma " + number,
                .mirrored = place.mirrored,
                .coat = coat(wheat_husk_palette(), m.wd, d, 0.10)};
    lemma.coat.nerves = kNerves;
    add(m, std::move(lemma), lemma_, husk(lemma_, seat, half, open));
  }
  if (w.awns)
    add_awn(m, name + "awn " + number, seat, w.husks ? lemma_tip : glm::dvec3(0, 0, 0.97 * size.z),
            place.size, d);
}

void WheatEar::add_glume(Moment& m, int segment, int side, const SpikeletPlace& at) const {
  const WheatOptions& w = options_.wheat;
  const Draws d = draw(options_.seed, w.variation, segment * 8 + (side < 0 ? 5 : 6));
  const FloretPlace place = glume_place(side);
  Frame frame = place.frame;
  frame.axes = frame.axes * rotation_x(d.lean) * rotation_z(d.roll);
  const glm::dvec3 full = glm::dvec3(d.width, d.thickness, d.length) * kernel_size(kHuskMoisture);
  Organ glume{.kind = OrganKind::glume,
              .name = "segment " + std::to_string(segment + 1) + (side < 0 ? " glume left" : " glume right"),
              .mirrored = place.mirrored,
              .coat = coat(wheat_husk_palette(), m.wd, d, 0.10)};
  glume.coat.nerves = kNerves;
  add(m, std::move(glume), glume_,
      husk(glume_, {at.frame, frame, at.size, place.mirrored}, {0.5 * full.x, 0.5 * full.y, full.z},
           0.6 * radians(w.gape_deg) * course_.ripeness(m.wd)));
}

void WheatEar::add_awn(Moment& m, const std::string& name, const Seat& seat, const glm::dvec3& tip,
                       double size, const Draws& d) const {
  const WheatOptions& w = options_.wheat;
  const glm::dvec3 root = seat(tip), below = seat(tip - glm::dvec3(0, 0, 1));
  const glm::dvec3 start = glm::normalize(root - below);
  // Away from the tip the awn rises towards the ear's own direction, and then bends a little outward again.
  const glm::dvec3 jitter(d.awn_side, d.awn_out, 0);
  const glm::dvec3 aim = glm::normalize(0.62 * start + glm::dvec3(0, 0, 0.38) + jitter);
  const glm::dvec3 outward = glm::normalize(glm::dvec3(aim.x, aim.y, 0) + glm::dvec3(1e-9, 0, 0));
  const double length = w.awn_length_mm * size * d.awn_length * (0.55 + 0.45 * seat.scale);
  const double grown =
      w.awn_start + (1 - w.awn_start) * m.wd;  // "from thin to thick" (Liu et al. 2007, sec. 2.1, 3)
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  glm::dvec3 p = root - 0.8 * start;
  for (int i = 0; i < kAwnRings; ++i) {
    const double s = double(i) / (kAwnRings - 1);
    points.push_back(p);
    radii.push_back(grown / awn_gain_ * (w.awn_root_radius_mm * (1 - s) + w.awn_tip_radius_mm * s));
    const double turn = std::min(1.0, 3 * s);
    const glm::dvec3 along =
        glm::normalize(start * (1 - turn) + aim * turn + outward * ((radians(7) + d.awn_curve) * s * s));
    p += along * (length / (kAwnRings - 1));
  }
  Draws early = d;
  early.ripe += 0.5;
  add(m, {.kind = OrganKind::awn, .name = name, .coat = coat(awn_palette(), m.wd, early, 0.04)}, awn_,
      sweep_tube(points, radii));
}

Organ WheatEar::kernel_at_rest() const {
  Organ grain{.shape = kernel_, .kind = OrganKind::kernel, .kernel = 0, .name = "kernel 0"};
  Draws alike{};
  alike.bright = 1;
  grain.coat = coat(wheat_kernel_palette(), 1.0, alike, 0.0);
  const glm::dvec3 size = kernel_size(course_.moisture_wb(1));
  for (const glm::dvec3& p : control_of(kernel_)) grain.control_m.push_back(p * size * kMm);
  return grain;
}

}  // namespace

std::unique_ptr<FruitModel> make_wheat_ear(const FruitOptions& options) {
  return std::make_unique<WheatEar>(options);
}

}  // namespace witherfield::fruit
