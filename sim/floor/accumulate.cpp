#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/errors.hpp"
#include "sim/floor/room.hpp"
#include "sim/floor/wear.hpp"

namespace witherfield::floor {
namespace {

constexpr std::size_t kFlush = std::size_t(1) << 18;
enum Scale { footfalls, dose, slide, work, soil };

Wear empty_wear(const FloorOptions& options) {
  Wear w;
  w.floors = make_grids(options);
  for (FloorField& f : w.floors) {
    for (const char* name : {"footfalls", "dose_N_s_m2", "slide_m"}) f.make(name);
    w.work_J_m2.emplace_back(f.cells());
    w.soil.emplace_back(f.cells());
  }
  return w;
}

void add_plane(std::vector<float>& to, const std::vector<float>& from) {
  for (std::size_t n = 0; n < to.size(); ++n) to[n] += from[n];
}

}  // namespace

std::vector<FloorField> make_grids(const FloorOptions& o) {
  const double spacing = 1 / o.footprints.pixels_per_m;
  const auto cells = [&](double length_m) { return std::max(1, int(std::ceil(length_m / spacing - 1e-6))); };
  std::vector<FloorField> grids;
  if (o.stairs) {
    for (int t = 0; t < o.stairs->treads; ++t)
      grids.emplace_back(cells(o.stairs->width_m), cells(o.stairs->going_m), glm::dvec2(0, t * o.stairs->going_m), spacing);
    return grids;
  }
  const Box box = RoomPlan(o.room, 0).bounds();
  grids.emplace_back(cells(box.hi.x - box.lo.x), cells(box.hi.y - box.lo.y), box.lo, spacing);
  return grids;
}

Accumulator::Accumulator(const FloorOptions& options, double weight)
    : options_(options), weight_(weight * options.crowd.visits_each), soles_(options), wear_(empty_wear(options)) {
  const int angles = options.footprints.angle_steps;
  for (const Mask& m : soles_.masks()) {
    std::vector<float> product(m.pressure.size());
    for (std::size_t n = 0; n < product.size(); ++n) product[n] = m.pressure[n] * m.slide[n];
    pressure_.emplace_back(m.pressure, m.size, angles);
    slide_.emplace_back(m.slide, m.size, angles);
    work_.emplace_back(product, m.size, angles);
  }
  waiting_.reserve(kFlush);
}

Placement Accumulator::placement(const Footprint& f, const FloorField& grid) const {
  const int mask = soles_.mask_of(f), angles = options_.footprints.angle_steps;
  Placement p;
  p.x = float((f.x_m - grid.origin_m.x) / grid.spacing_m);
  p.y = float((f.y_m - grid.origin_m.y) / grid.spacing_m);
  p.shape = std::uint16_t(mask);
  p.angle = std::uint16_t((std::uint32_t(f.heading_turns) * std::uint32_t(angles) + 32768) / 65536 % std::uint32_t(angles));
  p.mirrored = f.foot() == Foot::left;
  // Two feet carry a walker through the stance: each bears 1 / (2 stance_share) of him while it stands, half when both do.
  const double load = f.phase() == Phase::stand ? 0.5 : 0.5 / options_.gait.stance_share;
  const double area_m2 = pressure_[std::size_t(mask)].sum() * grid.spacing_m * grid.spacing_m;
  const double pressure_Pa = load * f.weight_N() / area_m2;  // where the mask is 1
  p.scale[footfalls] = float(weight_);
  p.scale[dose] = float(weight_ * pressure_Pa * f.contact_s());
  p.scale[slide] = float(weight_ * f.slip_m());
  p.scale[work] = float(weight_ * pressure_Pa * f.slip_m());
  p.scale[soil] = float(weight_ * options_.soil.carried * std::exp(-f.number / options_.soil.fades_over_steps));
  return p;
}

void Accumulator::add(std::span<const Footprint> prints) {
  while (!prints.empty()) {
    const std::size_t n = std::min(prints.size(), kFlush - waiting_.size());
    waiting_.insert(waiting_.end(), prints.begin(), prints.begin() + std::ptrdiff_t(n));
    prints = prints.subspan(n);
    if (waiting_.size() == kFlush) flush();
  }
}

void Accumulator::flush() {
  if (waiting_.empty()) return;
  std::vector<std::vector<Placement>> on(wear_.floors.size());
  for (const Footprint& f : waiting_) {
    std::size_t floor = 0;
    if (options_.stairs) {  // a sole touches the tread that its middle is on; what hangs over touches nothing
      const double tread = std::floor(f.y_m / options_.stairs->going_m);
      if (tread < 0 || tread >= double(on.size())) continue;
      floor = std::size_t(tread);
    }
    on[floor].push_back(placement(f, wear_.floors[floor]));
  }
  for (std::size_t k = 0; k < on.size(); ++k) {
    FloorField& f = wear_.floors[k];
    const StampPass passes[] = {
        {&pressure_, {{f.at("footfalls").data(), footfalls}, {f.at("dose_N_s_m2").data(), dose}, {wear_.soil[k].data(), soil}}},
        {&slide_, {{f.at("slide_m").data(), slide}}},
        {&work_, {{wear_.work_J_m2[k].data(), work}}}};
    add_stamps(on[k], passes, f.nx, f.ny, {512, 96});  // three planes at once
  }
  wear_.prints += std::int64_t(waiting_.size());
  waiting_.clear();
}

const Wear& Accumulator::wear() {
  flush();
  return wear_;
}

void add(Wear& sum, const Wear& part) {
  if (sum.floors.size() != part.floors.size()) throw InvalidInput("add: the two wears have different numbers of floors");
  for (std::size_t k = 0; k < sum.floors.size(); ++k) {
    add(sum.floors[k], part.floors[k]);
    add_plane(sum.work_J_m2[k], part.work_J_m2[k]);
    add_plane(sum.soil[k], part.soil[k]);
  }
  sum.prints += part.prints;
}

void clear_outside(const FloorOptions& options, Wear& wear) {
  if (options.stairs) return;
  FloorField& f = wear.floors.front();
  for (int j = 0; j < f.ny; ++j)
    for (int i = 0; i < f.nx; ++i) {
      if (contains(options.room.outline_m, f.centre_m(i, j))) continue;
      const std::size_t n = std::size_t(j) * std::size_t(f.nx) + std::size_t(i);
      for (FloorChannel& c : f.channels) c.values[n] = 0;
      wear.work_J_m2[0][n] = wear.soil[0][n] = 0;
    }
}

}  // namespace witherfield::floor
