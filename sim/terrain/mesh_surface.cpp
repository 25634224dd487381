#include "sim/terrain/mesh_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/errors.hpp"
#include "sim/terrain/triangle2.hpp"

namespace witherfield::terrain {
namespace {

constexpr double kTouch = 1e-9;  // overlaps below this part of the extent are rounding
constexpr double kCovered =
    1e-6;  // part of the crop that may stay uncovered (rounding along a ragged float edge)

}  // namespace

MeshSurface::MeshSurface(const TriMesh& mesh, const double (&crop)[4], const std::string& file)
    : Surface({}) {
  glm::dvec2 lo{std::numeric_limits<double>::infinity()}, hi = -lo;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    lo = {std::min(lo.x, p[0]), std::min(lo.y, p[1])};
    hi = {std::max(hi.x, p[0]), std::max(hi.y, p[1])};
  }
  const glm::dvec2 size = hi - lo;
  if (!(size.x > 0) || !(size.y > 0))
    throw InvalidInput(fmt::format("terrain.mesh: '{}' spans {} m x {} m seen from above, which is no area",
                                   file, size.x, size.y));
  extent_.width_m = size.x * (crop[2] - crop[0]);
  extent_.depth_m = size.y * (crop[3] - crop[1]);
  take_triangles(mesh, {lo.x + crop[0] * size.x, lo.y + crop[1] * size.y}, file);
  fill_bins();
  require_no_overlap(file);
  require_covered(file);
  extent_.cell_m = std::sqrt(extent_.width_m * extent_.depth_m / double(triangles_.size()));
}

// Triangles that touch the crop. All must face the same way, up or down, and none may stand upright.
void MeshSurface::take_triangles(const TriMesh& mesh, const glm::dvec2& corner, const std::string& file) {
  double signed_area = 0;
  for (const auto f : mesh.faces()) signed_area += mesh.calc_face_normal(f)[2] * mesh.calc_face_area(f);
  const bool upward = signed_area >= 0;
  for (const auto f : mesh.faces()) {
    std::array<OpenMesh::Vec3d, 3> c;
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) c[k++] = mesh.point(v);
    if (!upward) std::swap(c[1], c[2]);
    const OpenMesh::Vec3d n = (c[1] - c[0]) % (c[2] - c[0]);
    const double size = std::max({(c[1] - c[0]).sqrnorm(), (c[2] - c[1]).sqrnorm(), (c[0] - c[2]).sqrnorm()});
    if (n.norm() <= 1e-12 * size) continue;  // no area: its neighbours cover the place
    Triangle t;
    for (k = 0; k < 3; ++k) t.p[k] = glm::dvec2(c[k][0], c[k][1]) - corner;
    if (clip_to_rectangle(t.p, extent_.width_m, extent_.depth_m).size() < 3) continue;
    if (n[2] <= 1e-9 * n.norm())
      throw InvalidInput(fmt::format(
          "terrain.mesh: '{}' is no height field: face {} (from 0) is {}, at ({}, {}, {}) m", file, f.idx(),
          n[2] < -1e-9 * n.norm() ? "overhanging" : "vertical", c[0][0], c[0][1], c[0][2]));
    t.z0 = c[0][2];
    t.slope = {-n[0] / n[2], -n[1] / n[2]};
    t.face = f.idx();
    triangles_.push_back(t);
  }
  if (triangles_.empty())
    throw InvalidInput(fmt::format("terrain.mesh: no face of '{}' lies in the crop", file));
}

std::array<int, 2> MeshSurface::bin_of(const glm::dvec2& q) const {
  return {std::clamp(int(q.x / extent_.width_m * bins_x_), 0, bins_x_ - 1),
          std::clamp(int(q.y / extent_.depth_m * bins_y_), 0, bins_y_ - 1)};
}

void MeshSurface::fill_bins() {
  const double per_metre = std::sqrt(double(triangles_.size()) / (extent_.width_m * extent_.depth_m));
  bins_x_ = std::clamp(int(extent_.width_m * per_metre), 1, 4096);
  bins_y_ = std::clamp(int(extent_.depth_m * per_metre), 1, 4096);
  const auto each_bin = [&](const Triangle& t, const auto& use) {
    const auto [x0, x1] = std::minmax({t.p[0].x, t.p[1].x, t.p[2].x});
    const auto [y0, y1] = std::minmax({t.p[0].y, t.p[1].y, t.p[2].y});
    const auto lo = bin_of({x0, y0}), hi = bin_of({x1, y1});
    for (int y = lo[1]; y <= hi[1]; ++y)
      for (int x = lo[0]; x <= hi[0]; ++x) use(std::size_t(y) * std::size_t(bins_x_) + std::size_t(x));
  };
  bin_start_.assign(std::size_t(bins_x_) * std::size_t(bins_y_) + 1, 0);
  for (const Triangle& t : triangles_) each_bin(t, [&](std::size_t b) { ++bin_start_[b + 1]; });
  for (std::size_t b = 1; b < bin_start_.size(); ++b) bin_start_[b] += bin_start_[b - 1];
  bin_triangle_.resize(std::size_t(bin_start_.back()));
  std::vector<int> next(bin_start_.begin(), bin_start_.end() - 1);
  for (std::size_t k = 0; k < triangles_.size(); ++k)
    each_bin(triangles_[k], [&](std::size_t b) { bin_triangle_[std::size_t(next[b]++)] = int(k); });
}

// With all faces upward, a mesh can still pass over itself (a spiral ramp): no two triangles may overlap seen
// from above.
void MeshSurface::require_no_overlap(const std::string& file) const {
  const double tolerance = kTouch * std::max(extent_.width_m, extent_.depth_m);
  for (std::size_t b = 0; b + 1 < bin_start_.size(); ++b)
    for (int m = bin_start_[b]; m < bin_start_[b + 1]; ++m)
      for (int n = m + 1; n < bin_start_[b + 1]; ++n) {
        const Triangle& s = triangles_[std::size_t(bin_triangle_[std::size_t(m)])];
        const Triangle& t = triangles_[std::size_t(bin_triangle_[std::size_t(n)])];
        if (overlap(s.p, t.p, tolerance))
          throw InvalidInput(
              fmt::format("terrain.mesh: '{}' is no height field: face {} overhangs face {} (from 0)", file,
                          s.face, t.face));
      }
}

void MeshSurface::require_covered(const std::string& file) {
  double covered = 0;
  extent_.lowest_m = std::numeric_limits<double>::infinity();
  extent_.highest_m = -extent_.lowest_m;
  for (const Triangle& t : triangles_) {
    const auto part = clip_to_rectangle(t.p, extent_.width_m, extent_.depth_m);
    covered += polygon_area(part);
    for (const glm::dvec2& q : part) {
      extent_.lowest_m = std::min(extent_.lowest_m, t.at(q));
      extent_.highest_m = std::max(extent_.highest_m, t.at(q));
    }
  }
  const double share = covered / (extent_.width_m * extent_.depth_m);
  if (share < 1 - kCovered)
    throw InvalidInput(
        fmt::format("terrain.mesh: '{}' covers only {:.4f} % of the rectangle used (a hole, a ragged edge, "
                    "or the file is cut "
                    "off); use terrain.crop or fill it",
                    file, 100 * share));
}

const MeshSurface::Triangle& MeshSurface::find(const glm::dvec2& q) const {
  const auto [bx, by] = bin_of(q);
  const Triangle* best = nullptr;
  double best_inside = -std::numeric_limits<double>::infinity();
  // The bin itself nearly always; rings around it only in the slivers that `kCovered` allows.
  for (int ring = 0; best == nullptr; ++ring)
    for (int y = std::max(0, by - ring); y <= std::min(bins_y_ - 1, by + ring); ++y)
      for (int x = std::max(0, bx - ring); x <= std::min(bins_x_ - 1, bx + ring); ++x) {
        const std::size_t b = std::size_t(y) * std::size_t(bins_x_) + std::size_t(x);
        for (int k = bin_start_[b]; k < bin_start_[b + 1]; ++k) {
          const Triangle& t = triangles_[std::size_t(bin_triangle_[std::size_t(k)])];
          const double inside = insideness(t.p, q);
          if (inside > best_inside) best = &t, best_inside = inside;
        }
      }
  return *best;
}

double MeshSurface::elevation_m(double x_m, double y_m) const {
  const glm::dvec2 q{std::clamp(x_m, 0.0, extent_.width_m), std::clamp(y_m, 0.0, extent_.depth_m)};
  return std::clamp(find(q).at(q), extent_.lowest_m, extent_.highest_m);
}

glm::dvec2 MeshSurface::gradient(double x_m, double y_m) const {
  return find({std::clamp(x_m, 0.0, extent_.width_m), std::clamp(y_m, 0.0, extent_.depth_m)}).slope;
}

}  // namespace witherfield::terrain
