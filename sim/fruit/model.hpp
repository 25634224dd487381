// A crop's model: templates that are refined once, and the organs of any moment.
#pragma once
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "sim/fruit/options.hpp"
#include "sim/fruit/organ.hpp"
#include "sim/fruit/ripening.hpp"
#include "sim/fruit/shapes.hpp"

namespace witherfield::fruit {

/// Where an organ sits: p -> axes * p + origin.
struct Frame {
  glm::dmat3 axes{1.0};
  glm::dvec3 origin{0};
  glm::dvec3 operator()(const glm::dvec3& p) const { return axes * p + origin; }
};
Frame operator*(const Frame& outer, const Frame& inner);
glm::dmat3 rotation_x(double rad);
glm::dmat3 rotation_y(double rad);
glm::dmat3 rotation_z(double rad);
inline double radians(double deg) {
  return deg * 3.14159265358979323846 / 180;
}

class FruitModel {
 public:
  virtual ~FruitModel() = default;
  /// The organs at wd. @pre 0 <= wd <= 1. Same number and order at any wd.
  virtual Fruit at(double wd) const = 0;
  /// The kernel alone at wd = 1, axis along z from the origin: index of its template and control points.
  virtual Organ kernel_at_rest() const = 0;
  virtual int spikelets() const { return 0; }
  virtual int rows() const { return 0; }

  const std::vector<ShapeMesh>& shapes() const { return shapes_; }
  const std::vector<Refinement>& refinements() const { return refinements_; }

 protected:
  explicit FruitModel(const FruitOptions& options);
  /// Refines the shape's topology; `unit` scales it so that its refined form (at options.steps, at least 2)
  /// is 1 x 1 x 1.
  int add_shape(ShapeMesh shape, bool unit);
  Fruit empty_fruit() const { return {&shapes_, &refinements_, {}}; }
  const std::vector<glm::dvec3>& control_of(int shape) const {
    return shapes_[std::size_t(shape)].mesh.position_m;
  }

  const FruitOptions options_;
  const RipeningCourse course_;

 private:
  std::vector<ShapeMesh> shapes_;
  std::vector<Refinement> refinements_;
};

std::unique_ptr<FruitModel> make_wheat_ear(const FruitOptions& options);
std::unique_ptr<FruitModel> make_maize_ear(const FruitOptions& options);
std::unique_ptr<FruitModel> make_planted_fruit(const FruitOptions& options);
std::unique_ptr<FruitModel> make_mesh_fruit(const FruitOptions& options);
/// By options.crop. @throws InvalidInput.
std::unique_ptr<FruitModel> make_model(const FruitOptions& options);

}  // namespace witherfield::fruit
