#include "cli/video_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/errors.hpp"

extern char** environ;

namespace witherfield::cli {
namespace {

/// Starts ffmpeg with these as standard input and standard error.
pid_t start(std::vector<std::string> arguments, int input, int messages) {
  arguments.insert(arguments.begin(), {"ffmpeg", "-hide_banner", "-loglevel", "error"});
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input < 0)
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  else
    posix_spawn_file_actions_adddup2(&actions, input, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  if (messages < 0)
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  else
    posix_spawn_file_actions_adddup2(&actions, messages, 2);
  // A group of its own: Ctrl-C reaches this program alone, which then stops ffmpeg itself.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  const int error = posix_spawnp(&child, "ffmpeg", &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) throw IoFailure("ffmpeg is not installed: install the Debian package 'ffmpeg'");
  if (error != 0) throw IoFailure(std::string("cannot start ffmpeg: ") + std::strerror(error));
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void insist_on_ffmpeg() {
  if (const int status = wait_for(start({"-version"}, -1, -1)); status != 0)
    throw IoFailure("the program ffmpeg does not run: reinstall the Debian package 'ffmpeg'");
}

VideoWriter::VideoWriter(std::filesystem::path file, int width, int height, double frames_per_s)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  // A socket instead of a pipe: when ffmpeg dies, writing to it is an error and not a signal.
  int pair[2], pipe_ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
    throw IoFailure(std::string("cannot make a channel to ffmpeg: ") + std::strerror(errno));
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) {
    close(pair[0]), close(pair[1]);
    throw IoFailure(std::string("cannot make a channel to ffmpeg: ") + std::strerror(errno));
  }
  to_ = pair[0];
  messages_ = pipe_ends[0];
  try {
    // Quality 16: no visible loss; slow fades in dark corners are what x264 would else save on. bt709 both ways, so
    // that players undo exactly what was done. No picture is coded anew on the way: where everything stands still but a slow
    // fade, each new start would show as a pulse (0.7 levels in the mean, up to 14).
    child_ = start({"-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", fmt::format("{}x{}", width, height), "-r",
                    fmt::format("{}", frames_per_s), "-i", "pipe:0", "-an", "-vf",
                    "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p",
                    "-c:v", "libx264", "-preset", "medium", "-crf", "16", "-g", "100000", "-colorspace", "bt709", "-color_primaries",
                    "bt709", "-color_trc", "iec61966-2-1", "-movflags", "+faststart", "-f", "mp4", part_.string()},
                   pair[1], pipe_ends[1]);
  } catch (...) {
    close(pair[1]), close(pipe_ends[1]);
    end();
    throw;
  }
  close(pair[1]);
  close(pipe_ends[1]);
}

VideoWriter::~VideoWriter() {
  if (child_ < 0) return;
  kill(child_, SIGKILL);
  end();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

int VideoWriter::end() {
  if (to_ >= 0) close(to_);
  to_ = -1;
  const int status = child_ >= 0 ? wait_for(child_) : 0;
  child_ = -1;
  if (messages_ >= 0) close(messages_);
  messages_ = -1;
  return status;
}

void VideoWriter::fail() {
  if (to_ >= 0) close(to_);
  to_ = -1;
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(messages_, buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR);)
    if (n > 0) text.append(buffer, std::size_t(n));
  end();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  throw IoFailure(fmt::format("ffmpeg could not write '{}': {}", file_.string(), text.empty() ? "no reason given" : text));
}

void VideoWriter::frame(std::span<const std::uint8_t> rgb) {
  while (!rgb.empty()) {
    const ssize_t n = send(to_, rgb.data(), rgb.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    rgb = rgb.subspan(std::size_t(n));
  }
}

void VideoWriter::finish() {
  close(to_);
  to_ = -1;
  const int status = wait_for(child_);
  child_ = -1;
  if (status != 0) fail();
  end();
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw IoFailure(fmt::format("cannot rename '{}': {}", part_.string(), error.message()));
}

}  // namespace witherfield::cli
