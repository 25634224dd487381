// A file that appears whole or not at all: written as NAME.part beside its place and renamed by commit().
#pragma once
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace witherfield::vis {

class AtomicFile {
 public:
  /// @throws IoFailure when the temporary file cannot be created (names file and reason).
  explicit AtomicFile(std::filesystem::path file);
  /// Removes the temporary file unless commit() was reached.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @throws IoFailure when not all bytes could be written (disk full, size limit).
  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Flushes, closes and renames. @throws IoFailure; then nothing is left.
  void commit();

 private:
  std::filesystem::path file_, part_;
  std::FILE* stream_ = nullptr;
};

/// Writes `content` to `file` as one AtomicFile.
void write_whole_file(const std::filesystem::path& file, std::string_view content);

}  // namespace witherfield::vis
