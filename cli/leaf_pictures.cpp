#include "cli/leaf_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <set>

#include "cli/leaf_input.hpp"
#include "cli/markers.hpp"
#include "sim/leaf/editor.hpp"
#include "sim/leaf/leaf_colour.hpp"

namespace witherfield::cli {
namespace {

using Face = std::array<int, 3>;

// Linear sRGB.
constexpr glm::vec3 kMargin{0.05f, 0.16f, 0.03f}, kMidrib{0.38f, 0.15f, 0.03f}, kSheet{0.50f, 0.64f, 0.36f},
    kWire{0.06f, 0.11f, 0.05f}, kEar{0.62f, 0.03f, 0.02f}, kRepaired{0.05f, 0.16f, 0.55f},
    kDragged{0.03f, 0.12f, 0.60f}, kGhost{0.30f, 0.30f, 0.30f};

/// The triangles that the other mesh does not have.
std::vector<char> not_in(const Surface& now, const Surface& other) {
  const std::set<Face> old(other.triangles.begin(), other.triangles.end());
  std::vector<char> out;
  for (const Face& t : now.triangles)
    out.push_back(!old.count(t) && !old.count({t[1], t[2], t[0]}) && !old.count({t[2], t[0], t[1]}));
  return out;
}

/// Sheet with every edge as a thin cord, the border as a thicker one.
Surface wired(const Surface& mesh, const std::vector<char>& marked, const glm::vec3& mark, double size) {
  Surface out;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Face t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = int(out.position_m.size());
      out.position_m.push_back(mesh.position_m[std::size_t(mesh.triangles[f][k])]);
    }
    out.triangles.push_back(t);
  }
  auto& diffuse = out.make_field("diffuse").values;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c)
        diffuse[9 * f + 3 * k + std::size_t(c)] = (marked.empty() || !marked[f] ? kSheet : mark)[c];
  std::map<std::pair<int, int>, int> edges;
  for (const Face& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
  for (const auto& [e, faces] : edges) {
    const bool border = faces == 1;
    const glm::dvec3 ends[2] = {mesh.position_m[std::size_t(e.first)],
                                mesh.position_m[std::size_t(e.second)]};
    add_cord(out, ends, (border ? 0.0052 : 0.0022) * size, border ? kMargin : kWire);
  }
  return out;
}

Surface of_lines(const leaf::Stage& stage, bool dots, double size) {
  Surface out;
  for (std::size_t group = 0; group < stage.lines.size(); ++group) {
    const glm::vec3 colour = group == 2 ? kMidrib : kMargin;
    std::vector<glm::dvec3> line;
    for (const int v : stage.lines[group]) line.push_back(stage.surface.position_m[std::size_t(v)]);
    if (!dots) {
      add_cord(out, line, 0.0075 * size, colour);
      continue;
    }
    for (const glm::dvec3& p : line) add_ball(out, p, 0.017 * size, colour);
  }
  return out;
}

}  // namespace

ObjectLooks leaf_looks(const leaf::LeafModel& model) {
  ObjectLooks looks;
  looks.common_ground = true;  // the stem's end of the petiole stays at its height while the leaf wilts
  pov::ObjectLook& blade = looks.by_organ[kBladeOrgan];
  blade.kind = pov::LookKind::leaf;
  blade.vein_rgb = glm::vec3(leaf::leaf_colour(0.16 * model.chlorophyll_ug_cm2, 1));
  if (!model.veins.empty()) {
    // Leaves side by side ask for the same picture.
    const auto last = std::make_shared<pov::LeafDetail>();
    blade.detail = [&model, last](int pixels) {
      if (last->pixels != pixels) {
        leaf::VeinMap map = leaf::rasterize_veins(model, pixels);
        *last = {pixels, std::move(map.vein), std::move(map.height)};
      }
      return *last;
    };
  }
  looks.by_organ[kPetioleOrgan].kind = looks.by_organ[kStemOrgan].kind = pov::LookKind::grain;
  looks.other.kind = pov::LookKind::matte;
  return looks;
}

Surface without_vein_colour(Surface s, double fresh_chlorophyll) {
  const auto& organ = s.make_field("organ_id").values;
  const bool dries = s.has_field("water");
  const std::size_t n = s.position_m.size();
  std::vector<float> chlorophyll(n, float(fresh_chlorophyll)), water(n, 1.0f);
  if (dries) chlorophyll = s.field("chlorophyll_ug_cm2").values, water = s.field("water").values;
  auto& diffuse = s.make_field("diffuse").values;
  for (std::size_t v = 0; v < n; ++v) {
    if (int(organ[v]) != kBladeOrgan) continue;
    const glm::dvec3 c = leaf::leaf_colour(chlorophyll[v], water[v]);
    for (int k = 0; k < 3; ++k) diffuse[3 * v + std::size_t(k)] = float(c[k]);
  }
  return s;
}

std::vector<Surface> stage_objects(const leaf::LeafModel& m) {
  std::vector<Surface> out;
  const double size = m.main_vein_m;
  for (std::size_t i = 0; i < m.stages.size(); ++i) {
    const leaf::Stage& stage = m.stages[i];
    const bool last = i + 1 == m.stages.size();
    if (stage.surface.triangles.empty())
      out.push_back(of_lines(stage, i == 0, size));
    else if (last && i > 0 && !m.stages[i - 1].surface.triangles.empty())
      out.push_back(wired(stage.surface, not_in(stage.surface, m.stages[i - 1].surface), kRepaired, size));
    else if (i + 2 == m.stages.size())
      out.push_back(wired(stage.surface, not_in(stage.surface, m.stages[i + 1].surface), kEar, size));
    else
      out.push_back(wired(stage.surface, {}, kEar, size));
    auto& organ = out.back().make_field("organ_id").values;
    std::fill(organ.begin(), organ.end(), float(kMarkerOrgan));
  }
  return out;
}

void add_handles(Surface& s, const leaf::LeafModel& m, const leaf::EditOptions& edit,
                 const leaf::EditKey& key) {
  Surface markers;
  for (std::size_t i = 0; i < edit.handles.size(); ++i) {
    const leaf::HandleOptions& h = edit.handles[i];
    const int v =
        h.by_uv ? leaf::vertex_at_uv(m.natural, h.uv) : leaf::nearest_vertex(m.natural.position_m, h.point_m);
    const bool dragged = i < key.move_m.size() && glm::length(key.move_m[i]) > 0;
    add_ball(markers, s.position_m[std::size_t(v)], 0.03 * m.main_vein_m, dragged ? kDragged : kEar);
  }
  std::vector<glm::dvec3> margin;
  for (const int v : m.border) margin.push_back(m.natural.position_m[std::size_t(v)]);
  if (!margin.empty()) margin.push_back(margin.front());
  add_cord(markers, margin, 0.0045 * m.main_vein_m, kGhost);
  auto& organ = markers.make_field("organ_id").values;
  std::fill(organ.begin(), organ.end(), float(kMarkerOrgan));
  if (!s.uv.empty()) markers.uv.assign(markers.position_m.size(), glm::dvec2(0.0));
  if (!s.normal.empty()) markers.normal = vertex_normals(markers);
  append(s, markers);
}

void add_stem(Surface& s, const leaf::LeafModel& m, double low_m) {
  const auto& petiole = m.petiole.line_m;
  if (petiole.size() < 2) return;
  constexpr double kAbove_m = 0.05, kStemOverPetiole = 1.9;
  const glm::dvec3 end = petiole.front(), along = petiole[1] - end;
  const double radius = kStemOverPetiole * m.petiole.radius_stem_m,
               level = std::max(std::hypot(along.x, along.y), 1e-12);
  const glm::dvec3 axis = end - glm::dvec3(along.x, along.y, 0) * (0.7 * radius / level);
  std::vector<glm::dvec3> line;
  constexpr int kPieces = 12;
  for (int i = 0; i <= kPieces; ++i)
    line.emplace_back(axis.x, axis.y, low_m + (end.z + kAbove_m - low_m) * i / kPieces);
  Surface stem;
  add_cord(stem, line, radius, glm::vec3(leaf::leaf_colour(10, 1)));
  add_ball(stem, line.back(), radius, glm::vec3(leaf::leaf_colour(10, 1)));  // a rounded end
  auto& organ = stem.make_field("organ_id").values;
  std::fill(organ.begin(), organ.end(), float(kStemOrgan));
  if (s.has_field("chlorophyll_ug_cm2")) stem.make_field("chlorophyll_ug_cm2");
  if (!s.uv.empty()) stem.uv.assign(stem.position_m.size(), glm::dvec2(0.0));
  if (!s.normal.empty()) stem.normal = vertex_normals(stem);
  append(s, stem);
}

}  // namespace witherfield::cli
