// What the editor's window says: panel, hints, help.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "cli/edit_session.hpp"

namespace witherfield::cli {

using TextRows = std::vector<std::pair<std::string, std::string>>;

enum class EditTool { handles, outline };

/// What the panel shows beside the session itself.
struct EditStatus {
  std::string name;
  EditTool tool = EditTool::handles;
  int selected_handle = -1;
  bool changed = false;
  leaf::EditReport report;
  long intersections = -1;  ///< pairs of faces, -1 = being counted
  double frames_per_second = 0;
  std::string field;  ///< shown, "" = the leaf's colours
};

std::string panel_heading(const EditSession& session, EditTool tool);
TextRows panel_rows(const EditSession& session, const EditStatus& status);
/// One line: tool, handles, what the edit did; for the window's frame.
std::string title_text(const EditSession& session, const EditStatus& status);
std::string hint_text(EditTool tool);
/// Keys and mouse, for the window and for --help alike.
TextRows help_rows();

}  // namespace witherfield::cli
