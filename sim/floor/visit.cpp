// Who comes, and the room that he finds.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"
#include "sim/floor/gait.hpp"
#include "sim/floor/walkers.hpp"

namespace witherfield::floor {
namespace {

bool there(const Place& p, double day) { return day >= p.from_day && day < p.until_day; }

/// Free cells on the sill behind the door: the way goes on through it.
std::vector<std::size_t> sill(const NavGrid& grid, const Gate& gate) {
  std::vector<std::size_t> cells;
  const NavShape& s = grid.shape();
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) {
      const glm::dvec2 p = s.centre_m(i, j);
      const std::size_t cell = std::size_t(j) * std::size_t(s.nx) + std::size_t(i);
      if (const double d = gate.depth_m(p);
          d < -0.25 && d > -kVestibule_m && std::abs(gate.offset_m(p)) < gate.width_m / 2 && grid.free(cell))
        cells.push_back(cell);
    }
  return cells;
}

/// Index drawn by the shares; -1 when all are 0.
template <class Share>
int pick(double u, std::size_t n, const Share& share) {
  double total = 0;
  for (std::size_t k = 0; k < n; ++k) total += share(k);
  if (!(total > 0)) return -1;
  double at = u * total;
  int last = -1;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(share(k) > 0)) continue;
    last = int(k);
    if (at < share(k)) return last;
    at -= share(k);
  }
  return last;  // u * total met the total by rounding
}

}  // namespace

World::World(const FloorOptions& options, double from_day, double until_day)
    : from_day_(from_day),
      until_day_(until_day),
      plan_(options.room, from_day),
      grid_(plan_, options.gait.clearance_m),
      to_place_(options.room.places.size()) {
  const std::string when = from_day > 0 ? " from day " + std::to_string(from_day) + " on" : "";
  if (grid_.free_cells() == 0) throw InvalidInput("room.outline_m: no ground is wide enough for a walker" + when);
  const FieldSolver solver(grid_, options.gait.reach_m);
  std::vector<char> connected;
  for (std::size_t g = 0; g < plan_.gates().size(); ++g) {
    const std::vector<std::size_t> cells = sill(grid_, plan_.gates()[g]);
    const std::string what = "room.door[" + std::to_string(g) + "] '" + options.room.doors[g].name + "'";
    if (cells.empty()) throw InvalidInput(what + " is blocked" + when);
    if (connected.empty()) connected = grid_.reachable(cells.front());
    const std::ptrdiff_t inside = grid_.nearest_free(
        plan_.gates()[g].middle() + plan_.gates()[g].inward * (options.gait.clearance_m + grid_.shape().spacing_m),
        options.gait.clearance_m);
    if (inside < 0 || !grid_.reachable(cells.front())[std::size_t(inside)])
      throw InvalidInput(what + ": an obstacle blocks the way in" + when);
    if (!connected[cells.front()]) throw InvalidInput(what + " cannot be reached from the first door" + when);
    to_gate_.push_back(solver.towards(cells));
  }
  for (std::size_t p = 0; p < options.room.places.size(); ++p) {
    const Place& place = options.room.places[p];
    if (!there(place, from_day)) continue;
    const std::ptrdiff_t cell = grid_.nearest_free(place.at_m, 3 * grid_.shape().spacing_m);
    if (cell < 0 || !connected[std::size_t(cell)])
      throw InvalidInput("room.place[" + std::to_string(p) + "] '" + place.name +
                         "' cannot be reached from the doors" + when);
    to_place_[p] = solver.towards({std::size_t(cell)});
  }
  if (options.crowd.patrol_share > 0) round_ = solver.round();
  for (const Picture& p : options.room.pictures) pictures_.push_back(p.at_m);
}

std::vector<std::unique_ptr<World>> make_worlds(const FloorOptions& options) {
  std::vector<std::unique_ptr<World>> worlds;
  if (options.stairs) return worlds;
  std::vector<double> at = changes_of_plan(options.room, options.crowd.days);
  at.push_back(kForever);
  for (std::size_t n = 0; n + 1 < at.size(); ++n) worlds.push_back(std::make_unique<World>(options, at[n], at[n + 1]));
  return worlds;
}

const World& world_on(const std::vector<std::unique_ptr<World>>& worlds, double day) {
  for (const auto& w : worlds)
    if (day < w->until_day()) return *w;
  return *worlds.back();
}

namespace {

/// The draws of a visit that say what it is for; made whatever they are used for, so that changing one share leaves the
/// other draws alone.
struct Purpose { double time, kind, in, out, place, way; };

Visit person(const FloorOptions& o, std::int64_t number, Purpose& u) {
  const CrowdOptions& c = o.crowd;
  Random random(o.seed, Stream::walker, std::uint64_t(number));
  Visit v;
  v.number = number;
  u = {random.uniform(), random.uniform(), random.uniform(), random.uniform(), random.uniform(), random.uniform()};
  v.woman = random.uniform() < c.women_share;
  v.mass_kg = draw(random, v.woman ? c.mass_women_kg : c.mass_men_kg);
  v.foot_length_m = draw(random, v.woman ? c.foot_women_m : c.foot_men_m);
  v.speed_m_s = draw(random, v.woman ? c.speed_women_m_s : c.speed_men_m_s);
  return v;
}

}  // namespace

Visit plan_person(const FloorOptions& o, std::int64_t number) {
  Purpose unused;
  return person(o, number, unused);
}

Visit plan_visit(const FloorOptions& o, std::int64_t number) {
  const CrowdOptions& c = o.crowd;
  Purpose u;
  Visit v = person(o, number, u);
  v.day = c.days * (double(number) + u.time) / double(c.visits);
  for (const auto& [first, last] : c.absent) v.absent = v.absent || (number >= first && number < last);
  if (o.stairs) {
    v.behaviour = Behaviour::pass;
    v.clockwise = u.way < o.stairs->up_share;
    v.speed_m_s *= o.stairs->speed_m_s / 1.34;  // the spread between people stays
    return v;
  }
  const double shares[3] = {c.patrol_share, c.round_trip_share, c.pass_share};
  v.behaviour = Behaviour(pick(u.kind, 3, [&](std::size_t k) { return shares[k]; }));
  v.gate_in = v.gate_out = pick(u.in, o.room.doors.size(), [&](std::size_t k) { return o.room.doors[k].share; });
  if (v.behaviour == Behaviour::pass)
    v.gate_out = pick(u.out, o.room.doors.size(),
                      [&](std::size_t k) { return int(k) == v.gate_in ? 0.0 : o.room.doors[k].share; });
  if (v.behaviour == Behaviour::round_trip)
    v.place = pick(u.place, o.room.places.size(), [&](std::size_t k) {
      return there(o.room.places[k], v.day) ? o.room.places[k].share : 0.0;
    });
  v.clockwise = u.way < c.clockwise_share;
  if (v.behaviour == Behaviour::patrol) v.speed_m_s *= c.patrol_speed_factor;
  return v;
}

int sole_of(const FloorOptions& options, const Visit& visit, const Step& step) {
  if (const std::size_t own = options.footprints.masks.size(); own > 0)
    return int(std::uint64_t(visit.number) % own);
  return int(step.toe_slide ? (visit.woman ? Sole::woman_toe_slide : Sole::man_toe_slide)
                            : (visit.woman ? Sole::woman : Sole::man));
}

}  // namespace witherfield::floor
