// Debian builds GLEW for GLX. In an EGL context its glewInit() loads every core entry point and then reports
// that there is no GLX display; VTK takes that for a failure. This definition, exported from the executable
// (vis/CMakeLists.txt passes the linker option on), comes before GLEW's own for VTK's libraries: it calls the
// real one and lets that one report pass. GLVND dispatches the entry points to whichever context is current,
// so they are valid under EGL.
#include <GL/glew.h>
#include <dlfcn.h>

extern "C" __attribute__((visibility("default"))) GLenum GLEWAPIENTRY glewInit() {
  constexpr GLenum kNoGlxDisplay = 4;  // GLEW_ERROR_NO_GLX_DISPLAY, not named in older headers
  using Init = GLenum (*)();
  const auto real = reinterpret_cast<Init>(dlsym(RTLD_NEXT, "glewInit"));
  if (!real) return kNoGlxDisplay;
  const GLenum result = real();
  return result == kNoGlxDisplay ? GLenum(GLEW_OK) : result;
}

namespace witherfield::vis {

/// Referenced by render_window.cpp, so that a static library hands this file to the linker.
bool glew_is_bridged() {
  return dlsym(RTLD_DEFAULT, "glewInit") == reinterpret_cast<void*>(&glewInit);
}

}  // namespace witherfield::vis
