#include "cli/run_folder.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>
#include <vector>

#include "sim/core/errors.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::cli {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw IoFailure("cannot read '" + file.string() + "'");
  return text.str();
}

/// Does a run write a file of this name? (path relative to the run's folder, with /)
bool written_by_a_run(const std::string& name) {
  static const std::regex own(
      "(run\\.json|run\\.partial\\.json|scene\\.resolved\\.json|terrain\\.vtp|view_in_paraview\\.py"
      "|grass(_optics|_points)?(_variant[0-9]+)?\\.pvd"
      "|texel/texel_(v[0-9]+_)?[0-9]{4,}\\.vti|optics/optics_(v[0-9]+_)?[0-9]{4,}\\.vti"
      "|points/points_(v[0-9]+_)?[0-9]{4,}\\.vtp"
      "|(fruit|leaf|floor)\\.pvd|(fruit|leaf|floor)/(fruit|leaf|floor)_[0-9]{4,}\\.(vtp|vti|obj|ply)|leaf/"
      "stage_[0-9]_[a-z]+\\.vtp|footprints\\.(bin|vtp|csv)|walks\\.vtp"
      "|film/[a-z0-9_]+\\.(mp4|json)|film/[a-z0-9_]+_(keys|frames)/.+"
      "|pov/.+|images/[a-z0-9_]+_(texel|blades|object|room)\\.(png|hdr))(\\.part)?");
  return std::regex_match(name, own);
}

/// Is this one of the folders that a run makes inside its own? (path relative to the run's folder)
bool made_by_a_run(const fs::path& relative) {
  const std::string top = relative.begin()->string();
  return top == "texel" || top == "optics" || top == "points" || top == "fruit" || top == "leaf" ||
         top == "floor" || top == "pov" || top == "images" || top == "film";
}

}  // namespace

RunFolder::RunFolder(fs::path path) : path_(std::move(path)) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // "out/x/" means "out/x"
}

bool RunFolder::is_run() const {
  return fs::exists(signature_file()) || fs::exists(run_file());
}

RunFolder::Found RunFolder::inspect(const std::string& signature, bool resume, bool force) const {
  std::error_code error;
  if (!fs::exists(path_, error)) {
    if (error) throw IoFailure("cannot look into '" + path_.string() + "': " + error.message());
    return Found::nothing;
  }
  if (!fs::is_directory(path_))
    throw IoFailure("'" + path_.string() + "' is a file; a run needs a folder (-o DIR)");
  const bool empty = fs::is_empty(path_, error);
  if (error) throw IoFailure("cannot look into '" + path_.string() + "': " + error.message());
  if (empty) return Found::nothing;
  if (!is_run())
    throw InvalidInput(
        "'" + path_.string() +
        "' is not empty and not a run of witherfield; it is left alone. Choose another folder with -o DIR");
  const bool complete = fs::exists(run_file());
  if (force) return Found::nothing;
  if (!resume)
    throw InvalidInput("'" + path_.string() + "' already holds " +
                       (complete ? "a run" : "an unfinished run") + ": --resume " +
                       (complete ? "keeps it if it is of the same scene" : "finishes it") +
                       ", --force replaces it, -o DIR writes elsewhere");
  if (!fs::exists(signature_file()) || text_of(signature_file()) != signature)
    throw InvalidInput(
        "'" + path_.string() +
        "' holds a run of another scene or program version (see scene.resolved.json); it cannot be resumed. "
        "--force replaces it, -o DIR writes elsewhere");
  return complete ? Found::complete : Found::unfinished;
}

void RunFolder::begin(const std::string& signature, bool force) {
  if (fs::exists(path_) && is_run()) remove_run_files(/*only_parts=*/!force);
  for (fs::path p = fs::absolute(path_).lexically_normal(); !p.empty() && !fs::exists(p);
       p = p.parent_path()) {
    first_made_ = p;
    if (p == p.parent_path()) break;
  }
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw IoFailure("cannot make the folder '" + path_.string() + "': " + error.message());
  vis::write_whole_file(signature_file(), signature);
}

std::vector<fs::path> RunFolder::files() const {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
    const fs::path relative = entry.path().lexically_relative(path_);
    if (entry.is_regular_file() && relative.extension() != ".part" &&
        written_by_a_run(relative.generic_string()))
      files.push_back(relative);
  }
  std::sort(files.begin(), files.end());
  return files;
}

void RunFolder::remove_run_files(bool only_parts) const {
  std::vector<fs::path> files, folders;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
    const fs::path relative = entry.path().lexically_relative(path_);
    if (entry.is_directory() && !entry.is_symlink()) {
      if (made_by_a_run(relative)) folders.push_back(entry.path());
    } else if (written_by_a_run(relative.generic_string()) &&
               (!only_parts || relative.extension() == ".part")) {
      files.push_back(entry.path());
    }
  }
  std::error_code error;
  for (const fs::path& file : files) {
    fs::remove(file, error);
    if (error) throw IoFailure("cannot remove '" + file.string() + "': " + error.message());
  }
  if (only_parts) return;
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
    fs::remove(*folder, error);  // fails, as it should, for those that hold something else
}

void RunFolder::abandon() {
  std::error_code error;
  if (!fs::exists(path_, error)) return;
  if (is_run()) remove_run_files(false);
  if (first_made_.empty()) return;
  for (fs::path p = fs::absolute(path_).lexically_normal();; p = p.parent_path()) {
    if (!fs::remove(p, error) || p == first_made_) return;
  }
}

}  // namespace witherfield::cli
