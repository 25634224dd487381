#include "vis/render_window.hpp"

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRendererCollection.h>

#include "sim/core/errors.hpp"
#include "vis/egl_context.hpp"
#include "vis/vtk_messages.hpp"

namespace witherfield::vis {

bool glew_is_bridged();       // glew_bridge.cpp
bool x_display_can_render();  // x_display.cpp

namespace {

std::shared_ptr<vtkRenderWindow> shared(vtkRenderWindow* window) {
  return {window, [](vtkRenderWindow* w) {
            w->Finalize();
            w->Delete();
          }};
}

vtkRenderWindow* window_on(const EglContext& context) {
  auto* window = vtkGenericOpenGLRenderWindow::New();
  vtkNew<vtkCallbackCommand> make_current, ask_current;
  make_current->SetClientData(const_cast<EglContext*>(&context));
  make_current->SetCallback(
      [](vtkObject*, unsigned long, void* c, void*) { static_cast<EglContext*>(c)->make_current(); });
  ask_current->SetClientData(const_cast<EglContext*>(&context));
  ask_current->SetCallback([](vtkObject*, unsigned long, void* c, void* answer) {
    *static_cast<bool*>(answer) = static_cast<EglContext*>(c)->is_current();
  });
  window->AddObserver(vtkCommand::WindowMakeCurrentEvent, make_current);
  window->AddObserver(vtkCommand::WindowIsCurrentEvent, ask_current);
  window->SetReadyForRendering(true);
  window->SetIsCurrent(true);
  window->SetOffScreenRendering(1);
  window->SetFrameBlitModeToNoBlit();
  return window;
}

}  // namespace

struct RenderWindow::Egl {
  EglContext context;
};

RenderWindow::RenderWindow(int width_px, int height_px) {
  if (width_px < 1 || height_px < 1 || width_px > 16384 || height_px > 16384)
    throw InvalidInput("picture size " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                       " px is out of range 1..16384");
  auto egl = std::make_unique<Egl>();
  if (glew_is_bridged() && egl->context.start()) {
    const VtkMessages messages;
    auto* window = vtkGenericOpenGLRenderWindow::SafeDownCast(window_on(egl->context));
    window_ = shared(window);
    window->SetSize(width_px, height_px);
    window->OpenGLInit();
    if (!messages.has_error()) {
      egl_ = std::move(egl);
      return;
    }
    window_.reset();
  }
  if (!x_display_can_render())
    throw IoFailure(
        "cannot render: neither EGL nor an X display gives an OpenGL 3.2 context. Install libegl1, "
        "libegl-mesa0 and "
        "libgl1-mesa-dri, or run under: xvfb-run -a -s \"-noreset\"");
  egl.reset();
  window_ = shared(vtkRenderWindow::New());
  window_->SetOffScreenRendering(1);
  window_->SetSize(width_px, height_px);
}

RenderWindow::~RenderWindow() {
  window_.reset();  // before the context
}

}  // namespace witherfield::vis
