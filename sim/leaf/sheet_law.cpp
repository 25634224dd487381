#include "sim/leaf/sheet_law.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace witherfield::leaf {

SheetResponse sheet_response(const glm::dvec3& e, double stiffness, double nu, double compression) {
  const double mean = (e.x + e.y) / 2, half = (e.x - e.y) / 2, shear = e.z / 2, r = std::hypot(half, shear);
  const double e1 = mean + r, e2 = mean - r, trace = e.x + e.y;
  const auto weight = [&](double x) { return x >= 0 ? 1.0 : compression; };
  // Principal direction 1 at angle a: cos 2a = half / r, sin 2a = shear / r.
  const double c2 = r > 0 ? half / r : 1.0, s2 = r > 0 ? shear / r : 0.0;
  const glm::dvec3 along1((1 + c2) / 2, (1 - c2) / 2, s2 / 2), along2((1 - c2) / 2, (1 + c2) / 2, -s2 / 2);
  const glm::dvec3 across(-s2 / 2, s2 / 2, c2 / 2), all(1, 1, 0);
  const double w1 = weight(e1), w2 = weight(e2), wt = weight(trace);
  // Turning of the principal directions: (f'(e1) - f'(e2)) / (e1 - e2), between w2 and w1 as f' rises.
  const double turn = r > 1e-14 ? (w1 * e1 - w2 * e2) / (2 * r) : (w1 + w2) / 2;
  SheetResponse out;
  out.energy = 0.5 * stiffness * (nu * wt * trace * trace + (1 - nu) * (w1 * e1 * e1 + w2 * e2 * e2));
  out.force = stiffness * (nu * wt * trace * all + (1 - nu) * (w1 * e1 * along1 + w2 * e2 * along2));
  out.tangent = stiffness * (nu * wt * glm::outerProduct(all, all) +
                             (1 - nu) * (w1 * glm::outerProduct(along1, along1) + w2 * glm::outerProduct(along2, along2) +
                                         2 * turn * glm::outerProduct(across, across)));
  return out;
}

}  // namespace witherfield::leaf
