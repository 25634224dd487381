// The commands of the program. Each adds itself with its options and its help; it runs as the parser's
// callback and throws on failure.
#pragma once
#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace witherfield::cli {

inline constexpr const char* kProgramVersion = WITHERFIELD_VERSION;

/// `quiet` is set by the parser before a command runs.
void add_run_command(CLI::App& app, const bool& quiet);
void add_render_command(CLI::App& app, const bool& quiet);
void add_volume_command(CLI::App& app, const bool& quiet);
void add_info_command(CLI::App& app, const bool& quiet);
void add_check_command(CLI::App& app, const bool& quiet);
void add_edit_command(CLI::App& app, const bool& quiet);

/// "1280x720" -> (1280, 720). @throws InvalidInput.
std::pair<int, int> parse_size(const std::string& text);
/// "0.2,0.9" -> (0.2, 0.9), ascending. @throws InvalidInput.
std::pair<double, double> parse_range(const std::string& text);

}  // namespace witherfield::cli
