// Leaf models as surfaces with fields: for writers, for the wilting simulation.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/core/errors.hpp"
#include "sim/leaf/edit_report.hpp"
#include "sim/leaf/leaf_colour.hpp"
#include "sim/leaf/leaf_model.hpp"

namespace witherfield::leaf {
namespace {

void require_vertices(const LeafModel& m, std::size_t count, const char* who) {
  if (count != m.natural.position_m.size())
    throw InvalidInput(std::string(who) + ": " + std::to_string(count) + " positions, the leaf has " +
                       std::to_string(m.natural.position_m.size()) + " vertices");
}

/// Areal strain of each vertex: mean over its faces, weighted by area.
std::vector<double> areal_strain(const LeafModel& m, const std::vector<glm::dvec3>& position) {
  const auto stretch = principal_stretches(m.natural.position_m, position, m.natural.triangles);
  std::vector<double> sum(position.size(), 0.0), weight(position.size(), 0.0);
  for (std::size_t f = 0; f < stretch.size(); ++f) {
    const auto& t = m.natural.triangles[f];
    const glm::dvec3& a = m.natural.position_m[std::size_t(t[0])];
    const double area = glm::length(glm::cross(m.natural.position_m[std::size_t(t[1])] - a, m.natural.position_m[std::size_t(t[2])] - a));
    for (const int v : t) {
      sum[std::size_t(v)] += area * (stretch[f][0] * stretch[f][1] - 1);
      weight[std::size_t(v)] += area;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = weight[i] > 0 ? sum[i] / weight[i] : 0.0;
  return sum;
}

}  // namespace

Surface to_surface(const LeafModel& m, const std::vector<glm::dvec3>& position) {
  require_vertices(m, position.size(), "to_surface");
  Surface s;
  s.position_m = position;
  s.triangles = m.natural.triangles;
  s.uv = m.natural.uv;
  s.normal = vertex_normals(s);
  // Veins have little chlorophyll and much scattering: pale.
  const glm::dvec3 blade = leaf_colour(m.chlorophyll_ug_cm2, 1), pale = leaf_colour(0.16 * m.chlorophyll_ug_cm2, 1);
  const auto strain = areal_strain(m, position);
  for (const char* name : {"vein", "strain_area", "displacement_m", "diffuse"}) s.make_field(name);
  const auto values = [&](const char* name) { return s.make_field(name).values.data(); };
  float *vein = values("vein"), *area = values("strain_area"), *move = values("displacement_m"), *diffuse = values("diffuse");
  for (std::size_t i = 0; i < position.size(); ++i) {
    vein[i] = float(m.vein.empty() ? 0.0 : m.vein[i]);
    area[i] = float(strain[i]);
    const glm::dvec3 d = position[i] - m.natural.position_m[i], c = glm::mix(blade, pale, 0.75 * double(vein[i]));
    for (int k = 0; k < 3; ++k) {
      move[3 * i + std::size_t(k)] = float(d[k]);
      diffuse[3 * i + std::size_t(k)] = float(c[k]);
    }
  }
  return s;
}

Surface to_surface(const LeafModel& m) { return to_surface(m, m.natural.position_m); }

WiltBody wilt_body(const LeafModel& m, const std::vector<glm::dvec3>& position) {
  WiltBody body;
  body.rest = to_surface(m, position);
  for (const double v : m.vein) body.vein.push_back(float(v));
  for (const Vein& v : m.veins) {
    if (v.order > 2) continue;
    VeinCurve curve;
    for (const glm::dvec2& p : v.line_m) curve.points_m.emplace_back(p, 0.0);
    curve.radius_base_m = 0.5 * v.width_base_m;
    curve.radius_tip_m = 0.5 * v.width_tip_m;
    body.veins.push_back(std::move(curve));
  }
  if (!m.veins.empty()) body.vein_frame_m = m.flat.position_m;
  body.clamp = m.base;
  if (m.veins.empty())  // a mesh that was given: its veins are not known, but it lived by some
    for (int v = 0; v < int(position.size()); ++v) body.inlet.push_back(v);
  body.petiole_m = m.petiole.line_m;
  body.petiole_radius_stem_m = m.petiole.radius_stem_m;
  body.petiole_radius_blade_m = m.petiole.radius_blade_m;
  return body;
}

WiltBody wilt_body(const LeafModel& m) { return wilt_body(m, m.natural.position_m); }

Surface petiole_surface(const Petiole& petiole, int sides) {
  Surface s;
  const auto& line = petiole.line_m;
  if (line.size() < 2) return s;
  glm::dvec3 side(0, 1, 0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec3 along = glm::normalize(line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]);
    side = glm::normalize(side - glm::dot(side, along) * along);
    const glm::dvec3 other = glm::cross(along, side);
    const double share = double(i) / double(line.size() - 1);
    const double radius = (1 - share) * petiole.radius_stem_m + share * petiole.radius_blade_m;
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * std::numbers::pi * k / sides;
      // The upper end tapers below the blade instead of piercing it.
      const double end = share > 0.9 ? 1 - 0.55 * (share - 0.9) / 0.1 : 1.0;
      s.position_m.push_back(line[i] + radius * end * (std::cos(a) * side + std::sin(a) * other) - glm::dvec3(0, 0, share > 0.9 ? 0.8 * radius * (share - 0.9) / 0.1 : 0.0));
    }
  }
  const int rings = int(line.size());
  for (int i = 0; i + 1 < rings; ++i)
    for (int k = 0; k < sides; ++k) {
      const int a = i * sides + k, b = i * sides + (k + 1) % sides, c = a + sides, d = b + sides;
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, c});
    }
  for (const int ring : {0, rings - 1}) {
    const int centre = int(s.position_m.size());
    glm::dvec3 middle(0.0);
    for (int k = 0; k < sides; ++k) middle += s.position_m[std::size_t(ring * sides + k)] / double(sides);
    s.position_m.push_back(middle);
    for (int k = 0; k < sides; ++k) {
      const int a = ring * sides + k, b = ring * sides + (k + 1) % sides;
      s.triangles.push_back(ring == 0 ? std::array<int, 3>{centre, b, a} : std::array<int, 3>{centre, a, b});
    }
  }
  s.normal = vertex_normals(s);
  s.make_field("vein").values.assign(s.position_m.size(), 1.0f);
  s.make_field("diffuse");
  const glm::dvec3 colour = leaf_colour(9, 1);
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    for (int k = 0; k < 3; ++k) s.make_field("diffuse").values[3 * i + std::size_t(k)] = float(colour[k]);
  return s;
}

}  // namespace witherfield::leaf
