#include "pov/room_walls.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/text.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

constexpr double kOnWall_m = 0.02;  // an opening may miss its wall by this
constexpr double kSkirting_m = 0.09;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

std::string where(glm::dvec2 p) {
  return (Text() << "(" << p.x << ", " << p.y << ") m").str();
}

/// Along and height of an opening on a wall, in local coordinates, as a box that pierces it.
std::string hole_text(const WallOpening& o, double unit) {
  return (Text() << "box{" << glm::dvec3(o.a_m.x, o.sill_m > 0 ? o.sill_m : -0.5, -0.1) * unit << ","
                 << glm::dvec3(o.b_m.x, o.sill_m + o.height_m, kWallThick_m + 0.1) * unit << "}")
      .str();
}

std::string box_text(glm::dvec3 low, glm::dvec3 high, double unit) {
  return (Text() << "box{" << low * unit << "," << high * unit << "}").str();
}

/// Frame, sill and glazing bars.
std::string window_text(const WallOpening& o, double unit) {
  const double x0 = o.a_m.x, x1 = o.b_m.x, y0 = o.sill_m, y1 = y0 + o.height_m, f = 0.05, z0 = 0.16, z1 = 0.22;
  Text t;
  t << "union{" << box_text({x0, y0, z0}, {x0 + f, y1, z1}, unit) << box_text({x1 - f, y0, z0}, {x1, y1, z1}, unit)
    << box_text({x0, y0, z0}, {x1, y0 + f, z1}, unit) << box_text({x0, y1 - f, z0}, {x1, y1, z1}, unit)
    << box_text({x0 - 0.05, y0 - 0.035, -0.05}, {x1 + 0.05, y0 + 0.002, z1}, unit);
  const int lights = std::max(1, int(std::lround((x1 - x0) / 0.75)));
  for (int i = 1; i < lights; ++i) {
    const double x = x0 + (x1 - x0) * i / lights;
    t << box_text({x - 0.022, y0, z0 + 0.01}, {x + 0.022, y1, z1 - 0.01}, unit);
  }
  const double bar = y0 + 0.66 * o.height_m;
  t << box_text({x0, bar - 0.018, z0 + 0.01}, {x1, bar + 0.018, z1 - 0.01}, unit) << " texture{White}}\n";
  return t.str();
}

/// Closed leaves with two sunken panels each, lining and threshold. Wide doors have two leaves.
std::string door_text(const WallOpening& o, double unit) {
  const double x0 = o.a_m.x, x1 = o.b_m.x, top = o.height_m, z = 0.10;
  const int leaves = x1 - x0 > 1.25 ? 2 : 1;
  Text t;
  for (const auto& [a, b] : {std::pair{x0 - 0.07, x0}, std::pair{x1, x1 + 0.07}})
    t << box_text({a, 0.0, -0.018}, {b, top + 0.07, 0.02}, unit).insert(0, "object{") << " texture{White}}";
  t << "object{" << box_text({x0 - 0.07, top, -0.018}, {x1 + 0.07, top + 0.07, 0.02}, unit) << " texture{White}}\n"
    << "object{" << box_text({x0, -0.05, -0.001}, {x1, 0.004, kWallThick_m}, unit) << " texture{Threshold}}\n"
    << "object{" << box_text({x0 - 0.1, -0.1, z + 0.045}, {x1 + 0.1, top + 0.1, z + 0.06}, unit) << " texture{DoorPaint}}\n";
  for (int l = 0; l < leaves; ++l) {
    const double a = x0 + (x1 - x0) * l / leaves + 0.003, b = x0 + (x1 - x0) * (l + 1) / leaves - 0.003, w = b - a;
    t << "difference{" << box_text({a, 0.008, z}, {b, top - 0.004, z + 0.04}, unit);
    for (const auto& [y0, y1] : {std::pair{0.10, 0.44}, std::pair{0.52, 0.93}})
      t << box_text({a + 0.16 * w, y0 * top, z - 0.1}, {b - 0.16 * w, y1 * top, z + 0.012}, unit);
    const double knob = l == 0 ? b - 0.06 : a + 0.06;
    t << " texture{DoorPaint}}\n sphere{" << glm::dvec3(knob, 1.02, z - 0.05) * unit << "," << 0.027 * unit
      << " texture{Brass}} cylinder{" << glm::dvec3(knob, 1.02, z - 0.05) * unit << "," << glm::dvec3(knob, 1.02, z) * unit
      << "," << 0.011 * unit << " texture{Brass}}\n";
  }
  return t.str();
}

/// Skirting between the doors of a wall.
std::string skirting_text(const Wall& w, double unit) {
  std::vector<std::pair<double, double>> doors;
  for (const WallOpening& o : w.openings)
    if (o.sill_m <= 0) doors.push_back({o.a_m.x - 0.07, o.b_m.x + 0.07});
  std::sort(doors.begin(), doors.end());
  doors.push_back({w.length_m, w.length_m});
  Text t;
  double from = 0;
  for (const auto& [a, b] : doors) {
    if (a > from) t << "object{" << box_text({from, 0.0, -0.014}, {a, kSkirting_m, 0.01}, unit) << " texture{White}}\n";
    from = b;
  }
  return t.str();
}

}  // namespace

double signed_area(const std::vector<glm::dvec2>& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i], p[(i + 1) % p.size()]);
  return sum;
}

std::string prism_text(const std::vector<glm::dvec2>& p, double low_m, double high_m, double unit) {
  Text t;
  t << "prism{linear_spline linear_sweep " << low_m * unit << "," << high_m * unit << "," << p.size() + 1;
  for (std::size_t i = 0; i <= p.size(); ++i)
    t << ",<" << p[i % p.size()].x * unit << "," << p[i % p.size()].y * unit << ">";
  return t.str();
}

std::string Wall::matrix(double unit) const {
  return (Text() << "matrix<" << along.x << ",0," << along.y << ",0,1,0," << out.x << ",0," << out.y << "," << a_m.x * unit
                 << ",0," << a_m.y * unit << ">")
      .str();
}

std::vector<Wall> walls_of(const RoomSceneInput& in) {
  std::vector<glm::dvec2> p = in.outline_m;
  if (signed_area(p) < 0) std::reverse(p.begin(), p.end());
  std::vector<Wall> walls(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec2 d = p[(i + 1) % p.size()] - p[i];
    walls[i].a_m = p[i];
    walls[i].length_m = glm::length(d);
    walls[i].along = d / walls[i].length_m;
    walls[i].out = {walls[i].along.y, -walls[i].along.x};
  }
  for (std::size_t i = 0; i < p.size(); ++i) {  // outer corners are closed by mitres; inner ones close themselves
    Wall& next = walls[(i + 1) % p.size()];
    const double turn = std::atan2(cross(walls[i].along, next.along), glm::dot(walls[i].along, next.along));
    const double mitre = turn > 0 ? std::min(kWallThick_m * std::tan(0.5 * turn), 3 * kWallThick_m) : 0.0;
    walls[i].after_m = next.before_m = mitre;
  }
  for (const WallOpening& o : in.openings) {
    const auto fits = [&](const Wall& w) {
      for (const glm::dvec2 e : {o.a_m, o.b_m}) {
        const double x = glm::dot(e - w.a_m, w.along);
        if (std::abs(glm::dot(e - w.a_m, w.out)) > kOnWall_m || x < -kOnWall_m || x > w.length_m + kOnWall_m) return false;
      }
      return true;
    };
    const auto wall = std::find_if(walls.begin(), walls.end(), fits);
    if (wall == walls.end())
      throw InvalidInput(std::string("room scene: ") + (o.kind == OpeningKind::door ? "door " : "window ") + where(o.a_m) +
                         " to " + where(o.b_m) + " does not lie on a wall");
    WallOpening local = o;
    const double xa = glm::dot(o.a_m - wall->a_m, wall->along), xb = glm::dot(o.b_m - wall->a_m, wall->along);
    local.a_m = {std::min(xa, xb), 0};
    local.b_m = {std::max(xa, xb), 0};
    wall->openings.push_back(local);
  }
  return walls;
}

std::string walls_text(const RoomSceneInput& in, const std::vector<Wall>& walls, double unit) {
  const double top = in.wall_height_m;
  Text t;
  for (const Wall& w : walls) {
    t << "union{\n" << (w.openings.empty() ? "object{" : "difference{")
      << box_text({-w.before_m, -0.12, 0}, {w.length_m + w.after_m, top + 0.2, kWallThick_m}, unit);
    for (const WallOpening& o : w.openings) t << hole_text(o, unit);
    t << " texture{WallPaint}}\n" << skirting_text(w, unit);
    for (const WallOpening& o : w.openings) t << (o.kind == OpeningKind::door ? door_text(o, unit) : window_text(o, unit));
    t << w.matrix(unit) << "}\n";
  }
  t << prism_text(in.outline_m, top, top + 0.25, unit) << " texture{Ceiling}}\n"
    << prism_text(in.outline_m, -0.12, -0.1, unit) << " texture{Threshold}}\n";
  return t.str();
}

namespace {

/// What is painted on a canvas: one of three abstract manners with colours of its own.
std::string canvas_text(std::size_t number, double width, double height) {
  Random r(number + 11, Stream::colour, number);
  const auto colour = [&](double lightness) {
    const double hue = r.uniform() * 6.2832, chroma = r.uniform(0.10, 0.5);
    return (Text() << "rgb" << glm::dvec3(lightness * (1 + chroma * std::cos(hue)), lightness * (1 + chroma * std::cos(hue - 2.094)),
                                          lightness * (1 + chroma * std::cos(hue + 2.094))))
        .str();
  };
  const std::string a = colour(0.55), b = colour(0.18), c = colour(0.35), d = colour(0.07), e = colour(0.7);
  Text t;
  t << "pigment{";
  switch (number % 3) {
    case 0:  // fields of colour, one above the other
      t << "gradient y turbulence 0.06 lambda 3 color_map{[0 " << b << "][0.27 " << b << "][0.30 " << a << "][0.62 " << a
        << "][0.65 " << c << "][0.93 " << c << "][0.96 " << d << "][1 " << d << "]} scale " << height * 1.04;
      break;
    case 1:  // pours
      t << "marble turbulence 1.1 omega 0.55 color_map{[0 " << e << "][0.3 " << a << "][0.5 " << d << "][0.62 " << e
        << "][0.8 " << c << "][1 " << b << "]} rotate z*" << r.uniform(0, 180) << " scale " << 0.5 * width;
      break;
    default:  // cut shapes
      t << "crackle solid turbulence 0.0 color_map{[0 " << a << "][0.2 " << a << "][0.2 " << d << "][0.4 " << d << "][0.4 "
        << e << "][0.65 " << e << "][0.65 " << c << "][0.85 " << c << "][0.85 " << b << "][1 " << b << "]} scale "
        << 0.33 * width;
  }
  t << " translate <" << r.uniform(0, 9) * width << ",0," << r.uniform(0, 9) << ">}";
  return t.str();
}

}  // namespace

std::string pictures_text(const RoomSceneInput& in, const std::vector<Wall>& walls, double unit) {
  Text t;
  std::size_t number = 0;
  for (const WallPicture& p : in.pictures) {
    const auto off = [&](const Wall& w) {
      const double x = glm::dot(p.at_m - w.a_m, w.along);
      return glm::length(p.at_m - w.a_m - std::clamp(x, 0.0, w.length_m) * w.along);
    };
    const Wall& w = *std::min_element(walls.begin(), walls.end(),
                                      [&](const Wall& a, const Wall& b) { return off(a) < off(b); });
    const double x = std::clamp(glm::dot(p.at_m - w.a_m, w.along), 0.0, w.length_m), hw = p.width_m / 2,
                 hh = p.height_m / 2, f = 0.035;
    t << "union{difference{" << box_text({-hw - f, -hh - f, -0.035}, {hw + f, hh + f, -0.002}, unit)
      << box_text({-hw, -hh, -0.1}, {hw, hh, -0.012}, unit) << " texture{Frame}}\n"
      << box_text({-hw - 0.001, -hh - 0.001, -0.014}, {hw + 0.001, hh + 0.001, -0.004}, unit).insert(0, "object{")
      << " texture{" << canvas_text(number++, p.width_m * unit, p.height_m * unit)
      << " finish{diffuse 0.85 ambient Fill specular 0.05 roughness 0.05}}}\n translate "
      << glm::dvec3(x, p.middle_m, 0) * unit << " " << w.matrix(unit) << "}\n";
  }
  return t.str();
}

}  // namespace witherfield::pov
