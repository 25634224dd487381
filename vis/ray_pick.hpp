// What lies under the pointer: the first triangle that a ray meets. Plain arithmetic, no window.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace witherfield::vis {

struct Ray {
  glm::dvec3 origin{0.0}, direction{0, 0, -1};  ///< direction need not be of length 1
};

struct SurfaceHit {
  int triangle = 0;
  int vertex = 0;  ///< corner of the triangle that is nearest to the point
  glm::dvec3 point_m{0.0};
};

/// The nearest triangle in front of the ray's origin, from either side; none when the ray misses. Triangles without
/// area are passed over. @pre every index is in range.
std::optional<SurfaceHit> first_hit(const Ray& ray, std::span<const glm::dvec3> position_m,
                                    std::span<const std::array<int, 3>> triangles);

/// Where the ray meets the plane; none when it runs along the plane or away from it.
std::optional<glm::dvec3> meet_plane(const Ray& ray, const glm::dvec3& point_m, const glm::dvec3& normal);

}  // namespace witherfield::vis
