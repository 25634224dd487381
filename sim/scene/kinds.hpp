// The kinds of scene: one loader and one set of defaults each.
#pragma once
#include <filesystem>
#include <string>

namespace witherfield::scene {

/// @throws as scene_kind; InvalidInput when the file is of another kind.
void expect_kind(const std::string& path, const char* kind);
/// A file named in a scene: relative paths are relative to the scene file's folder.
std::string resolved_path(const std::string& path, const std::filesystem::path& folder);

std::string grass_defaults();
std::string floor_defaults();
std::string fruit_defaults();
std::string leaf_defaults();

}  // namespace witherfield::scene
