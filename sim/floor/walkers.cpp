#include "sim/floor/walkers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "sim/floor/gait.hpp"

namespace witherfield::floor {
namespace {

constexpr double kSubstep_m = 0.12;      // the heading follows the field within a step
constexpr double kStart_m = 0.3;         // behind the door
constexpr double kArrived_m = 0.25;      // from a place
constexpr Spread kPlaceAbout_m{0, 0.1, -0.25, 0.25};  // nobody stands on the same spot twice
constexpr double kPictureSeen_m = 2.8;
constexpr double kPastDoor_m = 0.5;     // nobody stops in the doorway
constexpr Spread kStopBefore_m{0, 0.35, -0.8, 0.8};  // a picture's middle, along the way
constexpr double kShuffle_s = 7;         // somebody who stands moves his feet about so often
constexpr Spread kShuffle_m{0, 0.09, -0.25, 0.25};
constexpr double kStands_s = 20;         // on both feet at a place, before sitting down
constexpr double kSharpTurn_rad = 0.6;   // between two steps: what is more than that is turned on the foot
constexpr int kWatchSteps = 24;          // within which somebody not stuck gets
constexpr double kWatch_m = 0.3;         // at least so far
constexpr Spread kLeaveRound_m{3.6, 0.8, 2.0, 5.6};  // way to the door at which a patrol makes for it

class Walking {
 public:
  Walking(const FloorOptions& options, const World& world, const Visit& visit, Walk& walk)
      : options_(options), world_(world), shape_(world.grid().shape()), visit_(visit), walk_(walk), gait_(options, visit) {}

  void run() {
    enter();
    bool ok = true;
    if (visit_.behaviour == Behaviour::patrol) ok = go_round();
    if (visit_.behaviour == Behaviour::round_trip) ok = go_to_place() && (stay(), true);
    const Gate& gate = world_.plan().gates()[std::size_t(visit_.gate_out)];
    const OrientationField& field = world_.to_gate(visit_.gate_out);
    const Phase phase = visit_.behaviour == Behaviour::pass ? Phase::out : Phase::back;
    walk_.out = ok && go(
                          phase, [&](const NavShape::Spot& s) { return field.at(shape_, s); },
                          [&] { return gate.depth_m(body_.at_m) < 0; });
    walk_.end_m = body_.at_m;
  }

 private:
  void enter() {
    const Gate& gate = world_.plan().gates()[std::size_t(visit_.gate_in)];
    const double half = gate.width_m / 2 - options_.gait.clearance_m;
    Random& r = gait_.random();
    body_.at_m = gate.middle() + gate.along * draw(r, {0, half / 2, -half, half}) - gate.inward * kStart_m;
    body_.heading_rad = std::atan2(gate.inward.y, gate.inward.x) + draw(r, eta(-0.35, 0.35));
    const double sd = options_.gait.heading_sd_deg * std::numbers::pi / 180;
    body_.deviation_rad = draw(r, {0, sd, -3 * sd, 3 * sd});
    body_.next = r.uniform() < 0.5 ? Foot::left : Foot::right;
    body_.time_s = visit_.day * 86400;
    first_share_ = r.uniform();
  }

  /// One step along `field`; true when `arrived` on the way. No foot is set down then.
  template <class Field, class Arrived>
  bool step(Phase phase, const Field& field, const Arrived& arrived) {
    // The first foot falls anywhere within a step's length: no row of prints behind the door.
    const double length = gait_.step_length_m(visit_.speed_m_s) * std::exchange(first_share_, 1.0);
    const double before = body_.heading_rad;
    gait_.deviate(body_.deviation_rad, length);
    const double c = std::cos(body_.deviation_rad), s = std::sin(body_.deviation_rad);
    const int parts = std::max(1, int(std::ceil(length / kSubstep_m)));
    const double part_m = length / parts;
    for (int n = 0; n < parts; ++n) {
      const glm::dvec2 e = field(shape_.spot(body_.at_m));
      if (e != glm::dvec2(0.0))
        steer(body_.heading_rad, {c * e.x - s * e.y, s * e.x + c * e.y}, part_m, options_.gait.turn_radius_m);
      const glm::dvec2 last = body_.at_m;
      body_.at_m += part_m * glm::dvec2(std::cos(body_.heading_rad), std::sin(body_.heading_rad));
      if (!world_.grid().push_out(body_.at_m)) body_.at_m = last;
      walk_.way_m += part_m;
      body_.time_s += part_m / visit_.speed_m_s;
      if (arrived()) return true;
    }
    const double turned = std::abs(body_.heading_rad - before);
    walk_.steps.push_back(
        gait_.set_foot(body_, phase, body_.steps > 0 ? length : 0, visit_.speed_m_s, std::max(0.0, turned - kSharpTurn_rad)));
    return false;
  }

  /// Steps until arrived or stuck.
  template <class Field, class Arrived>
  bool go(Phase phase, const Field& field, const Arrived& arrived) {
    glm::dvec2 watched = body_.at_m;
    for (int n = 1;; ++n) {
      if (step(phase, field, arrived)) return true;
      if (int(body_.steps) >= options_.gait.steps_max) return false;
      if (n % kWatchSteps == 0) {
        if (glm::distance(watched, body_.at_m) < kWatch_m) return false;
        watched = body_.at_m;
      }
    }
  }

  bool go_to_place() {
    glm::dvec2 goal = options_.room.places[std::size_t(visit_.place)].at_m;
    const glm::dvec2 about{draw(gait_.random(), kPlaceAbout_m), draw(gait_.random(), kPlaceAbout_m)};
    if (glm::dvec2 moved = goal + about; world_.grid().push_out(moved)) goal = moved;
    const OrientationField& field = world_.to_place(visit_.place);
    return go(
        Phase::out,
        [&](const NavShape::Spot& s) {
          const glm::dvec2 d = goal - body_.at_m;
          const double l = glm::length(d);
          if (l >= 0.7) return field.at(shape_, s);
          body_.heading_rad = std::atan2(d.y, d.x);  // the last step goes where it has to
          return d / std::max(l, 1e-9);
        },
        [&] { return glm::distance(goal, body_.at_m) < kArrived_m; });
  }

  /// Both feet side by side, the body turned to `facing_rad`; they are moved about every few seconds.
  void stand(double facing_rad, double stands_s) {
    double turned = std::remainder(facing_rad - body_.heading_rad, 2 * std::numbers::pi);
    const int times = 1 + int(stands_s / kShuffle_s);
    const double each_s = stands_s / times;
    for (int n = 0; n < times; ++n) {
      body_.heading_rad += turned;
      for (int foot = 0; foot < 2; ++foot) {
        Step s = gait_.set_foot(body_, Phase::stand, 0, visit_.speed_m_s, turned / 2);
        s.side_m = std::max(s.side_m, 0.07);  // one stands wider than one walks
        place_foot(s);
        s.contact_s = each_s;
        walk_.steps.push_back(s);
      }
      body_.time_s += each_s;
      if (n + 1 == times) break;
      turned = draw(gait_.random(), eta(-0.4, 0.4));
      const glm::dvec2 last = body_.at_m;
      body_.at_m += glm::dvec2(draw(gait_.random(), kShuffle_m), draw(gait_.random(), kShuffle_m));
      if (!world_.grid().push_out(body_.at_m)) body_.at_m = last;
    }
    body_.deviation_rad = 0;
  }

  void stay() {
    const Place& place = options_.room.places[std::size_t(visit_.place)];
    stand(place.facing_deg * std::numbers::pi / 180, kStands_s);
    body_.time_s += 60 * place.stay_min;
    turn_to(world_.to_gate(visit_.gate_out).at(shape_, shape_.spot(body_.at_m)));
  }

  void turn_to(glm::dvec2 e) {
    if (e != glm::dvec2(0.0)) body_.heading_rad = std::atan2(e.y, e.x);
  }

  /// Along the round, drawn to the walker's own distance from the wall, giving way to what stands there.
  glm::dvec2 round_direction(const NavShape::Spot& s, double lane_m, double sense) const {
    const RoundField& round = world_.round();
    const glm::dvec2 along = sense * round.direction.at(shape_, s);
    const double e = shape_.spacing_m;
    const auto slope = [&](const auto& f) {
      const glm::dvec2 g{f(glm::dvec2(e, 0)) - f(glm::dvec2(-e, 0)), f(glm::dvec2(0, e)) - f(glm::dvec2(0, -e))};
      const double l = glm::length(g);
      return l > 1e-9 ? g / l : glm::dvec2(0.0);
    };
    const double at = shape_.sample(round.lane_m, s);
    glm::dvec2 wanted = along + 1.2 * std::clamp((lane_m - at) / 0.8, -1.0, 1.0) * slope([&](glm::dvec2 d) {
                          return double(shape_.sample(round.lane_m, shape_.spot(body_.at_m + d)));
                        });
    const double room = options_.gait.reach_m, spare = world_.grid().clearance_m(body_.at_m) - options_.gait.clearance_m;
    if (spare < room)
      wanted += (1 - std::max(spare, 0.0) / room) *
                slope([&](glm::dvec2 d) { return world_.grid().clearance_m(body_.at_m + d); });
    const double l = glm::length(wanted);
    return l > 1e-9 ? wanted / l : along;
  }

  bool go_round() {
    const RoundField& round = world_.round();
    const OrientationField& home = world_.to_gate(visit_.gate_out);
    const double sense = visit_.clockwise ? -1 : 1;
    const double lane = std::min(draw(gait_.random(), options_.gait.view_distance_m), 0.8 * round.widest_m);
    const double leave = draw(gait_.random(), kLeaveRound_m);
    double turns = 0, phi = round.phi(shape_, body_.at_m);
    std::vector<Intent> intents(world_.pictures().size());
    int to_look_at = -1;
    glm::dvec2 watched = body_.at_m;
    for (int n = 1;; ++n) {
      const bool done = step(
          Phase::round, [&](const NavShape::Spot& s) { return round_direction(s, lane, sense); },
          [&] {
            const double now = round.phi(shape_, body_.at_m), d = now - phi;
            turns += sense * (d - std::round(d));
            phi = now;
            to_look_at = shape_.sample(round.lane_m, shape_.spot(body_.at_m)) > kPastDoor_m ? picture_abreast(intents) : -1;
            const double way = shape_.sample(home.way_m, shape_.spot(body_.at_m));
            return to_look_at >= 0 || turns >= 1 || (turns > 0.5 && way < leave);
          });
      if (to_look_at >= 0) {
        const glm::dvec2 d = world_.pictures()[std::size_t(to_look_at)] - body_.at_m;
        stand(std::atan2(d.y, d.x), draw(gait_.random(), options_.gait.look_s));
        turn_to(round_direction(shape_.spot(body_.at_m), lane, sense));
        to_look_at = -1;
        watched = {1e9, 1e9};
      } else if (done) {
        return true;
      }
      if (int(body_.steps) >= options_.gait.steps_max) return false;
      if (n % kWatchSteps == 0) {
        if (glm::distance(watched, body_.at_m) < kWatch_m) return false;
        watched = body_.at_m;
      }
    }
  }

  /// Whether and where to stop at a picture: settled when it comes near.
  struct Intent { bool settled = false, stops = false; double before_m = 0; };

  /// A picture before which the walker stops now, or -1.
  int picture_abreast(std::vector<Intent>& intents) {
    const glm::dvec2 ahead{std::cos(body_.heading_rad), std::sin(body_.heading_rad)};
    for (std::size_t k = 0; k < intents.size(); ++k) {
      const glm::dvec2 d = world_.pictures()[k] - body_.at_m;
      const double along = glm::dot(d, ahead);
      if (glm::dot(d, d) > kPictureSeen_m * kPictureSeen_m || std::abs(along) > 1.2) continue;
      Intent& intent = intents[k];
      if (!intent.settled)
        intent = {true, gait_.random().uniform() < options_.gait.look_share, draw(gait_.random(), kStopBefore_m)};
      if (!intent.stops || along > intent.before_m) continue;
      intent.stops = false;
      return int(k);
    }
    return -1;
  }

  const FloorOptions& options_;
  const World& world_;
  const NavShape& shape_;
  const Visit& visit_;
  Walk& walk_;
  Gait gait_;
  Body body_;
  double first_share_ = 1;
};

}  // namespace

void walk_visit(const FloorOptions& options, const World& world, const Visit& visit, Walk& walk) {
  walk.steps.clear();
  walk.way_m = 0;
  walk.out = false;
  Walking(options, world, visit, walk).run();
}

void walk_stairs(const FloorOptions& options, const Visit& visit, Walk& walk) {
  const StairOptions& stairs = *options.stairs;
  const double sense = visit.clockwise ? 1 : -1, half_pi = std::numbers::pi / 2;
  const double wall = options.gait.clearance_m;
  Gait gait(options, visit);
  Random& r = gait.random();
  walk.steps.clear();
  Body body;
  body.time_s = visit.day * 86400;
  body.next = r.uniform() < 0.5 ? Foot::left : Foot::right;
  // Upward is +y, so the right hand of who goes up is +x.
  const double lane = draw(r, {stairs.width_m / 2 + sense * stairs.keep_right_m, stairs.lane_sd_m, wall,
                               std::max(wall, stairs.width_m - wall)});
  double sway = 0;
  for (int n = 0; n < stairs.treads; ++n) {
    const int tread = visit.clockwise ? n : stairs.treads - 1 - n;
    // Going up the heel hangs over the nosing; going down the toes do.
    const double back = visit.clockwise ? draw(r, {-0.055, 0.035, -0.14, 0.04}) : draw(r, {-0.045, 0.03, -0.12, 0.03});
    sway = draw(r, {0.8 * sway, 0.02, -0.12, 0.12});
    gait.deviate(body.deviation_rad, stairs.going_m);
    body.at_m = {std::clamp(lane + sway, wall, stairs.width_m - wall), (tread + 0.5) * stairs.going_m + back};
    body.heading_rad = sense * half_pi + 0.5 * body.deviation_rad;
    Step step = gait.set_foot(body, visit.clockwise ? Phase::out : Phase::back, stairs.going_m, visit.speed_m_s, 0);
    step.foot_m.y = body.at_m.y;  // both feet reach the same depth of their treads
    walk.steps.push_back(step);
    body.time_s += stairs.going_m / visit.speed_m_s;
  }
  walk.way_m = stairs.treads * stairs.going_m;
  walk.out = true;
  walk.end_m = body.at_m;
}

}  // namespace witherfield::floor
