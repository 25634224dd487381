// OFF (Geomview's object file format), text: OFF, and COFF, NOFF, STOFF with their extra numbers left out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "vis/mesh_readers.hpp"
#include "vis/mesh_text.hpp"

namespace witherfield::vis {
namespace {

void check_magic(TextScanner& scan, std::string_view magic) {
  constexpr std::array<std::string_view, 8> kKnown{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                   "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  if (std::find(kKnown.begin(), kKnown.end(), magic) == kKnown.end())
    scan.fail(fmt::format("not an OFF file: it begins with '{}' instead of 'OFF'", printable(magic)));
}

}  // namespace

MeshFile read_off(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  TextScanner scan(file, text);
  scan.need_line("OFF");
  check_magic(scan, scan.word());
  if (scan.rest_of_line().find("BINARY") != std::string_view::npos) scan.fail("binary OFF is not supported");
  if (scan.rest_of_line().find_first_not_of(" \t\r") == std::string_view::npos)
    scan.need_line("the numbers of vertices and faces");
  const std::int64_t vertices = scan.integer("the number of vertices"),
                     faces = scan.integer("the number of faces");
  // An item needs a line of at least 4 characters; the last may lack its end.
  const auto most = std::int64_t(text.size() / 4 + 1);
  if (vertices < 0 || faces < 0 || vertices > most || faces > most)
    scan.fail(fmt::format("{} vertices and {} faces do not fit into this file: truncated", vertices, faces));
  MeshFile mesh;
  for (std::int64_t v = 0; v < vertices; ++v) {
    scan.need_line(fmt::format("vertex {}", v));
    const double x = scan.number("coordinate"), y = scan.number("coordinate"), z = scan.number("coordinate");
    mesh.surface.position_m.push_back({x, y, z});
  }
  std::vector<int> corners;
  for (std::int64_t f = 0; f < faces; ++f) {
    scan.need_line(fmt::format("face {}", f));
    const std::int64_t count = scan.integer("the number of corners");
    if (count < 3) scan.fail(fmt::format("face {} has {} corners, it needs at least 3", f, count));
    corners.clear();
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t v = scan.integer("a vertex index");
      if (v < 0 || v >= vertices)
        scan.fail(fmt::format("vertex index {} of face {} is out of range, there are {}", v, f, vertices));
      corners.push_back(int(v));
    }
    add_fan(mesh.surface, corners);
  }
  return mesh;
}

}  // namespace witherfield::vis
