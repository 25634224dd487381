#include "tests/vis/sample.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "sim/core/random.hpp"

namespace witherfield::vis::sample {
namespace {

struct Deposit {
  glm::ivec3 voxel;
  int blade;
  double along, across;  // 0 root .. 1 tip; -1 .. 1
  glm::dvec3 tangent, normal;
  double area_voxels;
};

/// Calls `put` for small pieces of each ribbon.
template <class Put>
void for_pieces(const GridShape& shape, int blades, Put&& put) {
  const double scale = 1 / shape.spacing_m, tile = shape.tile_m();
  for (int b = 0; b < blades; ++b) {
    Random r(7, Stream::test, static_cast<std::uint64_t>(b));
    const double heading = r.uniform(0, 2 * std::numbers::pi), length = r.uniform(0.07, 0.14) * scale;
    const double width = r.uniform(0.0028, 0.0045) * scale, lean = r.uniform(0.03, 0.3),
                 curl = r.uniform(0.1, 1.9);
    const glm::dvec3 ahead{std::cos(heading), std::sin(heading), 0},
        side{-std::sin(heading), std::cos(heading), 0};
    glm::dvec3 p = (glm::dvec3(r.uniform(0, tile), r.uniform(0, tile), 0) - shape.origin_m) * scale;
    const int steps = static_cast<int>(length * 3);
    for (int k = 0; k < steps; ++k) {
      const double t = double(k) / steps, inclination = lean + curl * t * t;
      const glm::dvec3 tangent = ahead * std::sin(inclination) + glm::dvec3(0, 0, std::cos(inclination));
      const glm::dvec3 normal = glm::cross(side, tangent);
      p += tangent * (length / steps);
      const double half = width / 2 * std::min(1.0, 1.6 * std::sqrt(1 - t));
      constexpr int kAcross = 12;
      for (int u = 0; u < kAcross; ++u) {
        const double across = (u + 0.5) / kAcross * 2 - 1;
        const glm::ivec3 v(glm::floor(p + side * (across * half)));
        if (glm::any(glm::lessThan(v, glm::ivec3(0))) || v.x >= shape.nx || v.y >= shape.ny ||
            v.z >= shape.nz)
          continue;
        put(Deposit{v, b, t, across, tangent, normal, 2 * half / kAcross * length / steps});
      }
    }
  }
}

void set_attributes(TexelGrid& grid, int brick, int v, const Deposit& d, double wd) {
  const auto set = [&](TexelChannel c, double value) {
    grid.channel(brick, c)[v] = static_cast<float>(value);
  };
  const double dry =
      std::clamp(1.3 * wd * (0.55 + 0.45 * d.along) + 0.12 * std::sin(d.blade * 2.4) * wd, 0.0, 1.0);
  const bool vein = std::abs(d.across) < 0.25;
  set(TexelChannel::water, 0.95 - 0.85 * dry);
  set(TexelChannel::chlorophyll_ug_cm2, 43.9 * (1 - dry) * (1 - 0.2 * d.along));
  set(TexelChannel::stress_vein_MPa, 6 * dry - 2.5 * d.along);
  set(TexelChannel::stress_mesophyll_MPa, -1.5 * dry + 0.4 * d.across);
  set(TexelChannel::strain_shrink, -0.6 * dry);
  set(TexelChannel::tissue, vein ? 1 : 2);
  set(TexelChannel::blade_id, d.blade + 3000);
  set(TexelChannel::arc, d.along);
  set(TexelChannel::specular, 0.04 - 0.02 * dry);
  for (int c = 0; c < 3; ++c) {
    set(static_cast<TexelChannel>(int(TexelChannel::normal_x) + c), d.normal[c]);
    set(static_cast<TexelChannel>(int(TexelChannel::tangent_x) + c), d.tangent[c]);
    const double green[] = {0.06, 0.11, 0.03}, straw[] = {0.26, 0.19, 0.10};
    set(static_cast<TexelChannel>(int(TexelChannel::diffuse_r) + c), green[c] + (straw[c] - green[c]) * dry);
  }
}

}  // namespace

TexelGrid texel(int resolution, int blades, double wd) {
  GridShape shape;
  shape.nx = shape.ny = shape.nz = resolution;
  shape.margin = resolution * 3 / 16;
  shape.spacing_m = 0.2 / (resolution - 2 * shape.margin);
  shape.origin_m = {-shape.margin * shape.spacing_m, -shape.margin * shape.spacing_m, 0};
  TexelGrid grid(shape);
  const auto cell = [&](glm::ivec3 v) {
    return ((v.z / 4) * grid.bricks_y() + v.y / 4) * grid.bricks_x() + v.x / 4;
  };
  std::set<int> cells;
  for_pieces(shape, blades, [&](const Deposit& d) { cells.insert(cell(d.voxel)); });
  grid.reset_bricks({cells.begin(), cells.end()});
  for_pieces(shape, blades, [&](const Deposit& d) {
    const int brick = grid.brick_at(cell(d.voxel)),
              v = ((d.voxel.z % 4) * 4 + d.voxel.y % 4) * 4 + d.voxel.x % 4;
    grid.channel(brick, TexelChannel::density)[v] += static_cast<float>(d.area_voxels);
    set_attributes(grid, brick, v, d, wd);
  });
  return grid;
}

VoxelBox box_of(const TexelGrid& grid) {
  const TexelGrid::Box b = grid.occupied_box();
  const glm::ivec3 n{grid.shape().nx, grid.shape().ny, grid.shape().nz};
  return {glm::max(b.lo - 2, glm::ivec3(0)), glm::min(b.hi + 2, n)};
}

PointSet points(const TexelGrid& grid) {
  PointSet p;
  p.point_mass_kg = 1e-7;
  p.radius_m = grid.shape().spacing_m / 2;
  const auto size = static_cast<std::size_t>(grid.occupied_voxels());
  p.resize(size);
  std::size_t n = 0;
  for (int b = 0; b < grid.brick_count(); ++b)
    for (int v = 0; v < TexelGrid::kVoxels; ++v) {
      const auto get = [&](TexelChannel c) { return grid.channel(b, c)[v]; };
      const auto vector = [&](TexelChannel c) {
        return glm::vec3(get(c), get(TexelChannel(int(c) + 1)), get(TexelChannel(int(c) + 2)));
      };
      if (!(get(TexelChannel::density) > 0)) continue;
      const glm::dvec3 voxel = glm::dvec3(grid.brick_base(b)) + glm::dvec3(v % 4, v / 4 % 4, v / 16) + 0.5;
      p.position_m[n] = grid.shape().origin_m + voxel * grid.shape().spacing_m;
      p.mass_kg[n] = p.point_mass_kg * p.proportion * get(TexelChannel::density);
      p.velocity_m_s[n] = {0.001f * float(n % 7), -0.002f, 0.0f};
      p.normal[n] = vector(TexelChannel::normal_x);
      p.tangent[n] = vector(TexelChannel::tangent_x);
      p.diffuse[n] = vector(TexelChannel::diffuse_r);
      p.blade_id[n] = static_cast<std::int32_t>(get(TexelChannel::blade_id));
      p.tissue[n] = static_cast<std::uint8_t>(get(TexelChannel::tissue));
      p.water[n] = get(TexelChannel::water);
      p.chlorophyll_ug_cm2[n] = get(TexelChannel::chlorophyll_ug_cm2);
      p.stress_vein_MPa[n] = get(TexelChannel::stress_vein_MPa);
      p.stress_mesophyll_MPa[n] = get(TexelChannel::stress_mesophyll_MPa);
      p.strain_shrink[n] = get(TexelChannel::strain_shrink);
      p.specular[n] = get(TexelChannel::specular);
      ++n;
    }
  return p;
}

Hill hill(int n) {
  Hill h;
  std::vector<TriMesh::VertexHandle> v;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double z =
          0.25 * n *
          std::exp(-8.0 * ((i - n / 2.0) * (i - n / 2.0) + (j - n / 2.0) * (j - n / 2.0)) / (n * n));
      v.push_back(h.mesh.add_vertex({double(i), double(j), z}));
      h.elevation_m.push_back(140 + z);
    }
  const auto at = [&](int i, int j) { return v[static_cast<std::size_t>(j * (n + 1) + i)]; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      h.mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      h.mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  h.placement.tile_m = 2;
  h.placement.cells_x = h.placement.cells_y = n / 2;
  for (int j = 0; j < n / 2; ++j)
    for (int i = 0; i < n / 2; ++i) {
      TexelInstance t;
      t.cell_i = i;
      t.cell_j = j;
      t.origin_m = {2.0 * i, 2.0 * j, 0};
      t.variant = (i + j) % 3;
      t.quarter_turns = (2 * i + j) % 4;
      t.mirrored = i % 2 == 1;
      t.lod = j % 4;
      h.placement.instances.push_back(t);
    }
  return h;
}

Folder::Folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = test ? std::string(test->test_suite_name()) + "." + test->name() : "vis";
  path_ = std::filesystem::temp_directory_path() / ("witherfield_" + name + "_" + std::to_string(::getpid()));
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace witherfield::vis::sample
