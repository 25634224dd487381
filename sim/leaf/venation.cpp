#include "sim/leaf/venation.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/random.hpp"
#include "sim/leaf/segment_grid.hpp"
#include "sim/leaf/splines.hpp"

namespace witherfield::leaf {
namespace {

using glm::dvec2;

enum Draw : std::uint64_t { kSides = 16, kNet = 17 };

dvec2 turned(const dvec2& v, double angle) {
  return {v.x * std::cos(angle) - v.y * std::sin(angle), v.x * std::sin(angle) + v.y * std::cos(angle)};
}

/// A side vein that is still growing.
struct Tip {
  int vein;            ///< its number
  dvec2 heading;
  double bend;         ///< per length
  bool alive = true;
};

SegmentGrid grid_of(const std::vector<Vein>& veins, double cell) {
  SegmentGrid grid(cell);
  for (std::size_t v = 0; v < veins.size(); ++v)
    if (veins[v].line_m.size() > 1) grid.add_line(veins[v].line_m, int(v));
  grid.build();
  return grid;
}

SegmentGrid grid_of_outline(const std::vector<dvec2>& outline, double cell) {
  SegmentGrid grid(cell);
  for (std::size_t i = 0; i < outline.size(); ++i) grid.add(outline[i], outline[(i + 1) % outline.size()], 0);
  grid.build();
  return grid;
}

/// Ends of the edges between bounded cells. CGAL's edge iterator takes the one of an edge's two faces that has the lower address, so
/// that order and direction would change from run to run: faces are numbered instead.
std::vector<std::pair<dvec2, dvec2>> voronoi_edges(const std::vector<dvec2>& seeds) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using FaceBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
  using Tds = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>, FaceBase>;
  CGAL::Delaunay_triangulation_2<Kernel, Tds> dt;
  for (const dvec2& p : seeds) dt.insert(Kernel::Point_2(p.x, p.y));
  std::vector<dvec2> centre;
  for (auto f = dt.finite_faces_begin(); f != dt.finite_faces_end(); ++f) {
    f->info() = int(centre.size());
    const auto c = dt.circumcenter(f);
    centre.emplace_back(c.x(), c.y());
  }
  std::vector<std::pair<dvec2, dvec2>> edges;
  for (auto f = dt.finite_faces_begin(); f != dt.finite_faces_end(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto g = f->neighbor(k);
      if (!dt.is_infinite(g) && f->info() < g->info()) edges.emplace_back(centre[std::size_t(f->info())], centre[std::size_t(g->info())]);
    }
  return edges;
}

}  // namespace

double vein_strength(int order) { return order == 1 ? 1.0 : order == 2 ? 0.65 : 0.26; }

void grow_side_veins(std::vector<Vein>& veins, const std::vector<dvec2>& outline, const VeinOptions& o, double main_vein_m,
                     std::uint64_t seed) {
  const double spacing = o.side_spacing * main_vein_m, step = 0.12 * spacing;
  Random random(seed, Stream::outline, kSides);
  const std::size_t parents = veins.size();
  const SegmentGrid fixed = grid_of(veins, 0.5 * spacing), margin = grid_of_outline(outline, spacing);
  std::vector<Tip> tips;
  for (std::size_t parent = 0; parent < parents; ++parent) {
    const std::vector<dvec2> line = veins[parent].line_m;
    const double length = polyline_length(line);
    for (const double side : {1.0, -1.0}) {
      double s = spacing * (veins[parent].order == 1 ? 0.9 : 0.7) + (side > 0 ? 0.0 : 0.5 * spacing);
      for (; s < length - 0.35 * spacing; s += spacing * (0.85 + 0.3 * random.uniform()) * (1 - 0.35 * s / length)) {
        const double share = s / length;
        const std::size_t i = std::clamp<std::size_t>(std::size_t(std::lround(share * double(line.size() - 1))), 1, line.size() - 2);
        const dvec2 along = glm::normalize(line[i + 1] - line[i - 1]);
        const double angle = side * (o.side_angle_deg + 5 * random.uniform(-1, 1)) * std::numbers::pi / 180;
        const dvec2 heading = turned(along, angle);
        // Another vein that leaves here already (a lobe's) takes the place.
        const dvec2 probe = line[i] + 0.45 * spacing * heading;
        if (!inside_polygon(outline, probe) || fixed.nearest(probe, int(parent)).distance_m < 0.3 * spacing) continue;
        Vein v;
        v.order = 2;
        v.parent = int(parent);
        v.line_m = {line[i]};
        const double parent_width = veins[parent].width_base_m + (veins[parent].width_tip_m - veins[parent].width_base_m) * share;
        v.width_base_m = 0.5 * parent_width;
        v.width_tip_m = 0.18 * parent_width;
        tips.push_back({int(veins.size()), heading, -0.45 * angle / (3.5 * spacing) * (0.7 + 0.6 * random.uniform())});
        veins.push_back(std::move(v));
      }
    }
  }
  // All tips grow in turns, so that those that meet share the space between their main veins.
  for (int round = 0; round < 400; ++round) {
    SegmentGrid grown(0.5 * spacing);
    for (std::size_t v = parents; v < veins.size(); ++v) {
      const auto& l = veins[v].line_m;
      if (l.size() > 1) grown.add_line(l, int(v));
    }
    grown.build();
    bool any = false;
    for (Tip& tip : tips) {
      if (!tip.alive) continue;
      Vein& v = veins[std::size_t(tip.vein)];
      tip.heading = turned(tip.heading, tip.bend * step + 0.06 * random.uniform(-1, 1));
      const dvec2 next = v.line_m.back() + step * tip.heading, ahead = next + 2.0 * step * tip.heading;
      const auto edge = margin.nearest(next);
      const bool young = v.line_m.size() < 4;
      const double near_fixed = fixed.nearest(next, v.parent).distance_m, near_grown = grown.nearest(next, tip.vein).distance_m;
      const bool back = !young && fixed.nearest(next).distance_m < 0.16 * spacing;  // onto its own parent
      if (!inside_polygon(outline, next) || !inside_polygon(outline, ahead) || edge.distance_m < 0.1 * spacing || near_fixed < 0.22 * spacing ||
          (!young && near_grown < 0.26 * spacing) || back) {
        tip.alive = false;
        continue;
      }
      v.line_m.push_back(next);
      any = true;
    }
    if (!any) break;
  }
  // Stumps are no veins.
  std::vector<Vein> kept(veins.begin(), veins.begin() + std::ptrdiff_t(parents));
  for (std::size_t v = parents; v < veins.size(); ++v)
    if (veins[v].line_m.size() >= 5) kept.push_back(std::move(veins[v]));
  veins = std::move(kept);
}

void grow_net(std::vector<Vein>& veins, const std::vector<dvec2>& outline, const VeinOptions& o, std::uint64_t seed) {
  const double spacing = o.net_spacing_m;
  if (spacing <= 0) return;
  Random random(seed, Stream::outline, kNet);
  const SegmentGrid large = grid_of(veins, 1.2 * spacing), margin = grid_of_outline(outline, 1.2 * spacing);
  std::vector<dvec2> seeds;
  dvec2 low = outline[0], high = outline[0];
  for (const dvec2& p : outline) low = glm::min(low, p), high = glm::max(high, p);
  low -= 2 * spacing, high += 2 * spacing;
  const double cell = 0.5 * spacing;
  const int nx = int((high.x - low.x) / cell) + 1, ny = int((high.y - low.y) / cell) + 1;
  std::vector<std::vector<int>> bucket(std::size_t(nx) * std::size_t(ny));
  const auto fits = [&](const dvec2& p, double least) {
    const int ci = int((p.x - low.x) / cell), cj = int((p.y - low.y) / cell), reach = int(least / cell) + 1;
    for (int j = std::max(0, cj - reach); j <= std::min(ny - 1, cj + reach); ++j)
      for (int i = std::max(0, ci - reach); i <= std::min(nx - 1, ci + reach); ++i)
        for (const int k : bucket[std::size_t(j) * std::size_t(nx) + std::size_t(i)])
          if (glm::distance(seeds[std::size_t(k)], p) < least) return false;
    return true;
  };
  const auto add = [&](const dvec2& p) {
    const int i = int((p.x - low.x) / cell), j = int((p.y - low.y) / cell);
    if (i < 0 || j < 0 || i >= nx || j >= ny) return;
    bucket[std::size_t(j) * std::size_t(nx) + std::size_t(i)].push_back(int(seeds.size()));
    seeds.push_back(p);
  };
  // Pairs of points mirrored at the larger veins: their common border is the vein.
  for (const Vein& v : veins) {
    const auto line = resample(v.line_m, std::max(2, int(polyline_length(v.line_m) / (0.62 * spacing))));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const dvec2 along = glm::normalize(line[i + 1] - line[i]), across(-along.y, along.x), middle = 0.5 * (line[i] + line[i + 1]);
      const dvec2 a = middle + 0.45 * spacing * across, b = middle - 0.45 * spacing * across;
      if (!fits(a, 0.5 * spacing) || !fits(b, 0.5 * spacing)) continue;
      add(a);
      add(b);
    }
  }
  const long tries = long(double(nx) * double(ny) * 8);
  for (long k = 0; k < tries; ++k) {
    const dvec2 p(low.x + random.uniform() * (high.x - low.x), low.y + random.uniform() * (high.y - low.y));
    if (large.nearest(p).distance_m < 0.42 * spacing || !fits(p, 0.86 * spacing)) continue;
    add(p);
  }

  for (auto [a, b] : voronoi_edges(seeds)) {
    if (glm::distance(a, b) < 0.02 * spacing || glm::distance(a, b) > 3 * spacing) continue;
    if (large.nearest(0.5 * (a + b)).distance_m < 0.12 * spacing) continue;  // the vein itself
    const bool in_a = inside_polygon(outline, a), in_b = inside_polygon(outline, b);
    if (!in_a && !in_b) continue;
    if (!in_a) std::swap(a, b);
    if (in_a != in_b) b = a + (b - a) * std::min(1.0, 0.9 * margin.nearest(a).distance_m / glm::distance(a, b));
    Vein v;
    v.order = 3;
    const dvec2 along = b - a, across(-along.y, along.x);
    v.line_m = {a, 0.5 * (a + b) + 0.1 * random.uniform(-1, 1) * across, b};
    v.width_base_m = v.width_tip_m = 0.05 * spacing;
    veins.push_back(std::move(v));
  }
}

}  // namespace witherfield::leaf
