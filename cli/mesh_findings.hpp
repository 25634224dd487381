// What `witherfield check` finds in one mesh, as the table and the JSON both tell it.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/overlap.hpp"
#include "sim/check/surface_check.hpp"
#include "vis/mesh_files.hpp"

namespace witherfield::cli {

struct CheckDemands {
  bool closed = false;  ///< every shell closed and outward
  bool self_intersections = true;
  bool overlap = false;
  std::optional<double> max_overlap;  ///< volume fraction; implies overlap
};

/// One thing that was looked for.
struct Finding {
  std::string name;
  std::size_t found = 0;
  bool demanded = true;                ///< does it fail the mesh when found?
  const char *kind = "", *kinds = "";  ///< what the ids name: "face", "vertex", "edge", "shell"
  std::vector<std::vector<int>>
      ids;  ///< each a face, a vertex, the two vertices of an edge, a pair of faces, ...
  bool passed() const { return found == 0 || !demanded; }
};

struct MeshFindings {
  std::string file, length_unit;
  std::string error;  ///< why it could not be read; then nothing else is filled
  int error_code = 0;
  check::MeshReport report;
  std::vector<Finding> findings;
  std::vector<std::string> part;  ///< of each shell: "kernel 12", "organ 3", "blade 7", "" when the mesh does not say
  std::vector<check::Overlap> overlaps;  ///< greatest fraction first
  double area = 0, volume = 0;           ///< in the file's own unit of length
  double per_metre = 1;                  ///< the file's units of length in a metre
  bool overlap_checked = false;
  bool passed() const;
};

MeshFindings find_in_mesh(const std::filesystem::path& file, const CheckDemands& demands);

std::string findings_table(const MeshFindings& mesh);
/// All meshes, indented.
std::string findings_json(const std::vector<MeshFindings>& meshes);

}  // namespace witherfield::cli
