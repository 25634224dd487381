// Pictures, one after another, into an .mp4 file: the program ffmpeg as a child process that reads them from us.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace witherfield::cli {

/// @throws IoFailure when the program ffmpeg does not start (names the Debian package).
void insist_on_ffmpeg();

/// H.264 (libx264), 4:2:0, BT.709, its index in front so that it plays while it loads.
class VideoWriter {
 public:
  /// @param width, height even. @throws IoFailure as insist_on_ffmpeg.
  VideoWriter(std::filesystem::path file, int width, int height, double frames_per_s);
  /// Stops ffmpeg and removes what it wrote, unless finish() was reached.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// 8-bit sRGB from the top, 3 bytes a pixel. @throws IoFailure with ffmpeg's own words.
  void frame(std::span<const std::uint8_t> rgb);
  /// The film under its own name. @throws IoFailure.
  void finish();

 private:
  [[noreturn]] void fail();
  int end();  ///< closes the pipes; ffmpeg's exit status

  std::filesystem::path file_, part_;
  pid_t child_ = -1;
  int to_ = -1, messages_ = -1;
};

}  // namespace witherfield::cli
