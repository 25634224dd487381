// What stands in a room: desks with what lies on them, chairs, tables, benches, cabinets, columns.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "pov/room_walls.hpp"
#include "pov/text.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

constexpr double kDeskReach_m = 1.0;  // a seat this near to a desk's middle line belongs to it

std::string part(glm::dvec3 low, glm::dvec3 high, const char* texture, double unit) {
  return (Text() << "object{box{" << low * unit << "," << high * unit << "} texture{" << texture << "}}\n").str();
}

glm::dvec2 middle_of(const std::vector<glm::dvec2>& p) {
  glm::dvec2 sum{0.0};
  for (const glm::dvec2& q : p) sum += q / double(p.size());
  return sum;
}

/// Box about an outline along its longest edge: local x along it, z across, origin in the middle on the floor.
struct Stand {
  glm::dvec2 middle{0.0}, along{1, 0}, across{0, 1};
  double half_x = 0, half_z = 0;
  std::string matrix(double unit) const {
    return (Text() << "matrix<" << along.x << ",0," << along.y << ",0,1,0," << across.x << ",0," << across.y << "," << middle.x * unit
                   << ",0," << middle.y * unit << ">")
        .str();
  }
};

Stand stand_of(const std::vector<glm::dvec2>& p) {
  Stand s;
  double longest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec2 d = p[(i + 1) % p.size()] - p[i];
    if (glm::length(d) > longest + 1e-9) longest = glm::length(d), s.along = d / longest;
  }
  s.across = {-s.along.y, s.along.x};
  glm::dvec2 low{1e30}, high{-1e30};
  for (const glm::dvec2& q : p) {
    const glm::dvec2 at{glm::dot(q, s.along), glm::dot(q, s.across)};
    low = glm::min(low, at), high = glm::max(high, at);
  }
  s.half_x = 0.5 * (high.x - low.x), s.half_z = 0.5 * (high.y - low.y);
  s.middle = s.along * (0.5 * (low.x + high.x)) + s.across * (0.5 * (low.y + high.y));
  return s;
}

/// A top on square legs at the corners, drawn in by `in`, with an apron under it.
std::string table_text(const RoomObstacle& o, double thick, double leg, double in, double unit) {
  const glm::dvec2 m = middle_of(o.outline_m);
  Text t;
  t << prism_text(o.outline_m, o.height_m - thick, o.height_m, unit) << " texture{Furniture}}\n";
  std::vector<glm::dvec2> feet;
  for (const glm::dvec2& c : o.outline_m) {
    const glm::dvec2 to = m - c, at = c + glm::dvec2(std::copysign(in, to.x), std::copysign(in, to.y));
    feet.push_back(at);
    t << part({at.x - leg / 2, -0.02, at.y - leg / 2}, {at.x + leg / 2, o.height_m - thick, at.y + leg / 2}, "Furniture", unit);
  }
  for (std::size_t i = 0; i < feet.size(); ++i) {  // apron
    const glm::dvec2 a = feet[i], b = feet[(i + 1) % feet.size()], d = glm::normalize(b - a), n = glm::dvec2(-d.y, d.x) * 0.011;
    t << prism_text({a - n, b - n, b + n, a + n}, o.height_m - thick - 0.07, o.height_m - thick, unit) << " texture{Furniture}}\n";
  }
  return t.str();
}

/// A writing desk: steel frame, drawers on one side, a panel away from the sitter, a screen, sheets, a cup. `sitter` is where it is
/// used from: +1 or -1 along z.
std::string desk_text(const RoomObstacle& o, const Stand& s, int sitter, std::size_t number, double unit) {
  Random r(number + 3, Stream::colour, number);
  const double top = o.height_m, x = s.half_x, z = s.half_z, thick = 0.032;
  Text t;
  t << prism_text(o.outline_m, top - thick, top, unit) << " texture{Furniture}}\n";
  t << "union{\n";
  for (const int sx : {-1, 1}) {  // frames of square tube
    const double at = sx * (x - 0.06);
    for (const int sz : {-1, 1})
      t << part({at - 0.022, -0.02, sz * (z - 0.06) - 0.022}, {at + 0.022, top - thick, sz * (z - 0.06) + 0.022}, "Steel", unit);
    t << part({at - 0.022, top - thick - 0.045, -(z - 0.06)}, {at + 0.022, top - thick, z - 0.06}, "Steel", unit);
  }
  const double back = -sitter * (z - 0.055), front = sitter * (z - 0.05), side = r.uniform() < 0.5 ? 1 : -1;
  t << part({-(x - 0.08), 0.30, back - 0.008}, {x - 0.08, top - thick, back + 0.008}, "Furniture", unit);
  const double d1 = side * (x - 0.10), d0 = d1 - side * 0.42;
  t << part({std::min(d0, d1), 0.10, std::min(front, back + sitter * 0.02)}, {std::max(d0, d1), top - thick, std::max(front, back + sitter * 0.02)},
            "Cabinet", unit);
  for (int k = 0; k < 3; ++k) {  // drawers stand out by their fronts, with a grip each
    const double y0 = 0.112 + k * 0.197, y1 = y0 + 0.185, f0 = front, f1 = front + sitter * 0.016;
    t << part({std::min(d0, d1) + 0.006, y0, std::min(f0, f1)}, {std::max(d0, d1) - 0.006, y1, std::max(f0, f1)}, "Cabinet", unit)
      << part({0.5 * (d0 + d1) - 0.06, y1 - 0.05, std::min(f1, f1 + sitter * 0.02)}, {0.5 * (d0 + d1) + 0.06, y1 - 0.038, std::max(f1, f1 + sitter * 0.02)}, "Steel", unit);
  }
  // Screen, keyboard, a pile of sheets, a cup.
  const double screen = -side * 0.10 + r.uniform(-0.08, 0.08), deep = -sitter * (z - 0.20);
  t << "union{" << part({-0.12, 0, -0.08}, {0.12, 0.012, 0.08}, "Steel", unit) << part({-0.02, 0, -0.012}, {0.02, 0.16, 0.012}, "Steel", unit)
    << part({-0.27, 0.11, -0.012}, {0.27, 0.44, 0.012}, "Screen", unit) << " rotate y*" << r.uniform(-12, 12) << " translate "
    << glm::dvec3(screen, top, deep) * unit << "}\n";
  t << "union{" << part({-0.22, 0, -0.07}, {0.22, 0.02, 0.07}, "Screen", unit) << " rotate y*" << r.uniform(-8, 8) << " translate "
    << glm::dvec3(screen + r.uniform(-0.03, 0.03), top, sitter * (z - 0.24)) * unit << "}\n";
  for (int k = 0; k < 4; ++k)
    t << "object{box{" << glm::dvec3(-0.105, 0.004 * k, -0.149) * unit << "," << glm::dvec3(0.105, 0.004 * (k + 1), 0.149) * unit
      << "} texture{Paper} rotate y*" << r.uniform(-25, 25) << " translate " << glm::dvec3(side * (x - 0.28), top, sitter * 0.05) * unit << "}\n";
  t << "difference{cylinder{0," << glm::dvec3(0, 0.095, 0) * unit << "," << 0.04 * unit << "} cylinder{" << glm::dvec3(0, 0.006, 0) * unit << ","
    << glm::dvec3(0, 0.1, 0) * unit << "," << 0.036 * unit << "} texture{White} translate "
    << glm::dvec3(screen - side * 0.38, top, sitter * r.uniform(0.02, 0.12)) * unit << "}\n";
  t << s.matrix(unit) << "}\n";
  return t.str();
}

/// Bent wood on four legs; one sits looking to -z in the chair's own frame.
std::string chair_text(const RoomSeat& seat, std::size_t number, double unit) {
  Random r(number + 29, Stream::colour, number);
  Text t;
  t << "union{" << part({-0.20, 0.435, -0.21}, {0.20, 0.46, 0.19}, "Chair", unit);
  for (const int side : {-1, 1}) {
    t << "cylinder{" << glm::dvec3(side * 0.18, 0, -0.18) * unit << "," << glm::dvec3(side * 0.165, 0.44, -0.16) * unit << "," << 0.016 * unit
      << " texture{Chair}}\n"
      << "cylinder{" << glm::dvec3(side * 0.185, 0, 0.23) * unit << "," << glm::dvec3(side * 0.17, 0.45, 0.17) * unit << "," << 0.017 * unit
      << " texture{Chair}} cylinder{" << glm::dvec3(side * 0.17, 0.45, 0.17) * unit << "," << glm::dvec3(side * 0.175, 0.83, 0.25) * unit << ","
      << 0.016 * unit << " texture{Chair}}\n"
      << "cylinder{" << glm::dvec3(side * 0.175, 0.20, -0.17) * unit << "," << glm::dvec3(side * 0.178, 0.20, 0.20) * unit << "," << 0.010 * unit
      << " texture{Chair}}\n";
  }
  // Three slats between the posts, following their lean.
  for (const double y : {0.56, 0.66, 0.765}) {
    const double back = 0.17 + 0.08 * (y - 0.45) / 0.38;
    t << part({-0.175, y, back - 0.007}, {0.175, y + (y > 0.7 ? 0.075 : 0.045), back + 0.007}, "Chair", unit);
  }
  t << "cylinder{" << glm::dvec3(-0.177, 0.24, 0.02) * unit << "," << glm::dvec3(0.177, 0.24, 0.02) * unit << "," << 0.010 * unit
    << " texture{Chair}}\n";
  // POV-Ray turns z towards x about y: -z comes to (cos facing, sin facing) of the plan.
  t << " rotate y*" << -(seat.facing_deg + 90) + r.uniform(-16, 16) << " translate "
    << glm::dvec3(seat.at_m.x + r.uniform(-0.04, 0.04), 0, seat.at_m.y + r.uniform(-0.04, 0.04)) * unit << "}\n";
  return t.str();
}

/// On which side of a desk somebody sits: +1 or -1 across it, 0 = nobody.
int sitter_of(const Stand& s, const std::vector<RoomSeat>& seats) {
  for (const RoomSeat& seat : seats) {
    const glm::dvec2 d = seat.at_m - s.middle;
    const double x = glm::dot(d, s.along), z = glm::dot(d, s.across);
    if (std::abs(x) < s.half_x && std::abs(z) < kDeskReach_m) return z > 0 ? 1 : -1;
  }
  return 0;
}

}  // namespace

std::string obstacles_text(const RoomSceneInput& in, double unit) {
  Text t;
  std::size_t number = 0;
  for (const RoomObstacle& o : in.obstacles) {
    ++number;
    const Stand s = stand_of(o.outline_m);
    const int sitter = sitter_of(s, in.seats);
    switch (o.kind) {
      case ObstacleKind::column:
        t << prism_text(o.outline_m, -0.05, in.wall_height_m + 0.05, unit) << " texture{WallPaint}}\n";
        break;
      case ObstacleKind::cabinet:
        t << prism_text(o.outline_m, -0.05, o.height_m, unit) << " texture{Furniture}}\n";
        break;
      case ObstacleKind::bench:
        t << table_text(o, 0.06, 0.07, 0.10, unit);
        break;
      case ObstacleKind::desk:
        t << (sitter != 0 ? desk_text(o, s, sitter, number, unit) : table_text(o, 0.032, 0.06, 0.06, unit));
        break;
    }
  }
  for (std::size_t i = 0; i < in.seats.size(); ++i) t << chair_text(in.seats[i], i, unit);
  return t.str();
}

}  // namespace witherfield::pov
