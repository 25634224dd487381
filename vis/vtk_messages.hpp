// While it lives, what VTK would print on the terminal is collected instead: libraries never print, and the
// text tells why a read or a render failed. One at a time (VTK has a single output window).
#pragma once
#include <memory>
#include <string>

class vtkOutputWindow;

namespace witherfield::vis {

class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  bool has_error() const;
  /// The first error's text on one line, without VTK's source location; "" when there was none.
  std::string first_error() const;

 private:
  class Window;
  std::shared_ptr<Window> window_;
  std::shared_ptr<vtkOutputWindow> previous_;
  int log_verbosity_ = 0;
};

}  // namespace witherfield::vis
