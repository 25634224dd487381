#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/mesh_findings.hpp"

namespace witherfield::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kIdsShown = 5, kShellsShown = 10, kOverlapsShown = 5;

/// "faces 1, 2, 7, ...", "edges 3-4, 8-9"
std::string ids_text(const Finding& f) {
  std::string text = f.found == 1 ? f.kind : f.kinds;
  for (std::size_t k = 0; k < std::min(f.ids.size(), kIdsShown); ++k) {
    text += k == 0 ? " " : ", ";
    for (std::size_t i = 0; i < f.ids[k].size(); ++i)
      text.append(i ? "-" : "").append(std::to_string(f.ids[k][i]));
  }
  return f.found > kIdsShown ? text + ", ..." : text;
}

std::string shell_name(const MeshFindings& mesh, std::size_t shell) {
  return fmt::format("{}{}", shell, mesh.part[shell].empty() ? "" : " (" + mesh.part[shell] + ")");
}

std::string state_of(const check::ComponentReport& c) {
  if (c.closed) return c.volume_m3 > 0 ? "closed" : "closed, inside out";
  return c.border_edges ? fmt::format("open, {} border edges", c.border_edges) : "not a surface's boundary";
}

std::string shell_row(const MeshFindings& mesh, std::size_t k) {
  const check::ComponentReport& c = mesh.report.component[k];
  return fmt::format("    {:<22}{:>10}{:>14.6g}{:>14.6g}  {}\n", shell_name(mesh, k), c.faces,
                     c.area_m2 * std::pow(mesh.per_metre, 2), c.volume_m3 * std::pow(mesh.per_metre, 3),
                     state_of(c));
}

/// All shells when there are few; of many the faulty ones, the smallest and the largest.
std::string shells_text(const MeshFindings& mesh) {
  const auto& shells = mesh.report.component;
  std::string text = fmt::format("    {:<22}{:>10}{:>14}{:>14}\n", "shell", "faces", "area", "volume");
  std::vector<std::size_t> shown;
  if (shells.size() <= kShellsShown) {
    for (std::size_t k = 0; k < shells.size(); ++k) shown.push_back(k);
  } else {
    for (std::size_t k = 0; k < shells.size() && shown.size() < kShellsShown; ++k)
      if (!shells[k].closed || !(shells[k].volume_m3 > 0)) shown.push_back(k);
    const auto [least, most] = std::minmax_element(
        shells.begin(), shells.end(), [](const auto& a, const auto& b) { return a.area_m2 < b.area_m2; });
    shown.push_back(std::size_t(least - shells.begin()));
    shown.push_back(std::size_t(most - shells.begin()));
    std::sort(shown.begin(), shown.end());
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  }
  for (const std::size_t k : shown) text += shell_row(mesh, k);
  if (shown.size() < shells.size())
    text += fmt::format("    ... and {} others (all in --json)\n", shells.size() - shown.size());
  return text;
}

std::string overlaps_text(const MeshFindings& mesh) {
  std::string text = fmt::format("  {} pairs of shells overlap (fraction of the smaller one's volume)\n",
                                 mesh.overlaps.size());
  for (std::size_t k = 0; k < std::min(mesh.overlaps.size(), kOverlapsShown); ++k) {
    const check::Overlap& o = mesh.overlaps[k];
    text += fmt::format("    {:<22}{:<22}{:>9.5f} +- {:.5f}\n", shell_name(mesh, o.a), shell_name(mesh, o.b),
                        o.fraction, o.error);
  }
  return text;
}

Json json_of(const MeshFindings& mesh) {
  Json j{{"file", mesh.file}, {"passed", mesh.passed()}};
  if (!mesh.error.empty()) {
    j["error"] = mesh.error;
    return j;
  }
  const check::MeshReport& r = mesh.report;
  j["length_unit"] = mesh.length_unit.empty() ? Json() : Json(mesh.length_unit);
  j.update(Json{{"vertices", r.vertices},
                {"edges", r.edges},
                {"faces", r.faces},
                {"shells", r.components},
                {"border_loops", r.border_loops},
                {"closed", r.closed},
                {"manifold", r.manifold},
                {"oriented_outward", r.oriented_outward},
                {"area", mesh.area},
                {"volume", mesh.volume}});
  for (const Finding& f : mesh.findings) {
    Json ids = Json::array();
    for (const auto& id : f.ids) ids.push_back(id.size() == 1 ? Json(id[0]) : Json(id));
    j["checks"].push_back({{"name", f.name},
                           {"found", f.found},
                           {"demanded", f.demanded},
                           {"passed", f.passed()},
                           {"ids_of", f.kind},
                           {"ids", ids}});
  }
  for (std::size_t k = 0; k < r.component.size(); ++k) {
    const check::ComponentReport& c = r.component[k];
    j["shell"].push_back({{"part", mesh.part[k]},
                          {"first_face", c.first_face},
                          {"faces", c.faces},
                          {"closed", c.closed},
                          {"border_edges", c.border_edges},
                          {"area", c.area_m2 * std::pow(mesh.per_metre, 2)},
                          {"volume", c.volume_m3 * std::pow(mesh.per_metre, 3)}});
  }
  if (!mesh.overlap_checked) return j;
  j["overlaps"] = Json::array();
  for (const check::Overlap& o : mesh.overlaps)
    j["overlaps"].push_back({{"shells", {o.a, o.b}},
                             {"fraction", o.fraction},
                             {"standard_error", o.error},
                             {"volume", o.volume_m3 * std::pow(mesh.per_metre, 3)}});
  return j;
}

}  // namespace

std::string findings_table(const MeshFindings& mesh) {
  if (!mesh.error.empty()) return fmt::format("{}: UNREADABLE\n  {}\n", mesh.file, mesh.error);
  const check::MeshReport& r = mesh.report;
  const std::string unit = mesh.length_unit.empty() ? "" : " " + mesh.length_unit;
  std::string text = fmt::format("{}: {}\n", mesh.file, mesh.passed() ? "passed" : "FAILED");
  text += fmt::format("  {} vertices, {} edges, {} faces, {} border loops\n", r.vertices, r.edges, r.faces,
                      r.border_loops);
  text += fmt::format("  area {:.8g}{}{}", mesh.area, unit, unit.empty() ? "" : "2");
  if (r.closed) text += fmt::format(", volume {:.8g}{}{}", mesh.volume, unit, unit.empty() ? "" : "3");
  text += '\n';
  for (const Finding& f : mesh.findings)
    text += fmt::format("  {:<44}{:>9}  {}{}\n", f.name, f.found,
                        f.found == 0 ? "ok"
                        : f.demanded ? "FAILED"
                                     : "allowed",
                        f.found == 0 ? "" : ": " + ids_text(f));
  if (!r.self_intersections_checked)
    text += fmt::format("  {:<44}{:>9}\n", "self-intersections", "not checked");
  text += fmt::format("  shells{:>47}\n", r.components) + shells_text(mesh);
  if (mesh.overlap_checked) text += overlaps_text(mesh);
  return text;
}

std::string findings_json(const std::vector<MeshFindings>& meshes) {
  Json j{{"passed",
          std::all_of(meshes.begin(), meshes.end(), [](const MeshFindings& m) { return m.passed(); })}};
  j["meshes"] = Json::array();
  for (const MeshFindings& mesh : meshes) j["meshes"].push_back(json_of(mesh));
  return j.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace witherfield::cli
