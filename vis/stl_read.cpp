// STL, text and binary. It has no vertices of its own: corners with the same bits become one.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"

namespace witherfield::vis {
namespace {

constexpr std::size_t kHead = 80, kFacet = 50;  // bytes of a binary file: title, then a count; each facet

class CornerMerge {
 public:
  CornerMerge(Surface& surface, std::size_t facets) : surface_(surface) { index_.reserve(facets / 2 + 16); }

  int vertex(const glm::dvec3& p) {
    const Key key{std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
                  std::bit_cast<std::uint64_t>(p.z + 0.0)};  // + 0.0: -0 and 0 are the same place
    const auto [at, fresh] = index_.try_emplace(key, int(surface_.position_m.size()));
    if (fresh) surface_.position_m.push_back(p);
    return at->second;
  }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = 0;
      for (const std::uint64_t word : k) {
        h = (h ^ word) * 0x9E3779B97F4A7C15u;
        h ^= h >> 29;
      }
      return std::size_t(h);
    }
  };
  Surface& surface_;
  std::unordered_map<Key, int, Hash> index_;
};

std::uint32_t little_u32(const char* bytes) {
  std::uint32_t x = 0;
  for (int k = 3; k >= 0; --k) x = x << 8 | static_cast<unsigned char>(bytes[k]);
  return x;
}

Surface read_binary(const std::filesystem::path& file, std::string_view content) {
  if (content.size() < kHead + 4)
    fail_reading(file, "not an STL file, or truncated: shorter than the head of one");
  const std::uint32_t facets = little_u32(content.data() + kHead);
  const std::size_t wanted = kHead + 4 + std::size_t(facets) * kFacet;
  if (content.size() < wanted || facets > std::uint32_t(std::numeric_limits<int>::max()) / 3)
    fail_reading(file, fmt::format("not an STL file, or truncated: {} facets need {} bytes, it has {}",
                                   facets, wanted, content.size()));
  Surface surface;
  CornerMerge merge(surface, facets);
  for (std::size_t f = 0; f < facets; ++f) {
    const char* at = content.data() + kHead + 4 + f * kFacet + 12;  // after the normal
    std::array<int, 3> t{};
    for (int& v : t) {
      glm::dvec3 p;
      for (int c = 0; c < 3; ++c, at += 4) p[c] = double(std::bit_cast<float>(little_u32(at)));
      if (!std::isfinite(p.x + p.y + p.z))
        fail_reading(file,
                     fmt::format("byte {}: a corner of facet {} is not finite", at - 12 - content.data(), f));
      v = merge.vertex(p);
    }
    surface.triangles.push_back(t);
  }
  return surface;
}

Surface read_text(const std::filesystem::path& file, std::string_view content) {
  Surface surface;
  CornerMerge merge(surface, content.size() / 250);
  TextScanner scan(file, content);
  scan.next_line(0);  // solid, title
  const auto need = [&](const char* keyword) {
    scan.need_line(fmt::format("'{}'", keyword), 0);
    if (const auto word = scan.word(); word != keyword)
      scan.fail(fmt::format("'{}' instead of '{}'", printable(word), keyword));
  };
  for (;;) {
    scan.need_line("'facet' or 'endsolid'", 0);
    const std::string_view word = scan.word();
    if (word == "endsolid") {
      if (!scan.next_line(0)) return surface;
      if (scan.word() != "solid") scan.fail("only another 'solid' may follow 'endsolid'");
      continue;
    }
    if (word != "facet") scan.fail(fmt::format("'{}' instead of 'facet' or 'endsolid'", printable(word)));
    need("outer");
    std::array<int, 3> t{};
    for (int& v : t) {
      need("vertex");
      const double x = scan.number("coordinate"), y = scan.number("coordinate"),
                   z = scan.number("coordinate");
      v = merge.vertex({x, y, z});
    }
    need("endloop");
    need("endfacet");
    surface.triangles.push_back(t);
  }
}

}  // namespace

MeshFile read_stl(const std::filesystem::path& file) {
  const std::string content = read_whole_file(file);
  // Binary files may begin with "solid" too: their size tells.
  const bool exact = content.size() >= kHead + 4 &&
                     content.size() == kHead + 4 + std::size_t(little_u32(content.data() + kHead)) * kFacet;
  const bool text = !exact && content.starts_with("solid") && content.find("facet") != std::string::npos;
  return {text ? read_text(file, content) : read_binary(file, content), ""};
}

}  // namespace witherfield::vis
