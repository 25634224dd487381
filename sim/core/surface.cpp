#include "sim/core/surface.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"

namespace witherfield {
namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_length(std::size_t length, std::size_t wanted, const std::string& what) {
  if (length != wanted)
    throw InvalidInput("surface: " + what + " has " + std::to_string(length) + " values, must have " +
                       std::to_string(wanted));
}

}  // namespace

bool Surface::has_field(std::string_view name) const {
  return std::any_of(fields.begin(), fields.end(), [&](const SurfaceField& f) { return f.name == name; });
}

const SurfaceField& Surface::field(std::string_view name) const {
  field_spec(name);
  for (const SurfaceField& f : fields)
    if (f.name == name) return f;
  throw InvalidInput("surface: it has no field '" + std::string(name) + "'");
}

SurfaceField& Surface::make_field(std::string_view name, bool on_faces) {
  const FieldSpec& spec = field_spec(name);
  for (SurfaceField& f : fields)
    if (f.name == name) return f;
  const std::size_t items = on_faces ? triangles.size() : position_m.size();
  fields.push_back({std::string(name), on_faces, std::vector<float>(items * std::size_t(spec.components))});
  return fields.back();
}

void Surface::validate() const {
  const int n = int(position_m.size());
  for (std::size_t i = 0; i < position_m.size(); ++i)
    if (!finite(position_m[i])) throw InvalidInput("surface: vertex " + std::to_string(i) + " is not finite");
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (const int v : triangles[f])
      if (v < 0 || v >= n)
        throw InvalidInput("surface: triangle " + std::to_string(f) + " names vertex " + std::to_string(v) +
                           ", there are " + std::to_string(n));
  if (!normal.empty()) check_length(normal.size(), position_m.size(), "normal");
  if (!uv.empty()) check_length(uv.size(), position_m.size(), "uv");
  for (const SurfaceField& f : fields)
    check_length(
        f.values.size(),
        (f.on_faces ? triangles.size() : position_m.size()) * std::size_t(field_spec(f.name).components),
        "field '" + f.name + "'");
}

std::vector<glm::dvec3> vertex_normals(const Surface& s) {
  std::vector<glm::dvec3> normals(s.position_m.size(), glm::dvec3(0.0));
  for (const auto& t : s.triangles) {
    const glm::dvec3 &a = s.position_m[std::size_t(t[0])], &b = s.position_m[std::size_t(t[1])],
                     &c = s.position_m[std::size_t(t[2])];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    for (const int v : t) normals[std::size_t(v)] += n;
  }
  for (glm::dvec3& n : normals) {
    const double length = glm::length(n);
    n = length > 0 ? n / length : glm::dvec3(0, 0, 1);
  }
  return normals;
}

void append(Surface& whole, const Surface& part) {
  const std::size_t vertices = whole.position_m.size(), faces = whole.triangles.size();
  const bool first = vertices == 0;
  for (const SurfaceField& f : part.fields) whole.make_field(f.name, f.on_faces);
  whole.position_m.insert(whole.position_m.end(), part.position_m.begin(), part.position_m.end());
  for (auto t : part.triangles) {
    for (int& v : t) v += int(vertices);
    whole.triangles.push_back(t);
  }
  if (!whole.normal.empty() || (first && !part.normal.empty())) {
    const auto normals = part.normal.empty() ? vertex_normals(part) : part.normal;
    whole.normal.insert(whole.normal.end(), normals.begin(), normals.end());
  }
  if (!whole.uv.empty() || (first && !part.uv.empty())) {
    whole.uv.resize(vertices);
    whole.uv.insert(whole.uv.end(), part.uv.begin(), part.uv.end());
    whole.uv.resize(whole.position_m.size());
  }
  for (SurfaceField& f : whole.fields) {
    const std::size_t components = std::size_t(field_spec(f.name).components);
    f.values.resize((f.on_faces ? faces : vertices) * components);
    if (part.has_field(f.name)) {
      const auto& values = part.field(f.name).values;
      f.values.insert(f.values.end(), values.begin(), values.end());
    }
    f.values.resize((f.on_faces ? whole.triangles.size() : whole.position_m.size()) * components);
  }
}

Surface keep_faces(const Surface& s, const std::function<bool(std::size_t)>& keep) {
  std::vector<std::size_t> faces, vertices;
  std::vector<int> number(s.position_m.size(), -1);
  for (std::size_t f = 0; f < s.triangles.size(); ++f) {
    if (!keep(f)) continue;
    faces.push_back(f);
    for (const int v : s.triangles[f]) number[std::size_t(v)] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = int(vertices.size());
      vertices.push_back(v);
    }
  const auto picked = [&](const auto& values) {
    auto out = values;
    out.clear();
    if (!values.empty())
      for (const std::size_t v : vertices) out.push_back(values[v]);
    return out;
  };
  Surface out;
  out.position_m = picked(s.position_m);
  out.normal = picked(s.normal);
  out.uv = picked(s.uv);
  for (const std::size_t f : faces) {
    auto t = s.triangles[f];
    for (int& v : t) v = number[std::size_t(v)];
    out.triangles.push_back(t);
  }
  for (const SurfaceField& f : s.fields) {
    const auto components = std::ptrdiff_t(field_spec(f.name).components);
    SurfaceField& to = out.fields.emplace_back(SurfaceField{f.name, f.on_faces, {}});
    for (const std::size_t i : f.on_faces ? faces : vertices) {
      const auto at = f.values.begin() + std::ptrdiff_t(i) * components;
      to.values.insert(to.values.end(), at, at + components);
    }
  }
  return out;
}

TriMesh to_tri_mesh(const Surface& s, bool split_non_manifold) {
  TriMesh mesh;
  mesh.reserve(s.position_m.size(), s.triangles.size() * 3 / 2, s.triangles.size());
  const auto add = [&](int v) {
    const glm::dvec3& p = s.position_m[std::size_t(v)];
    return mesh.add_vertex(TriMesh::Point(p.x, p.y, p.z));
  };
  for (std::size_t v = 0; v < s.position_m.size(); ++v) add(int(v));
  // OpenMesh prints a complaint when it is given a complex edge: ask first.
  const auto fits = [&](const std::array<int, 3>& t) {
    for (int k = 0; k < 3; ++k) {
      const auto a = mesh.vertex_handle(unsigned(t[std::size_t(k)])),
                 b = mesh.vertex_handle(unsigned(t[std::size_t(k + 1) % 3]));
      if (a == b || !mesh.is_boundary(a)) return false;
      const auto edge = mesh.find_halfedge(a, b);
      if (edge.is_valid() && !mesh.is_boundary(edge)) return false;
    }
    return true;
  };
  for (std::size_t f = 0; f < s.triangles.size(); ++f) {
    const auto& t = s.triangles[f];
    TriMesh::FaceHandle face;
    if (fits(t))
      face = mesh.add_face(mesh.vertex_handle(unsigned(t[0])), mesh.vertex_handle(unsigned(t[1])),
                           mesh.vertex_handle(unsigned(t[2])));
    if (face.is_valid()) continue;
    if (!split_non_manifold)
      throw InvalidInput("surface: triangle " + std::to_string(f) +
                         " makes a non-manifold edge or vertex, or names a vertex twice");
    mesh.add_face(add(t[0]), add(t[1]), add(t[2]));
  }
  return mesh;
}

Surface to_surface(const TriMesh& mesh) {
  Surface s;
  s.position_m.reserve(mesh.n_vertices());
  s.triangles.reserve(mesh.n_faces());
  for (const auto v : mesh.vertices()) {
    const TriMesh::Point& p = mesh.point(v);
    s.position_m.push_back({p[0], p[1], p[2]});
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> t{};
    int k = 0;
    for (const auto v : mesh.fv_range(f)) t[std::size_t(k++)] = v.idx();
    s.triangles.push_back(t);
  }
  return s;
}

}  // namespace witherfield
