// Whether an X display can hold VTK's off-screen window. VTK aborts the process when it cannot, so this asks
// first.
#include <GL/glx.h>
#include <X11/Xlib.h>

namespace witherfield::vis {

bool x_display_can_render() {
  Display* display = XOpenDisplay(nullptr);
  if (!display) return false;
  const int wish[] = {GLX_RENDER_TYPE,
                      GLX_RGBA_BIT,
                      GLX_DOUBLEBUFFER,
                      True,
                      GLX_RED_SIZE,
                      1,
                      GLX_GREEN_SIZE,
                      1,
                      GLX_BLUE_SIZE,
                      1,
                      GLX_DEPTH_SIZE,
                      1,
                      None};
  bool ok = false;
  if (glXQueryExtension(display, nullptr, nullptr)) {
    int count = 0;
    GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wish, &count);
    ok = configs && count > 0;
    if (configs) XFree(configs);
  }
  XCloseDisplay(display);
  return ok;
}

}  // namespace witherfield::vis
