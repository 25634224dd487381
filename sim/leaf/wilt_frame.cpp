#include "sim/leaf/wilt_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/leaf_colour.hpp"
#include "sim/leaf/leaf_tissue.hpp"

namespace witherfield::leaf {
namespace {

constexpr int kSides = 14;

/// A closed tube around the rod: rings at its nodes, tapered where it meets the blade, two end points.
Surface tube(const WiltMechanics& mechanics, const std::vector<glm::dvec3>& line) {
  Surface s;
  const auto& frames = mechanics.shape().frame;
  const int rings = int(line.size());
  for (int k = 0; k < rings; ++k) {
    const glm::dquat q = k == 0 ? frames.front() : k + 1 == rings ? frames.back()
                         : glm::slerp(frames[std::size_t(k) - 1], frames[std::size_t(k)], 0.5);
    const double radius = mechanics.rod_radius_m(k) * (k + 1 == rings ? 0.35 : 1.0);
    glm::dvec3 centre = line[std::size_t(k)];
    if (k + 1 == rings) centre = glm::mix(centre, line[std::size_t(k) - 1], 0.12);  // ends just short of the blade
    for (int i = 0; i < kSides; ++i) {
      const double a = 2 * std::numbers::pi * i / kSides;
      s.position_m.push_back(centre + q * glm::dvec3(radius * std::cos(a), radius * std::sin(a), 0));
    }
  }
  for (int k = 0; k + 1 < rings; ++k)
    for (int i = 0; i < kSides; ++i) {
      const int a = k * kSides + i, b = k * kSides + (i + 1) % kSides;
      s.triangles.push_back({a, b, b + kSides});
      s.triangles.push_back({a, b + kSides, a + kSides});
    }
  const int foot = int(s.position_m.size()), top = foot + 1, last = (rings - 1) * kSides;
  s.position_m.push_back(line.front());
  s.position_m.push_back(glm::mix(line[std::size_t(rings) - 1], line[std::size_t(rings) - 2], 0.08));
  for (int i = 0; i < kSides; ++i) {
    s.triangles.push_back({foot, (i + 1) % kSides, i});
    s.triangles.push_back({top, last + i, last + (i + 1) % kSides});
  }
  s.normal = vertex_normals(s);
  return s;
}

std::vector<glm::dvec3> rod_line(const WiltMechanics& m) {
  return {m.shape().x.end() - m.rod_nodes(), m.shape().x.end()};
}

std::vector<glm::dvec3> blade_of(const WiltMechanics& m, std::size_t vertices) {
  return {m.shape().x.begin(), m.shape().x.begin() + std::ptrdiff_t(vertices)};
}

double slope_deg(const glm::dvec3& d) { return std::atan2(d.z, std::hypot(d.x, d.y)) * 180 / std::numbers::pi; }

glm::dvec3 mean_weighted(const std::vector<glm::dvec3>& x, const std::vector<double>& weight) {
  glm::dvec3 sum(0.0);
  double all = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * x[i], all += weight[i];
  return sum / all;
}

void put(Surface& s, const char* name, std::size_t vertex, const glm::dvec3& v) {
  auto& values = s.make_field(name).values;
  for (int c = 0; c < 3; ++c) values[3 * vertex + std::size_t(c)] = float(v[c]);
}

}  // namespace

WiltFrames::WiltFrames(const WiltBody& body, const WiltOptions& options, const WiltMechanics& mechanics)
    : body_(body), options_(options),
      chlorophyll_ug_cm2_(body.rest.position_m.size(), options.tissue.chlorophyll_fresh_ug_cm2),
      rest_area_m2_(vertex_areas(body.rest.position_m, body.rest.triangles)),
      rest_midrib_m_(chain_length_m(mechanics.ribs().main_vein, body.rest.position_m)),
      rest_centre_m_(mean_weighted(body.rest.position_m, rest_area_m2_)),
      rest_petiole_m_(rod_line(mechanics)) {
  if (!rest_petiole_m_.empty()) rest_tube_m_ = tube(mechanics, rest_petiole_m_).position_m;
}

void WiltFrames::age(double hours, std::span<const double> water) {
  const double tlp = turgor_loss_point(options_.tissue);
  for (std::size_t i = 0; i < chlorophyll_ug_cm2_.size(); ++i) {
    const double dry = tlp > 0 ? std::clamp(1 - water[i] / tlp, 0.0, 1.0) : 0.0;
    chlorophyll_ug_cm2_[i] *= std::exp(-hours / options_.tissue.chlorophyll_loss_hours * dry);
  }
}

void WiltFrames::fill_blade(const WiltMechanics& mechanics, const LeafWater& water) {
  const std::size_t n = body_.rest.position_m.size();
  surface_ = Surface{};
  surface_.position_m = blade_of(mechanics, n);
  surface_.triangles = body_.rest.triangles;
  surface_.uv = body_.rest.uv;
  surface_.normal = vertex_normals(surface_);
  const std::vector<double> area = vertex_areas(surface_.position_m, surface_.triangles), stress = mechanics.von_mises_MPa();
  std::vector<double> stress_at(n, 0.0);
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const auto& c = surface_.triangles[t];
    const glm::dvec3 a = body_.rest.position_m[std::size_t(c[0])];
    const double rest = glm::length(glm::cross(body_.rest.position_m[std::size_t(c[1])] - a, body_.rest.position_m[std::size_t(c[2])] - a)) / 6;
    for (const int v : c) stress_at[std::size_t(v)] += stress[t] * rest / rest_area_m2_[std::size_t(v)];
  }
  for (const char* name : {"water", "chlorophyll_ug_cm2", "stress_von_mises_MPa", "strain_area", "vein", "organ_id", "displacement_m", "diffuse"})
    surface_.make_field(name);
  const bool painted = body_.rest.has_field("diffuse");
  const glm::dvec3 fresh = leaf_colour(options_.tissue.chlorophyll_fresh_ug_cm2, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double w = water.blade()[i], grown = rest_area_m2_[i] > 0 ? area[i] / rest_area_m2_[i] : 1.0;
    surface_.make_field("water").values[i] = float(w);
    surface_.make_field("chlorophyll_ug_cm2").values[i] = float(chlorophyll_ug_cm2_[i] / grown);  // the same amount on less area
    surface_.make_field("stress_von_mises_MPa").values[i] = float(stress_at[i]);
    surface_.make_field("strain_area").values[i] = float(grown - 1);
    surface_.make_field("vein").values[i] = mechanics.vein()[i];
    put(surface_, "displacement_m", i, surface_.position_m[i] - body_.rest.position_m[i]);
    glm::dvec3 colour = leaf_colour(chlorophyll_ug_cm2_[i], w);
    if (painted) {  // what the leaf was painted with, changed as plain tissue changes
      const auto& base = body_.rest.field("diffuse").values;
      colour = colour / fresh * glm::dvec3(base[3 * i], base[3 * i + 1], base[3 * i + 2]);
    }
    put(surface_, "diffuse", i, glm::min(colour, glm::dvec3(1.0)));
  }
}

void WiltFrames::fill_petiole(const WiltMechanics& mechanics, const LeafWater& water) {
  if (petiole_m_.empty()) return;
  Surface s = tube(mechanics, petiole_m_);
  if (!surface_.uv.empty()) s.uv.assign(s.position_m.size(), glm::dvec2(0.0));
  const std::vector<double> stress = mechanics.rod_stress_MPa();
  const std::size_t last = petiole_m_.size() - 1;
  for (const char* name : {"water", "chlorophyll_ug_cm2", "stress_von_mises_MPa", "strain_area", "vein", "organ_id"}) s.make_field(name);
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    const std::size_t k = i + 2 == s.position_m.size() ? 0 : std::min(i / kSides, last);
    const double w = water.petiole()[k], chlorophyll = 0.25 * options_.tissue.chlorophyll_fresh_ug_cm2;
    s.make_field("water").values[i] = float(w);
    s.make_field("chlorophyll_ug_cm2").values[i] = float(chlorophyll);
    s.make_field("stress_von_mises_MPa").values[i] = float(stress[std::min(k, stress.size() - 1)]);
    s.make_field("vein").values[i] = 1.0f;
    s.make_field("organ_id").values[i] = 1.0f;
    put(s, "displacement_m", i, s.position_m[i] - rest_tube_m_[i]);
    put(s, "diffuse", i, leaf_colour(chlorophyll, w));
  }
  append(surface_, s);
}

void WiltFrames::fill(const WiltMechanics& mechanics, const LeafWater& water, WiltFrame& frame) {
  petiole_m_ = rod_line(mechanics);
  fill_blade(mechanics, water);
  const std::vector<double> area = vertex_areas(surface_.position_m, surface_.triangles);
  double now = 0, rest = 0;
  for (std::size_t i = 0; i < area.size(); ++i) now += area[i], rest += rest_area_m2_[i];
  frame.area_change = now / rest - 1;
  frame.drop_m = rest_centre_m_.z - mean_weighted(surface_.position_m, rest_area_m2_).z;
  frame.midrib_change = rest_midrib_m_ > 0 ? chain_length_m(mechanics.ribs().main_vein, surface_.position_m) / rest_midrib_m_ - 1 : 0;
  if (!petiole_m_.empty()) {
    const std::size_t e = petiole_m_.size() - 1;
    frame.petiole_drop_deg = slope_deg(rest_petiole_m_[e] - rest_petiole_m_[0]) - slope_deg(petiole_m_[e] - petiole_m_[0]);
    frame.tip_drop_deg = slope_deg(rest_petiole_m_[e] - rest_petiole_m_[e - 1]) - slope_deg(petiole_m_[e] - petiole_m_[e - 1]);
  }
  fill_petiole(mechanics, water);
  frame.water = water.mean_blade();
  frame.surface = &surface_;
  frame.petiole_m = &petiole_m_;
}

}  // namespace witherfield::leaf
