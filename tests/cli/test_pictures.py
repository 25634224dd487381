"""render and volume, end to end, as small pictures."""
import os
import shutil
import struct
import unittest

from program import HILL, STILL, TINY, ProgramTest


def png_size(path):
    head = path.read_bytes()[:24]
    return head[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", head[16:24])


class Pictures(ProgramTest):
    @unittest.skipUnless(shutil.which("povray"), "povray is not installed")
    def test_render_both_looks_of_a_hill(self):
        self.hill()
        self.good("run", self.scene(HILL + STILL))
        done = self.good("render", "out/scene", "--look", "all", "--quality", "draft")
        for look in ("texel", "blades"):
            picture = self.folder / f"out/scene/images/a_{look}.png"
            self.assertEqual(png_size(picture), (64, 36))
            self.assertIn(f"a_{look}.png", done.stdout)
        self.assertIn("a_texel", self.good("info", "out/scene").stdout)
        self.good("render", "out/scene", "--scene", "a", "--size", "32x18", "--quality", "draft")
        self.assertEqual(png_size(self.folder / "out/scene/images/a_texel.png"), (32, 18))
        self.assert_nothing_half_written()

    def test_volume_of_a_run_and_of_a_file_without_a_display(self):
        env = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        self.good("run", self.scene(TINY))
        for name, arguments in {"water": ["out/scene", "--wd", "0.3"],
                                "stress": ["out/scene", "--day", "18", "--field", "stress_vein_MPa", "--surface"],
                                "file": ["out/scene/texel/texel_0000.vti", "--range", "0,1"]}.items():
            self.good("volume", *arguments, "--size", "160x90", "-o", name + ".png", env=env)
            self.assertEqual(png_size(self.folder / (name + ".png")), (160, 90), name)

    def test_volume_says_which_frame_it_took(self):
        self.good("run", self.scene(TINY))
        done = self.good("volume", "out/scene", "--day", "7", "--size", "96x64", "-o", "a.png")
        self.assertIn("wd 0.3", done.stderr)
        self.bad(2, "volume", "out/scene/texel/texel_0000.vti", "--day", "7", "-o", "b.png", says=["--day"])
        self.assertFalse((self.folder / "b.png").exists())


if __name__ == "__main__":
    unittest.main()
