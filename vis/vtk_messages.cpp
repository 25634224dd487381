#include "vis/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>

namespace witherfield::vis {

class VtkMessages::Window : public vtkOutputWindow {
 public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { keep(text); }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  bool failed = false;
  std::string first;

 private:
  void keep(const char* text) {
    if (!failed && text) first = text;
    failed = true;
  }
};
vtkStandardNewMacro(VtkMessages::Window);

namespace {

/// "ERROR: In file.cxx, line 5\nvtkClass (0x...): what happened\n\n" -> "what happened"
std::string essence(std::string text) {
  if (const auto end = text.find("): "); end != std::string::npos) text.erase(0, end + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

VtkMessages::VtkMessages() : window_(Window::New(), [](Window* w) { w->Delete(); }) {
  vtkOutputWindow* previous = vtkOutputWindow::GetInstance();
  previous->Register(nullptr);
  previous_ = {previous, [](vtkOutputWindow* w) { w->Delete(); }};
  vtkOutputWindow::SetInstance(window_.get());
  // VTK's log writes errors to the terminal whatever the output window does with them.
  log_verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(previous_.get());
}

bool VtkMessages::has_error() const {
  return window_->failed;
}
std::string VtkMessages::first_error() const {
  return essence(window_->first);
}

}  // namespace witherfield::vis
