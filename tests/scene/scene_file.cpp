#include "scene_file.hpp"

#include <unistd.h>

#include <fstream>

#include "sim/core/errors.hpp"

namespace witherfield::scene {

SceneFile::SceneFile(const std::string& text, const std::string& stem, const std::string& kind) {
  std::string folder = (std::filesystem::temp_directory_path() / "witherfield_scene_XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::runtime_error("cannot make a folder for the test");
  path_ = std::filesystem::path(folder) / (stem + ".toml");
  std::ofstream(path_) << "kind = \"" << kind << "\"\n" << text;
}

SceneFile::~SceneFile() {
  std::filesystem::remove_all(path_.parent_path());
}

GrassScene load_text(const std::string& text, bool preview) {
  const SceneFile file(text);
  return load_grass_scene(file.path(), preview);
}

std::string error_of(const std::string& text) {
  const SceneFile file(text);
  try {
    load_grass_scene(file.path());
  } catch (const InvalidInput& e) {
    const std::string folder = std::filesystem::path(file.path()).parent_path().string() + "/";
    const std::string message = e.what();
    return message.rfind(folder, 0) == 0 ? message.substr(folder.size())
                                         : "without the file's name: " + message;
  }
  return "";
}

}  // namespace witherfield::scene
