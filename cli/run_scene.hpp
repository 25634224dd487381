// The scene of a run that is complete.
#pragma once
#include <filesystem>
#include <string>

namespace witherfield::cli {

/// The resolved scene in run.json, as JSON text. @throws IoFailure.
std::string read_scene_json(const std::filesystem::path& folder);

}  // namespace witherfield::cli
