#include "vis/x_events.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <poll.h>

#include <cctype>
#include <optional>

namespace witherfield::vis {
namespace {

Display* as_display(void* p) { return static_cast<Display*>(p); }

XInput at(XInput::Kind kind, int x, int y, unsigned state) {
  XInput in;
  in.kind = kind;
  in.x = x;
  in.y = y;
  in.shift = (state & ShiftMask) != 0;
  in.control = (state & ControlMask) != 0;
  return in;
}

std::optional<XInput> button_input(const XButtonEvent& e) {
  const bool down = e.type == ButtonPress;
  XInput in = at(down ? XInput::Kind::press : XInput::Kind::release, e.x, e.y, e.state);
  in.button = int(e.button);
  if (e.button <= 3) return in;
  if (!down || e.button > 5) return std::nullopt;  // buttons 4 and 5 are the wheel's steps
  in.kind = XInput::Kind::wheel;
  in.button = e.button == 4 ? 1 : -1;
  return in;
}

std::optional<XInput> key_input(XKeyEvent& e) {
  XInput in = at(XInput::Kind::key, e.x, e.y, e.state);
  const char* name = XKeysymToString(XLookupKeysym(&e, 0));
  if (!name) return std::nullopt;
  in.key = name;
  if (in.key.size() == 1) in.key[0] = char(std::tolower(static_cast<unsigned char>(in.key[0])));
  return in;
}

}  // namespace

XEvents::XEvents(void* display, unsigned long window) : display_(display), window_(window) {
  Display* d = as_display(display);
  XSelectInput(d, window,
               KeyPressMask | ButtonPressMask | ButtonReleaseMask | PointerMotionMask | ExposureMask | StructureNotifyMask);
  Atom message = XInternAtom(d, "WM_DELETE_WINDOW", False);
  delete_message_ = message;
  XSetWMProtocols(d, window, &message, 1);
  XFlush(d);
}

std::vector<XInput> XEvents::fetch() {
  Display* d = as_display(display_);
  std::vector<XInput> out;
  const auto add = [&](const XInput& in, bool replaces_same) {
    if (replaces_same && !out.empty() && out.back().kind == in.kind)
      out.back() = in;
    else
      out.push_back(in);
  };
  while (XPending(d) > 0) {
    XEvent e;
    XNextEvent(d, &e);
    if (e.xany.window != window_) continue;
    switch (e.type) {
      case ButtonPress:
      case ButtonRelease:
        if (const auto in = button_input(e.xbutton)) add(*in, false);
        break;
      case MotionNotify:
        add(at(XInput::Kind::motion, e.xmotion.x, e.xmotion.y, e.xmotion.state), true);
        break;
      case KeyPress:
        if (const auto in = key_input(e.xkey)) add(*in, false);
        break;
      case ConfigureNotify:
        add(at(XInput::Kind::resized, e.xconfigure.width, e.xconfigure.height, 0), true);
        break;
      case Expose:
        add(at(XInput::Kind::exposed, 0, 0, 0), true);
        break;
      case ClientMessage:
        if (static_cast<Atom>(e.xclient.data.l[0]) == delete_message_) add(at(XInput::Kind::close, 0, 0, 0), false);
        break;
      default:
        break;
    }
  }
  return out;
}

void XEvents::wait(double seconds) {
  Display* d = as_display(display_);
  if (XPending(d) > 0) return;
  pollfd line{ConnectionNumber(d), POLLIN, 0};
  poll(&line, 1, int(seconds * 1000));
}

}  // namespace witherfield::vis
