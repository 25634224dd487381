// The light of a room. The sky's own light comes as area lights in the windows (radiance times area, over the cosine), so
// the sky itself is hidden from radiosity: it would be counted twice, and few of its rays would find the window.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/room_walls.hpp"
#include "pov/text.hpp"

namespace witherfield::pov {
namespace {

// A bright day with thin cloud: soft enough that neither the sun's patches nor the far corners are lost.
const glm::dvec3 kSun{6.5, 5.8, 4.7};   // irradiance over pi of a surface that faces it
const glm::dvec3 kSky{4.9, 5.4, 6.1};   // radiance
constexpr double kDust_1_m = 0.030;      // scattering of the air at haze 1: a room in which rugs were beaten
const glm::dvec3 kLamp{1.0, 0.89, 0.75};

std::string rgb(const glm::dvec3& c) { return (Text() << "rgb" << c).str(); }

/// Light that a glowing rectangle sends: POV-Ray's 2 I / (1 + (d / f)^2) is L A / (pi d^2) far away for I = L and
/// f^2 = A / (2 pi).
std::string glowing_text(const glm::dvec3& at, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& toward,
                         const glm::dvec3& radiance, int cells, double unit) {
  const double area = glm::length(a) * glm::length(b);
  Text t;
  t << "light_source{" << at * unit << " " << rgb(radiance) << " area_light " << a * unit << "," << b * unit << "," << cells
    << "," << cells << " adaptive 1 JITTER() spotlight radius 35 falloff 90 tightness 1 point_at " << (at + toward) * unit
    << " fade_distance " << std::sqrt(area / (2 * 3.14159265)) * unit
    << " fade_power 2 media_interaction off media_attenuation off}\n";
  return t.str();
}

/// Dust that the sun lights up. Only where its light can come in, a sheared box behind each window: the rest of the room need not be
/// sampled, and there each sample asks the sun.
std::string shafts_text(const RoomSceneInput& in, const std::vector<Wall>& walls, const glm::dvec3& toward, double unit) {
  Text t;
  for (const Wall& w : walls) {
    if (glm::dot(glm::dvec3(w.out.x, 0, w.out.y), toward) < 0.01) continue;  // it looks away from the sun
    for (const WallOpening& o : w.openings) {
      if (o.kind != OpeningKind::window) continue;
      const glm::dvec2 corner = w.a_m + w.along * o.a_m.x;
      // From inside the glass down to below the floor.
      const glm::dvec3 start(corner.x, o.sill_m, corner.y), across = glm::dvec3(w.along.x, 0, w.along.y) * (o.b_m.x - o.a_m.x),
          down = -toward * ((o.sill_m + o.height_m + 0.05) / toward.y);
      t << "box{0,1 hollow no_shadow no_reflection no_radiosity pigment{rgbt 1} interior{media{method 3 samples 10,10 jitter 0 scattering{5,rgb "
        << kDust_1_m * in.haze / unit << " eccentricity 0.35}}} matrix<" << across.x * unit << "," << across.y * unit << ","
        << across.z * unit << ",0," << o.height_m * unit << ",0," << down.x * unit << "," << down.y * unit << "," << down.z * unit << ","
        << start.x * unit << "," << start.y * unit << "," << start.z * unit << ">}\n";
    }
  }
  return t.str();
}

}  // namespace

std::string room_light_text(const RoomSceneInput& in, const std::vector<Wall>& walls, double unit) {
  const glm::dvec3 sun = in.still.sun.direction();
  const glm::dvec3 toward{sun.x, sun.z, sun.y};
  glm::dvec2 low = in.outline_m[0], high = low;
  for (const glm::dvec2& p : in.outline_m) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec2 mid = 0.5 * (low + high), half = 0.5 * (high - low);
  const double far = 1000 * unit;
  const glm::dvec3 side = glm::normalize(glm::cross(toward, glm::dvec3(0, 1, 0.01))), up = glm::cross(side, toward);
  Text t;
  // The sun's disc is 0.53 degrees wide.
  t << "light_source{" << (toward * far + glm::dvec3(mid.x, 0, mid.y) * unit) << " " << rgb(kSun) << " parallel point_at "
    << glm::dvec3(mid.x, 0, mid.y) * unit << " area_light " << side * (0.0093 * far) << "," << up * (0.0093 * far)
    << ",3,3 adaptive 1 circular JITTER()}\n";
  t << "sphere{0," << 4 * far << " hollow no_shadow no_radiosity pigment{gradient y color_map{[0 " << rgb({0.30, 0.33, 0.20})
    << "][0.497 " << rgb({0.45, 0.48, 0.32}) << "][0.503 " << rgb(kSky * glm::dvec3(0.72, 0.65, 0.57)) << "][0.75 "
    << rgb(kSky * 0.55) << "][1 " << rgb(kSky * 0.4) << "]} translate -0.5*y scale " << 8 * far
    << "} finish{emission 1 diffuse 0 ambient 0}}\n";
  for (const Wall& w : walls)
    for (const WallOpening& o : w.openings) {
      if (o.kind != OpeningKind::window) continue;
      const double width = o.b_m.x - o.a_m.x;
      const glm::dvec2 p = w.a_m + w.along * (0.5 * (o.a_m.x + o.b_m.x)) - w.out * 0.06;
      t << glowing_text({p.x, o.sill_m + 0.5 * o.height_m, p.y}, glm::dvec3(w.along.x, 0, w.along.y) * (0.9 * width),
                        {0, 0.9 * o.height_m, 0}, {-w.out.x, -0.25, -w.out.y}, kSky, 4, unit);
    }
  if (in.lamps > 0) {
    const double size = 0.5 * std::min(half.x, half.y);
    t << glowing_text({mid.x, in.wall_height_m - 0.02, mid.y}, {size, 0, 0}, {0, 0, size}, {0, -1, 0.001},
                      kLamp * (in.lamps * 6.0), 3, unit);
  }
  if (in.haze > 0) t << shafts_text(in, walls, toward, unit);
  return t.str();
}

}  // namespace witherfield::pov
