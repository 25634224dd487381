#include "sim/terrain/terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "sim/terrain/dem_gdal.hpp"
#include "sim/terrain/grid_surface.hpp"
#include "sim/terrain/mesh_surface.hpp"
#include "sim/terrain/terrain_data.hpp"
#include "sim/terrain/terrain_mesh_input.hpp"

namespace witherfield::terrain {
namespace {

constexpr double kWidest = 1e7;         // m: a quarter of a meridian
constexpr double kSmallestCrop = 1e-6;  // of the width or height
constexpr int kMostMeshCells = 10000;   // along a side

void validate(const TerrainOptions& o) {
  if (o.dem.empty() && o.mesh.empty())
    throw InvalidInput("terrain.dem, terrain.mesh: neither is given; exactly one is needed");
  if (!o.dem.empty() && !o.mesh.empty())
    throw InvalidInput(fmt::format(
        "terrain.dem ('{}') and terrain.mesh ('{}') are both given; exactly one is needed", o.dem, o.mesh));
  const double* c = o.crop;
  for (int k = 0; k < 4; ++k)
    if (!(c[k] >= 0 && c[k] <= 1))
      throw InvalidInput(
          fmt::format("terrain.crop: value {} is {}; fractions from 0 to 1 are expected", k + 1, c[k]));
  if (c[2] - c[0] < kSmallestCrop || c[3] - c[1] < kSmallestCrop)
    throw InvalidInput(fmt::format(
        "terrain.crop: [{}, {}, {}, {}] is empty; [x0, y0, x1, y1] with x0 < x1 and y0 < y1 is expected",
        c[0], c[1], c[2], c[3]));
  if (!(o.width_m >= 0 && o.width_m <= kWidest))
    throw InvalidInput(
        fmt::format("terrain.width_m is {}; 0 (true size) to {} m is expected", o.width_m, kWidest));
  if (!(o.vertical_exaggeration >= 0.01 && o.vertical_exaggeration <= 100))
    throw InvalidInput(
        fmt::format("terrain.vertical_exaggeration is {}; 0.01 to 100 is expected", o.vertical_exaggeration));
}

}  // namespace

Terrain load_terrain(const TerrainOptions& options) {
  validate(options);
  auto data = std::make_shared<Terrain::Data>();
  if (!options.dem.empty())
    data->surface = std::make_unique<GridSurface>(load_dem(options));
  else
    data->surface =
        std::make_unique<MeshSurface>(read_terrain_mesh(options.mesh), options.crop, options.mesh);
  const double true_width_m = data->surface->extent().width_m;
  data->horizontal = options.width_m > 0 ? options.width_m / true_width_m : 1.0;
  data->vertical = data->horizontal * options.vertical_exaggeration;
  return Terrain(std::move(data));
}

double Terrain::width_m() const {
  return data_->surface->extent().width_m * data_->horizontal;
}
double Terrain::depth_m() const {
  return data_->surface->extent().depth_m * data_->horizontal;
}
double Terrain::cell_m() const {
  return data_->surface->extent().cell_m * data_->horizontal;
}
double Terrain::horizontal_scale() const {
  return data_->horizontal;
}

double Terrain::max_height_m() const {
  return (data_->surface->extent().highest_m - data_->surface->extent().lowest_m) * data_->vertical;
}

double Terrain::true_elevation_m(double x_m, double y_m) const {
  return data_->surface->elevation_m(x_m / data_->horizontal, y_m / data_->horizontal);
}

double Terrain::height(double x_m, double y_m) const {
  // The lowest value is known within 1e-7 of the relief: what is left below it is rounding.
  return std::max(0.0, (true_elevation_m(x_m, y_m) - data_->surface->extent().lowest_m) * data_->vertical);
}

glm::dvec3 Terrain::normal(double x_m, double y_m) const {
  const glm::dvec2 slope = data_->surface->gradient(x_m / data_->horizontal, y_m / data_->horizontal) *
                           (data_->vertical / data_->horizontal);
  return glm::normalize(glm::dvec3(-slope.x, -slope.y, 1.0));
}

TriMesh terrain_mesh(const Terrain& terrain, int cells_x, int cells_y) {
  for (const int cells : {cells_x, cells_y})
    if (cells < 1 || cells > kMostMeshCells)
      throw InvalidInput(fmt::format("terrain_mesh: {} x {} cells; 1 to {} a side are expected", cells_x,
                                     cells_y, kMostMeshCells));
  const std::size_t nx = std::size_t(cells_x) + 1, ny = std::size_t(cells_y) + 1;
  std::vector<glm::dvec3> point(nx * ny), normal(nx * ny);
  parallel_for(ny, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const double x = terrain.width_m() * double(i) / cells_x, y = terrain.depth_m() * double(j) / cells_y;
        point[j * nx + i] = {x, y, terrain.height(x, y)};
        normal[j * nx + i] = terrain.normal(x, y);
      }
  });
  TriMesh mesh;
  mesh.reserve(nx * ny, 3 * nx * ny, 2 * nx * ny);
  for (std::size_t k = 0; k < point.size(); ++k) {
    const auto v = mesh.add_vertex({point[k].x, point[k].y, point[k].z});
    mesh.set_normal(v, {normal[k].x, normal[k].y, normal[k].z});
  }
  for (std::size_t j = 0; j + 1 < ny; ++j)
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      const std::size_t k00 = j * nx + i, k10 = k00 + 1, k01 = k00 + nx, k11 = k01 + 1;
      const TriMesh::VertexHandle a{int(k00)}, b{int(k10)}, c{int(k11)}, d{int(k01)};
      // The flatter diagonal follows ridges and valleys instead of crossing them.
      if (std::abs(point[k00].z - point[k11].z) <= std::abs(point[k10].z - point[k01].z)) {
        mesh.add_face(a, b, c);
        mesh.add_face(a, c, d);
      } else {
        mesh.add_face(a, b, d);
        mesh.add_face(b, c, d);
      }
    }
  mesh.update_face_normals();
  return mesh;
}

}  // namespace witherfield::terrain
