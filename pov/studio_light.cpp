#include "pov/studio_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "pov/text.hpp"

namespace witherfield::pov {
namespace {

constexpr double kReach = 5;  // softboxes stand this many radii away

std::string rgb(const glm::dvec3& c) {
  return (Text() << "rgb" << c).str();
}

/// A square light source of `side`, `reach` from the center, and the glowing cloth that shiny skin mirrors.
std::string softbox(const Studio& s, const glm::dvec3& toward, double side, const glm::dvec3& colour, int samples) {
  const glm::dvec3 at = s.center + kReach * s.radius * toward;
  const glm::dvec3 helper = std::abs(toward.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 a = glm::normalize(glm::cross(helper, toward)) * side, b = glm::cross(toward, a);
  // Radiance of a cloth that gives irradiance pi * colour at the center.
  const double solid = side * side / (kReach * kReach * s.radius * s.radius);
  Text t;
  t << "light_source{" << at << " " << rgb(colour) << " area_light " << a << "," << b << "," << samples << ","
    << samples << " adaptive 1 jitter area_illumination on}\n"
    << "mesh{triangle{" << at - 0.5 * (a + b) << "," << at + 0.5 * (a - b) << "," << at + 0.5 * (a + b)
    << "} triangle{" << at - 0.5 * (a + b) << "," << at + 0.5 * (a + b) << "," << at + 0.5 * (b - a)
    << "} texture{pigment{" << rgb(glm::dvec3(1.0)) << "} finish{diffuse 0 emission "
    << rgb(colour * std::min(12.0, 3.14159265 / solid)) << "}} no_shadow no_radiosity no_image}\n";
  return t.str();
}

/// Paper: level under the objects, a quarter of a cylinder, a wall.
std::string sweep(const Studio& s) {
  const double back = 3.2 * s.radius, bend = 3 * s.radius, far = 60 * s.radius, thick = 0.1 * s.radius;
  const glm::dvec3 z = s.away, x = glm::cross(glm::dvec3(0, 1, 0), z);
  Text t;
  t << "union{box{<" << -far << "," << -thick << "," << -far << ">,<" << far << ",0," << back << ">}\n"
    << "box{<" << -far << "," << bend << "," << back + bend << ">,<" << far << "," << far << "," << back + bend + thick
    << ">}\ndifference{box{<" << -far << "," << -thick << "," << back << ">,<" << far << "," << bend << ","
    << back + bend + thick << ">} cylinder{<" << -2 * far << "," << bend << "," << back << ">,<" << 2 * far << "," << bend
    << "," << back << ">," << bend << "}}\n"
    << "matrix<" << x.x << "," << x.y << "," << x.z << ",0,1,0," << z.x << "," << z.y << "," << z.z << ","
    << s.center.x << "," << s.ground << "," << s.center.z << "> texture{Paper}}\n";
  return t.str();
}

}  // namespace

Studio make_studio(const ObjectSceneInput& input, double unit) {
  const Bounds box = bounds_of(input.objects);
  Studio s;
  s.center = flip(0.5 * (box.low + box.high), unit);
  s.radius = std::max(0.5 * glm::length(box.high - box.low) * unit, 1e-3);
  s.ground = (box.low.z - input.ground_gap_m) * unit;
  s.to_key = flip(input.still.sun.direction());
  const glm::dvec3 view = flip(input.still.camera.look_at_m - input.still.camera.position_m);
  glm::dvec3 level(view.x, 0, view.z);
  // Straight down: the picture's top is behind.
  s.away = glm::length(level) > 1e-9 * glm::length(view) ? glm::normalize(level) : glm::dvec3(0, 0, 1);
  const glm::dvec3 aside = glm::cross(glm::dvec3(0, 1, 0), s.away);
  const double other = glm::dot(s.to_key, aside) > 0 ? -1 : 1;
  s.to_rim = glm::normalize(s.away * 0.8 + aside * (0.55 * other) + glm::dvec3(0, 0.75, 0));
  return s;
}

std::string studio_light_text(const ObjectSceneInput& in, const Studio& s) {
  const bool paper = in.backdrop == Backdrop::paper, sky = in.backdrop == Backdrop::sky;
  const glm::dvec3 warm(1.02, 1.0, 0.97), cool(0.96, 0.99, 1.05);
  const double side = in.key_size * 2 * s.radius;
  Text t;
  t << "global_settings{assumed_gamma 1.0 max_trace_level 6 mm_per_unit 1 subsurface{samples 30,10 radiosity off}\n"
    << "#if(QUALITY>0) radiosity{pretrace_start 0.08 pretrace_end 4/image_width count (QUALITY=1?120:300) nearest_count 8"
    << " error_bound (QUALITY=1?0.5:0.3) low_error_factor 0.6 recursion_limit 1 gray_threshold 0"
    << " brightness 1 normal off always_sample off minimum_reuse 0.004} #end}\n";
  const glm::dvec3 room = cool * in.fill * (paper ? 1.0 : 0.8);
  if (sky)
    t << "sky_sphere{pigment{gradient y color_map{[0 rgb<0.95,1.0,1.02>*1.1][0.6 rgb<0.45,0.65,1.0>*0.9]}}}\n";
  else
    t << "sky_sphere{pigment{gradient y color_map{[0 " << rgb(room * 0.55) << "][1 " << rgb(room * 1.1) << "]}}}\n";
  t << softbox(s, s.to_key, side, warm, 9);
  if (in.rim > 0) t << softbox(s, s.to_rim, 0.5 * side, cool * in.rim, 5);
  if (sky) return t.str();
  if (paper)
    t << "#declare Paper=texture{pigment{rgb<0.80,0.80,0.79>} finish{diffuse 1}}\n";
  else
    t << "#declare Paper=texture{pigment{rgb<0.012,0.012,0.013>} finish{diffuse 1}}\n";
  t << sweep(s);
  return t.str();
}

}  // namespace witherfield::pov
