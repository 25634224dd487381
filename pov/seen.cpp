#include "pov/seen.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

TriangleTree tree_of(std::span<const LitMesh> placed, std::vector<int>& first) {
  std::vector<glm::vec3> positions;
  std::vector<std::array<int, 3>> triangles;
  for (const LitMesh& m : placed) {
    first.push_back(int(triangles.size()));
    const int base = int(positions.size());
    for (const LitVertex& v : m.vertices) positions.push_back(v.position_m);
    for (const auto& t : m.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  first.push_back(int(triangles.size()));
  return TriangleTree(positions, triangles);
}

}  // namespace

SceneTree::SceneTree(std::span<const LitMesh> placed) : tree(tree_of(placed, first)) {
  faces = first.back();
  first.pop_back();
}

View::View(const Still& still) {
  const Camera& c = still.camera;
  position_ = glm::vec3(c.position_m);
  ahead_ = glm::vec3(glm::normalize(c.look_at_m - c.position_m));
  const glm::vec3 up = std::abs(ahead_.z) < 0.999999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  right_ = glm::normalize(glm::cross(ahead_, up));
  up_ = glm::cross(right_, ahead_);
  wide_ = float(std::tan(c.fov_deg * 0.00872664626));
  high_ = wide_ * float(still.height_px) / float(still.width_px);
  pixel_ = 2 * wide_ / float(still.width_px);
}

bool View::contains(const glm::vec3& point) const {
  const glm::vec3 d = point - position_;
  const float far = glm::dot(d, ahead_) * 1.04f;
  return far > 0 && std::abs(glm::dot(d, right_)) < wide_ * far && std::abs(glm::dot(d, up_)) < high_ * far;
}

double View::pixel_m(const glm::vec3& point) const {
  return pixel_ * std::max(glm::dot(point - position_, ahead_), 1e-6f);
}

void mark_seen(LitMesh& m, const SceneTree& tree, const View& view) {
  const auto visible = [&](const glm::vec3& p) {
    if (!view.contains(p)) return false;
    glm::vec3 d = view.position() - p;
    const float distance = glm::length(d);
    d /= distance;
    // From the camera's side, a third of a pixel off the surface.
    return !tree.tree.blocked(p + d * float(0.3 * view.pixel_m(p)), d, distance);
  };
  std::vector<char> seen(m.triangles.size(), 0);
  parallel_for(seen.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      glm::vec3 p[3], middle(0.0f);
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = m.vertices[std::size_t(m.triangles[f][k])].position_m;
        middle += p[k] / 3.0f;
      }
      const float longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
      // A large face may show where none of its corners does.
      seen[f] = longest > 8 * view.pixel_m(middle) || visible(middle) || visible(p[0]) || visible(p[1]) || visible(p[2]);
    }
  });
  for (LitVertex& v : m.vertices) v.seen = false;
  for (std::size_t f = 0; f < seen.size(); ++f)
    if (seen[f])
      for (const int v : m.triangles[f]) m.vertices[std::size_t(v)].seen = true;
  // One ring more.
  std::vector<char> wider(m.vertices.size(), 0);
  for (const auto& t : m.triangles)
    if (m.vertices[std::size_t(t[0])].seen || m.vertices[std::size_t(t[1])].seen || m.vertices[std::size_t(t[2])].seen)
      for (const int v : t) wider[std::size_t(v)] = 1;
  for (std::size_t v = 0; v < wider.size(); ++v) m.vertices[v].seen = wider[v];
}

}  // namespace witherfield::pov
