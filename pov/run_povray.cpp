#include "pov/run_povray.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <deque>

#include "sim/core/errors.hpp"

extern char** environ;

namespace witherfield::pov {
namespace {

/// Collects povray's messages: its lines end in \n, its progress in \r ("Rendered 1234 of 230400 pixels
/// (0%)").
class Messages {
 public:
  explicit Messages(const Progress& progress) : progress_(progress) {}
  void feed(std::string_view bytes) {
    for (char ch : bytes) {
      if (ch != '\n' && ch != '\r') {
        line_ += ch;
        continue;
      }
      take();
      line_.clear();
    }
  }
  /// The last lines that tell what went wrong.
  std::string last() const {
    std::string text;
    for (const std::string& l : lines_) text += "\n  " + l;
    return text;
  }

 private:
  void take() {
    long done = 0, all = 0;
    if (numbers("Rendered ", done, all)) {
      if (progress_ && all > 0) progress_("rendering", double(done) / double(all));
      return;
    }
    if (line_.starts_with("====")) lines_.clear();  // a new stage: what came before is a banner
    if (line_.empty() || line_.starts_with("Parsing ") || line_.starts_with("Parsed ")) return;
    lines_.push_back(line_);
    if (lines_.size() > 12) lines_.pop_front();
  }
  bool numbers(std::string_view head, long& a, long& b) const {
    if (!line_.starts_with(head)) return false;
    const char* p = line_.data() + head.size();
    const char* end = line_.data() + line_.size();
    auto r = std::from_chars(p, end, a);
    if (r.ec != std::errc{} || std::string_view(r.ptr, std::size_t(end - r.ptr)).substr(0, 4) != " of ")
      return false;
    return std::from_chars(r.ptr + 4, end, b).ec == std::errc{};
  }
  const Progress& progress_;
  std::string line_;
  std::deque<std::string> lines_;
};

struct SpawnActions {
  posix_spawn_file_actions_t actions;
  SpawnActions() { posix_spawn_file_actions_init(&actions); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions); }
};

}  // namespace

void run_povray(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                const Progress& progress) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0)
    throw IoFailure(std::string("cannot make a pipe for povray: ") + std::strerror(errno));
  std::vector<std::string> text{"povray"};
  text.insert(text.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& s : text) argv.push_back(s.data());
  argv.push_back(nullptr);
  SpawnActions spawn;
  posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  posix_spawn_file_actions_addopen(&spawn.actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&spawn.actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.actions, pipe_ends[1], 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, "povray", &spawn.actions, nullptr, argv.data(), environ);
  close(pipe_ends[1]);
  if (error != 0) {
    close(pipe_ends[0]);
    if (error == ENOENT && std::filesystem::exists(folder))
      throw IoFailure("povray is not installed: install the Debian package 'povray'");
    throw IoFailure("cannot start povray in " + folder.string() + ": " + std::strerror(error));
  }
  Messages messages(progress);
  char buffer[4096];
  for (ssize_t n; (n = read(pipe_ends[0], buffer, sizeof buffer)) != 0;) {
    if (n < 0 && errno != EINTR) break;
    if (n > 0) messages.feed({buffer, std::size_t(n)});
  }
  close(pipe_ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const std::string how = WIFSIGNALED(status)
                              ? "was stopped by signal " + std::to_string(WTERMSIG(status))
                              : "failed with exit code " + std::to_string(WEXITSTATUS(status));
  throw IoFailure("povray " + how + "; its last messages:" + messages.last());
}

}  // namespace witherfield::pov
