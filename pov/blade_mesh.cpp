#include "pov/blade_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pov/text.hpp"
#include "sim/core/random.hpp"

namespace witherfield::pov {
namespace {

/// One node, interpolated at arc s.
struct Node {
  glm::dvec3 center, tangent, side;
  double half_width, fold, thickness;
};

Node node_at(const BladeRibbons& b, int blade, double s) {
  const int n = b.nodes_per_blade;
  const double x = std::clamp(s, 0.0, 1.0) * (n - 1);
  const int k = std::min(int(x), n - 2);
  const double f = x - k;
  const std::size_t i = std::size_t(blade) * n + k, j = i + 1;
  Node node;
  node.center = glm::mix(b.center_m[i], b.center_m[j], f);
  node.tangent = glm::normalize(glm::dvec3(glm::mix(b.tangent[i], b.tangent[j], float(f))));
  const glm::dvec3 side(glm::mix(b.side[i], b.side[j], float(f)));
  node.side = glm::normalize(side - node.tangent * glm::dot(side, node.tangent));
  const auto mix = [&](const std::vector<float>& v) { return v[i] * (1 - f) + v[j] * f; };
  node.half_width = mix(b.half_width_m);
  node.fold = b.fold_rad.empty() ? 0.0 : mix(b.fold_rad);
  node.thickness = b.thickness_m.empty() ? 0.0 : mix(b.thickness_m);
  return node;
}

struct MeshText {
  Text points, normals, uvs, faces;
  int count = 0, face_count = 0;
  double unit;

  int add(const glm::dvec3& p, const glm::dvec3& n, double u, double v) {
    points << "," << flip(p, unit);
    normals << "," << flip(n);
    uvs << ",<" << u << "," << v << ">";
    return count++;
  }
  void face(int a, int b, int c) {
    faces << ",<" << a << "," << b << "," << c << ">";
    ++face_count;
  }
  std::string str() const {
    Text t;
    t << "mesh2{vertex_vectors{" << count << points.str() << "}\nnormal_vectors{" << count << normals.str()
      << "}\nuv_vectors{" << count << uvs.str() << "}\nface_indices{" << face_count << faces.str() << "}}\n";
    return t.str();
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

std::string blade_mesh(const BladeRibbons& b, const BladeDetail& detail, double unit) {
  MeshText m;
  m.unit = unit;
  const AtlasLayout layout = atlas_layout(b.blade_count());
  const auto u_of = [&](double s) { return (0.5 + s * (layout.columns - 1)) / layout.columns; };
  for (int blade = 0; blade < b.blade_count(); ++blade) {
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
        const int tip = m.add(n.center, face, u_of(s), v_of(0));
        for (std::size_t i = 0; i + 1 < previous.size(); ++i) m.face(previous[i], previous[i + 1], tip);
        break;
      }
      std::vector<int> now;
      if (b.cone) {  // three sides of a slender prism
        for (int i = 0; i <= 3; ++i) {
          const double a = i * 2.0943951023931953;
          const glm::dvec3 out = n.side * std::cos(a) + face * std::sin(a);
          now.push_back(m.add(n.center + out * n.half_width, out, u_of(s), v_of(0)));
        }
      } else {
        for (const Across& x : section(detail, n)) {
          const glm::dvec3 p = n.center + n.half_width * (x.offset * n.side + x.rise * face);
          now.push_back(m.add(p, face * std::cos(x.lean) + n.side * std::sin(x.lean), u_of(s),
                              v_of(x.offset < 0   ? -1
                                   : x.offset > 0 ? 1
                                                  : 0)));
        }
      }
      for (std::size_t i = 0; !previous.empty() && i + 1 < now.size(); ++i) {
        m.face(previous[i], previous[i + 1], now[i + 1]);
        m.face(previous[i], now[i + 1], now[i]);
      }
      previous = std::move(now);
    }
  }
  return m.str();
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
