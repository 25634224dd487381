#include "sim/floor/room.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <sstream>

#include "sim/core/errors.hpp"

namespace witherfield::floor {
namespace {

constexpr double kOnWall_m = 0.02;  // a door's jambs may lie this far off the wall (drawing accuracy)

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

std::string text(glm::dvec2 p) {
  std::ostringstream s;
  s << '(' << p.x << ", " << p.y << ") m";
  return s.str();
}

Segment edge(const Polygon& p, std::size_t n) { return {p[n], p[(n + 1) % p.size()]}; }

/// Proper crossing or overlap of two segments that share no end.
bool meet(const Segment& s, const Segment& t) {
  const double a = cross(s.b - s.a, t.a - s.a), b = cross(s.b - s.a, t.b - s.a);
  const double c = cross(t.b - t.a, s.a - t.a), d = cross(t.b - t.a, s.b - t.a);
  if (((a > 0) != (b > 0) || a == 0 || b == 0) && ((c > 0) != (d > 0) || c == 0 || d == 0)) {
    if (a == 0 && b == 0)  // on one line
      return std::min(std::max(s.a.x, s.b.x), std::max(t.a.x, t.b.x)) >=
                 std::max(std::min(s.a.x, s.b.x), std::min(t.a.x, t.b.x)) &&
             std::min(std::max(s.a.y, s.b.y), std::max(t.a.y, t.b.y)) >=
                 std::max(std::min(s.a.y, s.b.y), std::min(t.a.y, t.b.y));
    return true;
  }
  return false;
}

Polygon counter_clockwise(Polygon p) {
  if (signed_area_m2(p) < 0) std::reverse(p.begin(), p.end());
  return p;
}

/// Edge of the outline that the door lies on, or -1.
int wall_of(const Polygon& outline, const Door& door) {
  for (std::size_t n = 0; n < outline.size(); ++n)
    if (distance_m(edge(outline, n), door.a_m) <= kOnWall_m && distance_m(edge(outline, n), door.b_m) <= kOnWall_m)
      return int(n);
  return -1;
}

Gate gate_of(const Polygon& outline, const Door& door) {
  const Segment wall = edge(outline, std::size_t(wall_of(outline, door)));
  const glm::dvec2 along = glm::normalize(wall.b - wall.a);
  const auto foot = [&](glm::dvec2 p) { return wall.a + along * glm::dot(p - wall.a, along); };
  Gate g;
  g.a = foot(door.a_m);
  g.b = foot(door.b_m);
  if (glm::dot(g.b - g.a, along) < 0) std::swap(g.a, g.b);
  g.along = along;
  g.inward = {-along.y, along.x};  // the outline runs counter-clockwise: inside is to the left
  g.width_m = glm::distance(g.a, g.b);
  return g;
}

bool active(double from_day, double until_day, double day) { return day >= from_day && day < until_day; }

void check_span(const std::string& what, double from, double until) {
  if (!(from >= 0) || !(until > from))
    throw InvalidInput(what + ": from_day = " + std::to_string(from) + ", until_day = " + std::to_string(until) +
                       ": needs 0 <= from_day < until_day, days");
}

void check_doors(const RoomOptions& room, const Polygon& outline, const GaitOptions& gait) {
  if (room.doors.empty()) throw InvalidInput("room.door: at least one door is needed");
  double shares = 0;
  for (std::size_t n = 0; n < room.doors.size(); ++n) {
    const Door& d = room.doors[n];
    const std::string what = "room.door[" + std::to_string(n) + "] '" + d.name + "'";
    if (wall_of(outline, d) < 0)
      throw InvalidInput(what + ": from " + text(d.a_m) + " to " + text(d.b_m) +
                         " does not lie on one edge of the outline (within 0.02 m)");
    const double width = glm::distance(d.a_m, d.b_m), least = std::max(0.5, 2 * gait.clearance_m + 0.1);
    if (!(width >= least && width <= 10))
      throw InvalidInput(what + ": width " + std::to_string(width) + " m is outside " + std::to_string(least) +
                         "..10 m (lower bound: twice gait.clearance_m and 0.1 m)");
    if (!(d.share >= 0) || !std::isfinite(d.share))
      throw InvalidInput(what + ": share = " + std::to_string(d.share) + " must be >= 0");
    shares += d.share;
  }
  if (!(shares > 0)) throw InvalidInput("room.door: the shares of all doors are 0");
}

void check_place(const RoomOptions& room, const Polygon& outline, const Place& p, const std::string& what,
                 const GaitOptions& gait) {
  check_span(what, p.from_day, p.until_day);
  if (!contains(outline, p.at_m)) throw InvalidInput(what + ": " + text(p.at_m) + " is outside the room");
  if (!(p.share >= 0) || !std::isfinite(p.share))
    throw InvalidInput(what + ": share = " + std::to_string(p.share) + " must be >= 0");
  double free = distance_m(outline, p.at_m);
  std::string of = "a wall";
  for (const Obstacle& o : room.obstacles) {
    if (std::max(o.from_day, p.from_day) >= std::min(o.until_day, p.until_day)) continue;  // never at once
    if (contains(o.outline_m, p.at_m))
      throw InvalidInput(what + ": " + text(p.at_m) + " is inside the obstacle '" + o.name + "'");
    if (const double d = distance_m(o.outline_m, p.at_m); d < free) free = d, of = "the obstacle '" + o.name + "'";
  }
  if (free < gait.clearance_m)
    throw InvalidInput(what + ": " + text(p.at_m) + " is " + std::to_string(free) + " m from " + of +
                       "; at least gait.clearance_m = " + std::to_string(gait.clearance_m) + " m is needed");
}

}  // namespace

double signed_area_m2(const Polygon& p) {
  double twice = 0;
  for (std::size_t n = 0; n < p.size(); ++n) twice += cross(p[n], p[(n + 1) % p.size()]);
  return twice / 2;
}

bool contains(const Polygon& p, glm::dvec2 q) {
  bool in = false;
  for (std::size_t n = 0; n < p.size(); ++n) {
    const auto [a, b] = edge(p, n);
    if ((a.y > q.y) != (b.y > q.y) && q.x < a.x + (b.x - a.x) * (q.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

double distance_m(const Segment& s, glm::dvec2 p) {
  const glm::dvec2 d = s.b - s.a;
  const double l = glm::dot(d, d), t = l > 0 ? std::clamp(glm::dot(p - s.a, d) / l, 0.0, 1.0) : 0.0;
  return glm::distance(p, s.a + t * d);
}

double distance_m(const Polygon& polygon, glm::dvec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < polygon.size(); ++n) least = std::min(least, distance_m(edge(polygon, n), p));
  return least;
}

void check_simple(const Polygon& p, const std::string& what) {
  if (p.size() < 3) throw InvalidInput(what + ": " + std::to_string(p.size()) + " corners; at least 3 are needed");
  for (std::size_t n = 0; n < p.size(); ++n) {
    if (!std::isfinite(p[n].x) || !std::isfinite(p[n].y) || std::abs(p[n].x) > 1e4 || std::abs(p[n].y) > 1e4)
      throw InvalidInput(what + ": corner " + std::to_string(n) + " " + text(p[n]) + " is outside -10000..10000 m");
    if (glm::distance(p[n], p[(n + 1) % p.size()]) < 1e-3)
      throw InvalidInput(what + ": corners " + std::to_string(n) + " and " + std::to_string((n + 1) % p.size()) +
                         " are less than 0.001 m apart");
  }
  for (std::size_t n = 0; n < p.size(); ++n)
    for (std::size_t m = n + 2; m < p.size(); ++m) {
      if (n == 0 && m + 1 == p.size()) continue;  // neighbours share a corner
      if (meet(edge(p, n), edge(p, m)))
        throw InvalidInput(what + ": the outline crosses itself: edge " + std::to_string(n) + " from " + text(p[n]) +
                           " meets edge " + std::to_string(m) + " from " + text(p[m]));
    }
  if (std::abs(signed_area_m2(p)) < 1e-4)
    throw InvalidInput(what + ": area " + std::to_string(std::abs(signed_area_m2(p))) + " m2; at least 0.0001 m2");
}

double Gate::depth_m(glm::dvec2 p) const { return glm::dot(p - a, inward); }
double Gate::offset_m(glm::dvec2 p) const { return glm::dot(p - middle(), along); }

RoomPlan::RoomPlan(const RoomOptions& room, double day) : outline_(counter_clockwise(room.outline_m)) {
  for (const Obstacle& o : room.obstacles)
    if (active(o.from_day, o.until_day, day)) obstacles_.push_back(o.outline_m);
  for (const Door& d : room.doors) gates_.push_back(gate_of(outline_, d));
  for (std::size_t n = 0; n < outline_.size(); ++n) {  // each edge without its doors
    const Segment wall = edge(outline_, n);
    const glm::dvec2 along = glm::normalize(wall.b - wall.a);
    std::vector<std::pair<double, double>> gaps;
    for (std::size_t g = 0; g < gates_.size(); ++g)
      if (wall_of(outline_, room.doors[g]) == int(n))
        gaps.emplace_back(glm::dot(gates_[g].a - wall.a, along), glm::dot(gates_[g].b - wall.a, along));
    std::sort(gaps.begin(), gaps.end());
    double at = 0;
    for (const auto& [from, to] : gaps) {
      if (from > at) walls_.push_back({wall.a + along * at, wall.a + along * from});
      at = std::max(at, to);
    }
    if (const double length = glm::distance(wall.a, wall.b); length > at) walls_.push_back({wall.a + along * at, wall.b});
  }
  for (const Gate& g : gates_)  // jambs go on outward: a walker cannot leave sideways
    for (const glm::dvec2 jamb : {g.a, g.b}) walls_.push_back({jamb, jamb - g.inward * (kVestibule_m + 1)});
}

bool RoomPlan::open(glm::dvec2 p) const {
  for (const Polygon& o : obstacles_)
    if (contains(o, p)) return false;
  if (contains(outline_, p)) return true;
  for (const Gate& g : gates_)
    if (const double d = g.depth_m(p); d <= 1e-9 && d >= -kVestibule_m && std::abs(g.offset_m(p)) <= g.width_m / 2)
      return true;
  return false;
}

double RoomPlan::clearance_m(glm::dvec2 p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : walls_) least = std::min(least, distance_m(s, p));
  for (const Polygon& o : obstacles_) least = std::min(least, distance_m(o, p));
  return least;
}

Box RoomPlan::bounds() const {
  Box box{outline_[0], outline_[0]};
  for (const glm::dvec2& p : outline_) {
    box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
    box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
  }
  return box;
}

std::vector<double> changes_of_plan(const RoomOptions& room, double days) {
  std::vector<double> at{0};
  const auto note = [&](double day) {
    if (day > 0 && day < days) at.push_back(day);
  };
  for (const Obstacle& o : room.obstacles) note(o.from_day), note(o.until_day);
  for (const Place& p : room.places) note(p.from_day), note(p.until_day);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

void validate_room(const RoomOptions& room, const GaitOptions& gait, double days) {
  check_simple(room.outline_m, "room.outline_m");
  const Polygon outline = counter_clockwise(room.outline_m);
  check_doors(room, outline, gait);
  for (std::size_t n = 0; n < room.obstacles.size(); ++n) {
    const Obstacle& o = room.obstacles[n];
    const std::string what = "room.obstacle[" + std::to_string(n) + "] '" + o.name + "'";
    check_simple(o.outline_m, what);
    check_span(what, o.from_day, o.until_day);
    if (std::none_of(o.outline_m.begin(), o.outline_m.end(), [&](glm::dvec2 p) {
          return contains(outline, p) || distance_m(outline, p) < 1e-6;
        }))
      throw InvalidInput(what + ": no corner lies in the room");
  }
  for (std::size_t n = 0; n < room.places.size(); ++n)
    check_place(room, outline, room.places[n],
                "room.place[" + std::to_string(n) + "] '" + room.places[n].name + "'", gait);
  for (std::size_t n = 0; n < room.pictures.size(); ++n)
    if (const glm::dvec2 p = room.pictures[n].at_m; !contains(outline, p) && distance_m(outline, p) > 0.05)
      throw InvalidInput("room.picture[" + std::to_string(n) + "] '" + room.pictures[n].name + "': " + text(p) +
                         " is outside the room");
  if (room.obstacles.size() + room.places.size() > 10000 || changes_of_plan(room, days).size() > 200)
    throw InvalidInput("room: more than 10000 obstacles and places, or the plan changes on more than 200 days");
}

}  // namespace witherfield::floor
