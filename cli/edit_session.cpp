#include "cli/edit_session.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>

#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

using leaf::OutlinePoints;
using Positions = EditSession::Positions;

constexpr double kMoveGrain_m = 1e-7;       // moves are rounded to it: short numbers in the scene file
constexpr double kHoldShare = 0.035;        // radius of the handle at the petiole over the main vein's length
constexpr std::size_t kUndoSteps = 200;
constexpr std::size_t kUndoModels = 8;      // of them keep their mesh; older ones build it again
constexpr double kGripShare = 0.012;        // radius of a new handle, likewise: a single vertex would be drawn out to a spike

std::vector<glm::dvec3>& points_of(OutlinePoints& p, OutlineGroup group) {
  return group == OutlineGroup::left ? p.left_m : group == OutlineGroup::right ? p.right_m : p.midrib_m;
}
bool same(const OutlinePoints& a, const OutlinePoints& b) {
  return a.left_m == b.left_m && a.right_m == b.right_m && a.midrib_m == b.midrib_m;
}

/// The points as they come back from a file: what is shown is built of the very numbers that are saved.
OutlinePoints as_saved(const OutlinePoints& p) { return leaf::parse_outline_csv(leaf::outline_csv(p), "outline points"); }

/// Those of the construction's first stage; base and tip stand in the midrib only.
OutlinePoints points_of_model(const leaf::LeafModel& model) {
  OutlinePoints p;
  const leaf::Stage& stage = model.stages.front();
  for (std::size_t g = 0; g < 3; ++g)
    for (const int v : stage.lines[g])
      points_of(p, OutlineGroup(g)).push_back(stage.surface.position_m[std::size_t(v)]);
  for (auto* side : {&p.left_m, &p.right_m}) {
    side->erase(side->begin());
    side->pop_back();
  }
  return p;
}

/// A leaf whose mesh is made in a few milliseconds.
leaf::LeafOptions coarse(leaf::LeafOptions o) {
  const double length = o.main_vein_m;
  o.mesh.edge_m = std::max(o.mesh.edge_m, length / 14);
  o.mesh.vein_edge_m = std::max(o.mesh.vein_edge_m, length / 28);
  o.mesh.outline_spacing_m = std::max(o.mesh.outline_spacing_m, length / 80);
  o.veins.net_spacing_m = 0;
  o.pose.apply = false;
  o.petiole_m = 0;
  return o;
}

/// Where the leaf of some points lies: measured points come in any place, the model's base lies in the origin and its tip
/// on +x.
struct PlaneFrame {
  glm::dvec2 origin{0.0}, x{1, 0};
  glm::dvec3 operator()(const glm::dvec3& p) const {
    return {origin.x + x.x * p.x - x.y * p.y, origin.y + x.y * p.x + x.x * p.y, 0};
  }
};

double to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, glm::dvec2& nearest) {
  const glm::dvec2 along = b - a;
  const double square = glm::dot(along, along), t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
  nearest = a + t * along;
  return glm::distance(p, nearest);
}

struct State {
  leaf::EditOptions edit;
  OutlinePoints points;
  std::shared_ptr<const leaf::LeafModel> model;  ///< null: to be built again
  std::shared_ptr<const Positions> position;
  long revision = 0;
};

}  // namespace

struct EditSession::Impl {
  scene::LeafScene scene;
  leaf::LeafInput input;
  State now, opened;
  std::vector<State> past, future;
  std::optional<State> start;  ///< of the gesture under way
  bool touched = false, points_touched = false;
  long revisions = 0, saved = 0;
  std::unique_ptr<leaf::LeafModel> sketch;  ///< coarse, while points move
  std::shared_ptr<const leaf::LeafModel> live_model;
  std::unique_ptr<leaf::LeafEditor> live;
  std::unique_ptr<leaf::EditWalk> walk;

  std::vector<glm::dvec3>& moves() { return now.edit.keys.back().move_m; }
  const glm::dvec3& home(int vertex) const { return now.model->natural.position_m[std::size_t(vertex)]; }

  leaf::LeafModel build(const leaf::LeafOptions& options) const {
    leaf::LeafInput in = input;
    if (!same(now.points, opened.points)) in.points = now.points;
    return leaf::build_leaf(options, in);
  }
  /// Handles of the present edit on the present leaf, at the last key.
  void ensure_walk() {
    if (!live || live_model != now.model) {
      walk.reset();
      live = std::make_unique<leaf::LeafEditor>(now.model->natural, now.edit);
      live_model = now.model;
    }
    if (walk) return;
    walk = std::make_unique<leaf::EditWalk>(*live, now.edit);
    for (const leaf::EditKey& key : now.edit.keys) walk->go(key.move_m);
  }
  /// The shape that `witherfield run` makes of this edit.
  void settle() {
    walk.reset();
    if (now.edit.handles.empty()) {
      now.position = std::make_shared<Positions>(now.model->natural.position_m);
      return;
    }
    ensure_walk();
    now.position = std::make_shared<Positions>(live->positions());
  }
  void rebuild() {
    now.model = std::make_shared<leaf::LeafModel>(build(scene.leaf));
    settle();
  }
  void go_to(State state) {
    now = std::move(state);
    walk.reset();
    sketch.reset();
    if (!now.model) rebuild();
  }
  void remember(State state) {
    past.push_back(std::move(state));
    if (past.size() > kUndoSteps) past.erase(past.begin());
    if (past.size() > kUndoModels) {
      State& old = past[past.size() - 1 - kUndoModels];
      if (old.model != now.model) old.model.reset(), old.position.reset();
    }
    future.clear();
  }
  void change() {
    touched = true;
    now.revision = ++revisions;
  }
  PlaneFrame frame() const {
    if (scene.leaf.source != leaf::LeafSource::points) return {};
    const glm::dvec2 base(now.points.midrib_m.front()), along = glm::dvec2(now.points.midrib_m.back()) - base;
    return {base, glm::normalize(along)};
  }
  const leaf::LeafModel& drawn() const { return sketch ? *sketch : *now.model; }
  void hold_petiole();
};

/// A leaf that nothing holds would follow its first handle as a whole.
void EditSession::Impl::hold_petiole() {
  leaf::EditOptions& e = now.edit;
  if (e.handles.empty()) e.keys.clear();
  const leaf::LeafModel& m = *now.model;
  if (e.handles.empty() && !m.midrib.empty()) {
    leaf::HandleOptions h;
    h.name = "petiole";
    h.by_uv = false;
    h.point_m = m.natural.position_m[std::size_t(m.midrib.front())];
    h.radius_m = kHoldShare * m.main_vein_m;
    e.handles.push_back(h);
  }
  if (e.keys.empty() && !e.handles.empty())
    e.keys.push_back({"edited", std::vector<glm::dvec3>(e.handles.size(), glm::dvec3(0.0))});
}

EditSession::EditSession(scene::LeafScene scene, leaf::LeafInput input) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.scene = std::move(scene);
  m.input = std::move(input);
  m.now.edit = m.scene.leaf.edit;
  m.now.model = std::make_shared<leaf::LeafModel>(leaf::build_leaf(m.scene.leaf, m.input));
  if (has_outline()) m.now.points = as_saved(points_of_model(*m.now.model));
  m.hold_petiole();
  m.settle();
  m.opened = m.now;
}
EditSession::~EditSession() = default;

const leaf::LeafModel& EditSession::model() const { return *impl_->now.model; }
const Positions& EditSession::positions() const { return *impl_->now.position; }
const leaf::EditOptions& EditSession::edit() const { return impl_->now.edit; }

leaf::EditReport EditSession::report() const {
  return leaf::edit_report(model().natural.position_m, positions(), model().natural.triangles);
}

void EditSession::begin() {
  impl_->start = impl_->now;
  impl_->touched = impl_->points_touched = false;
}

void EditSession::end() {
  Impl& m = *impl_;
  if (!m.start) return;
  State before = std::move(*m.start);
  m.start.reset();
  m.sketch.reset();
  if (!m.touched) return;
  try {
    if (!m.now.edit.keys.empty())
      for (glm::dvec3& move : m.moves()) move = glm::round(move / kMoveGrain_m) * kMoveGrain_m;
    if (m.points_touched) {
      m.now.points = as_saved(m.now.points);
      m.rebuild();
    } else {
      m.settle();
    }
  } catch (const Error&) {
    m.go_to(std::move(before));
    throw;
  }
  m.remember(std::move(before));
}

bool EditSession::in_gesture() const { return impl_->start.has_value(); }

namespace {

/// Runs `action` as a gesture of its own unless one is under way.
template <class Action>
void as_gesture(EditSession& session, const Action& action) {
  if (session.in_gesture()) return action();
  session.begin();
  action();  // changes nothing before it throws
  session.end();
}

}  // namespace

int EditSession::add_handle(int vertex) {
  Impl& m = *impl_;
  const Surface& natural = m.now.model->natural;
  const bool any = !m.now.edit.handles.empty();
  if (any) m.ensure_walk();
  for (std::size_t i = 0; any && i < m.walk->vertices().size(); ++i) {
    if (m.walk->vertices()[i] != vertex) continue;
    const std::size_t owner = m.walk->owners()[i];
    if (m.walk->vertex(owner) == vertex) return int(owner);
    throw InvalidInput("this place moves with the handle '" + m.now.edit.handles[owner].name + "' already");
  }
  leaf::HandleOptions h;
  h.name = "handle " + std::to_string(m.now.edit.handles.size() + 1);
  // Not by uv: its axes may turn when another outline is drawn.
  h.by_uv = false;
  h.point_m = glm::round(natural.position_m[std::size_t(vertex)] / kMoveGrain_m) * kMoveGrain_m;
  h.radius_m = std::round(kGripShare * m.now.model->main_vein_m * 1e6) * 1e-6;
  as_gesture(*this, [&] {
    // Where the place is in the keys before, it stays: the new handle changes nothing yet.
    std::vector<glm::dvec3> at;
    if (m.now.edit.keys.size() > 1) {
      leaf::EditWalk again(*m.live, m.now.edit);
      for (const leaf::EditKey& key : m.now.edit.keys) {
        again.go(key.move_m);
        at.push_back(m.live->positions()[std::size_t(vertex)] - m.home(vertex));
      }
      at.pop_back();
    }
    at.push_back((*m.now.position)[std::size_t(vertex)] - m.home(vertex));
    if (m.now.edit.keys.empty()) m.now.edit.keys.push_back({"edited", {}});
    for (std::size_t k = 0; k < at.size(); ++k) m.now.edit.keys[k].move_m.push_back(at[k]);
    m.now.edit.handles.push_back(h);
    m.walk.reset();
    m.change();
  });
  return int(m.now.edit.handles.size()) - 1;
}

void EditSession::remove_handle(int handle) {
  Impl& m = *impl_;
  if (m.now.edit.handles.size() < 2) throw InvalidInput("the last handle stays: without any, the leaf could be anywhere");
  as_gesture(*this, [&] {
    m.now.edit.handles.erase(m.now.edit.handles.begin() + handle);
    for (leaf::EditKey& key : m.now.edit.keys) key.move_m.erase(key.move_m.begin() + handle);
    m.walk.reset();
    m.change();
  });
}

void EditSession::set_radius(int handle, double radius_m) {
  Impl& m = *impl_;
  as_gesture(*this, [&] {
    m.now.edit.handles[std::size_t(handle)].radius_m = std::round(std::clamp(radius_m, 0.0, 1.0) * 1e6) * 1e-6;
    m.walk.reset();
    m.change();
  });
}

void EditSession::move_handle(int handle, const glm::dvec3& to_m, int iterations) {
  Impl& m = *impl_;
  m.ensure_walk();
  m.moves()[std::size_t(handle)] = to_m - m.home(m.walk->vertex(std::size_t(handle)));
  m.change();
  m.walk->follow(m.moves(), std::clamp(iterations, 1, m.now.edit.max_iterations));
  m.now.position = std::make_shared<Positions>(m.live->positions());
}

glm::dvec3 EditSession::handle_place(int handle) const {
  Impl& m = *impl_;
  m.ensure_walk();
  return m.home(m.walk->vertex(std::size_t(handle))) + m.moves()[std::size_t(handle)];
}

std::vector<int> EditSession::held_along(int handle) const {
  Impl& m = *impl_;
  m.ensure_walk();
  std::vector<int> out;
  for (std::size_t i = 0; i < m.walk->vertices().size(); ++i)
    if (m.walk->owners()[i] == std::size_t(handle) && m.walk->vertices()[i] != m.walk->vertex(std::size_t(handle)))
      out.push_back(m.walk->vertices()[i]);
  return out;
}

void EditSession::set_mode(leaf::EditMode mode) {
  Impl& m = *impl_;
  if (mode == m.now.edit.mode) return;
  as_gesture(*this, [&] {
    m.now.edit.mode = mode;
    m.walk.reset();
    m.change();
  });
}

void EditSession::add_key() {
  Impl& m = *impl_;
  if (m.now.edit.keys.empty()) throw InvalidInput("a key frame needs a handle");
  as_gesture(*this, [&] {
    leaf::EditKey& last = m.now.edit.keys.back();
    leaf::EditKey next{"edited", last.move_m};
    if (last.name == "edited") last.name = "key " + std::to_string(m.now.edit.keys.size());
    m.now.edit.keys.push_back(std::move(next));
    m.change();
  });
}

bool EditSession::has_outline() const { return impl_->scene.leaf.source != leaf::LeafSource::mesh; }
const OutlinePoints& EditSession::points() const { return impl_->now.points; }

glm::dvec3 EditSession::place(const OutlinePoint& p) const {
  const glm::dvec3& at = points_of(impl_->now.points, p.group)[std::size_t(p.index)];
  return {at.x, at.y, 0};
}

OutlinePoint EditSession::add_point(const glm::dvec3& at_m) {
  Impl& m = *impl_;
  if (!has_outline()) throw InvalidInput("this leaf was read from a mesh: it has no outline points");
  const glm::dvec2 at(at_m);
  OutlinePoint best;
  double least = std::numeric_limits<double>::infinity(), height = 0;
  glm::dvec2 nearest(at), place(at);
  for (const OutlineGroup group : {OutlineGroup::left, OutlineGroup::right, OutlineGroup::midrib}) {
    std::vector<glm::dvec3> line = points_of(m.now.points, group);
    const bool side = group != OutlineGroup::midrib;
    if (side) {
      line.insert(line.begin(), m.now.points.midrib_m.front());
      line.push_back(m.now.points.midrib_m.back());
    }
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      if (const double d = to_segment(at, glm::dvec2(line[k]), glm::dvec2(line[k + 1]), nearest); d < least) {
        least = d;
        best = {group, int(k) + (side ? 0 : 1)};
        height = 0.5 * (line[k].z + line[k + 1].z);
      }
  }
  // On the curve, so that the leaf stays as it is until the point is dragged.
  least = std::numeric_limits<double>::infinity();
  const Positions curve = curves()[std::size_t(best.group)];
  for (std::size_t k = 0; k + 1 < curve.size(); ++k)
    if (const double d = to_segment(at, glm::dvec2(curve[k]), glm::dvec2(curve[k + 1]), nearest); d < least)
      least = d, place = nearest;
  as_gesture(*this, [&] {
    auto& group = points_of(m.now.points, best.group);
    group.insert(group.begin() + best.index, glm::dvec3(place, height));
    m.points_touched = true;
    m.change();
  });
  return best;
}

void EditSession::remove_point(const OutlinePoint& p) {
  Impl& m = *impl_;
  auto& group = points_of(m.now.points, p.group);
  if (group.size() < 3) throw InvalidInput("at least two points must stay on each side and on the midrib");
  as_gesture(*this, [&] {
    group.erase(group.begin() + p.index);
    m.points_touched = true;
    m.change();
  });
}

void EditSession::move_point(const OutlinePoint& p, const glm::dvec3& to_m) {
  Impl& m = *impl_;
  glm::dvec3& at = points_of(m.now.points, p.group)[std::size_t(p.index)];
  at = {to_m.x, to_m.y, at.z};
  m.points_touched = true;
  m.change();
  m.sketch = std::make_unique<leaf::LeafModel>(m.build(coarse(m.scene.leaf)));
}

Surface EditSession::flat_leaf() const {
  const leaf::LeafModel& model = impl_->drawn();
  const PlaneFrame frame = impl_->frame();
  Surface s = leaf::to_surface(model, model.flat.position_m);
  for (glm::dvec3& p : s.position_m) p = frame(p);
  s.normal.clear();
  return s;
}

std::vector<Positions> EditSession::curves() const {
  std::vector<Positions> out;
  if (!has_outline()) return out;
  const leaf::Stage& stage = impl_->drawn().stages[1];
  const PlaneFrame frame = impl_->frame();
  for (const auto& line : stage.lines) {
    out.emplace_back();
    for (const int v : line) out.back().push_back(frame(stage.surface.position_m[std::size_t(v)]));
  }
  return out;
}

bool EditSession::can_undo() const { return !impl_->past.empty(); }
bool EditSession::can_redo() const { return !impl_->future.empty(); }

void EditSession::undo() {
  Impl& m = *impl_;
  if (m.past.empty() || m.start) return;
  m.future.push_back(m.now);
  State before = std::move(m.past.back());
  m.past.pop_back();
  m.go_to(std::move(before));
}

void EditSession::redo() {
  Impl& m = *impl_;
  if (m.future.empty() || m.start) return;
  m.past.push_back(m.now);
  State after = std::move(m.future.back());
  m.future.pop_back();
  m.go_to(std::move(after));
}

void EditSession::reset() {
  Impl& m = *impl_;
  if (m.start || m.now.revision == m.opened.revision) return;
  State before = m.now;
  m.go_to(m.opened);
  m.remember(std::move(before));
}

bool EditSession::changed() const { return impl_->now.revision != impl_->saved; }
void EditSession::mark_saved() { impl_->saved = impl_->now.revision; }
bool EditSession::points_changed() const { return !same(impl_->now.points, impl_->opened.points); }

}  // namespace witherfield::cli
