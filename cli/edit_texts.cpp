#include "cli/edit_texts.hpp"

#include <fmt/format.h>

namespace witherfield::cli {
namespace {

/// 12345 -> "12,345".
std::string grouped(std::size_t n) {
  std::string text = std::to_string(n);
  for (int at = int(text.size()) - 3; at > 0; at -= 3) text.insert(std::size_t(at), ",");
  return text;
}

const char* mode_name(leaf::EditMode mode) { return mode == leaf::EditMode::linear ? "linear" : "rotation-aware"; }

std::string percent(double share) { return fmt::format("{:+.2f} %", 100 * share + 0.0); }

std::string crossing(long pairs) { return pairs < 0 ? "..." : std::to_string(pairs); }

}  // namespace

std::string panel_heading(const EditSession& session, EditTool tool) {
  return tool == EditTool::outline ? "Outline points" : fmt::format("Handles, {}", mode_name(session.edit().mode));
}

TextRows panel_rows(const EditSession& session, const EditStatus& s) {
  const leaf::LeafModel& m = session.model();
  TextRows rows{{"leaf", s.name + (s.changed ? " *" : "")},
                {"mesh", fmt::format("{} vertices, {} faces", grouped(m.natural.position_m.size()),
                                     grouped(m.natural.triangles.size()))}};
  if (s.tool == EditTool::outline) {
    const leaf::OutlinePoints& p = session.points();
    rows.push_back({"points", fmt::format("{} left, {} right, {} midrib", p.left_m.size(), p.right_m.size(), p.midrib_m.size())});
    rows.push_back({"blade", fmt::format("{:.1f} cm\u00b2, midrib {:.1f} cm", m.area_m2 * 1e4, m.main_vein_m * 100)});
    if (m.area_error != 0) rows.push_back({"against reference", percent(m.area_error)});
    return rows;
  }
  const leaf::EditOptions& e = session.edit();
  rows.push_back({"handles", std::to_string(e.handles.size()) +
                                 (e.keys.size() > 1 ? fmt::format(", key frame {}", e.keys.size()) : std::string())});
  if (s.selected_handle >= 0) {
    const auto& h = e.handles[std::size_t(s.selected_handle)];
    rows.push_back({"selected", h.name + (h.radius_m > 0 ? fmt::format(", radius {:.1f} mm", h.radius_m * 1e3) : "")});
  }
  rows.push_back({"area", fmt::format("{:.1f} cm\u00b2, drift {}", s.report.area_after_m2 * 1e4, percent(s.report.area_drift))});
  rows.push_back({"largest strain", fmt::format("{:.1f} %", 100 * s.report.largest_strain)});
  rows.push_back({"faces", fmt::format("{} flipped, {} intersecting", s.report.flipped_faces, crossing(s.intersections))});
  if (!s.field.empty()) rows.push_back({"colours", s.field});
  if (s.frames_per_second > 0) rows.push_back({"frames/s", fmt::format("{:.0f}", s.frames_per_second)});
  return rows;
}

std::string title_text(const EditSession& session, const EditStatus& s) {
  const std::string name = s.name + (s.changed ? "*" : "");
  if (s.tool == EditTool::outline) {
    const leaf::OutlinePoints& p = session.points();
    return fmt::format("{} - points: outline {}, midrib {}; {:.1f} cm2 - witherfield edit", name, p.left_m.size() + p.right_m.size(),
                       p.midrib_m.size(), session.model().area_m2 * 1e4);
  }
  return fmt::format("{} - handles: {}, {}, area {}, strain {:.1f} %, flipped {}, intersecting {} - witherfield edit", name,
                     session.edit().handles.size(), mode_name(session.edit().mode), percent(s.report.area_drift),
                     100 * s.report.largest_strain, s.report.flipped_faces, crossing(s.intersections));
}

std::string hint_text(EditTool tool) {
  return tool == EditTool::handles
             ? "click the leaf: new handle    drag a handle: the leaf follows    right drag: turn    wheel: zoom    Tab: outline    H: help"
             : "drag a point: the leaf is rebuilt    click the curve: new point    Delete: remove    right drag: shift    Tab: handles    H: help";
}

TextRows help_rows() {
  return {{"left button", "handle or point: drag it;  leaf or curve: make a new one;  beside the leaf: turn the view"},
          {"right button, middle button", "turn the view, shift it"},
          {"wheel", "zoom to the pointer"},
          {"Tab", "handles on the leaf / points of outline and midrib on the flat leaf"},
          {"M", "linear (the paper's) / rotation-aware"},
          {"Delete", "remove the selected handle or point"},
          {"brackets [ ]", "the selected handle holds fewer / more of the leaf around it"},
          {"K", "key frame: keep this shape as one, go on to the next"},
          {"Ctrl+Z, Ctrl+Y", "undo, redo"},
          {"R", "reset: the leaf as it was opened (can be undone)"},
          {"W", "smooth / with the mesh / wireframe"},
          {"F", "colours: leaf, areal strain, displacement, veins"},
          {"V, C", "next view, whole leaf"},
          {"S or Ctrl+S", "save scene and mesh"},
          {"P", "save a picture of the window"},
          {"H or F1", "this help"},
          {"Q", "quit"}};
}

}  // namespace witherfield::cli
