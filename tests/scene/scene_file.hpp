// A scene file for the length of a test.
#pragma once
#include <filesystem>
#include <string>

#include "sim/scene/scene.hpp"

namespace witherfield::scene {

class SceneFile {
 public:
  /// Writes `text` to a new file <folder>/<stem>.toml; "kind" is put on the first line.
  explicit SceneFile(const std::string& text, const std::string& stem = "scene", const std::string& kind = "grass");
  ~SceneFile();
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Loads a scene of this text (its first line is line 2 of the file).
GrassScene load_text(const std::string& text, bool preview = false);
/// The message of the InvalidInput that loading throws, without the folder; "" when nothing is thrown.
std::string error_of(const std::string& text);

}  // namespace witherfield::scene
