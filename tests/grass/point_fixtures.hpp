// Points made by hand: fixtures of the tests of points, merging and splatting.
#pragma once
#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "sim/core/point_set.hpp"
#include "sim/core/random.hpp"
#include "sim/grass/points.hpp"
#include "sim/grass/voxelize.hpp"
#include "tests/grass/blade_fixtures.hpp"

namespace witherfield::grass::fixtures {

/// n points at rest, unit mass, tangent z, normal x.
inline PointSet plain_points(std::size_t n) {
  PointSet p;
  p.resize(n);
  p.point_mass_kg = 1;
  p.proportion = 6;
  p.radius_m = 0.001;
  std::fill(p.mass_kg.begin(), p.mass_kg.end(), 1.0);
  std::fill(p.tangent.begin(), p.tangent.end(), glm::vec3(0, 0, 1));
  std::fill(p.normal.begin(), p.normal.end(), glm::vec3(1, 0, 0));
  std::fill(p.normal_local.begin(), p.normal_local.end(), glm::vec3(0, 1, 0));
  std::fill(p.tissue.begin(), p.tissue.end(), std::uint8_t(2));
  return p;
}

inline glm::vec3 random_direction(Random& random) {
  const glm::dvec3 v(random.normal(), random.normal(), random.normal());
  return glm::vec3(glm::normalize(v));
}

/// n points with random everything in the box [lo, hi), on `blades` blades.
inline PointSet random_points(std::size_t n, const glm::dvec3& lo, const glm::dvec3& hi, int blades = 5,
                              std::uint64_t seed = 11) {
  PointSet p = plain_points(n);
  for (std::size_t i = 0; i < n; ++i) {
    Random r(seed, Stream::test, i);
    for (int a = 0; a < 3; ++a) p.position_m[i][a] = r.uniform(lo[a], hi[a]);
    p.velocity_m_s[i] = random_direction(r);
    p.mass_kg[i] = r.uniform(0.5, 3);
    p.tangent[i] = random_direction(r), p.normal[i] = random_direction(r),
    p.normal_local[i] = random_direction(r);
    p.blade_id[i] = std::int32_t(r.uniform() * blades);
    p.tissue[i] = std::uint8_t(1 + (r.bits() & 1));
    p.arc[i] = float(r.uniform()), p.water[i] = float(r.uniform()), p.specular[i] = float(r.uniform());
    p.chlorophyll_ug_cm2[i] = float(40 * r.uniform());
    p.stress_vein_MPa[i] = float(-r.uniform()), p.stress_mesophyll_MPa[i] = float(r.uniform());
    p.strain_shrink[i] = float(-0.5 * r.uniform());
    p.diffuse[i] = {float(r.uniform()), float(r.uniform()), float(r.uniform())};
    p.offset[i] = 0.001f * random_direction(r);
  }
  return p;
}

/// Points scattered about the blades of a state, within a millimetre of the centre line, with the arc known
/// roughly.
inline PointSet points_on(const BladeState& state, int per_blade) {
  PointSet p = plain_points(std::size_t(state.blade_count() * per_blade));
  for (std::size_t i = 0; i < p.size(); ++i) {
    Random r(3, Stream::test, i);
    const int b = int(i) / per_blade;
    const double s = r.uniform() * state.segments;
    const std::size_t node = std::size_t(b * state.nodes_per_blade() + std::min(int(s), state.segments - 1));
    const glm::dvec3 centre = glm::mix(state.node_m[node], state.node_m[node + 1], s - std::floor(s));
    p.position_m[i] = centre + 0.001 * r.uniform() * glm::dvec3(random_direction(r));
    p.position_m[i].z = std::max(p.position_m[i].z, 0.0);
    p.blade_id[i] = b;
    p.tissue[i] = std::uint8_t(1 + i % 2);
    p.arc[i] = float(s / state.segments);
    p.normal[i] = random_direction(r);
  }
  return p;
}

/// By looking at every segment.
inline double distance_to_blade(const BladeState& state, int blade, const glm::dvec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < state.segments; ++k) {
    const std::size_t n = std::size_t(blade * state.nodes_per_blade() + k);
    const glm::dvec3 a = state.node_m[n], d = state.node_m[n + 1] - a;
    const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
    best = std::min(best, glm::length(p - (a + d * t)));
  }
  return best;
}

/// A small texel with real blades in it.
inline TexelGrid meadow_texel() {
  const BladeState state = make_state(BladeForm::ribbon, 16, meadow(40, 0.1));
  return voxelize(state, {128, 128, 128, glm::dvec3(-0.0125, -0.0125, 0), 0.1 / 96, 16}, 0.18);
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const PointSet& a, const PointSet& b) {
  return same_bytes(a.position_m, b.position_m) && same_bytes(a.velocity_m_s, b.velocity_m_s) &&
         same_bytes(a.mass_kg, b.mass_kg) && same_bytes(a.normal, b.normal) &&
         same_bytes(a.tangent, b.tangent) && same_bytes(a.blade_id, b.blade_id) && same_bytes(a.arc, b.arc) &&
         same_bytes(a.offset, b.offset) && same_bytes(a.normal_local, b.normal_local) &&
         same_bytes(a.tissue, b.tissue) && same_bytes(a.water, b.water) &&
         same_bytes(a.chlorophyll_ug_cm2, b.chlorophyll_ug_cm2) &&
         same_bytes(a.stress_vein_MPa, b.stress_vein_MPa) &&
         same_bytes(a.stress_mesophyll_MPa, b.stress_mesophyll_MPa) &&
         same_bytes(a.strain_shrink, b.strain_shrink) && same_bytes(a.specular, b.specular) &&
         same_bytes(a.diffuse, b.diffuse);
}

}  // namespace witherfield::grass::fixtures
