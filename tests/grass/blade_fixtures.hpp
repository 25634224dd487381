// Blades made by hand, with every per-node array filled: fixtures of the texel tests.
#pragma once
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <random>
#include <vector>

#include "sim/core/texel_grid.hpp"
#include "sim/grass/blades.hpp"

namespace witherfield::grass::fixtures {

/// One blade: a chain of segments in a vertical plane. lean at the foot, lean + curl at the tip (radians).
struct BladeShape {
  glm::dvec3 root_m{0.1, 0.1, 0.0};
  double length_m = 0.1;
  double half_width_m = 0.002;
  double azimuth = 0;  ///< of the lean, from +x
  double lean = 0, curl = 0;
  double turn = 0,
         twist = 0;  ///< of the side vector about the tangent: at the foot, and added toward the tip
  double fold = 0;
  bool pointed = false;  ///< width falls linearly to 0 at the tip
};

/// Material: linear in the arc a, different for each blade b, so that tests know what to expect.
inline float water_at(int b, double a) {
  return float(0.9 - 0.5 * a - 0.01 * (b % 10));
}
inline float chlorophyll_at(int b, double a) {
  return float(0.8 - 0.6 * a + 0.01 * (b % 10));
}
inline constexpr float kStrainVein = -0.10f, kStrainMesophyll = -0.60f;

inline BladeState make_state(BladeForm form, int segments, const std::vector<BladeShape>& shapes) {
  BladeState s;
  s.form = form;
  s.segments = segments;
  s.chlorophyll_fresh_ug_cm2 = 40;
  int b = 0;
  for (const BladeShape& shape : shapes) {
    const glm::dvec3 ahead(std::cos(shape.azimuth), std::sin(shape.azimuth), 0), across(-ahead.y, ahead.x, 0);
    glm::dvec3 p = shape.root_m;
    for (int k = 0; k <= segments; ++k) {
      const double a = double(k) / segments, lean = shape.lean + shape.curl * a,
                   turn = shape.turn + shape.twist * a;
      const glm::dvec3 tangent = std::sin(lean) * ahead + std::cos(lean) * glm::dvec3(0, 0, 1);
      const glm::dvec3 side = std::cos(turn) * across + std::sin(turn) * glm::cross(tangent, across);
      s.node_m.push_back(p);
      s.velocity_m_day.push_back({0, 0, 0});
      s.tangent.push_back(tangent);
      s.side.push_back(side);
      s.half_width_m.push_back(float(shape.half_width_m * (shape.pointed ? 1 - a : 1)));
      s.thickness_m.push_back(0.0002f);
      s.fold_rad.push_back(float(shape.fold));
      s.water.push_back(water_at(b, a));
      s.chlorophyll.push_back(chlorophyll_at(b, a));
      s.stress_vein_MPa.push_back(float(-2 - a));
      s.stress_mesophyll_MPa.push_back(float(1 + 0.5 * a));
      s.strain_vein.push_back(kStrainVein);
      s.strain_mesophyll.push_back(kStrainMesophyll);
      s.diffuse.push_back({float(0.1 + 0.3 * a), float(0.3 - 0.1 * a), 0.05f});
      s.specular.push_back(0.04f);
      const double next = shape.lean + shape.curl * (a + 0.5 / segments);
      p += shape.length_m / segments * (std::sin(next) * ahead + std::cos(next) * glm::dvec3(0, 0, 1));
    }
    ++b;
  }
  return s;
}

/// A vertical flat strip across x: side = +y turned to +x, so that it lies in the plane y = const.
inline BladeShape strip_across_x(glm::dvec3 root_m, double length_m, double half_width_m) {
  BladeShape shape;
  shape.root_m = root_m;
  shape.length_m = length_m;
  shape.half_width_m = half_width_m;
  shape.azimuth = -1.5707963267948966;  // lean toward -y: the side is then +x
  return shape;
}

/// Blades of all kinds all over a tile: leaning, curled, twisted, folded, pointed.
inline std::vector<BladeShape> meadow(int count, double tile_m, unsigned seed = 7) {
  std::mt19937 bits(seed);
  const auto uniform = [&bits](double lo, double hi) {
    return lo + (hi - lo) * (double(bits()) / 4294967296.0);
  };
  std::vector<BladeShape> shapes(static_cast<std::size_t>(count));
  for (BladeShape& s : shapes) {
    s.root_m = {uniform(0, tile_m), uniform(0, tile_m), 0};
    s.length_m = uniform(0.07, 0.15);
    s.half_width_m = uniform(0.00125, 0.00225);
    s.azimuth = uniform(0, 6.283185307179586);
    s.lean = uniform(0, 0.5), s.curl = uniform(0.1, 1.2);
    s.turn = uniform(-0.5, 0.5), s.twist = uniform(-0.8, 0.8);
    s.fold = uniform(0.2, 0.55);
    s.pointed = true;
  }
  return shapes;
}

/// Bricks and every channel of every brick equal, bit for bit.
inline bool same_bits(const TexelGrid& a, const TexelGrid& b) {
  if (!(a.shape() == b.shape()) || a.brick_count() != b.brick_count()) return false;
  for (int i = 0; i < a.brick_count(); ++i)
    if (a.brick_cell(i) != b.brick_cell(i) ||
        std::memcmp(a.channel(i, TexelChannel::density), b.channel(i, TexelChannel::density),
                    sizeof(float) * kTexelChannels * TexelGrid::kVoxels) != 0)
      return false;
  return true;
}

/// Calls visit(i, j, k) for every voxel with density > 0.
template <class Visit>
void for_occupied(const TexelGrid& grid, const Visit& visit) {
  for (int b = 0; b < grid.brick_count(); ++b) {
    const glm::ivec3 base = grid.brick_base(b);
    for (int v = 0; v < TexelGrid::kVoxels; ++v)
      if (grid.channel(b, TexelChannel::density)[v] > 0)
        visit(base.x + (v & 3), base.y + ((v >> 2) & 3), base.z + (v >> 4));
  }
}

inline glm::dvec3 vector_at(const TexelGrid& g, int i, int j, int k, TexelChannel first) {
  const auto next = [first](int n) { return TexelChannel(int(first) + n); };
  return {g.at(i, j, k, first), g.at(i, j, k, next(1)), g.at(i, j, k, next(2))};
}

/// Largest difference of density between two grids of one shape.
inline double density_difference(const TexelGrid& a, const TexelGrid& b) {
  double worst = 0;
  const auto compare = [&](int i, int j, int k) {
    worst = std::max(worst, std::abs(double(a.at(i, j, k, TexelChannel::density)) -
                                     double(b.at(i, j, k, TexelChannel::density))));
  };
  for_occupied(a, compare);
  for_occupied(b, compare);
  return worst;
}

}  // namespace witherfield::grass::fixtures
