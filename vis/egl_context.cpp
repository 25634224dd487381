#include "vis/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace witherfield::vis {
namespace {

/// One display for the life of the process: eglTerminate does not count its users.
EGLDisplay surfaceless_display() {
  static const EGLDisplay display = [] {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!get_display) return EGL_NO_DISPLAY;
    const EGLDisplay d = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (d == EGL_NO_DISPLAY || !eglInitialize(d, nullptr, nullptr)) return EGL_NO_DISPLAY;
    return d;
  }();
  return display;
}

}  // namespace

EglContext::~EglContext() {
  if (!context_) return;
  if (is_current()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

bool EglContext::start() {
  display_ = surfaceless_display();
  if (display_ == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API)) return false;
  const EGLint config_wish[] = {EGL_SURFACE_TYPE,
                                EGL_PBUFFER_BIT,
                                EGL_RENDERABLE_TYPE,
                                EGL_OPENGL_BIT,
                                EGL_RED_SIZE,
                                8,
                                EGL_GREEN_SIZE,
                                8,
                                EGL_BLUE_SIZE,
                                8,
                                EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display_, config_wish, &config, 1, &count) || count < 1) return false;
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            2,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
  // VTK draws into frame buffers of its own, so no surface is needed.
  return context_ && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

void EglContext::make_current() const {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

bool EglContext::is_current() const {
  return eglGetCurrentContext() == context_;
}

}  // namespace witherfield::vis
