#include "cli/mesh_findings.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"

namespace witherfield::cli {
namespace {

constexpr std::size_t kListed = 100;

template <class Ids>
std::vector<std::vector<int>> listed(const Ids& ids) {
  std::vector<std::vector<int>> out;
  for (const auto& id : ids) {
    if constexpr (std::is_integral_v<std::decay_t<decltype(id)>>)
      out.push_back({int(id)});
    else
      out.push_back({std::get<0>(id), std::get<1>(id)});
  }
  return out;
}

/// The parts that kernel_id, organ_id and blade_id name at the first face of each shell.
std::vector<std::string> parts_of(const Surface& surface, const check::MeshReport& report) {
  std::vector<std::string> parts;
  for (const check::ComponentReport& c : report.component) {
    const auto label = [&](const char* field) {
      if (!surface.has_field(field)) return -1;
      const SurfaceField& f = surface.field(field);
      const auto face = std::size_t(c.first_face);
      return int(std::lround(f.values[f.on_faces ? face : std::size_t(surface.triangles[face][0])]));
    };
    const int kernel = label("kernel_id"), organ = label("organ_id"), blade = label("blade_id");
    parts.push_back(kernel >= 0  ? "kernel " + std::to_string(kernel)
                    : organ >= 0 ? "organ " + std::to_string(organ)
                    : blade >= 0 ? "blade " + std::to_string(blade)
                                 : "");
  }
  return parts;
}

Finding shells_that(const char* name, const check::MeshReport& report, bool demanded,
                    bool (*fault)(const check::ComponentReport&)) {
  Finding f{name, 0, demanded, "shell", "shells", {}};
  for (std::size_t k = 0; k < report.component.size(); ++k)
    if (fault(report.component[k]) && ++f.found <= kListed) f.ids.push_back({int(k)});
  return f;
}

std::vector<Finding> findings_of(const check::MeshReport& r, const CheckDemands& demands) {
  std::vector<Finding> all{
      {"non-manifold edges", r.non_manifold_edges, true, "edge", "edges", listed(r.non_manifold_edge_ids)},
      {"edges between faces of opposite orientation", r.clashing_edges, true, "edge", "edges",
       listed(r.clashing_edge_ids)},
      {"non-manifold vertices", r.non_manifold_vertices, true, "vertex", "vertices",
       listed(r.non_manifold_vertex_ids)},
      {"isolated vertices", r.isolated_vertices, true, "vertex", "vertices", listed(r.isolated_ids)},
      {"non-finite vertices", r.non_finite_vertices, true, "vertex", "vertices", listed(r.non_finite_ids)},
      {"duplicate faces", r.duplicate_faces, true, "face", "faces", listed(r.duplicate_ids)},
      {"degenerate faces", r.degenerate_faces, true, "face", "faces", listed(r.degenerate_ids)}};
  if (r.self_intersections_checked) {
    const char *pair = "pair of faces", *pairs = "pairs of faces";
    all.push_back(
        {"self-intersections", r.self_intersections, true, pair, pairs, listed(r.self_intersection_ids)});
    all.push_back({"intersections between shells", r.shell_intersections, false, pair, pairs,
                   listed(r.shell_intersection_ids)});
  }
  all.push_back(shells_that("open shells", r, demands.closed,
                            [](const check::ComponentReport& c) { return !c.closed; }));
  all.push_back(shells_that("inside-out shells", r, demands.closed,
                            [](const check::ComponentReport& c) { return c.closed && !(c.volume_m3 > 0); }));
  return all;
}

void find_overlaps(const Surface& surface, const CheckDemands& demands, MeshFindings& mesh) {
  mesh.overlap_checked = true;
  mesh.overlaps = check::overlap_fractions(surface);
  std::stable_sort(mesh.overlaps.begin(), mesh.overlaps.end(),
                   [](const check::Overlap& a, const check::Overlap& b) { return a.fraction > b.fraction; });
  if (!demands.max_overlap) return;
  Finding f{"overlaps beyond the limit", 0, true, "pair of shells", "pairs of shells", {}};
  for (const check::Overlap& o : mesh.overlaps)
    if (o.fraction > *demands.max_overlap && ++f.found <= kListed) f.ids.push_back({int(o.a), int(o.b)});
  mesh.findings.push_back(std::move(f));
}

}  // namespace

bool MeshFindings::passed() const {
  return error.empty() &&
         std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passed(); });
}

MeshFindings find_in_mesh(const std::filesystem::path& file, const CheckDemands& demands) {
  MeshFindings mesh;
  mesh.file = file.string();
  try {
    const vis::MeshFile read = vis::read_mesh_file(file);
    mesh.length_unit = read.length_unit;
    mesh.per_metre = read.length_unit == "mm" ? 1e3 : 1;
    mesh.report = check::check_surface(read.surface, {demands.self_intersections, kListed});
    mesh.area = mesh.report.area_m2 * std::pow(mesh.per_metre, 2);
    mesh.volume = mesh.report.volume_m3 * std::pow(mesh.per_metre, 3);
    mesh.part = parts_of(read.surface, mesh.report);
    mesh.findings = findings_of(mesh.report, demands);
    if (demands.overlap || demands.max_overlap) find_overlaps(read.surface, demands, mesh);
  } catch (const Error& e) {
    mesh.error = e.what();
    mesh.error_code = e.exit_code();
  }
  return mesh;
}

}  // namespace witherfield::cli
