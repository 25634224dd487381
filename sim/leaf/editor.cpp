#include "sim/leaf/editor.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "sim/core/errors.hpp"
#include "sim/leaf/arap.hpp"
#include "sim/leaf/cotangent.hpp"
#include "sim/leaf/laplacian_edit.hpp"
#include "sim/leaf/leaf_area.hpp"

namespace witherfield::leaf {
namespace {

std::string place(const glm::dvec3& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ") m";
}

/// Why a surface cannot be edited, in words.
void require_editable(const Surface& s) {
  const std::string at = "leaf editor: ";
  if (s.triangles.empty()) throw InvalidInput(at + "the leaf has no triangle");
  s.validate();
  std::vector<std::pair<int, int>> edges;
  edges.reserve(s.triangles.size() * 3);
  for (std::size_t f = 0; f < s.triangles.size(); ++f) {
    const auto& t = s.triangles[f];
    const glm::dvec3 &a = s.position_m[std::size_t(t[0])], &b = s.position_m[std::size_t(t[1])],
                     &c = s.position_m[std::size_t(t[2])];
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    if (!(glm::length(glm::cross(b - a, c - a)) > 1e-12 * longest * longest))
      throw InvalidInput(at + "triangle " + std::to_string(f) + " (vertices " + std::to_string(t[0]) + ", " +
                         std::to_string(t[1]) + ", " + std::to_string(t[2]) + ") near " + place(a) +
                         " has no area: its corners lie on a line; remove it or move a corner");
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 2; e < edges.size(); ++e)
    if (edges[e] == edges[e - 2])
      throw InvalidInput(at + "more than two triangles meet at the edge of vertices " + std::to_string(edges[e].first) +
                         " and " + std::to_string(edges[e].second) + " near " +
                         place(s.position_m[std::size_t(edges[e].first)]));
  std::vector<int> piece;
  const int pieces = connected_pieces(s.position_m.size(), s.triangles, piece);
  if (pieces == 1) return;
  std::vector<int> size(std::size_t(pieces), 0);
  for (const int p : piece) ++size[std::size_t(p)];
  for (std::size_t v = 0; v < piece.size(); ++v)
    if (size[std::size_t(piece[v])] == 1)
      throw InvalidInput(at + "vertex " + std::to_string(v) + " at " + place(s.position_m[v]) +
                         " belongs to no triangle; remove it");
  const auto smallest = std::min_element(size.begin(), size.end());
  throw InvalidInput(at + "the mesh is in " + std::to_string(pieces) + " pieces that share no edge (the smallest has " +
                     std::to_string(*smallest) +
                     " vertices): a piece without a handle could be anywhere; join them or edit them one by one");
}

}  // namespace

struct LeafEditor::Impl {
  Surface leaf;
  EditOptions options;
  LaplaceSolver solver;
  ArapEdit arap;
  EditMode mode;
  ArapEdit::Limits limits;
  std::vector<Handle> handles;
  std::vector<glm::dvec3> base, position, target;
  std::unique_ptr<LaplacianEdit> linear;
  int iterations = 0;

  Impl(Surface s, const EditOptions& o)
      : leaf(std::move(s)), options(o), solver(cotangent_laplacian(leaf)),
        arap(solver, leaf.position_m, surface_area_m2(leaf), o.smoothness), mode(o.mode), limits{o.max_iterations, o.tolerance},
        base(leaf.position_m), position(leaf.position_m) {}

  /// The shape in which handles are set is what later drags keep the details of.
  void take_base() {
    base = position;
    arap.set_rest(base);
    target.clear();
    for (const Handle& h : handles) target.push_back(base[std::size_t(h.vertex)]);
  }

  void drag_with_rotations(std::span<const glm::dvec3> wanted) {
    // Handles that moved together carry the whole leaf along; what is left is small and bends it.
    std::vector<glm::dvec3> now;
    for (const Handle& h : handles) now.push_back(position[std::size_t(h.vertex)]);
    double residual = 0, moved = 0;
    const RigidMotion motion = fit_rigid(now, wanted, residual);
    for (std::size_t i = 0; i < now.size(); ++i) moved = std::max(moved, glm::distance(now[i], wanted[i]));
    if (residual < 0.02 * moved) {
      for (glm::dvec3& p : position) p = motion(p);
      arap.turn(motion.rotation);
    }
    // First guess: the linear answer for the rest of the way. It is smooth; the rotations are then read off it.
    linear->drag(std::vector<glm::dvec3>(position), wanted, position);
    iterations = arap.drag(wanted, position, limits);
  }
};

LeafEditor::LeafEditor(Surface leaf, const EditOptions& options) {
  require_editable(leaf);
  impl_ = std::make_unique<Impl>(std::move(leaf), options);
}
LeafEditor::~LeafEditor() = default;
LeafEditor::LeafEditor(LeafEditor&&) noexcept = default;
LeafEditor& LeafEditor::operator=(LeafEditor&&) noexcept = default;

void LeafEditor::set_handles(std::vector<Handle> handles) {
  const std::string at = "leaf editor: ";
  const std::size_t n = impl_->position.size();
  if (handles.empty()) throw InvalidInput(at + "no handle: the leaf could be anywhere; pick at least one vertex");
  if (handles.size() * n > 100000000)
    throw InvalidInput(at + std::to_string(handles.size()) + " handles on " + std::to_string(n) +
                       " vertices: the response would need " + std::to_string(handles.size() * n / 125000) +
                       " MB; at most " + std::to_string(100000000 / n) + " handles on this leaf");
  std::vector<int> vertices;
  std::vector<double> weights;
  for (const Handle& h : handles) {
    if (h.vertex < 0 || std::size_t(h.vertex) >= n)
      throw InvalidInput(at + "handle at vertex " + std::to_string(h.vertex) + ", the leaf has vertices 0.." +
                         std::to_string(n - 1));
    if (!(h.weight >= 0.01 && h.weight <= 1e6))
      throw InvalidInput(at + "weight " + std::to_string(h.weight) + " of the handle at vertex " +
                         std::to_string(h.vertex) + " is outside 0.01..1e6");
    if (std::find(vertices.begin(), vertices.end(), h.vertex) != vertices.end())
      throw InvalidInput(at + "vertex " + std::to_string(h.vertex) + " is named by two handles");
    vertices.push_back(h.vertex);
    weights.push_back(h.weight);
  }
  const HandleColumns columns = handle_columns(impl_->solver, vertices);
  impl_->linear = std::make_unique<LaplacianEdit>(columns, weights);
  impl_->arap.set_handles(columns);
  impl_->handles = std::move(handles);
  impl_->take_base();
}

const std::vector<Handle>& LeafEditor::handles() const { return impl_->handles; }

void LeafEditor::set_mode(EditMode mode) {
  if (mode == impl_->mode) return;
  impl_->mode = mode;
  impl_->take_base();
}

EditMode LeafEditor::mode() const { return impl_->mode; }

void LeafEditor::set_iterations(int max_iterations, double tolerance) { impl_->limits = {max_iterations, tolerance}; }

const std::vector<glm::dvec3>& LeafEditor::drag(std::span<const glm::dvec3> target_m) {
  Impl& m = *impl_;
  if (m.handles.empty()) throw InvalidInput("leaf editor: drag before handles are set");
  if (target_m.size() != m.handles.size())
    throw InvalidInput("leaf editor: " + std::to_string(target_m.size()) + " targets for " +
                       std::to_string(m.handles.size()) + " handles");
  for (std::size_t i = 0; i < target_m.size(); ++i)
    if (!std::isfinite(target_m[i].x + target_m[i].y + target_m[i].z))
      throw InvalidInput("leaf editor: the target of handle " + std::to_string(i) + " is not finite");
  if (std::equal(target_m.begin(), target_m.end(), m.target.begin())) return m.position;  // nothing was dragged
  m.target.assign(target_m.begin(), target_m.end());
  if (m.mode == EditMode::linear) {
    m.linear->drag(m.base, target_m, m.position);
    m.iterations = 0;
  } else {
    m.drag_with_rotations(target_m);
  }
  return m.position;
}

const std::vector<glm::dvec3>& LeafEditor::positions() const { return impl_->position; }
const Surface& LeafEditor::leaf() const { return impl_->leaf; }

void LeafEditor::reset() { restore(impl_->leaf.position_m); }

void LeafEditor::restore(std::vector<glm::dvec3> position_m) {
  if (position_m.size() != impl_->position.size())
    throw InvalidInput("leaf editor: restore with " + std::to_string(position_m.size()) + " positions, the leaf has " +
                       std::to_string(impl_->position.size()));
  impl_->position = std::move(position_m);
  impl_->take_base();
}

int LeafEditor::factorisations() const { return impl_->solver.factorisations() + impl_->arap.factorisations(); }
int LeafEditor::iterations() const { return impl_->iterations; }

double LeafEditor::energy() const {
  const Impl& m = *impl_;
  if (m.mode == EditMode::rotation_aware) return m.arap.energy(m.position);
  std::vector<int> vertices;
  std::vector<double> weights;
  for (const Handle& h : m.handles) vertices.push_back(h.vertex), weights.push_back(h.weight);
  return linear_energy(m.solver.matrix(), m.base, m.position, vertices, weights, m.target);
}

EditReport LeafEditor::report() const { return edit_report(impl_->leaf.position_m, impl_->position, impl_->leaf.triangles); }

}  // namespace witherfield::leaf
