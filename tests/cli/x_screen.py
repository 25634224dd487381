"""A screen without a monitor, and a hand on its mouse and keys: Xvfb, driven through the XTEST extension.

Only what Debian's xvfb, libx11-6 and libxtst6 bring; pictures are numpy arrays."""
import ctypes as c
import os
import shutil
import subprocess
import time

import numpy as np


def missing():
    """Why there can be no screen here; "" when there can."""
    if not shutil.which("Xvfb"):
        return "Xvfb is not installed"
    try:
        c.CDLL("libXtst.so.6")
    except OSError:
        return "libXtst.so.6 is not installed"
    return ""


class XImage(c.Structure):
    _fields_ = [("width", c.c_int), ("height", c.c_int), ("xoffset", c.c_int), ("format", c.c_int),
                ("data", c.c_void_p), ("byte_order", c.c_int), ("bitmap_unit", c.c_int), ("bitmap_bit_order", c.c_int),
                ("bitmap_pad", c.c_int), ("depth", c.c_int), ("bytes_per_line", c.c_int), ("bits_per_pixel", c.c_int)]


def libraries():
    x, xtst = c.CDLL("libX11.so.6"), c.CDLL("libXtst.so.6")
    display, window = c.c_void_p, c.c_ulong
    for library, name, result, arguments in (
            (x, "XOpenDisplay", display, [c.c_char_p]), (x, "XCloseDisplay", c.c_int, [display]),
            (x, "XDefaultRootWindow", window, [display]), (x, "XSync", c.c_int, [display, c.c_int]),
            (x, "XStringToKeysym", c.c_ulong, [c.c_char_p]), (x, "XKeysymToKeycode", c.c_ubyte, [display, c.c_ulong]),
            (x, "XGetImage", c.POINTER(XImage), [display, window, c.c_int, c.c_int, c.c_uint, c.c_uint, c.c_ulong, c.c_int]),
            (x, "XFree", c.c_int, [c.c_void_p]), (x, "XFetchName", c.c_int, [display, window, c.POINTER(c.c_char_p)]),
            (x, "XQueryTree", c.c_int, [display, window, c.POINTER(window), c.POINTER(window),
                                        c.POINTER(c.POINTER(window)), c.POINTER(c.c_uint)]),
            (xtst, "XTestFakeMotionEvent", c.c_int, [display, c.c_int, c.c_int, c.c_int, c.c_ulong]),
            (xtst, "XTestFakeButtonEvent", c.c_int, [display, c.c_uint, c.c_int, c.c_ulong]),
            (xtst, "XTestFakeKeyEvent", c.c_int, [display, c.c_uint, c.c_int, c.c_ulong])):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return x, xtst


class Screen:
    """An Xvfb of its own and a connection to it."""

    def __init__(self, width=1000, height=760):
        self.size = width, height
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-noreset"],
                                       pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as answer:
            self.name = ":" + answer.readline().strip()
        self.x, self.xtst = libraries()
        self.display = self.x.XOpenDisplay(self.name.encode())
        if self.name == ":" or not self.display:
            self.server.kill()
            raise RuntimeError("Xvfb does not answer")
        self.root = self.x.XDefaultRootWindow(self.display)

    def close(self):
        self.x.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait()

    def environment(self):
        return {**os.environ, "DISPLAY": self.name}

    # ---- the hand

    def move(self, x, y):
        self.xtst.XTestFakeMotionEvent(self.display, -1, round(x), round(y), 0)
        self.x.XSync(self.display, 0)

    def button(self, down, button=1):
        self.xtst.XTestFakeButtonEvent(self.display, button, int(down), 0)
        self.x.XSync(self.display, 0)

    def click(self, at, button=1):
        self.move(*at)
        self.button(True, button)
        self.button(False, button)

    def drag(self, start, end, steps=25, button=1, pause=0.012, held=None):
        """Presses at `start`, moves to `end`; calls held() before the button goes up."""
        self.move(*start)
        self.button(True, button)
        for i in range(1, steps + 1):
            self.move(*(a + (b - a) * i / steps for a, b in zip(start, end)))
            time.sleep(pause)
        if held:
            held()
        self.button(False, button)

    def key(self, *names):
        """The last key, pressed while the others are held."""
        codes = [self.x.XKeysymToKeycode(self.display, self.x.XStringToKeysym(n.encode())) for n in names]
        for code in codes:
            self.xtst.XTestFakeKeyEvent(self.display, code, 1, 0)
        for code in reversed(codes):
            self.xtst.XTestFakeKeyEvent(self.display, code, 0, 0)
        self.x.XSync(self.display, 0)

    # ---- the eye

    def shot(self):
        """The whole screen, rows from the top, red green blue as int16."""
        image = self.x.XGetImage(self.display, self.root, 0, 0, *self.size, 0xFFFFFFFF, 2)
        raw = c.string_at(image.contents.data, image.contents.bytes_per_line * self.size[1])
        pixels = np.frombuffer(raw, np.uint8).reshape(self.size[1], -1, 4)[:, :self.size[0], 2::-1].astype(np.int16)
        self.x.XFree(image.contents.data)
        self.x.XFree(image)
        return pixels

    def title(self):
        """Of the only window; "" while there is none."""
        root, parent, children, count = c.c_ulong(), c.c_ulong(), c.POINTER(c.c_ulong)(), c.c_uint()
        self.x.XQueryTree(self.display, self.root, root, parent, children, count)
        titles = []
        for i in range(count.value):
            name = c.c_char_p()
            if self.x.XFetchName(self.display, children[i], name) and name.value:
                titles.append(name.value.decode(errors="replace"))
        return titles[0] if titles else ""
