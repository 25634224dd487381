// What the editor saves: a scene file that `witherfield run` makes the same leaf of, and the leaf as a mesh.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cli/edit_session.hpp"

namespace witherfield::cli {

/// NAME_edited.toml beside NAME.toml; a file that is called so already is its own.
std::filesystem::path edited_name(const std::filesystem::path& scene_file);

/// `target`: name of the scene file; beside it NAME.obj, NAME.vtp (blade and petiole, with the fields) and, when the outline
/// was changed, NAME_points.csv. Each is written under a temporary name and renamed, the scene last.
/// @param scene_file what was opened, @param toml its text. Returns the files written.
/// @throws IoFailure naming the file.
std::vector<std::filesystem::path> save_edit(const EditSession& session, const scene::LeafScene& scene,
                                             const std::filesystem::path& scene_file, const std::string& toml,
                                             const std::filesystem::path& target);

}  // namespace witherfield::cli
