// Text over an edit window: a panel of names and values, a hint line, notices, help. In pixels; scaled for large windows.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace witherfield::vis {

using PanelRows = std::vector<std::pair<std::string, std::string>>;

class EditPanels {
 public:
  explicit EditPanels(vtkRenderer& renderer);
  ~EditPanels();
  EditPanels(const EditPanels&) = delete;
  EditPanels& operator=(const EditPanels&) = delete;

  void set_panel(const std::string& heading, const PanelRows& rows);
  void set_hint(const std::string& hint);
  void set_notice(const std::string& text, bool is_warning);
  void set_help(const std::string& heading, const PanelRows& rows);
  /// Puts everything in its place. @param unit 1 = text as in a window of 800 pixels' height.
  void lay_out(int width_px, int height_px, double unit);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace witherfield::vis
