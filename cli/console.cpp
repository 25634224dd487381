#include "cli/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace witherfield::cli {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void on_signal(int signal) {
  caught_signal = signal;
  std::signal(signal, SIG_DFL);  // the next one ends the program at once
}

constexpr double kSecondsBetweenLines = 10;

}  // namespace

void install_signal_handlers() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ, SIG_IGN);
}

void check_interrupted() {
  if (caught_signal != 0) throw Interrupted{int(caught_signal)};
}

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string size_text(double bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  for (const char* unit : {"KiB", "MiB"})
    if ((bytes /= 1024) < 1024) return fmt::format("{:.1f} {}", bytes, unit);
  return fmt::format("{:.1f} GiB", bytes / 1024);
}

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Console::~Console() {
  finish_stage();
}

Progress Console::progress() {
  return [this](std::string_view stage, double fraction) { report(stage, fraction); };
}

void Console::report(std::string_view stage, double fraction) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (stage != stage_) {
    if (bar_open_) std::fputc('\n', stderr);
    bar_open_ = false;
    stage_ = stage;
    stage_start_ = last_line_ = now;
    last_permille_ = -1;
    if (!terminal_) fmt::print(stderr, "{} ...\n", stage_);
  }
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double seconds = std::chrono::duration<double>(now - stage_start_).count();
  const int permille = int(fraction * 1000);
  if (terminal_) {
    if (permille == last_permille_) return;
    draw_bar(fraction, seconds);
  } else if (std::chrono::duration<double>(now - last_line_).count() >= kSecondsBetweenLines) {
    last_line_ = now;
    fmt::print(stderr, "{}: {:.0f} %, {} so far\n", stage_, 100 * fraction, duration_text(seconds));
  }
  last_permille_ = permille;
}

void Console::draw_bar(double fraction, double seconds) {
  constexpr int kWidth = 30;
  const int full = int(fraction * kWidth + 0.5);
  const std::string left = fraction >= 1  ? "done in " + duration_text(seconds)
                           : fraction > 0 ? duration_text(seconds * (1 - fraction) / fraction) + " left"
                                          : std::string();
  fmt::print(stderr, "\r\033[K{:<22.22} [{}{}] {:3.0f} %  {}", stage_, std::string(std::size_t(full), '#'),
             std::string(std::size_t(kWidth - full), '.'), 100 * fraction, left);
  std::fflush(stderr);
  bar_open_ = true;
}

void Console::finish_stage() {
  const std::lock_guard lock(mutex_);
  if (bar_open_) std::fputc('\n', stderr);
  bar_open_ = false;
  stage_.clear();
}

void Console::note(const std::string& text) {
  finish_stage();
  if (!quiet_) fmt::print(stderr, "{}\n", text);
}

void Console::say(const std::string& text) {
  finish_stage();
  fmt::print("{}\n", text);
}

}  // namespace witherfield::cli
