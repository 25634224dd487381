// The point-based structure of a texel (Jiao et al. 2010, sec. 2.3): one record a point, structure of arrays.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace witherfield {

struct PointSet {
  // --- geometry and dynamics
  std::vector<glm::dvec3> position_m;
  std::vector<glm::vec3> velocity_m_s;
  std::vector<double> mass_kg;       ///< grows when points merge; weight of a point = mass / point_mass_kg
  double point_mass_kg = 0.0;        ///< mass of one unmerged point (all equal at the start)
  double radius_m = 0.0;             ///< the same for all points
  double proportion = 6.0;           ///< points per unit of density
  // --- frame
  std::vector<glm::vec3> normal;     ///< unit; zero on a cone's axis
  std::vector<glm::vec3> tangent;    ///< unit, axial
  // --- where on the plant
  std::vector<std::int32_t> blade_id;
  std::vector<float> arc;            ///< 0 root .. 1 tip of the blade
  std::vector<glm::vec3> offset;     ///< from the blade's centre line, in its frame at wd = 0 (side, normal, tangent), metres
  std::vector<glm::vec3> normal_local;  ///< the normal in that frame; unit, or zero
  std::vector<std::uint8_t> tissue;  ///< 1 vein, 2 mesophyll
  // --- material
  std::vector<float> water, chlorophyll_ug_cm2, stress_vein_MPa, stress_mesophyll_MPa, strain_shrink, specular;
  std::vector<glm::vec3> diffuse;    ///< linear sRGB

  std::size_t size() const { return position_m.size(); }
  void resize(std::size_t n) {
    position_m.resize(n); velocity_m_s.resize(n); mass_kg.resize(n); normal.resize(n); tangent.resize(n);
    blade_id.resize(n); arc.resize(n); offset.resize(n); normal_local.resize(n); tissue.resize(n);
    water.resize(n); chlorophyll_ug_cm2.resize(n); stress_vein_MPa.resize(n); stress_mesophyll_MPa.resize(n);
    strain_shrink.resize(n); specular.resize(n); diffuse.resize(n);
  }
};

}  // namespace witherfield
