#include "pov/lit_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "pov/leaf_optics.hpp"
#include "pov/relief.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

using Face = std::array<int, 3>;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

glm::vec3 unit(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : glm::vec3(0, 0, 1);
}

LitVertex middle(const LitVertex& a, const LitVertex& b) {
  return {0.5f * (a.position_m + b.position_m), unit(a.normal + b.normal), 0.5f * (a.local_m + b.local_m), 0.5f * (a.uv + b.uv),
          0.5f * (a.front + b.front),           0.5f * (a.back + b.back),  0.5f * (a.through + b.through),
          0.5f * (a.spread_m + b.spread_m), a.seen || b.seen};
}

/// Mean way of light in tissue: maize endosperm lets yellow and red wander a good millimetre, a dry husk less.
glm::vec3 spread_of(const ObjectLook& look) {
  switch (look.kind) {
    case LookKind::waxy:
      return glm::vec3(0.0013f, 0.0008f, 0.0003f) * float(look.softness);
    case LookKind::grain:
      return glm::vec3(0.0004f, 0.0003f, 0.00015f) * float(look.softness);
    case LookKind::matte:
    case LookKind::leaf:
      break;
  }
  return glm::vec3(0.0f);
}

glm::vec3 colour_at(const SurfaceField& field, int vertex) {
  const float* c = &field.values[3 * at(vertex)];
  return {c[0], c[1], c[2]};
}

/// Every face gets vertices of its own, with its own normal.
void split_faces(LitMesh& m) {
  std::vector<LitVertex> vertices;
  for (Face& t : m.triangles) {
    const glm::vec3 a = m.vertices[at(t[0])].position_m;
    const glm::vec3 n = unit(glm::cross(m.vertices[at(t[1])].position_m - a, m.vertices[at(t[2])].position_m - a));
    for (int& v : t) {
      vertices.push_back(m.vertices[at(v)]);
      vertices.back().normal = n;
      v = static_cast<int>(vertices.size()) - 1;
    }
  }
  m.vertices = std::move(vertices);
}

/// A face with the vertices in the middle of its edges (-1: none); edge k runs from corner k to corner k + 1.
template <class Add>
void split_face(const Face& t, const Face& mid, const Add& add) {
  const int halved = (mid[0] >= 0) + (mid[1] >= 0) + (mid[2] >= 0);
  if (halved == 0) return add(t[0], t[1], t[2]);
  if (halved == 3) {
    for (std::size_t k = 0; k < 3; ++k) add(t[k], mid[k], mid[(k + 2) % 3]);
    return add(mid[0], mid[1], mid[2]);
  }
  // Turn the face so that edge 0 is the one halved edge, or edge 2 the one that is not.
  std::size_t k = 0;
  while (halved == 1 ? mid[k] < 0 : mid[(k + 2) % 3] >= 0) ++k;
  const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = mid[k], bc = mid[(k + 1) % 3];
  if (halved == 1) {
    add(a, ab, c);
    add(ab, b, c);
  } else {
    add(ab, b, bc);
    add(a, ab, bc);
    add(a, bc, c);
  }
}

}  // namespace

const ObjectLook& look_of(const ObjectPlacement& o, int organ) {
  const auto found = o.looks.find(organ);
  return found == o.looks.end() ? o.other_look : found->second;
}

bool halve_long_edges(LitMesh& m, double longest_edge_m, std::size_t max_faces) {
  const auto key = [](int a, int b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
  };
  const float limit = static_cast<float>(longest_edge_m);
  std::unordered_map<std::uint64_t, int> middles;
  std::vector<Face> mid(m.triangles.size(), Face{-1, -1, -1});
  std::size_t faces = m.triangles.size();
  for (std::size_t f = 0; f < mid.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = m.triangles[f][k], b = m.triangles[f][(k + 1) % 3];
      if (!m.vertices[at(a)].seen && !m.vertices[at(b)].seen) continue;
      if (glm::distance(m.vertices[at(a)].position_m, m.vertices[at(b)].position_m) <= limit) continue;
      ++faces;
      const auto [entry, fresh] = middles.try_emplace(key(a, b), static_cast<int>(m.vertices.size()));
      if (fresh) m.vertices.push_back(middle(m.vertices[at(a)], m.vertices[at(b)]));
      mid[f][k] = entry->second;
    }
  if (middles.empty()) return false;
  if (faces > max_faces) {
    m.vertices.resize(m.vertices.size() - middles.size());
    return false;
  }
  LitMesh fine;
  fine.triangles.reserve(faces);
  for (std::size_t f = 0; f < mid.size(); ++f)
    split_face(m.triangles[f], mid[f], [&](int a, int b, int c) {
      fine.triangles.push_back({a, b, c});
      fine.organ.push_back(m.organ[f]);
      fine.base.push_back(m.base[f]);
    });
  m.triangles = std::move(fine.triangles);
  m.organ = std::move(fine.organ);
  m.base = std::move(fine.base);
  return true;
}

LitMesh place_mesh(const ObjectPlacement& o) {
  const Surface& s = *o.surface;
  const SurfaceField& diffuse = s.field("diffuse");
  const SurfaceField* organ = s.has_field("organ_id") ? &s.field("organ_id") : nullptr;
  const SurfaceField* green = s.has_field("chlorophyll_ug_cm2") ? &s.field("chlorophyll_ug_cm2") : nullptr;
  LitMesh m;
  m.triangles = s.triangles;
  std::vector<const ObjectLook*> look(s.position_m.size(), &o.other_look);
  for (std::size_t f = 0; f < s.triangles.size(); ++f) {
    const auto& t = s.triangles[f];
    m.organ.push_back(organ ? int(std::lround(organ->values[organ->on_faces ? f : at(t[0])])) : 0);
    m.base.push_back(int(f));
    for (const int v : t) look[at(v)] = &look_of(o, m.organ.back());
  }
  const auto normals = s.normal.empty() ? vertex_normals(s) : s.normal;
  const glm::dvec3 origin = o.world(glm::dvec3(0.0));
  for (std::size_t v = 0; v < s.position_m.size(); ++v) {
    LitVertex x;
    x.position_m = glm::vec3(o.world(s.position_m[v]));
    x.local_m = glm::vec3(s.position_m[v]);
    x.normal = unit(glm::vec3(o.world(normals[v]) - origin));
    if (!s.uv.empty()) x.uv = glm::vec2(s.uv[v]);
    x.front = colour_at(diffuse, int(v));
    x.spread_m = spread_of(*look[v]) * float(o.scale);
    if (look[v]->kind == LookKind::leaf) {
      m.thin = true;
      const double fresh = green && !green->on_faces ? green->values[v] / kFreshChlorophyll : 1.0;
      x.through = glm::max(glm::vec3(0.0f), glm::min(leaf_optics(x.front, fresh).transmittance, 0.95f - x.front));
      // Spongy tissue with air in it lies on the lower side: paler and greyer.
      x.back = glm::mix(x.front, glm::vec3(0.42f, 0.47f, 0.36f), 0.22f);
    }
    m.vertices.push_back(x);
  }
  if (o.facets)
    split_faces(m);
  else
    raise_veins(m, s, o);
  return m;
}

void refine_mesh(LitMesh& m, const ObjectPlacement& o, double longest_edge_m, std::size_t max_faces) {
  constexpr int kRounds = 24;  // edges that no halving shortens (coordinates of few digits left) end here
  for (int round = 0; round < kRounds && halve_long_edges(m, longest_edge_m, max_faces); ++round) {
  }
  if (!o.facets) add_relief(m, o);
}

}  // namespace witherfield::pov
