#include "vis/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "sim/core/errors.hpp"

namespace witherfield::vis {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int error) {
  throw IoFailure(std::string("cannot ") + what + " '" + file.string() + "': " + std::strerror(error));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), part_(file_.string() + ".part") {
  stream_ = std::fopen(part_.c_str(), "wb");
  if (!stream_) fail("create", file_, errno);
}

AtomicFile::~AtomicFile() {
  if (stream_) std::fclose(stream_);
  if (part_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  if (bytes && std::fwrite(data, 1, bytes, stream_) != bytes) fail("write", file_, errno);
}

void AtomicFile::commit() {
  // fclose is the last chance of the file system to report a full disk.
  const bool flushed = std::fflush(stream_) == 0;
  const int flush_error = errno;
  const bool closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
  if (!flushed) fail("write", file_, flush_error);
  if (!closed) fail("write", file_, errno);
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) fail("rename the finished file to", file_, error.value());
  part_.clear();
}

void write_whole_file(const std::filesystem::path& file, std::string_view content) {
  AtomicFile out(file);
  out.write(content);
  out.commit();
}

}  // namespace witherfield::vis
