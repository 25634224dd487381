#include "pov/plan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pov/text.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

constexpr double kNearTiles = 6;       // nearer texels are merged cell by cell
constexpr double kFoldedPixels = 10;   // tiles less wide than this on the picture are folded
constexpr int kRingCells = 28;         // most texels in the ring around a placement
constexpr double kFinestPixels = 0.8;  // a finer voxel than this on the picture is not worth its memory
constexpr double kRingPixels = 1.3;    // what the ring is given

double smoothstep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

const TexelInstance& border_cell(const Placement& p, double x, double y, double x0, double y0) {
  const int i = std::clamp(int(std::floor((x - x0) / p.tile_m)), 0, p.cells_x - 1);
  const int j = std::clamp(int(std::floor((y - y0) / p.tile_m)), 0, p.cells_y - 1);
  return p.instances[std::size_t(j) * p.cells_x + i];
}

double plane_height(const TexelInstance& t, double x, double y) {
  return t.origin_m.z + t.slope_x * (x - t.origin_m.x) + t.slope_y * (y - t.origin_m.y);
}

int lod_for(const SceneInput& in, int variant, double distance_m, double pixels_per_rad, double pixels) {
  int best = 0;
  for (int l = 0; l < 4; ++l) {
    const TexelGrid* g = in.variants[std::size_t(variant)].lod[l];
    if (g && g->shape().spacing_m * pixels_per_rad / std::max(distance_m, 1e-9) <= pixels) best = l;
  }
  return best;
}

}  // namespace

Eye::Eye(const Still& still) {
  const Camera& c = still.camera;
  position_m = c.position_m;
  forward = glm::normalize(c.look_at_m - c.position_m);
  right = glm::cross(forward, glm::dvec3(0, 0, 1));
  right = glm::dot(right, right) > 1e-12 ? glm::normalize(right) : glm::dvec3(1, 0, 0);
  up = glm::cross(right, forward);
  tan_x = std::tan(c.fov_deg * std::numbers::pi / 360);
  tan_y = tan_x * still.height_px / still.width_px;
  pixels_per_rad = still.width_px / (2 * tan_x);
}

bool Eye::sees(const glm::dvec3& centre_m, double radius_m) const {
  const glm::dvec3 d = centre_m - position_m;
  const double z = glm::dot(d, forward);
  if (glm::dot(d, d) < radius_m * radius_m) return true;
  if (z < -radius_m) return false;
  const double side = std::abs(glm::dot(d, right)), height = std::abs(glm::dot(d, up));
  return side - z * tan_x <= radius_m * std::sqrt(1 + tan_x * tan_x) &&
         height - z * tan_y <= radius_m * std::sqrt(1 + tan_y * tan_y);
}

Surroundings::Surroundings(const Placement& placement) : placement_(&placement) {
  const TexelInstance& first = placement.instances.front();
  x0_ = first.origin_m.x - first.cell_i * placement.tile_m;
  y0_ = first.origin_m.y - first.cell_j * placement.tile_m;
  x1_ = x0_ + placement.cells_x * placement.tile_m;
  y1_ = y0_ + placement.cells_y * placement.tile_m;
  double low = 1e300, high = -1e300;
  for (const TexelInstance& t : placement.instances) {
    if (t.cell_i > 0 && t.cell_j > 0 && t.cell_i < placement.cells_x - 1 && t.cell_j < placement.cells_y - 1)
      continue;
    low = std::min(low, t.origin_m.z);
    high = std::max(high, t.origin_m.z);
  }
  plain_m_ = low - 0.02 * placement.tile_m;
  // At least ten tiles, and no steeper than one in four.
  reach_m_ = std::max(10 * placement.tile_m, 4 * (high - plain_m_));
  cells_ = std::min(kRingCells, int(std::ceil(reach_m_ / placement.tile_m)) + 6);
}

double Surroundings::height_m(double x, double y) const {
  const double cx = std::clamp(x, x0_, x1_), cy = std::clamp(y, y0_, y1_);
  const double edge = plane_height(border_cell(*placement_, cx, cy, x0_, y0_), cx, cy);
  return edge + (plain_m_ - edge) * smoothstep(std::hypot(x - cx, y - cy) / reach_m_);
}

StandPlan plan_stands(const SceneInput& in, const Surroundings* around, double margin_m) {
  const Placement& p = *in.placement;
  const Eye eye(in.still);
  const double tile = p.tile_m;
  StandPlan plan;
  const auto consider = [&](TexelInstance t, bool ring) {
    plan.cells[{t.cell_i, t.cell_j}] = t;
    Stand s{t, Boxing::folded, 0};
    const glm::dvec3 centre = to_world(t, tile, {tile / 2, tile / 2, tile / 4});
    s.distance_m = std::max(glm::length(centre - eye.position_m), 0.2 * tile);
    if (!eye.sees(centre, 1.1 * tile + margin_m)) return;
    const int useful =
        lod_for(in, t.variant, s.distance_m, eye.pixels_per_rad, ring ? kRingPixels : kFinestPixels);
    s.at.lod = ring ? useful : std::max(t.lod, useful);
    if (s.distance_m < kNearTiles * tile)
      s.boxing = Boxing::merged;
    else if (tile * eye.pixels_per_rad / s.distance_m > kFoldedPixels)
      s.boxing = Boxing::overhanging;
    plan.stands.push_back(s);
  };
  for (const TexelInstance& t : p.instances) consider(t, false);
  if (!around) return plan;
  const int n = around->cells();
  for (int j = -n; j < p.cells_y + n; ++j)
    for (int i = -n; i < p.cells_x + n; ++i) {
      if (i >= 0 && j >= 0 && i < p.cells_x && j < p.cells_y) continue;
      const double x = around->low_x_m() + i * tile, y = around->low_y_m() + j * tile;
      const double h00 = around->height_m(x, y), h10 = around->height_m(x + tile, y);
      const double h01 = around->height_m(x, y + tile), h11 = around->height_m(x + tile, y + tile);
      Random random(0x51, Stream::placement, (std::uint64_t(std::uint32_t(i)) << 32) | std::uint32_t(j));
      TexelInstance t = border_cell(p, x + tile / 2, y + tile / 2, around->low_x_m(), around->low_y_m());
      t.cell_i = i;
      t.cell_j = j;
      t.slope_x = (h10 - h00 + h11 - h01) / (2 * tile);
      t.slope_y = (h01 - h00 + h11 - h10) / (2 * tile);
      t.origin_m = {x, y, (h00 + h10 + h01 + h11) / 4 - (t.slope_x + t.slope_y) * tile / 2};
      t.variant = int(random.bits() % in.variants.size());
      t.quarter_turns = int(random.bits() & 3);
      t.mirrored = random.bits() & 1;
      t.height_scale = random.uniform(0.88, 1.12);
      t.sun_visibility = 1;
      consider(t, true);
    }
  return plan;
}

double box_overlap(int cell_i, int cell_j) {
  return kOverlapStep * (1 + (cell_i & 1) + 2 * (cell_j & 1));
}

TexelInstance smoothed(const StandPlan& plan, const TexelInstance& t) {
  TexelInstance mean = t;
  double weight = 2;
  mean.slope_x *= weight;
  mean.slope_y *= weight;
  mean.sun_visibility *= weight;
  for (int k = 0; k < 9; ++k) {
    const auto other = plan.cells.find({t.cell_i + k % 3 - 1, t.cell_j + k / 3 - 1});
    if (k == 4 || other == plan.cells.end()) continue;
    mean.slope_x += other->second.slope_x;
    mean.slope_y += other->second.slope_y;
    mean.sun_visibility += other->second.sun_visibility;
    weight += 1;
  }
  mean.slope_x /= weight;
  mean.slope_y /= weight;
  mean.sun_visibility /= weight;
  return mean;
}

glm::dvec3 to_local_direction(const TexelInstance& t, const glm::dvec3& world) {
  double x = world.x, y = world.y;
  for (int q = 0; q < (t.quarter_turns & 3); ++q) {
    const double turned = y;  // a quarter turn clockwise undoes one counter-clockwise
    y = -x;
    x = turned;
  }
  return {t.mirrored ? -x : x, y, world.z};
}

std::string instance_matrix(const TexelInstance& t, double tile_m, double unit) {
  const glm::dvec3 origin = to_world(t, tile_m, glm::dvec3(0.0));
  const glm::dvec3 x = to_world(t, tile_m, {1, 0, 0}) - origin, y = to_world(t, tile_m, {0, 1, 0}) - origin,
                   z = to_world(t, tile_m, {0, 0, 1}) - origin;
  Text m;
  m << "matrix<";
  for (const glm::dvec3& row : {flip(x), flip(z), flip(y)}) m << row.x << "," << row.y << "," << row.z << ",";
  const glm::dvec3 o = flip(origin, unit);
  m << o.x << "," << o.y << "," << o.z << ">";
  return m.str();
}

}  // namespace witherfield::pov
