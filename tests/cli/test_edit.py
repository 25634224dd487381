"""witherfield edit, used as a person uses it: a window on a screen, a mouse, keys, and eyes on what is shown."""
import re
import subprocess
import time
import unittest

import numpy as np

import x_screen
from program import PROGRAM, ProgramTest

LEAF = """kind = "leaf"  # to be kept
species = "cucumber"
[mesh]
edge_m = 0.004
vein_edge_m = 0.003
outline_spacing_m = 0.002
[view]
size_px = [160, 120]
"""
SIZE = 900, 640
PATIENCE_S = 60  # a busy machine is slow


class NoWindow(ProgramTest):
    def test_without_a_display_it_says_so(self):
        self.scene(LEAF)
        for name in (None, ":4711"):
            with self.subTest(display=name):
                environment = {k: v for k, v in __import__("os").environ.items() if k != "DISPLAY"}
                if name:
                    environment["DISPLAY"] = name
                self.bad(3, "edit", "scene.toml", env=environment, says=["needs a display", "xvfb-run"])

    def test_wrong_input(self):
        self.scene("kind = \"grass\"\n", "grass.toml")
        self.bad(2, "edit", "grass.toml", says=["grass.toml", "leaf"])
        self.bad(3, "edit", "absent.toml", says=["absent.toml"])
        self.assertEqual(self.program("edit", "grass.toml", "--samples", "99").returncode, 2)

    def test_help_teaches_keys_and_mouse(self):
        text = self.good("edit", "--help").stdout
        for word in ("left button", "wheel", "Tab", "Ctrl+Z", "Delete", "S or Ctrl+S", "_edited.toml", "rotation-aware"):
            self.assertIn(word, text)


@unittest.skipIf(x_screen.missing(), x_screen.missing())
class Window(ProgramTest):
    def setUp(self):
        super().setUp()
        self.screen = x_screen.Screen()
        self.addCleanup(self.screen.close)
        self.editor = None
        self.addCleanup(self.kill)

    def kill(self):
        if self.editor and self.editor.poll() is None:
            self.editor.kill()
            self.editor.communicate()

    def open(self, text=LEAF, *arguments):
        self.scene(text, "leaf.toml")
        self.editor = subprocess.Popen([PROGRAM, "edit", "leaf.toml", "--size", "%dx%d" % SIZE, *arguments], cwd=self.folder,
                                       env=self.screen.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.wait_for(lambda: "witherfield edit" in self.screen.title() and "intersecting ..." not in self.screen.title(), "the window")
        self.screen.move(SIZE[0] - 30, 30)
        return self.still()

    def wait_for(self, holds, what):
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            if self.editor.poll() is not None:
                self.fail("the editor ended: %s" % (self.editor.communicate(),))
            value = holds()
            if value:
                return value
            time.sleep(0.05)
        self.fail("waited in vain for %s; title: %s" % (what, self.screen.title()))

    def still(self):
        """The picture when it does not change any more."""
        last = [self.screen.shot(), 0]

        def settled():
            time.sleep(0.3)
            shot = self.screen.shot()
            last[1] = last[1] + 1 if np.array_equal(shot, last[0]) and "intersecting ..." not in self.screen.title() else 0
            last[0] = shot
            return last[1] >= 3
        self.wait_for(settled, "a still picture")
        return last[0]

    def title_holds(self, pattern):
        return self.wait_for(lambda: re.search(pattern, self.screen.title()), "the title to hold '%s'" % pattern)

    def quit(self):
        self.screen.key("q")
        try:
            out, err = self.editor.communicate(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.fail("it does not quit; title: " + self.screen.title())
        self.assertEqual(self.editor.returncode, 0, err)
        return out, err

    # ---- what the eye tells apart

    @staticmethod
    def leaf(shot):
        """Where the blade is seen: greener than anything of the window itself."""
        r, g, b = (shot[:, :, k] for k in range(3))
        mask = (g > b + 22) & (g > r - 12)
        mask[:, SIZE[0]:] = mask[SIZE[1]:] = False
        return mask

    @staticmethod
    def middle(mask, what):
        y, x = np.nonzero(mask)
        if len(x) < 20:
            raise AssertionError("no %s is seen" % what)
        return float(x.mean()), float(y.mean())

    def orange(self, shot):
        r, g, b = (shot[:, :, k] for k in range(3))
        return (r > 170) & (g > 70) & (g < 0.65 * r) & (b < 80)

    def blue(self, shot):
        r, g, b = (shot[:, :, k] for k in range(3))
        return (b > 140) & (r < 90) & (g < 0.75 * b)

    def far_end(self, shot):
        """A place well inside the leaf, far from the blue handle at the petiole."""
        mask = self.leaf(shot)
        for _ in range(14):  # away from the margin
            mask = mask & np.roll(mask, 1, 0) & np.roll(mask, -1, 0) & np.roll(mask, 1, 1) & np.roll(mask, -1, 1)
        y, x = np.nonzero(mask)
        bx, by = self.middle(self.blue(shot), "handle at the petiole")
        k = np.argmax((x - bx) ** 2 + (y - by) ** 2)
        return float(x[k]), float(y[k])

    @staticmethod
    def view(shot):
        """Without the panel and the lines at the bottom, which say what was done."""
        out = shot[:SIZE[1] - 110, :SIZE[0]].copy()
        out[:250, :330] = 0
        return out

    def pixels_changed(self, a, b):
        return int((np.abs(self.view(a) - self.view(b)).max(axis=2) > 24).sum())

    def looks_like(self, picture, pixels):
        """Soon, but for so many pixels."""
        try:
            self.wait_for(lambda: self.pixels_changed(self.screen.shot(), picture) < pixels, "a picture seen before")
        except AssertionError as e:
            raise AssertionError("%s; %d pixels differ" % (e, self.pixels_changed(self.screen.shot(), picture))) from e

    # ---- tests

    def test_a_drag_moves_the_leaf_and_undo_brings_it_back(self):
        first = self.open()
        self.assertGreater(self.leaf(first).sum(), 30000)
        self.title_holds(r"handles: 1, rotation-aware, area [+-]0\.00 %")
        at = self.far_end(first)
        self.screen.click(at)
        self.title_holds("handles: 2")
        self.screen.key("Escape")
        self.wait_for(lambda: self.orange(self.screen.shot()).sum() > 20, "the new handle")
        placed = self.still()
        x, y = self.middle(self.orange(placed), "new handle")
        self.assertLess(np.hypot(x - at[0], y - at[1]), 16)  # on the nearest vertex

        while_held = []
        pin = self.middle(self.blue(placed), "handle at the petiole")
        def under_the_pointer():
            shot = self.screen.shot()
            if self.orange(shot).sum() > 20 and abs(self.middle(self.orange(shot), "handle")[1] - (y - 90)) < 4:
                while_held.append(shot)
            return bool(while_held)
        self.screen.drag((x, y), (x - 40, y - 90), held=lambda: self.wait_for(under_the_pointer, "the handle under the pointer"))
        self.assertGreater(self.pixels_changed(placed, while_held[0]), 5000)  # it follows before the button is up
        self.title_holds(r"strain (?!0\.0)")
        self.screen.key("Escape")  # nothing selected, as after undo and redo
        moved = self.still()
        self.assertGreater(self.pixels_changed(placed, moved), 5000)
        x2, y2 = self.middle(self.orange(moved), "handle")
        self.assertLess(np.hypot(x2 - (x - 40), y2 - (y - 90)), 4)
        pin2 = self.middle(self.blue(moved), "handle at the petiole")
        self.assertLess(np.hypot(pin2[0] - pin[0], pin2[1] - pin[1]), 2)
        drift, strain = (float(v) for v in self.title_holds(r"area ([+-]\d+\.\d+) %, strain (\d+\.\d+) %, flipped \d+, inter").groups())
        self.assertNotEqual(strain, 0)
        self.assertLess(abs(drift), 20)

        self.screen.key("Control_L", "z")
        self.title_holds(r"strain 0\.0 %")
        self.looks_like(placed, 30)
        self.screen.key("Control_L", "z")
        self.title_holds("^leaf - handles: 1")  # no star: as it was opened
        self.screen.key("Control_L", "y")
        self.screen.key("Control_L", "Shift_L", "z")
        self.title_holds("handles: 2")
        self.looks_like(moved, 30)
        self.screen.key("r")
        self.title_holds("handles: 1,")
        self.looks_like(first, 30)

        self.screen.key("Control_L", "z")
        self.title_holds("handles: 2")
        self.screen.key("q")  # not saved: it asks for a second time
        time.sleep(1)
        self.assertIsNone(self.editor.poll())
        _, err = self.quit()
        self.assertRegex(err, r"\d+ frames while dragging \d+ vertices: \d+ frames/s")

    def test_what_is_saved_runs_to_the_same_leaf(self):
        shot = self.open()
        at = self.far_end(shot)
        self.screen.drag(at, (at[0] + 30, at[1] - 70))  # a new handle, taken along at once
        self.title_holds("handles: 2.*strain [1-9]")
        self.still()
        self.screen.key("Control_L", "s")
        self.wait_for(lambda: (self.folder / "leaf_edited.toml").exists(), "the saved scene")
        self.title_holds("^leaf - ")
        out, _ = self.quit()  # saved: no second time
        self.assertEqual(out.split(), ["leaf_edited.obj", "leaf_edited.vtp", "leaf_edited.toml"])
        self.assert_nothing_half_written()
        self.assertIn('kind = "leaf"  # to be kept\n', (self.folder / "leaf_edited.toml").read_text())
        self.good("check", "leaf_edited.obj", "leaf_edited.vtp")
        self.good("run", "leaf_edited.toml", "-o", "out")
        ran = sorted((self.folder / "out" / "leaf").glob("leaf_*.obj"))[-1]
        saved, again = (np.array([line.split()[1:4] for line in path.read_text().splitlines() if line.startswith("v ")], float)
                        for path in (self.folder / "leaf_edited.obj", ran))
        self.assertEqual(saved.shape, again.shape)
        self.assertLess(np.abs(saved - again).max(), 1e-3)  # mm

    def test_dragging_an_outline_point_rebuilds_the_leaf(self):
        self.open()
        self.screen.key("Tab")
        area = self.area()
        self.wait_for(lambda: self.green(self.screen.shot()).sum() > 300, "the points of the outline")
        flat = self.still()
        g = self.green(flat)
        # A marker at the right margin: the ball that is farthest to the right.
        y, x = np.nonzero(g)
        k = np.argmax(x)
        at = self.marker_at(g, x[k], y[k])
        self.screen.drag(at, (at[0] + 60, at[1]))
        self.wait_for(lambda: self.area() > area * 1.01, "a larger leaf")
        wider = self.still()
        self.assertGreater(self.leaf(wider).sum(), self.leaf(flat).sum() * 1.005)
        self.screen.key("s")
        self.wait_for(lambda: (self.folder / "leaf_edited.toml").exists(), "the saved scene")
        self.assertTrue((self.folder / "leaf_edited_points.csv").exists())
        self.screen.key("Control_L", "z")
        self.title_holds(r"; %.1f cm2" % area)
        self.looks_like(flat, 60)

    def test_points_are_made_on_the_curve_and_removed(self):
        self.open()
        self.screen.key("Tab")
        count = int(self.title_holds(r"outline (\d+), midrib").group(1))
        area = self.area()
        self.wait_for(lambda: self.green(self.screen.shot()).sum() > 300, "the points of the outline")
        flat = self.still()
        green = self.green(flat)
        balls = green | self.violet(flat)
        for _ in range(2):  # lines are thin
            balls = balls & np.roll(balls, 1, 0) & np.roll(balls, -1, 0) & np.roll(balls, 1, 1) & np.roll(balls, -1, 1)
        by, bx = np.nonzero(balls)
        y, x = np.nonzero(green)
        free = np.array([np.hypot(bx - u, by - v).min() for u, v in zip(x, y)])
        k = np.argmax(free)
        self.assertGreater(free[k], 16)
        mx, my = self.middle(self.leaf(flat), "leaf")
        away = np.array([x[k] - mx, y[k] - my]) / np.hypot(x[k] - mx, y[k] - my)
        at = float(x[k]), float(y[k])
        self.screen.drag(at, (at[0] + 30 * away[0], at[1] + 30 * away[1]))  # made and taken along at once
        self.title_holds(r"outline %d, midrib" % (count + 1))
        self.wait_for(lambda: self.area() > area * 1.001, "a larger leaf")
        self.screen.key("Delete")  # it is selected
        self.title_holds(r"outline %d, midrib" % count)
        self.wait_for(lambda: abs(self.area() - area) < 0.11, "the leaf as it was")
        self.screen.key("Control_L", "z")
        self.screen.key("Control_L", "z")
        self.title_holds(r"outline %d, midrib" % count)
        self.looks_like(flat, 60)

    def test_dragging_the_midrib_bends_the_leaf(self):
        self.open()
        self.screen.key("Tab")
        self.title_holds("midrib [3-9]")
        flat = self.still()
        violet = self.violet(flat)
        y, x = np.nonzero(violet)
        k = np.argmin(y)  # the tip is up
        at = self.marker_at(violet, x[k], y[k])
        area = self.area()
        self.screen.drag(at, (at[0] + 15, at[1] - 30))
        self.wait_for(lambda: self.area() > area + 0.4, "a longer leaf")
        longer = self.still()
        self.assertGreater(self.pixels_changed(flat, longer), 2000)
        self.screen.key("Tab")
        self.title_holds("handles: ")
        self.screen.key("Tab")
        self.screen.key("Control_L", "z")
        self.title_holds(r"; %.1f cm2" % area)
        self.screen.key("c")  # the view took in the longer leaf
        self.looks_like(flat, 60)

    def marker_at(self, mask, x, y):
        """Middle of the ball that this pixel of its colour belongs to."""
        near = np.hypot(*np.meshgrid(np.arange(mask.shape[1]) - x, np.arange(mask.shape[0]) - y)) < 14
        return self.middle(mask & near, "marker")

    def violet(self, shot):
        r, g, b = (shot[:, :, k] for k in range(3))
        mask = (b > 120) & (g < 0.75 * r) & (r < 0.95 * b)
        mask[:, SIZE[0]:] = mask[SIZE[1]:] = False
        return mask

    def area(self):
        return float(self.title_holds(r"points: outline \d+, midrib \d+; (\d+\.\d+) cm2").group(1))

    def green(self, shot):
        r, g, b = (shot[:, :, k] for k in range(3))
        return (g > 95) & (r < 0.45 * g) & (b > 0.5 * g) & (b < 0.85 * g)

    def test_keys_change_what_is_shown(self):
        shot = self.open()
        for key, least in (("w", 3000), ("f", 20000), ("h", 20000), ("v", 20000)):
            self.screen.key(key)
            self.wait_for(lambda: self.pixels_changed(shot, self.screen.shot()) > least, "another picture after " + key)
            shot = self.still()
        self.screen.key("m")
        self.title_holds("handles: 1, linear")
        self.screen.key("p")
        self.wait_for(lambda: (self.folder / "leaf_edited.png").exists(), "the picture")
        self.assertEqual((self.folder / "leaf_edited.png").read_bytes()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
