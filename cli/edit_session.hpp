// A leaf while it is edited by hand: handles, outline points, undo. No window and no printing in it; what it holds at any
// time is what a scene file can say, so that `witherfield run` makes the same leaf of what is saved.
#pragma once
#include <memory>
#include <vector>

#include "sim/leaf/edit_report.hpp"
#include "sim/leaf/edit_walk.hpp"
#include "sim/leaf/leaf_model.hpp"
#include "sim/scene/scene.hpp"

namespace witherfield::cli {

enum class OutlineGroup { left, right, midrib };
/// A point of the outline or of the midrib, from the petiole on.
struct OutlinePoint {
  OutlineGroup group = OutlineGroup::left;
  int index = 0;
  bool operator==(const OutlinePoint&) const = default;
};

class EditSession {
 public:
  using Positions = std::vector<glm::dvec3>;

  /// Builds the leaf and makes the scene's edit. A scene without handles gets one that holds the blade at its petiole.
  /// @throws InvalidInput as build_leaf and LeafEditor.
  EditSession(scene::LeafScene scene, leaf::LeafInput input);
  ~EditSession();

  const leaf::LeafModel& model() const;
  const Positions& positions() const;               ///< of the model's vertices, edited
  const leaf::EditOptions& edit() const;            ///< handles and where they are; the last key is the one that is edited
  leaf::EditReport report() const;                  ///< present shape against the unedited leaf

  /// A gesture: what is done between begin and end is undone together. Gestures that change nothing leave no trace.
  /// When end() throws, the leaf is as it was at begin().
  void begin();
  void end();
  bool in_gesture() const;

  // Handles. Each of these is a gesture of its own unless one is under way.
  /// @returns its number; that of the handle which is there already. @throws InvalidInput when the vertex is held by another's radius.
  int add_handle(int vertex);
  /// @throws InvalidInput when it is the last one.
  void remove_handle(int handle);
  void set_radius(int handle, double radius_m);
  /// Within a gesture; quick, end() makes it exact. @param iterations of the rotation-aware mode: each call goes on from the last.
  void move_handle(int handle, const glm::dvec3& to_m, int iterations = 4);
  glm::dvec3 handle_place(int handle) const;
  /// Vertices that a handle with a radius moves along, without its own.
  std::vector<int> held_along(int handle) const;
  void set_mode(leaf::EditMode mode);
  void add_key();  ///< from here on the handles move to another key; the present one stays as it is

  // Outline and midrib, on the flat leaf.
  bool has_outline() const;  ///< false for leaves from a mesh
  const leaf::OutlinePoints& points() const;
  glm::dvec3 place(const OutlinePoint& p) const;
  /// Where a new point would go on the curve that is nearest. @returns the point that was made.
  OutlinePoint add_point(const glm::dvec3& at_m);
  /// @throws InvalidInput when fewer than two would stay in its group.
  void remove_point(const OutlinePoint& p);
  /// Within a gesture; the flat leaf follows with a coarse mesh, end() rebuilds the fine one and its edit.
  void move_point(const OutlinePoint& p, const glm::dvec3& to_m);
  /// The flat leaf in the frame of the points: coarse within a gesture of points, else the model's own.
  Surface flat_leaf() const;
  /// The splines through left, right and midrib points in the same frame.
  std::vector<Positions> curves() const;

  bool can_undo() const;
  bool can_redo() const;
  void undo();
  void redo();
  void reset();  ///< to the leaf as it was opened; can be undone

  bool changed() const;  ///< since it was opened or mark_saved()
  void mark_saved();
  bool points_changed() const;  ///< other points than the scene's own

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::cli
