#include "pov/blade_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/text.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

/// A place between two nodes.
struct Between {
  std::size_t i, j;
  double f;
  double of(const std::vector<float>& v, double missing) const {
    return v.empty() ? missing : v[i] * (1 - f) + v[j] * f;
  }
  template <class Vector>
  glm::dvec3 of(const std::vector<Vector>& v) const {
    return glm::mix(glm::dvec3(v[i]), glm::dvec3(v[j]), f);
  }
};

Between between(const BladeRibbons& b, int blade, double s) {
  const int n = b.nodes_per_blade;
  const double x = std::clamp(s, 0.0, 1.0) * (n - 1);
  const int k = std::min(int(x), n - 2);
  const std::size_t i = std::size_t(blade) * n + k;
  return {i, i + 1, x - k};
}

/// One node, interpolated at arc s.
struct Node {
  glm::dvec3 center, tangent, side, diffuse;
  double half_width, fold, water, chlorophyll;
};

Node node_at(const BladeRibbons& b, int blade, double s) {
  const Between at = between(b, blade, s);
  Node node;
  node.center = at.of(b.center_m);
  node.tangent = glm::normalize(at.of(b.tangent));
  const glm::dvec3 side = at.of(b.side);
  node.side = glm::normalize(side - node.tangent * glm::dot(side, node.tangent));
  node.half_width = at.of(b.half_width_m, 0);
  node.fold = at.of(b.fold_rad, 0);
  node.diffuse = b.diffuse.empty() ? glm::dvec3(0.0) : at.of(b.diffuse);
  node.water = at.of(b.water, 0);
  node.chlorophyll = at.of(b.chlorophyll_ug_cm2, 0);
  return node;
}

/// Gathers the blades' vertices and faces.
struct Builder {
  Surface out{};
  std::vector<float> blade_id{}, water{}, chlorophyll{}, diffuse{};
  int blade = 0;

  int add(const Node& n, const glm::dvec3& p, const glm::dvec3& normal, double u, double v) {
    out.position_m.push_back(p);
    out.normal.push_back(normal);
    out.uv.push_back({u, v});
    blade_id.push_back(float(blade));
    water.push_back(float(n.water));
    chlorophyll.push_back(float(n.chlorophyll));
    for (int c = 0; c < 3; ++c) diffuse.push_back(float(n.diffuse[c]));
    return int(out.position_m.size()) - 1;
  }
  void face(int a, int b, int c) { out.triangles.push_back({a, b, c}); }
  Surface finish() {
    out.make_field("blade_id").values = std::move(blade_id);
    out.make_field("water").values = std::move(water);
    out.make_field("chlorophyll_ug_cm2").values = std::move(chlorophyll);
    out.make_field("diffuse").values = std::move(diffuse);
    return std::move(out);
  }
};

/// Vertices across the blade at one node, left to right: position along side (in half-widths), rise along the
/// face normal, and lean of the normal to that side (radians, beyond the facet's own).
struct Across {
  double offset, rise, lean;
};

std::vector<Across> section(const BladeDetail& d, const Node& n) {
  constexpr double kSplay = 0.35;  // about 20 degrees: fakes the blade's rounded cross-section
  const double c = std::cos(n.fold), s = std::sin(n.fold);
  if (d.folded) return {{-c, s, n.fold - kSplay}, {0, 0, 0}, {c, s, kSplay - n.fold}};
  return {{-c, s * 0.5, -kSplay}, {c, s * 0.5, kSplay}};
}

}  // namespace

AtlasLayout atlas_layout(int blades) {
  return {blades, 32, blades <= 2000 ? 8 : 4};
}

Surface blade_surface(const BladeRibbons& b, const BladeDetail& detail) {
  Builder m;
  const AtlasLayout layout = atlas_layout(b.blade_count());
  const auto u_of = [&](double s) { return (0.5 + s * (layout.columns - 1)) / layout.columns; };
  for (int blade = 0; blade < b.blade_count(); ++blade) {
    m.blade = blade;
    // Within a blade's rows the outermost ones are margin; v runs upward in POV-Ray's images.
    const auto v_of = [&](double across) {
      const double row = blade * layout.rows + layout.rows * 0.5 + across * (layout.rows * 0.5 - 1.5);
      return row / layout.height();
    };
    std::vector<int> previous;
    for (int k = 0; k <= detail.segments; ++k) {
      const double s = double(k) / detail.segments;
      const Node n = node_at(b, blade, s);
      const glm::dvec3 face = glm::cross(n.side, n.tangent);
      if (k == detail.segments) {
        const int tip = m.add(n, n.center, face, u_of(s), v_of(0));
        for (std::size_t i = 0; i + 1 < previous.size(); ++i) m.face(previous[i], previous[i + 1], tip);
        break;
      }
      std::vector<int> now;
      if (b.cone) {  // three sides of a slender prism
        for (int i = 0; i <= 3; ++i) {
          const double a = i % 3 * 2.0943951023931953;
          const glm::dvec3 out = n.side * std::cos(a) + face * std::sin(a);
          now.push_back(m.add(n, n.center + out * n.half_width, out, u_of(s), v_of(0)));
        }
      } else {
        for (const Across& x : section(detail, n)) {
          const glm::dvec3 p = n.center + n.half_width * (x.offset * n.side + x.rise * face);
          const double across = x.offset < 0 ? -1 : x.offset > 0 ? 1 : 0;
          now.push_back(m.add(n, p, face * std::cos(x.lean) + n.side * std::sin(x.lean), u_of(s), v_of(across)));
        }
      }
      for (std::size_t i = 0; !previous.empty() && i + 1 < now.size(); ++i) {
        m.face(previous[i], previous[i + 1], now[i + 1]);
        m.face(previous[i], now[i + 1], now[i]);
      }
      previous = std::move(now);
    }
  }
  return m.finish();
}

std::string blade_mesh(const BladeRibbons& b, const BladeDetail& detail, double unit) {
  const Surface s = blade_surface(b, detail);
  Text t;
  t << "mesh2{vertex_vectors{" << s.position_m.size();
  for (const glm::dvec3& p : s.position_m) t << "," << flip(p, unit);
  t << "}\nnormal_vectors{" << s.normal.size();
  for (const glm::dvec3& n : s.normal) t << "," << flip(n);
  t << "}\nuv_vectors{" << s.uv.size();
  for (const glm::dvec2& uv : s.uv) t << ",<" << uv.x << "," << uv.y << ">";
  t << "}\nface_indices{" << s.triangles.size();
  for (const auto& f : s.triangles) t << ",<" << f[0] << "," << f[1] << "," << f[2] << ">";
  t << "}}\n";
  return t.str();
}

BladeAtlas blade_atlas(const BladeRibbons& b, std::span<const float> sky, const Illumination& light,
                       const glm::dvec3& mean_albedo) {
  BladeAtlas a;
  a.layout = atlas_layout(b.blade_count());
  const std::size_t pixels = std::size_t(a.layout.columns) * a.layout.height();
  a.reflected.resize(pixels);
  a.transmitted.resize(pixels);
  a.ambient.resize(pixels);
  const int n = b.nodes_per_blade, rows = a.layout.rows;
  for (int blade = 0; blade < b.blade_count(); ++blade) {
    Random random(0xb1ade, Stream::noise, std::uint64_t(blade));
    const double ripple = random.uniform(0, 6.28), mottle = random.uniform(0, 6.28);
    for (int x = 0; x < a.layout.columns; ++x) {
      const double s = double(x) / (a.layout.columns - 1), at = s * (n - 1);
      const int k = std::min(int(at), n - 2);
      const float f = float(at - k);
      const std::size_t i = std::size_t(blade) * n + k, j = i + 1;
      const LeafOptics leaf =
          leaf_optics(glm::mix(b.diffuse[i], b.diffuse[j], f),
                      glm::mix(b.chlorophyll_ug_cm2[i], b.chlorophyll_ug_cm2[j], f) / kFreshChlorophyll);
      const double seen = glm::mix(sky[i], sky[j], f);
      const glm::vec3 other(light.sky_rgb * seen + scattered_light(light, mean_albedo, seen));
      for (int r = 0; r < rows; ++r) {
        const double across = rows > 1 ? 2.0 * r / (rows - 1) - 1 : 0;  // -1 .. 1
        // Pale midrib, faint lengthwise veins and mottling: a few per cent, as on real blades.
        const float tone = float(1 + 0.22 * std::exp(-std::pow(across / 0.22, 2)) * (1 - 0.6 * s) +
                                 0.05 * std::sin(9 * across + ripple) + 0.05 * std::sin(11 * s + mottle));
        // POV-Ray's v runs upward, pictures run downward.
        const std::size_t row = std::size_t(a.layout.height() - 1 - (blade * rows + r));
        const std::size_t p = row * a.layout.columns + x;
        a.reflected[p] = leaf.reflectance * tone;
        a.transmitted[p] = leaf.transmittance * tone;
        a.ambient[p] = other * (leaf.reflectance + leaf.transmittance) * (0.5f * tone);
      }
    }
  }
  return a;
}

}  // namespace witherfield::pov
