// The folder of a run: may it be used, what of an earlier attempt is still good, and removing exactly what a
// run wrote.
//
// scene.resolved.json is written first and says whose folder it is; run.partial.json grows with each whole
// key frame; run.json is written last and marks the run as complete.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace witherfield::cli {

class RunFolder {
 public:
  enum class Found { nothing, unfinished, complete };

  explicit RunFolder(std::filesystem::path path);

  /// Decides what to do; writes and removes nothing. @param signature what identifies the run: version and
  /// resolved scene.
  /// @returns what is to be built on: `nothing`, an `unfinished` run to resume, or a `complete` one (resume
  /// only).
  /// @throws InvalidInput when the folder holds a run and neither flag is given, when it holds another run
  /// than the one to resume, or something that is not a run.
  Found inspect(const std::string& signature, bool resume, bool force) const;

  /// Makes the folder, after removing the old run when `force`, and writes the signature. Remains of files
  /// that a killed run was writing go. @throws IoFailure.
  void begin(const std::string& signature, bool force);
  /// Whole files in the folder that a run writes, sorted, relative to it; other people's files are not among
  /// them.
  std::vector<std::filesystem::path> files() const;
  /// Removes what this run has written and the folders it made, if they are then empty.
  void abandon();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path signature_file() const { return path_ / "scene.resolved.json"; }
  std::filesystem::path partial_file() const { return path_ / "run.partial.json"; }
  std::filesystem::path run_file() const { return path_ / "run.json"; }

 private:
  bool is_run() const;
  void remove_run_files(bool only_parts) const;

  std::filesystem::path path_;
  std::filesystem::path first_made_;  ///< topmost folder that begin() had to make
};

}  // namespace witherfield::cli
