// Where the camera of a studio picture stands, and where the objects do.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numbers>

#include "pov/object_scene.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

constexpr double kRad = std::numbers::pi / 180;

void check(double value, double low, double high, const char* what, const char* unit) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("frame_objects: ") + what + " must be " + std::to_string(low) + " to " +
                       std::to_string(high) + unit + ", got " + std::to_string(value));
}

template <class Visit>
void each_vertex(std::span<const ObjectPlacement> objects, const Visit& visit) {
  for (const ObjectPlacement& o : objects) {
    if (!o.surface) throw InvalidInput("an object placement has no surface");
    for (const glm::dvec3& p : o.surface->position_m) visit(o.world(p));
  }
}

/// The middle and the half extent of a cone's cut: what stands between x <= s z + a and -x <= s z + b for all
/// vertices (x aside, z away from the camera, s the picture's half width at z = 1).
struct Wedge {
  double slope, plus = -std::numeric_limits<double>::infinity(), minus = plus;
  void add(double x, double z) {
    plus = std::max(plus, x - slope * z);
    minus = std::max(minus, -x - slope * z);
  }
  double distance() const { return (plus + minus) / (2 * slope); }
  double aside() const { return (plus - minus) / 2; }
};

}  // namespace

glm::dvec3 ObjectPlacement::world(const glm::dvec3& local) const {
  const double cy = std::cos(yaw_deg * kRad), sy = std::sin(yaw_deg * kRad);
  const double cp = std::cos(pitch_deg * kRad), sp = std::sin(pitch_deg * kRad);
  const double cr = std::cos(roll_deg * kRad), sr = std::sin(roll_deg * kRad);
  const glm::dvec3 a{local.x, cr * local.y - sr * local.z, sr * local.y + cr * local.z};
  const glm::dvec3 b{cp * a.x + sp * a.z, a.y, cp * a.z - sp * a.x};
  return position_m + scale * glm::dvec3{cy * b.x - sy * b.y, sy * b.x + cy * b.y, b.z};
}

Bounds bounds_of(std::span<const ObjectPlacement> objects) {
  Bounds b{glm::dvec3(std::numeric_limits<double>::infinity()),
           glm::dvec3(-std::numeric_limits<double>::infinity())};
  each_vertex(objects, [&](const glm::dvec3& p) {
    b.low = glm::min(b.low, p);
    b.high = glm::max(b.high, p);
  });
  if (!(b.low.x <= b.high.x)) throw InvalidInput("the objects of a picture have no vertices");
  return b;
}

Camera frame_objects(std::span<const ObjectPlacement> objects, double azimuth_deg, double elevation_deg,
                     double fov_deg, double aspect, double margin) {
  check(elevation_deg, -89, 89.9, "elevation", " degrees");
  check(fov_deg, 1, 120, "field of view", " degrees");
  check(aspect, 0.05, 20, "aspect", "");
  check(margin, 0, 0.45, "margin", "");
  const Bounds box = bounds_of(objects);
  const glm::dvec3 center = 0.5 * (box.low + box.high);
  const double az = azimuth_deg * kRad, el = elevation_deg * kRad;
  const glm::dvec3 view = -glm::dvec3{std::cos(az) * std::cos(el), std::sin(az) * std::cos(el), std::sin(el)};
  const glm::dvec3 right = glm::normalize(glm::cross(view, glm::dvec3(0, 0, 1)));
  const glm::dvec3 up = glm::cross(right, view);
  const double slope = std::tan(fov_deg * kRad / 2) * (1 - 2 * margin);
  Wedge across{slope}, along{slope / aspect};
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  each_vertex(objects, [&](const glm::dvec3& p) {
    const glm::dvec3 d = p - center;
    const double z = glm::dot(d, view);
    across.add(glm::dot(d, right), z);
    along.add(glm::dot(d, up), z);
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  });
  // Never inside the objects, however flat they lie in the view.
  const double size = glm::length(box.high - box.low);
  const double distance =
      std::max({across.distance(), along.distance(), -nearest + 0.01 * size, 1e-6});
  Camera camera;
  camera.fov_deg = fov_deg;
  camera.position_m = center + across.aside() * right + along.aside() * up - distance * view;
  camera.look_at_m = camera.position_m + (distance + 0.5 * (nearest + farthest)) * view;
  return camera;
}

void stand_in_row(std::span<ObjectPlacement> objects, double gap_m, bool common_ground) {
  double x = 0;
  const double lowest = common_ground && !objects.empty() ? bounds_of(objects).low.z : 0.0;
  for (ObjectPlacement& o : objects) {
    const Bounds b = bounds_of(std::span(&o, 1));
    o.position_m += glm::dvec3(x - b.low.x, -0.5 * (b.low.y + b.high.y), common_ground ? -lowest : -b.low.z);
    x += b.high.x - b.low.x + gap_m;
  }
}

}  // namespace witherfield::pov
