#include "cli/hill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"
#include "vis/writers.hpp"

namespace witherfield::cli {
namespace {

constexpr std::size_t kMostFacesForIntersections =
    300000;  // seconds beyond; a height field cannot intersect itself anyway

void check_tiles(const terrain::Terrain& terrain, const scene::GrassScene& scene) {
  const double tile = terrain.width_m() / scene.placement.cells_x, size = scene.grass.texel.size_m;
  if (std::abs(tile - size) <= 1e-6 * size) return;
  throw InvalidInput(
      fmt::format("terrain: {} texels over a width of {} m make tiles of {} m, but texel.size_m = {} m; the "
                  "two must be equal",
                  scene.placement.cells_x, terrain.width_m(), tile, size));
}

void raise_camera(const terrain::Terrain& terrain, Still& still) {
  Camera& c = still.camera;
  const double ground = terrain.height(c.position_m.x, c.position_m.y);
  if (c.height_above_ground_m) c.position_m.z = ground + *c.height_above_ground_m;
  const bool over_terrain = c.position_m.x >= 0 && c.position_m.x <= terrain.width_m() &&
                            c.position_m.y >= 0 && c.position_m.y <= terrain.depth_m();
  if (over_terrain && c.position_m.z <= ground)
    throw InvalidInput(
        fmt::format("still \"{}\": camera_m = [{}, {}, {}] is under ground; the terrain there is {} m high "
                    "(camera_height_above_ground_m is measured from it)",
                    still.name, c.position_m.x, c.position_m.y, c.position_m.z, ground));
}

}  // namespace

Hill make_hill(scene::GrassScene& scene) {
  Hill hill{terrain::load_terrain(*scene.terrain), {}, {}, {}};
  check_tiles(hill.terrain, scene);
  for (Still& still : scene.stills) {
    raise_camera(hill.terrain, still);
    hill.placements.push_back(
        terrain::place_texels(hill.terrain, scene.placement, still.camera.position_m, still.sun.direction()));
  }
  if (hill.placements.empty())
    hill.placements.push_back(
        terrain::place_texels(hill.terrain, scene.placement, Camera{}.position_m, Sun{}.direction()));
  // Two quads to a tile each way: finer would only show the ground through the texels, which stand on planes.
  const double step = hill.terrain.width_m() / std::clamp(2 * scene.placement.cells_x, 64, 1024);
  const auto cells = [&](double extent_m) { return std::max(1, int(std::lround(extent_m / step))); };
  hill.mesh =
      terrain::terrain_mesh(hill.terrain, cells(hill.terrain.width_m()), cells(hill.terrain.depth_m()));
  check::MeshCheckOptions options;
  options.self_intersections = hill.mesh.n_faces() <= kMostFacesForIntersections;
  hill.report = check::check_mesh(hill.mesh, options);
  return hill;
}

void write_hill(const RunFolder& folder, const Hill& hill) {
  std::vector<double> elevation;
  elevation.reserve(hill.mesh.n_vertices());
  for (const auto v : hill.mesh.vertices()) {
    const auto& p = hill.mesh.point(v);
    elevation.push_back(hill.terrain.true_elevation_m(p[0], p[1]));
  }
  vis::write_terrain_vtp(folder.path() / "terrain.vtp", hill.mesh, elevation, hill.placements.front());
}

}  // namespace witherfield::cli
