#include "sim/fruit/organ.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/core/parallel.hpp"

namespace witherfield::fruit {
namespace {

/// Refined paint of every shape that occurs.
std::vector<std::vector<Paint>> refine_paint(const Fruit& fruit) {
  std::vector<std::vector<Paint>> paint;
  for (std::size_t s = 0; s < fruit.shapes->size(); ++s) {
    const Refinement& r = (*fruit.refinements)[s];
    paint.emplace_back(r.vertices());
    r.evaluate(std::span<const glm::vec3>((*fruit.shapes)[s].paint), std::span<glm::vec3>(paint.back()));
  }
  return paint;
}

glm::vec3 coat_colour(const Coat& coat, const Paint& p) {
  const float y = std::clamp(p.y, 0.0f, 1.0f) * 2;
  const glm::vec3 along =
      y < 1 ? glm::mix(coat.along[0], coat.along[1], y) : glm::mix(coat.along[1], coat.along[2], y - 1);
  const glm::vec3 c = glm::mix(along, coat.mark, std::clamp(p.z, 0.0f, 1.0f));
  // Two slow waves over the organ, with the organ's own phase.
  const float wave = std::sin(3.1f * p.x + 5.3f * p.y + coat.mottle_phase) *
                     std::cos(7.9f * p.y - 2.3f * p.x + 1.7f * coat.mottle_phase);
  // At -90, -45, 0, 45, 90 degrees round the organ.
  const float nerve =
      std::cos(8.0f * std::asin(std::clamp(p.x, -1.0f, 1.0f))) * std::min(1.0f, 6.0f * (1.0f - 0.5f * y));
  return glm::clamp(c * (1.0f + coat.mottle * wave + coat.nerves * nerve), 0.0f, 1.0f);
}

void accumulate_normals(std::span<const glm::dvec3> position, std::span<const std::array<int, 3>> faces,
                        int first_vertex, std::span<glm::dvec3> normal) {
  for (const auto& t : faces) {
    const std::size_t a = std::size_t(t[0] - first_vertex), b = std::size_t(t[1] - first_vertex),
                      c = std::size_t(t[2] - first_vertex);
    const glm::dvec3 n = glm::cross(position[b] - position[a], position[c] - position[a]);
    normal[a] += n;
    normal[b] += n;
    normal[c] += n;
  }
  for (glm::dvec3& n : normal) {
    const double length = glm::length(n);
    n = length > 0 ? n / length : glm::dvec3(0, 0, 1);
  }
}

}  // namespace

const char* organ_name(OrganKind kind) {
  constexpr const char* names[] = {"stem",     "wedge", "kernel", "glume", "lemma", "awn", "cob",
                                   "cob_bump", "shank", "body",   "sepal", "style", "mesh"};
  return names[int(kind)];
}

OrganRanges organ_ranges(const Fruit& fruit, std::size_t first, std::size_t last) {
  OrganRanges l{{0}, {0}};
  for (std::size_t i = first; i < last; ++i) {
    const Refinement& r = (*fruit.refinements)[std::size_t(fruit.organs[i].shape)];
    l.vertex.push_back(l.vertex.back() + r.vertices());
    l.face.push_back(l.face.back() + r.faces());
  }
  return l;
}

Surface mesh_organs(const Fruit& fruit, std::size_t first, std::size_t last) {
  const OrganRanges layout = organ_ranges(fruit, first, last);
  const auto paint = refine_paint(fruit);
  Surface s;
  s.position_m.resize(layout.vertex.back());
  s.normal.resize(layout.vertex.back());
  s.uv.resize(layout.vertex.back());
  s.triangles.resize(layout.face.back());
  for (const char* name : {"organ_id", "kernel_id", "sharpness", "diffuse", "water", "moisture_wb"})
    s.make_field(name);
  const auto values = [&](const char* name) { return s.make_field(name).values.data(); };
  float *organ_id = values("organ_id"), *kernel_id = values("kernel_id"), *sharpness = values("sharpness"),
        *diffuse = values("diffuse"), *water = values("water"), *moisture = values("moisture_wb");

  parallel_for(last - first, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Organ& organ = fruit.organs[first + i];
      const Refinement& r = (*fruit.refinements)[std::size_t(organ.shape)];
      const std::size_t v0 = layout.vertex[i], f0 = layout.face[i], n = r.vertices();
      const std::span<glm::dvec3> position(s.position_m.data() + v0, n), normal(s.normal.data() + v0, n);
      r.evaluate(std::span<const glm::dvec3>(organ.control_m), position);
      for (std::size_t f = 0; f < r.faces(); ++f) {
        auto t = r.triangles()[f];
        if (organ.mirrored) std::swap(t[1], t[2]);
        for (int& v : t) v += int(v0);
        s.triangles[f0 + f] = t;
      }
      accumulate_normals(position, {s.triangles.data() + f0, r.faces()}, int(v0), normal);
      for (std::size_t v = 0; v < n; ++v) {
        const Paint& p = paint[std::size_t(organ.shape)][v];
        const glm::vec3 c = coat_colour(organ.coat, p);
        const std::size_t at = v0 + v;
        s.uv[at] = {0.5 * (double(p.x) + 1), double(p.y)};
        organ_id[at] = float(organ.kind);
        kernel_id[at] = float(organ.kernel);
        sharpness[at] = float(r.rules()[v]);
        for (int k = 0; k < 3; ++k) diffuse[3 * at + std::size_t(k)] = c[k];
        water[at] = organ.coat.water;
        moisture[at] = organ.coat.moisture_wb;
      }
    }
  });
  return s;
}

double enclosed_volume_m3(const Surface& s, std::size_t begin, std::size_t end) {
  if (begin == end) return 0;
  // About a vertex of the shell: far from the origin nothing is lost to rounding.
  const glm::dvec3 o = s.position_m[std::size_t(s.triangles[begin][0])];
  double six = 0;
  for (std::size_t f = begin; f < end; ++f) {
    const auto& t = s.triangles[f];
    const glm::dvec3 a = s.position_m[std::size_t(t[0])] - o, b = s.position_m[std::size_t(t[1])] - o,
                     c = s.position_m[std::size_t(t[2])] - o;
    six += glm::dot(a, glm::cross(b, c));
  }
  return six / 6;
}

double area_m2(const Surface& s, std::size_t begin, std::size_t end) {
  double twice = 0;
  for (std::size_t f = begin; f < end; ++f) {
    const auto& t = s.triangles[f];
    const glm::dvec3 &a = s.position_m[std::size_t(t[0])], &b = s.position_m[std::size_t(t[1])],
                     &c = s.position_m[std::size_t(t[2])];
    twice += glm::length(glm::cross(b - a, c - a));
  }
  return twice / 2;
}

}  // namespace witherfield::fruit
