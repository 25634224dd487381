// Points -> splines -> triangles -> finer triangles -> no ears: Miao et al., fig. 5; then veins, pose and relief.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "sim/core/errors.hpp"
#include "sim/core/random.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/leaf_area.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/margin.hpp"
#include "sim/leaf/pose.hpp"
#include "sim/leaf/repair.hpp"
#include "sim/leaf/segment_grid.hpp"
#include "sim/leaf/splines.hpp"
#include "sim/leaf/texture_coordinates.hpp"
#include "sim/leaf/triangulate.hpp"
#include "sim/leaf/vein_morphology.hpp"
#include "sim/leaf/venation.hpp"

namespace witherfield::leaf {
namespace {

using glm::dvec2;
using glm::dvec3;

enum Draw : std::uint64_t { kTeethLeft = 48, kTeethRight = 49 };
constexpr double kMaxTurn = 10 * std::numbers::pi / 180;  // of the outline between two samples

/// Base and tip stand at both ends of all three groups.
OutlinePoints with_ends(OutlinePoints p) {
  const dvec3 base = p.midrib_m.front(), tip = p.midrib_m.back();
  const double near = 1e-6 * glm::distance(base, tip);
  for (std::vector<dvec3>* side : {&p.left_m, &p.right_m}) {
    if (glm::distance(side->front(), base) > near) side->insert(side->begin(), base);
    else side->front() = base;
    if (glm::distance(side->back(), tip) > near) side->push_back(tip);
    else side->back() = tip;
  }
  return p;
}

/// Measured leaves stand anywhere: base to the origin, plane to z = 0, tip to +x, left to +y.
void to_leaf_frame(OutlinePoints& p) {
  std::vector<dvec3> all = p.left_m;
  all.insert(all.end(), p.right_m.begin(), p.right_m.end());
  all.insert(all.end(), p.midrib_m.begin(), p.midrib_m.end());
  const dvec3 base = p.midrib_m.front(), along = p.midrib_m.back() - base;
  // The vector area of base-right-tip-left looks to the upper side.
  std::vector<dvec3> ring(p.right_m);
  ring.insert(ring.end(), p.left_m.rbegin(), p.left_m.rend());
  dvec3 up(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) up += glm::cross(ring[i] - base, ring[(i + 1) % ring.size()] - base);
  const PrincipalPlane plane = principal_plane(all, along, up);
  const dvec3 z = plane.normal, x = glm::normalize(along - glm::dot(along, z) * z), y = glm::cross(z, x);
  for (std::vector<dvec3>* group : {&p.left_m, &p.right_m, &p.midrib_m})
    for (dvec3& q : *group) q = {glm::dot(q - base, x), glm::dot(q - base, y), glm::dot(q - base, z)};
}

struct Curves {
  std::vector<dvec3> left, right, midrib;  ///< base -> tip, ends included
};

Stage line_stage(std::string name, const std::vector<dvec3>& left, const std::vector<dvec3>& right,
                 const std::vector<dvec3>& midrib) {
  Stage s{std::move(name), {}, {}};
  for (const std::vector<dvec3>* line : {&left, &right, &midrib}) {
    std::vector<int> chain;
    for (const dvec3& p : *line) {
      chain.push_back(int(s.surface.position_m.size()));
      s.surface.position_m.push_back(p);
    }
    s.lines.push_back(std::move(chain));
  }
  return s;
}

std::vector<dvec2> flattened(const std::vector<dvec3>& line) {
  std::vector<dvec2> out;
  for (const dvec3& p : line) out.emplace_back(p.x, p.y);
  return out;
}

Surface lifted(const PlanarMesh& mesh, const std::vector<double>& height) {
  Surface s;
  for (std::size_t i = 0; i < mesh.point.size(); ++i)
    s.position_m.emplace_back(mesh.point[i].x, mesh.point[i].y, height.empty() ? 0.0 : height[i]);
  s.triangles = mesh.triangles;
  return s;
}

/// Heights of measured curves, carried into the blade: harmonic between outline and midrib (laplace z = 0).
std::vector<double> spread_heights(const PlanarMesh& mesh, const SegmentGrid& lines, double size) {
  const Surface flat = lifted(mesh, {});
  const std::size_t n = mesh.point.size();
  std::vector<double> tie(n, 0.0), right(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto hit = lines.nearest(mesh.point[i]);
    if (hit.distance_m > 1e-9 * size) continue;
    tie[i] = 1e9;
    right[i] = 1e9 * hit.along;
  }
  std::vector<double> height(n);
  SparseCholesky(scaled_plus_diagonal(cotangent_laplacian(flat), 1.0, tie)).solve(right, height);
  return height;
}

/// What is shared by all sources once there is a flat blade with its veins.
class Builder {
 public:
  Builder(const LeafOptions& o) : o_(o) {}

  LeafModel from_points(OutlinePoints points, std::vector<Vein> main_veins, bool measured);
  LeafModel from_mesh(Surface mesh);

 private:
  Curves splines(const OutlinePoints& points, bool measured);
  void add_veins(LeafModel& m, const PlanarDomain& domain, std::vector<Vein> main_veins);
  PlanarMesh fine_mesh(const PlanarDomain& domain, const std::vector<Vein>& veins) const;
  void mark_veins(LeafModel& m) const;
  void finish(LeafModel& m) const;

  LeafOptions o_;
};

/// To the nearest multiple of a nanometre or so. The same leaf measured elsewhere differs in its last bits only, and the refinement of a
/// symmetric leaf has many ties that those bits would decide: without them it gets the same triangles wherever it stands.
void snap(std::vector<dvec3>& line) {
  constexpr double kPerMetre = double(1 << 30);
  for (dvec3& p : line) p = glm::round(p * kPerMetre) / kPerMetre;
}

Curves Builder::splines(const OutlinePoints& p, bool measured) {
  const CubicSpline left(p.left_m), right(p.right_m), midrib(p.midrib_m);
  const double spacing = o_.mesh.outline_spacing_m;
  Curves c{left.sample(spacing, 8, kMaxTurn), right.sample(spacing, 8, kMaxTurn), midrib.sample(o_.mesh.vein_edge_m, 4)};
  if (measured)
    for (std::vector<dvec3>* line : {&c.left, &c.right, &c.midrib}) snap(*line);
  if (measured || o_.margin.tooth_depth_m <= 0) return c;
  for (const bool is_left : {true, false}) {
    Random random(o_.seed, Stream::outline, is_left ? kTeethLeft : kTeethRight);
    std::vector<dvec3>& side = is_left ? c.left : c.right;
    const auto teeth = toothed(flattened(side), o_.margin, is_left ? -1 : 1, spacing, random);
    side.clear();
    for (const dvec2& q : teeth) side.emplace_back(q.x, q.y, 0);
  }
  return c;
}

/// Main veins end inside the blade; side veins grow from them.
void Builder::add_veins(LeafModel& m, const PlanarDomain& domain, std::vector<Vein> main_veins) {
  m.veins = std::move(main_veins);
  for (std::size_t v = 1; v < m.veins.size(); ++v) {  // the midrib ends in the tip
    std::vector<dvec2>& line = m.veins[v].line_m;
    const double stay = 0.01 * o_.main_vein_m;
    const auto out = [&](const dvec2& p) {
      const dvec2 ahead = p + stay * glm::normalize(p - line[line.size() - 2]);
      return !inside_polygon(domain.outline, p) || !inside_polygon(domain.outline, ahead);
    };
    while (line.size() > 3 && out(line.back())) line.pop_back();
  }
  grow_side_veins(m.veins, domain.outline, o_.veins, o_.main_vein_m, o_.seed);
}

/// The large veins as edges of the mesh: points of a line that are nearer to one another than edges shall be are left out,
/// save those at which another vein starts.
std::vector<std::vector<dvec2>> vein_edges(const std::vector<Vein>& veins, double spacing) {
  std::vector<std::vector<dvec2>> lines;
  for (std::size_t v = 0; v < veins.size(); ++v) {
    const std::vector<dvec2>& line = veins[v].line_m;
    std::vector<dvec2> kept{line.front()};
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const bool fork = std::any_of(veins.begin(), veins.end(), [&](const Vein& w) { return w.parent == int(v) && w.line_m.front() == line[i]; });
      if (v == 0 || fork || (glm::distance(line[i], kept.back()) >= spacing && glm::distance(line[i], line.back()) >= 0.7 * spacing))
        kept.push_back(line[i]);
    }
    kept.push_back(line.back());
    lines.push_back(std::move(kept));
  }
  return lines;
}

PlanarMesh Builder::fine_mesh(const PlanarDomain& domain, const std::vector<Vein>& veins) const {
  const double reach = (o_.mesh.edge_m - std::min(o_.mesh.vein_edge_m, o_.mesh.outline_spacing_m)) / o_.mesh.growth;
  SegmentGrid lines(std::max(reach, 1e-4)), outline(std::max(reach, 1e-4));
  for (const Vein& v : veins)
    if (v.order < 3) lines.add_line(v.line_m, 0);
  for (std::size_t i = 0; i < domain.outline.size(); ++i)
    outline.add(domain.outline[i], domain.outline[(i + 1) % domain.outline.size()], 0);
  lines.build();
  outline.build();
  const auto edge_m = [&](const dvec2& p) {
    const double at_vein = o_.mesh.vein_edge_m + o_.mesh.growth * lines.nearest(p).distance_m;
    const double at_margin = 1.3 * o_.mesh.outline_spacing_m + o_.mesh.growth * outline.nearest(p).distance_m;
    return std::min({o_.mesh.edge_m, at_vein, at_margin});
  };
  return triangulate(domain, edge_m, o_.mesh.max_vertices);
}

/// vein, vein_width_m, midrib, base and border from the curves.
void Builder::mark_veins(LeafModel& m) const {
  const auto& flat = m.flat.position_m;
  const std::size_t n = flat.size();
  m.vein.assign(n, 0.0);
  m.vein_width_m.assign(n, 0.0);
  const auto loops = border_loops(m.flat.triangles);
  m.border = *std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (m.veins.empty()) return;
  SegmentGrid grid(0.004 * std::max(0.25, o_.main_vein_m / 0.15));
  for (std::size_t v = 0; v < m.veins.size(); ++v) grid.add_line(m.veins[v].line_m, int(v));
  grid.build();
  // The net is left out where triangles are too coarse for it: single vertices on it would be noise.
  const double fine = std::clamp(o_.veins.net_spacing_m / std::max(o_.mesh.edge_m, 1e-6) - 3, 0.0, 1.0);
  const double on_line = 1e-7 * o_.main_vein_m;
  std::vector<std::pair<double, int>> midrib;
  for (std::size_t i = 0; i < n; ++i) {
    const dvec2 p(flat[i]);
    double along_midrib = -1;
    grid.each(p, [&](const SegmentGrid::Hit& h) {
      const Vein& v = m.veins[std::size_t(h.tag)];
      const double width = v.width_base_m + (v.width_tip_m - v.width_base_m) * h.along;
      const double q = h.distance_m / (0.62 * width + 0.00012);
      m.vein[i] = std::max(m.vein[i], vein_strength(v.order) * (v.order == 3 ? fine : 1.0) * std::exp(-q * q));
      if (v.order < 3 && h.distance_m <= std::max(0.5 * width, on_line)) m.vein_width_m[i] = std::max(m.vein_width_m[i], width);
      if (h.tag == 0 && h.distance_m <= on_line) along_midrib = h.along;
    });
    if (along_midrib >= 0) midrib.emplace_back(along_midrib, int(i));
  }
  std::sort(midrib.begin(), midrib.end());
  for (const auto& [along, v] : midrib) m.midrib.push_back(v);
}

void Builder::finish(LeafModel& m) const {
  const std::size_t n = m.flat.position_m.size();
  m.main_vein_m = o_.main_vein_m;
  m.net_spacing_m = o_.veins.net_spacing_m;
  m.chlorophyll_ug_cm2 = o_.chlorophyll_fresh_ug_cm2;
  // Held by the petiole: what lies within its end.
  const double radius = std::max(1.2 * o_.petiole_radius_m, 0.012 * o_.main_vein_m);
  const dvec3 foot = m.midrib.empty() ? m.flat.position_m[std::size_t(m.border.front())] : m.flat.position_m[std::size_t(m.midrib.front())];
  std::vector<std::pair<double, int>> near;
  for (std::size_t i = 0; i < n; ++i) near.emplace_back(glm::distance(m.flat.position_m[i], foot), int(i));
  constexpr std::size_t kLeast = 5;  // on coarse meshes the nearest ones, or the blade could turn about what holds it
  std::sort(near.begin(), near.end());
  for (std::size_t i = 0; i < n && (near[i].first <= radius || i < kLeast); ++i) m.base.push_back(near[i].second);
  std::sort(m.base.begin(), m.base.end());
  const dvec3 at = m.natural.position_m[std::size_t(m.midrib.empty() ? m.border.front() : m.midrib.front())];
  if (o_.petiole_m > 0) {
    // From the stem upwards and forwards, in a shallow bow, to the blade's base.
    const double angle = o_.petiole_angle_deg * std::numbers::pi / 180;
    constexpr int kPieces = 24;
    std::vector<dvec3> line{dvec3(0.0)};
    for (int k = 0; k < kPieces; ++k) {
      const double t = (k + 0.5) / kPieces, a = angle * (1.25 - 0.5 * t) ;
      line.push_back(line.back() + (o_.petiole_m / kPieces) * dvec3(std::cos(a), 0, std::sin(a)));
    }
    for (dvec3& p : line) p += at - line.back() - dvec3(0, 0, 0);
    m.petiole = {std::move(line), 1.25 * o_.petiole_radius_m, 0.85 * o_.petiole_radius_m};
  }
  m.flat.normal = vertex_normals(m.flat);
  m.natural.normal = vertex_normals(m.natural);
  m.natural.uv = m.flat.uv;
  m.area_m2 = surface_area_m2(m.stages.back().surface);
  m.natural_area_m2 = surface_area_m2(m.natural);
  if (o_.reference_area_m2 > 0) m.area_error = area_error(m.area_m2, o_.reference_area_m2);
}

LeafModel Builder::from_points(OutlinePoints points, std::vector<Vein> main_veins, bool measured) {
  validate(points);
  points = with_ends(std::move(points));
  if (measured) to_leaf_frame(points);
  LeafModel m;
  m.stages.push_back(line_stage("points", points.left_m, points.right_m, points.midrib_m));
  const Curves c = splines(points, measured);
  m.stages.push_back(line_stage("splines", c.left, c.right, c.midrib));

  PlanarDomain domain;
  domain.outline = flattened(c.right);
  for (std::size_t i = c.left.size() - 2; i > 0; --i) domain.outline.emplace_back(c.left[i].x, c.left[i].y);
  domain.lines.push_back(flattened(c.midrib));
  SegmentGrid heights(1e-3);
  for (const std::vector<dvec3>* line : {&c.left, &c.right, &c.midrib})
    for (std::size_t i = 0; i + 1 < line->size(); ++i)
      heights.add(dvec2((*line)[i]), dvec2((*line)[i + 1]), 0, (*line)[i].z, (*line)[i + 1].z);
  heights.build();
  const double length = polyline_length(domain.lines[0]);
  const auto rise = [&](const PlanarMesh& mesh) { return measured ? spread_heights(mesh, heights, length) : std::vector<double>(); };

  const PlanarMesh coarse = triangulate(domain);  // the polygons left-midrib and midrib-right
  m.stages.push_back({"mesh", lifted(coarse, rise(coarse)), {}});
  if (main_veins.empty()) main_veins.push_back({1, -1, {}, o_.veins.main_width_m, 0.22 * o_.veins.main_width_m});
  main_veins[0].line_m = domain.lines[0];
  o_.main_vein_m = length;
  add_veins(m, domain, std::move(main_veins));
  domain.lines = vein_edges(m.veins, o_.mesh.vein_edge_m);
  PlanarMesh fine = fine_mesh(domain, m.veins);
  m.stages.push_back({"subdivided", lifted(fine, rise(fine)), {}});

  m.flat = lifted(fine, {});
  m.ears_split = int(split_ears(m.flat).size());
  fine.point = flattened(m.flat.position_m);
  fine.triangles = m.flat.triangles;
  grow_net(m.veins, domain.outline, o_.veins, o_.seed);
  mark_veins(m);
  m.natural = lifted(fine, rise(fine));
  m.stages.push_back({"repaired", m.natural, {}});
  m.flat.uv = plane_uv(m.flat.position_m, principal_plane(m.flat.position_m, {1, 0, 0}, {0, 0, 1}));
  if (o_.pose.apply) {
    if (!measured) m.natural.position_m = bent_blade(m.flat.position_m, length, o_.pose, o_.seed);
    const auto height = relief(m, o_);
    const auto normal = vertex_normals(m.natural);
    for (std::size_t i = 0; i < height.size(); ++i) m.natural.position_m[i] += height[i] * normal[i];
  }
  finish(m);
  return m;
}

LeafModel Builder::from_mesh(Surface mesh) {
  mesh.validate();
  if (mesh.triangles.empty()) throw InvalidInput("leaf mesh: it has no triangle");
  std::vector<int> piece;
  const int pieces = connected_pieces(mesh.position_m.size(), mesh.triangles, piece);
  if (pieces != 1)
    throw InvalidInput("leaf mesh: it is in " + std::to_string(pieces) +
                       " pieces that share no edge (single vertices count); a leaf is one piece");
  LeafModel m;
  m.stages.push_back({"mesh", mesh, {}});
  m.ears_split = int(split_ears(mesh).size());
  m.stages.push_back({"repaired", mesh, {}});
  dvec3 up(0.0);
  for (const auto& t : mesh.triangles) {
    const dvec3& a = mesh.position_m[std::size_t(t[0])];
    up += glm::cross(mesh.position_m[std::size_t(t[1])] - a, mesh.position_m[std::size_t(t[2])] - a);
  }
  if (mesh.uv.empty()) mesh.uv = plane_uv(mesh.position_m, principal_plane(mesh.position_m, {1, 0, 0}, up));
  mesh.normal.clear();
  m.flat = mesh;
  m.natural = std::move(mesh);
  mark_veins(m);
  if (m.border.empty()) throw InvalidInput("leaf mesh: it is closed (no margin); a blade has a border");
  finish(m);
  return m;
}

}  // namespace

LeafModel build_leaf(const LeafOptions& options, const LeafInput& input) {
  validate(options);
  Builder builder(options);
  if (options.source == LeafSource::mesh) return builder.from_mesh(input.mesh);
  if (options.source == LeafSource::points) return builder.from_points(input.points, {}, true);
  VeinDraft draft = vein_draft(options);
  if (!input.points.empty()) draft.points = input.points;  // the outline by hand; veins, margin and pose of the species
  return builder.from_points(std::move(draft.points), std::move(draft.veins), false);
}

}  // namespace witherfield::leaf
