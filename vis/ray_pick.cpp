#include "vis/ray_pick.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace witherfield::vis {

std::optional<SurfaceHit> first_hit(const Ray& ray, std::span<const glm::dvec3> position,
                                    std::span<const std::array<int, 3>> triangles) {
  std::optional<SurfaceHit> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    // Moeller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", without culling.
    const glm::dvec3& a = position[std::size_t(triangles[f][0])];
    const glm::dvec3 ab = position[std::size_t(triangles[f][1])] - a, ac = position[std::size_t(triangles[f][2])] - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) continue;
    const glm::dvec3 s = ray.origin - a, q = glm::cross(s, ab);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest)) continue;
    nearest = t;
    best = SurfaceHit{int(f), 0, ray.origin + t * ray.direction};
  }
  if (!best) return best;
  const auto& corners = triangles[std::size_t(best->triangle)];
  best->vertex = corners[0];
  for (const int v : corners)
    if (glm::distance(position[std::size_t(v)], best->point_m) <
        glm::distance(position[std::size_t(best->vertex)], best->point_m))
      best->vertex = v;
  return best;
}

std::optional<glm::dvec3> meet_plane(const Ray& ray, const glm::dvec3& point, const glm::dvec3& normal) {
  const double slope = glm::dot(ray.direction, normal);
  if (std::abs(slope) < 1e-9 * glm::length(ray.direction) * glm::length(normal)) return std::nullopt;
  const double t = glm::dot(point - ray.origin, normal) / slope;
  if (!(t > 0)) return std::nullopt;
  return ray.origin + t * ray.direction;
}

}  // namespace witherfield::vis
