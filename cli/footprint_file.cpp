#include "cli/footprint_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "footprints.bin is little-endian");

constexpr char kMagic[8] = {'w', 'i', 't', 'h', 'e', 'r', 'f', 'p'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kPortion = 65536;

struct Head {
  char magic[8];
  std::uint32_t version, bytes_each;
  std::int64_t first_visit, last_visit;
  std::uint64_t scene_bytes;  // padded to a multiple of bytes_each with blanks
};
static_assert(sizeof(Head) == 40);

}  // namespace

FootprintWriter::FootprintWriter(const std::filesystem::path& file, const std::string& scene_toml,
                                 const floor::Stretch& visits)
    : file_(file) {
  constexpr std::size_t each = sizeof(floor::Footprint);
  std::string scene = scene_toml;
  while ((sizeof(Head) + scene.size()) % each != 0) scene += ' ';  // records are aligned for whoever maps the file
  Head head{};
  std::memcpy(head.magic, kMagic, sizeof kMagic);
  head.version = kVersion;
  head.bytes_each = each;
  head.first_visit = visits.first;
  head.last_visit = visits.last;
  head.scene_bytes = scene.size();
  file_.write(&head, sizeof head);
  file_.write(scene);
}

FootprintReader::FootprintReader(const std::filesystem::path& file) : path_(file), in_(file, std::ios::binary) {
  if (!in_) throw IoFailure("cannot read the footprints '" + file.string() + "' (does the file exist?)");
  Head head{};
  in_.read(reinterpret_cast<char*>(&head), sizeof head);
  const std::uint64_t bytes = std::filesystem::file_size(file);
  if (!in_ || std::memcmp(head.magic, kMagic, sizeof kMagic) != 0)
    throw IoFailure("'" + file.string() + "' is not a file of footprints (footprints.bin of a run)");
  if (head.version != kVersion || head.bytes_each != sizeof(floor::Footprint))
    throw IoFailure(fmt::format("'{}' holds footprints of format {}; this program reads format {}", file.string(),
                                head.version, kVersion));
  start_ = sizeof head + head.scene_bytes;
  if (head.scene_bytes > bytes || start_ > bytes || (bytes - start_) % sizeof(floor::Footprint) != 0)
    throw IoFailure("'" + file.string() + "' is damaged: its length does not fit");
  scene_toml_.resize(head.scene_bytes);
  in_.read(scene_toml_.data(), std::streamsize(head.scene_bytes));
  visits_ = {head.first_visit, head.last_visit};
  count_ = (bytes - start_) / sizeof(floor::Footprint);
}

floor::FootprintSource FootprintReader::source() {
  in_.clear();
  in_.seekg(std::streamoff(start_));
  read_ = 0;
  return [this]() -> std::span<const floor::Footprint> {
    portion_.resize(std::min<std::uint64_t>(kPortion, count_ - read_));
    in_.read(reinterpret_cast<char*>(portion_.data()),
             std::streamsize(portion_.size() * sizeof(floor::Footprint)));
    if (!in_) throw IoFailure("cannot read the footprints '" + path_.string() + "'");
    read_ += portion_.size();
    return portion_;
  };
}

}  // namespace witherfield::cli
