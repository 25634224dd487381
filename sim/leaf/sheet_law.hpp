// Plane stress of a thin sheet that gives way to compression.
//
// A sheet under compression folds into wrinkles, the finer the thinner it is. Wrinkles below the size of the triangles leave
// only a small share of the stiffness (tension-field theory: Reissner 1938; Pipkin 1986, the relaxed energy):
//   W = Y / 2 [ nu p(tr e) + (1 - nu) (p(e_1) + p(e_2)) ],   p(x) = x^2 for x > 0, c x^2 for x < 0
// with the principal strains e_i, Y = E h / (1 - nu^2). c = 1 is the linear isotropic law. Convex, once continuously differentiable.
#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace witherfield::leaf {

struct SheetResponse {
  double energy;       ///< W
  glm::dvec3 force;    ///< dW / d(e11, e22, 2 e12)
  glm::dmat3 tangent;  ///< second derivatives, positive semi-definite
};

/// @param strain (e11, e22, 2 e12); @param stiffness Y; @param poisson 0..0.5; @param compression c, 0..1.
SheetResponse sheet_response(const glm::dvec3& strain, double stiffness, double poisson, double compression);

}  // namespace witherfield::leaf
