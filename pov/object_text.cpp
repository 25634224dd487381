#include "pov/object_text.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "pov/text.hpp"

namespace witherfield::pov {
namespace {

std::string rgb(const glm::dvec3& c) {
  return (Text() << "rgb" << c).str();
}

std::string box_text(const Softbox& b, double unit) {
  const auto corner = [&](double x, double y) { return flip(b.center_m + x * b.side_a_m + y * b.side_b_m, unit); };
  const glm::dvec3 low_left = corner(-0.5, -0.5), low_right = corner(0.5, -0.5), high_right = corner(0.5, 0.5),
                   high_left = corner(-0.5, 0.5);
  Text t;
  // No material here sends diffuse light back: the light source makes highlights only.
  t << "light_source{" << flip(b.center_m, unit) << " " << rgb(b.colour) << " area_light "
    << flip(b.side_a_m, unit) << "," << flip(b.side_b_m, unit) << ",3,3 adaptive 0 area_illumination on}\n"
    << "mesh{triangle{" << low_left << "," << low_right << "," << high_right << "} triangle{" << low_left << ","
    << high_right << "," << high_left << "} pigment{rgb 1} finish{diffuse 0 emission " << rgb(b.radiance)
    << "} no_shadow no_image}\n";
  return t.str();
}

}  // namespace

std::string studio_text(const Studio& s, double unit) {
  const auto ring = [&](double height) { return rgb(s.room(glm::dvec3(std::sqrt(1 - height * height), 0, height))); };
  Text t;
  t << "global_settings{assumed_gamma 1.0 max_trace_level 4}\n"
    << "sky_sphere{pigment{gradient y color_map{[0 " << rgb(s.nadir) << "][0.375 " << rgb(s.nadir) << "][0.5 " << ring(0)
    << "][1 " << ring(1) << "]} scale 2 translate -y}}\n";
  for (const Softbox& b : s.boxes) t << box_text(b, unit);
  return t.str();
}

namespace {

/// `corner(face, k)` writes one texture coordinate.
template <class Corner>
std::string mesh_with(const LitMesh& m, std::span<const int> faces, double unit, const Corner& write_corner) {
  std::vector<int> number(m.vertices.size(), -1);
  Text points, normals, corners, indices, uv_indices;
  int vertices = 0, corner = 0;
  for (const int f : faces) {
    const auto& t = m.triangles[std::size_t(f)];
    for (const int v : t) {
      int& n = number[std::size_t(v)];
      if (n >= 0) continue;
      n = vertices++;
      points << "," << flip(glm::dvec3(m.vertices[std::size_t(v)].position_m), unit);
      normals << "," << flip(glm::dvec3(m.vertices[std::size_t(v)].normal));
    }
    for (const int k : {0, 1, 2}) write_corner(corners, std::size_t(f), k);
    indices << ",<" << number[std::size_t(t[0])] << "," << number[std::size_t(t[1])] << "," << number[std::size_t(t[2])] << ">";
    uv_indices << ",<" << corner << "," << corner + 1 << "," << corner + 2 << ">";
    corner += 3;
  }
  Text out;
  out << "mesh2{vertex_vectors{" << vertices << points.str() << "}\nnormal_vectors{" << vertices << normals.str()
      << "}\nuv_vectors{" << corner << corners.str() << "}\nface_indices{" << faces.size() << indices.str()
      << "}\nuv_indices{" << faces.size() << uv_indices.str() << "}}\n";
  return out.str();
}

}  // namespace

std::string mesh2_text(const LitMesh& m, std::span<const int> faces, const FaceAtlas& atlas, double unit) {
  return mesh_with(m, faces, unit, [&](Text& out, std::size_t face, int k) {
    const glm::ivec2 uv = atlas.corner(face, k);
    out << ",<" << uv.x << "," << uv.y << ">";
  });
}

std::string mesh2_text(const LitMesh& m, std::span<const int> faces, double unit) {
  return mesh_with(m, faces, unit, [&](Text& out, std::size_t face, int k) {
    const glm::vec2 uv = m.vertices[std::size_t(m.triangles[face][std::size_t(k)])].uv;
    out << ",<" << double(uv.x) << "," << double(uv.y) << ">";
  });
}

std::string skin_text(const std::string& front, const std::string& back) {
  const std::string glow = (Text() << "} finish{diffuse 0 emission " << kFullGlow << "}}\n").str();
  return "texture{pigment{" + front + glow + "interior_texture{pigment{" + back + glow;
}

std::string look_text(const ObjectLook& look, const std::string& front, const std::string& back) {
  const auto texture = [&](const char* head, const std::string& pigment, const std::string& rest) {
    return (Text() << head << "{pigment{" << pigment << "} " << rest << "}\n").str();
  };
  const std::string glow = (Text() << "finish{diffuse 0 emission " << kFullGlow).str();
  const auto sheen = [&](double specular, double roughness) {
    return (Text() << glow << " specular " << specular * look.gloss << " roughness " << roughness).str();
  };
  const auto bumps = [&](double height, double wave_mm) {
    return (Text() << "normal{bumps " << height * look.relief << " scale " << wave_mm << "} ").str();
  };
  switch (look.kind) {
    case LookKind::grain:
      return texture("texture", front, sheen(0.10, 0.05) + "}");
    case LookKind::waxy:
      return texture("texture", front,
                     bumps(0.06, 0.5) + sheen(0.10, 0.02) +
                         (Text() << " reflection{0," << std::min(1.0, 0.9 * look.gloss) << " fresnel on}}").str()) +
             "interior{ior 1.45}\n";
    case LookKind::leaf:
      return texture("texture", front, bumps(0.15, 0.6) + sheen(0.08, 0.03) + "}") +
             texture("interior_texture", back, bumps(0.15, 0.6) + sheen(0.03, 0.08) + "}");
    case LookKind::matte:
      break;
  }
  return texture("texture", front, glow + "}");
}

}  // namespace witherfield::pov
