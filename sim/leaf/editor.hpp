// Deforming a leaf by handles: pick vertices, drag them, the rest follows. Behind the interactive window and scripted edits.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/surface.hpp"
#include "sim/leaf/edit_report.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/leaf/options.hpp"

namespace witherfield::leaf {

struct Handle {
  int vertex = 0;
  double weight = 10;  ///< k_i of the linear mode; the rotation-aware mode holds handles exactly
};

/// The matrices of the leaf are factored once, when the editor is made: neither another set of handles, nor another mode,
/// nor a drag factors again.
class LeafEditor {
 public:
  /// @throws InvalidInput with the reason: no triangle, a triangle without area, a vertex without triangle, more than
  /// one piece, more than two triangles at an edge.
  explicit LeafEditor(Surface leaf, const EditOptions& options = {});
  ~LeafEditor();
  LeafEditor(LeafEditor&&) noexcept;
  LeafEditor& operator=(LeafEditor&&) noexcept;

  /// The present shape becomes the one whose details are kept. @throws InvalidInput: no handle, one named twice, out of
  /// range, too many (vertices x handles > 1e8).
  void set_handles(std::vector<Handle> handles);
  const std::vector<Handle>& handles() const;

  void set_mode(EditMode mode);
  EditMode mode() const;
  /// While dragging, fewer iterations of the rotation-aware mode are enough: each drag goes on from the last.
  void set_iterations(int max_iterations, double tolerance);

  /// Moves the handles there and the rest after them. @param target_m one per handle, all of them each time.
  /// @throws InvalidInput when no handles are set, on a wrong count or values that are not finite.
  const std::vector<glm::dvec3>& drag(std::span<const glm::dvec3> target_m);

  const std::vector<glm::dvec3>& positions() const;
  const Surface& leaf() const;       ///< as given
  void reset();                      ///< back to the leaf as given; handles stay set
  /// Puts the leaf into a shape that it had (undo, redo). @throws InvalidInput on a wrong count.
  void restore(std::vector<glm::dvec3> position_m);

  int factorisations() const;        ///< 2, always: the leaf's operator and, for the rotation-aware mode, that of its rotations
  int iterations() const;            ///< that the last drag took; 0 in the linear mode
  double energy() const;             ///< of the present shape in the present mode, m2 (arap.hpp, laplacian_edit.hpp)
  EditReport report() const;         ///< present shape against the leaf as given

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

int nearest_vertex(std::span<const glm::dvec3> position_m, const glm::dvec3& point_m);
/// @throws InvalidInput when the surface has no uv.
int vertex_at_uv(const Surface& surface, const glm::dvec2& uv);

/// One key of a scripted edit.
struct EditFrame {
  int index = 0;
  const EditKey* key = nullptr;
  const std::vector<glm::dvec3>* position_m = nullptr;  ///< valid during the call only
  EditReport report;
  int iterations = 0;
};

/// Throws what `run_edit` would, before anything is moved: a mesh that cannot be edited, handles that share a vertex, keys that do
/// not move all handles. @throws InvalidInput naming the handle or the key.
void require_edit(const LeafModel& model, const EditOptions& options);

/// All keys of `options` on the model's natural pose, one after the other; calls `sink` for each.
/// @throws InvalidInput as the editor does, naming the handle or the key.
void run_edit(const LeafModel& model, const EditOptions& options, const std::function<void(const EditFrame&)>& sink);

}  // namespace witherfield::leaf
