// The leaf editor: joins a session (what is edited) with a window (what is seen).
#pragma once
#include <filesystem>
#include <string>

#include "cli/console.hpp"
#include "sim/scene/scene.hpp"
#include "vis/edit_window.hpp"

namespace witherfield::cli {

struct EditRequest {
  std::filesystem::path scene_file, target;
  vis::EditWindowOptions window;
};

/// Opens the window and returns when the user closes it. @throws IoFailure without a display, InvalidInput as the scene.
void edit_leaf(const EditRequest& request, Console& console);

}  // namespace witherfield::cli
