// A triangle mesh with fields as plain arrays: what simulators of leaves and fruit hand to the writers of
// data and pictures. (TriMesh is for algorithms that walk over the neighbourhood; this is for everything that
// only reads.)
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/tri_mesh.hpp"

namespace witherfield {

/// Values of one declared field (sim/core/fields.hpp), component-major: value of item i, component c at [i *
/// components + c].
struct SurfaceField {
  std::string name;
  bool on_faces = false;  ///< one tuple per triangle; else one per vertex
  std::vector<float> values;
};

struct Surface {
  std::vector<glm::dvec3> position_m;
  std::vector<std::array<int, 3>>
      triangles;                   ///< counter-clockwise seen from outside (from the upper side of a leaf)
  std::vector<glm::dvec3> normal;  ///< unit, one per vertex; empty = to be computed
  std::vector<glm::dvec2> uv;      ///< one per vertex; empty = none
  std::vector<SurfaceField> fields;

  /// @throws InvalidInput naming the unknown or missing field.
  const SurfaceField& field(std::string_view name) const;
  bool has_field(std::string_view name) const;
  /// Adds the field, or gives the one that is there, sized for this mesh and zero-filled when new.
  /// @throws InvalidInput when the name is not declared.
  SurfaceField& make_field(std::string_view name, bool on_faces = false);
  /// @throws InvalidInput when an index is out of range, a position is not finite, a normal, uv or field has
  /// the wrong length, or a field is not declared; the message names the item.
  void validate() const;
};

/// Area-weighted vertex normals, unit; (0, 0, 1) where a vertex has no face of positive area.
std::vector<glm::dvec3> vertex_normals(const Surface& surface);

/// Appends `part` to `whole`: vertices, triangles, normals, uv and fields (those that one of the two lacks
/// are zero).
void append(Surface& whole, const Surface& part);

/// The triangles for which keep(face) holds, with the vertices they use, in order.
Surface keep_faces(const Surface& surface, const std::function<bool(std::size_t)>& keep);

/// Connectivity and positions only. Faces that would make a non-manifold edge are doubled in their own
/// vertices when `split_non_manifold`. @throws InvalidInput naming the first such face otherwise.
TriMesh to_tri_mesh(const Surface& surface, bool split_non_manifold = false);
Surface to_surface(const TriMesh& mesh);

}  // namespace witherfield
