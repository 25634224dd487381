// What the user sees while a command works: progress on stderr (a bar with the time left on a terminal, an
// occasional line elsewhere), results on stdout. Ctrl-C is noticed here too, so that a run stops between two
// files and leaves nothing half-written.
#pragma once
#include <chrono>
#include <mutex>
#include <string>

#include "sim/core/progress.hpp"

namespace witherfield::cli {

class Console {
 public:
  explicit Console(bool quiet);
  ~Console();

  /// For the long-running functions. Safe to call from any thread.
  Progress progress();
  /// Ends the progress line of the stage under way.
  void finish_stage();
  /// A remark on stderr; not shown when quiet.
  void note(const std::string& text);
  /// A result on stdout; shown always.
  void say(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  void report(std::string_view stage, double fraction);
  void draw_bar(double fraction, double seconds);

  const bool quiet_, terminal_;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point stage_start_, last_line_;
  int last_permille_ = -1;
  bool bar_open_ = false;
};

/// From now on SIGINT and SIGTERM only set a flag (a second one kills); writing beyond a file size limit is
/// an error instead of a signal.
void install_signal_handlers();
/// Thrown by check_interrupted after SIGINT or SIGTERM; the exit code is the shell's, 128 + signal.
struct Interrupted {
  int signal;
};
/// Call between two pieces of work, on the main thread. @throws Interrupted.
void check_interrupted();

/// "3 s", "2 min 05 s", "1 h 20 min".
std::string duration_text(double seconds);
/// "812 B", "3.4 MiB".
std::string size_text(double bytes);

}  // namespace witherfield::cli
