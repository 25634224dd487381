// A window to render into without any display: an EGL context on no surface; where EGL cannot start, an
// off-screen window of an X display. VTK itself would abort the process where neither is there; this throws.
#pragma once
#include <memory>

class vtkRenderWindow;

namespace witherfield::vis {

class RenderWindow {
 public:
  /// @throws IoFailure when no rendering context can be made (says what to install or run).
  RenderWindow(int width_px, int height_px);
  ~RenderWindow();
  RenderWindow(const RenderWindow&) = delete;
  RenderWindow& operator=(const RenderWindow&) = delete;

  vtkRenderWindow* get() const { return window_.get(); }
  bool uses_egl() const { return egl_ != nullptr; }

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;  // outlives the window, which frees its graphics memory in it
  std::shared_ptr<vtkRenderWindow> window_;
};

}  // namespace witherfield::vis
