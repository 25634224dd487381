// Runs the program povray as a child process and follows its progress.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/progress.hpp"

namespace witherfield::pov {

/// Runs povray with `arguments` in `folder` (its default configuration lets it read and write only there).
/// Progress is read from its messages. @throws IoFailure when povray is missing (names the Debian package) or
/// fails (its last messages).
void run_povray(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                const Progress& progress);

}  // namespace witherfield::pov
