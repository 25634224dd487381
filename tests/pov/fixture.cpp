#include "tests/pov/fixture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "sim/core/random.hpp"

namespace witherfield::pov::fixture {
namespace {

constexpr int kNodes = 17;
using C = TexelChannel;

/// What is added up in a voxel while blades are sampled.
struct Sum {
  double density = 0, chlorophyll = 0;
  glm::dvec3 normal{0.0}, tangent{0.0}, diffuse{0.0};
};

}  // namespace

BladeRibbons blades(int count, double tile_m, double dry, std::uint64_t seed) {
  BladeRibbons b;
  b.nodes_per_blade = kNodes;
  for (int i = 0; i < count; ++i) {
    Random r(seed, Stream::test, std::uint64_t(i));
    const double own = std::clamp(dry * 1.3 - 0.15 + 0.35 * (r.uniform() - 0.5), 0.0, 1.0);
    const double length = r.uniform(0.07, 0.15) * (1 - 0.05 * own),
                 width = r.uniform(0.0025, 0.0045) * (1 - 0.25 * own);
    const double azimuth = r.uniform(0, 6.2831853), twist = 0.6 * r.normal();
    const double lean = 0.05 + 0.2 * std::abs(r.normal()), u = r.uniform();
    const double curl = 0.2 + 0.9 * u * u + own * r.uniform(0.5, 1.5), fold = r.uniform(0.2, 0.55);
    glm::dvec3 p{r.uniform() * tile_m, r.uniform() * tile_m, 0};
    const glm::dvec3 out{std::cos(azimuth), std::sin(azimuth), 0}, up{0, 0, 1};
    const glm::vec3 green(0.060f, 0.080f, 0.028f), straw(0.30f, 0.231f, 0.122f);
    for (int k = 0; k < kNodes; ++k) {
      const double s = double(k) / (kNodes - 1);
      const double a = std::min(lean + curl * std::pow(s, 1.6), 2.6);
      const glm::dvec3 t = out * std::sin(a) + up * std::cos(a);
      const glm::dvec3 across = glm::normalize(glm::cross(out, up)), face = glm::cross(across, t);
      const double d = std::clamp(own + 0.25 * (s - 0.5), 0.0, 1.0);
      b.center_m.push_back(p);
      b.tangent.push_back(glm::vec3(t));
      b.side.push_back(glm::vec3(across * std::cos(twist * s) + face * std::sin(twist * s)));
      b.half_width_m.push_back(float(0.5 * width * std::min(1.0, 0.55 + 5 * s) * std::pow(1 - s, 0.55)));
      b.fold_rad.push_back(float(fold));
      b.thickness_m.push_back(0.00025f);
      b.diffuse.push_back(glm::mix(green, straw, float(d)) * float(r.uniform(0.97, 1.03)));
      b.water.push_back(float(1 - d));
      b.chlorophyll_ug_cm2.push_back(float(44 * (1 - d)));
      p += t * (length / (kNodes - 1));
      p.z = std::max(p.z, 0.0005);
    }
  }
  return b;
}

GridShape shape(double tile_m, int resolution, int margin) {
  GridShape s;
  s.spacing_m = tile_m / resolution;
  s.margin = margin;
  s.nx = s.ny = resolution + 2 * margin;
  s.nz = resolution;
  s.origin_m = {-margin * s.spacing_m, -margin * s.spacing_m, 0};
  return s;
}

TexelGrid texel(const BladeRibbons& b, const GridShape& s) {
  std::map<std::int64_t, Sum> voxels;
  for (int blade = 0; blade < b.blade_count(); ++blade)
    for (int k = 0; k + 1 < b.nodes_per_blade; ++k) {
      const std::size_t i = std::size_t(blade) * b.nodes_per_blade + k, j = i + 1;
      const double length = glm::length(b.center_m[j] - b.center_m[i]);
      const int along = std::max(2, int(length / s.spacing_m * 4)),
                across = std::max(2, int(2 * b.half_width_m[i] / s.spacing_m * 4));
      for (int u = 0; u < along; ++u)
        for (int v = 0; v < across; ++v) {
          const double f = (u + 0.5) / along, x = 2 * (v + 0.5) / across - 1;
          const double half = b.half_width_m[i] * (1 - f) + b.half_width_m[j] * f;
          const glm::dvec3 side(b.side[i]), t(b.tangent[i]), face = glm::cross(side, t);
          const double c = std::cos(b.fold_rad[i]), n = std::sin(b.fold_rad[i]);
          const glm::dvec3 p =
              glm::mix(b.center_m[i], b.center_m[j], f) + half * (x * c * side + std::abs(x) * n * face);
          const glm::ivec3 q((p - s.origin_m) / s.spacing_m);
          if (q.x < 0 || q.y < 0 || q.x >= s.nx || q.y >= s.ny || q.z < 0 || q.z >= s.nz) continue;
          const double area = length / along * 2 * half / across / (s.spacing_m * s.spacing_m);
          Sum& sum = voxels[(std::int64_t(q.z) * s.ny + q.y) * s.nx + q.x];
          sum.density += area;
          sum.chlorophyll += area * b.chlorophyll_ug_cm2[i];
          sum.diffuse += area * glm::dvec3(b.diffuse[i]);
          sum.tangent += area * (t.z < 0 ? -t : t);
          const glm::dvec3 facet = face * c - side * (x < 0 ? -n : n);
          sum.normal += area * (glm::dot(facet, sum.normal) < 0 ? -facet : facet);
        }
    }
  std::map<int, int> cells;
  TexelGrid g(s);
  for (const auto& [index, sum] : voxels) {
    const int x = int(index % s.nx), y = int(index / s.nx % s.ny),
              z = int(index / (std::int64_t(s.nx) * s.ny));
    cells[((z / 4) * g.bricks_y() + y / 4) * g.bricks_x() + x / 4] = 0;
  }
  std::vector<int> list;
  for (const auto& c : cells) list.push_back(c.first);
  g.reset_bricks(list);
  for (const auto& [index, sum] : voxels) {
    const int x = int(index % s.nx), y = int(index / s.nx % s.ny),
              z = int(index / (std::int64_t(s.nx) * s.ny));
    const int brick = g.brick_at(((z / 4) * g.bricks_y() + y / 4) * g.bricks_x() + x / 4),
              v = ((z % 4) * 4 + y % 4) * 4 + x % 4;
    const auto put = [&](C c, double value) { g.channel(brick, c)[v] = float(value); };
    const glm::dvec3 n = glm::normalize(sum.normal + glm::dvec3(1e-12)),
                     t = glm::normalize(sum.tangent + glm::dvec3(1e-12));
    put(C::density, sum.density);
    put(C::chlorophyll_ug_cm2, sum.chlorophyll / sum.density);
    put(C::specular, 0.04);
    for (int k = 0; k < 3; ++k) {
      put(C(int(C::normal_x) + k), n[k]);
      put(C(int(C::tangent_x) + k), t[k]);
      put(C(int(C::diffuse_r) + k), sum.diffuse[k] / sum.density);
    }
  }
  return g;
}

TexelGrid turned(const TexelGrid& g, int quarter_turns, bool mirrored) {
  const GridShape& s = g.shape();
  TexelGrid out(s);
  std::vector<int> all;
  for (int i = 0; i < g.bricks_x() * g.bricks_y() * g.bricks_z(); ++i) all.push_back(i);
  out.reset_bricks(all);
  const auto direction = [&](glm::vec3 d) {
    if (mirrored) d.x = -d.x;
    for (int q = 0; q < quarter_turns; ++q) d = {-d.y, d.x, d.z};
    return d;
  };
  for (int k = 0; k < s.nz; ++k)
    for (int j = 0; j < s.ny; ++j)
      for (int i = 0; i < s.nx; ++i) {
        if (!(g.at(i, j, k, C::density) > 0)) continue;
        int x = mirrored ? s.nx - 1 - i : i, y = j;
        for (int q = 0; q < quarter_turns; ++q) {
          const int from = x;
          x = s.nx - 1 - y;
          y = from;
        }
        const int brick = out.brick_at(((k / 4) * g.bricks_y() + y / 4) * g.bricks_x() + x / 4),
                  v = ((k % 4) * 4 + y % 4) * 4 + x % 4;
        for (int c = 0; c < kTexelChannels; ++c) out.channel(brick, C(c))[v] = g.at(i, j, k, C(c));
        for (C first : {C::normal_x, C::tangent_x}) {
          const int c = int(first);
          const glm::vec3 d =
              direction({g.at(i, j, k, first), g.at(i, j, k, C(c + 1)), g.at(i, j, k, C(c + 2))});
          for (int a = 0; a < 3; ++a) out.channel(brick, C(c + a))[v] = d[a];
        }
      }
  return out;
}

TexelGrid uniform_slab(const GridShape& s, int layers, float density) {
  TexelGrid g(s);
  std::vector<int> cells;
  for (int i = 0; i < g.bricks_x() * g.bricks_y() * (layers / 4); ++i) cells.push_back(i);
  g.reset_bricks(cells);
  for (int b = 0; b < g.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      g.channel(b, C::density)[v] = density;
      g.channel(b, C::normal_x)[v] = g.channel(b, C::tangent_z)[v] = 1;
      for (C c : {C::diffuse_r, C::diffuse_g, C::diffuse_b}) g.channel(b, c)[v] = 0.2f;
    }
  return g;
}

Placement level_placement(double tile_m, int cells) {
  Placement p;
  p.tile_m = tile_m;
  p.cells_x = p.cells_y = cells;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      TexelInstance t;
      t.cell_i = i;
      t.cell_j = j;
      t.origin_m = {i * tile_m, j * tile_m, 0};
      p.instances.push_back(t);
    }
  return p;
}

}  // namespace witherfield::pov::fixture
