// The text of a leaf's scene file with another edit in it. All else, comments included, stays as its author wrote it.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/leaf/options.hpp"

namespace witherfield::scene {

struct SceneEdit {
  leaf::EditOptions edit;                  ///< replaces [edit], its handles and its keys
  std::optional<std::string> points_file;  ///< replaces `points`
  std::string points_unit = "m";           ///< and its unit
  std::optional<std::string> mesh_file;    ///< replaces `mesh_file`
  std::optional<std::string> name;         ///< replaces `name`
};

/// @param toml text that load_leaf_scene accepts. Loading the result gives the same scene but for what `edit` states.
std::string with_edit(std::string_view toml, const SceneEdit& edit);

}  // namespace witherfield::scene
