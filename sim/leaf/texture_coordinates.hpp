// Texture coordinates by principal components (Miao et al., sec. 1).
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace witherfield::leaf {

struct PrincipalPlane {
  glm::dvec3 centre{0, 0, 0};
  glm::dvec3 first{1, 0, 0}, second{0, 1, 0}, normal{0, 0, 1};  ///< orthonormal, right-handed, by falling variance
};

/// Components have no sign of their own: the one nearest to `along` points its way (base to tip), the normal that of `up`.
/// @throws InvalidInput when the points lie on one line.
PrincipalPlane principal_plane(std::span<const glm::dvec3> points, const glm::dvec3& along, const glm::dvec3& up);

/// Projection on the plane, moved and scaled (alike in u and v) into 0..1.
std::vector<glm::dvec2> plane_uv(std::span<const glm::dvec3> points, const PrincipalPlane& plane);

}  // namespace witherfield::leaf
