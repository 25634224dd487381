#include "sim/fruit/model.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"

namespace witherfield::fruit {

Frame operator*(const Frame& outer, const Frame& inner) {
  return {outer.axes * inner.axes, outer.axes * inner.origin + outer.origin};
}

// glm matrices are built from columns.
glm::dmat3 rotation_x(double a) {
  return {{1, 0, 0}, {0, std::cos(a), std::sin(a)}, {0, -std::sin(a), std::cos(a)}};
}
glm::dmat3 rotation_y(double a) {
  return {{std::cos(a), 0, -std::sin(a)}, {0, 1, 0}, {std::sin(a), 0, std::cos(a)}};
}
glm::dmat3 rotation_z(double a) {
  return {{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}};
}

FruitModel::FruitModel(const FruitOptions& options)
    : options_(options), course_(options.ripening, options.crop) {}

int FruitModel::add_shape(ShapeMesh shape, bool unit) {
  refinements_.emplace_back(shape.mesh, options_.scheme, options_.steps);
  if (unit) {
    // Control meshes lie outside what they control; sizes are those of the finished organ, whatever is drawn.
    if (options_.steps >= 2)
      normalise(shape, refinements_.back());
    else
      normalise(shape, Refinement(shape.mesh, options_.scheme, 2));
  }
  shapes_.push_back(std::move(shape));
  return int(shapes_.size()) - 1;
}

std::unique_ptr<FruitModel> make_model(const FruitOptions& options) {
  validate(options);
  if (options.crop == "wheat") return make_wheat_ear(options);
  if (options.crop == "maize") return make_maize_ear(options);
  if (options.crop == "planted") return make_planted_fruit(options);
  return make_mesh_fruit(options);
}

}  // namespace witherfield::fruit
