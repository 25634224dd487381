// Picking handles, and edits that a scene file scripts.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "sim/core/errors.hpp"
#include "sim/leaf/edit_walk.hpp"

namespace witherfield::leaf {
namespace {

constexpr std::size_t kPatch = 16;      // vertices that hold a patch: enough to keep its turn
constexpr double kStepShare = 0.04;     // of the leaf's size that a handle moves at once in the rotation-aware mode

std::string named(const HandleOptions& h, std::size_t number) {
  return "edit.handles[" + std::to_string(number) + "]" + (h.name.empty() ? "" : " '" + h.name + "'");
}

/// Vertices within the radius, thinned to kPatch that lie far from one another (the picked one first).
std::vector<int> patch(const std::vector<glm::dvec3>& position, int centre, double radius) {
  std::vector<int> inside, chosen{centre};
  std::vector<double> distance;
  for (std::size_t v = 0; v < position.size(); ++v) {
    const double d = glm::distance(position[v], position[std::size_t(centre)]);
    if (d > radius || int(v) == centre) continue;
    inside.push_back(int(v));
    distance.push_back(d);
  }
  while (chosen.size() < kPatch && !inside.empty()) {
    const std::size_t far = std::size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (!(distance[far] > 0)) break;
    chosen.push_back(inside[far]);
    for (std::size_t i = 0; i < inside.size(); ++i)
      distance[i] = std::min(distance[i], glm::distance(position[std::size_t(inside[i])], position[std::size_t(chosen.back())]));
  }
  return chosen;
}

}  // namespace

int nearest_vertex(std::span<const glm::dvec3> position_m, const glm::dvec3& point_m) {
  if (position_m.empty()) throw InvalidInput("nearest_vertex: the leaf has no vertex");
  std::size_t best = 0;
  for (std::size_t v = 1; v < position_m.size(); ++v)
    if (glm::distance(position_m[v], point_m) < glm::distance(position_m[best], point_m)) best = v;
  return int(best);
}

int vertex_at_uv(const Surface& s, const glm::dvec2& uv) {
  if (s.uv.empty()) throw InvalidInput("vertex_at_uv: the surface has no texture coordinates");
  std::size_t best = 0;
  for (std::size_t v = 1; v < s.uv.size(); ++v)
    if (glm::distance(s.uv[v], uv) < glm::distance(s.uv[best], uv)) best = v;
  return int(best);
}

EditWalk::EditWalk(LeafEditor& editor, const EditOptions& options)
    : editor_(&editor), mode_(options.mode), max_iterations_(options.max_iterations), tolerance_(options.tolerance) {
  const Surface& leaf = editor.leaf();
  std::vector<Handle> handles;
  for (std::size_t i = 0; i < options.handles.size(); ++i) {
    const HandleOptions& h = options.handles[i];
    centre_.push_back(h.by_uv ? vertex_at_uv(leaf, h.uv) : nearest_vertex(leaf.position_m, h.point_m));
    for (const int v : h.radius_m > 0 ? patch(leaf.position_m, centre_[i], h.radius_m) : std::vector<int>{centre_[i]}) {
      const auto taken = std::find(held_.begin(), held_.end(), v);
      if (taken != held_.end()) {
        const std::size_t other = owner_[std::size_t(taken - held_.begin())];
        throw InvalidInput(named(h, i) + " picks vertex " + std::to_string(v) + ", which " +
                           named(options.handles[other], other) + " holds already; move it or make its radius_m smaller");
      }
      handles.push_back({v, h.weight});
      held_.push_back(v);
      owner_.push_back(i);
      home_.push_back(leaf.position_m[std::size_t(v)]);
    }
  }
  editor.set_mode(mode_);
  editor.reset();
  editor.set_handles(std::move(handles));
  now_ = home_;
  glm::dvec3 low = leaf.position_m[0], high = low;
  for (const glm::dvec3& p : leaf.position_m) low = glm::min(low, p), high = glm::max(high, p);
  step_m_ = kStepShare * glm::distance(low, high);
}

std::vector<glm::dvec3> EditWalk::targets(std::span<const glm::dvec3> move) const {
  if (move.size() != centre_.size())
    throw InvalidInput("edit: " + std::to_string(move.size()) + " moves for " + std::to_string(centre_.size()) + " handles");
  std::vector<glm::dvec3> goal(home_);
  for (std::size_t i = 0; i < goal.size(); ++i) goal[i] += move[owner_[i]];
  return goal;
}

void EditWalk::go(std::span<const glm::dvec3> move) {
  const std::vector<glm::dvec3> goal = targets(move), start(now_);
  double longest = 0;
  for (std::size_t i = 0; i < goal.size(); ++i) longest = std::max(longest, glm::distance(goal[i], now_[i]));
  // Long ways in several drags: rotations then follow; only the last one must be exact.
  const int drags = mode_ == EditMode::linear ? 1 : std::max(1, int(std::ceil(longest / step_m_)));
  for (int d = 1; d <= drags; ++d) {
    const double t = double(d) / drags;
    for (std::size_t i = 0; i < now_.size(); ++i) now_[i] = d == drags ? goal[i] : (1 - t) * start[i] + t * goal[i];
    editor_->set_iterations(d == drags ? max_iterations_ : std::min(8, max_iterations_), tolerance_);
    editor_->drag(now_);
  }
}

void EditWalk::follow(std::span<const glm::dvec3> move, int iterations) {
  now_ = targets(move);
  editor_->set_iterations(iterations, tolerance_);
  editor_->drag(now_);
}

namespace {

void require_moves(const EditOptions& options) {
  for (std::size_t k = 0; k < options.keys.size(); ++k)
    if (options.keys[k].move_m.size() != options.handles.size())
      throw InvalidInput("edit.keys[" + std::to_string(k) + "]: " + std::to_string(options.keys[k].move_m.size()) + " moves for " +
                         std::to_string(options.handles.size()) + " handles");
}

}  // namespace

void require_edit(const LeafModel& model, const EditOptions& options) {
  if (options.keys.empty()) return;
  require_moves(options);
  LeafEditor editor(model.natural, options);
  EditWalk(editor, options);
}

void run_edit(const LeafModel& model, const EditOptions& options, const std::function<void(const EditFrame&)>& sink) {
  if (options.keys.empty()) return;
  require_moves(options);
  LeafEditor editor(model.natural, options);
  EditWalk walk(editor, options);
  for (std::size_t k = 0; k < options.keys.size(); ++k) {
    const EditKey& key = options.keys[k];
    walk.go(key.move_m);
    sink({int(k), &key, &editor.positions(), editor.report(), editor.iterations()});
  }
}

}  // namespace witherfield::leaf
