"""Bad input: the right exit code, a message that names file, line, key or file, and nothing written."""
import os
import resource
import unittest

from program import HILL, STILL, TINY, ProgramTest, ascii_grid, hill_rows


class BadInput(ProgramTest):
    def assert_nothing_written(self):
        self.assertFalse((self.folder / "out").exists())
        self.assert_nothing_half_written()

    def run_bad(self, code, text, *says, **options):
        self.bad(code, "run", self.scene(text), says=says, **options)
        self.assert_nothing_written()

    def test_missing_scene(self):
        self.bad(3, "run", "none.toml", says=["none.toml"])

    def test_unknown_key(self):
        self.run_bad(2, TINY + "lenght_m = [0.1, 0.2]\n", "scene.toml:11: blades.lenght_m", "did you mean 'length_m'")

    def test_proportion_zero(self):
        self.run_bad(2, TINY + "[model]\nproportion = 0\n", "scene.toml:12: model.proportion = 0", "greater than 0")

    def test_negative_lengths(self):
        self.run_bad(2, TINY + "length_m = [-0.1, 0.2]\n", "scene.toml:11: blades.length_m[0] = -0.1", "0.005..2 m")

    def test_curve_not_monotone_in_time(self):
        self.run_bad(2, TINY.replace("[texel]", "water_curve = [[0, 1], [0.6, 0.5], [0.5, 0.2]]\n[texel]"),
                     "scene.toml:6: season.water_curve[2]", "time must increase")

    def test_unknown_kind(self):
        self.run_bad(2, 'kind = "rock"\n', "scene.toml:1: kind", '"grass"')

    def test_not_toml(self):
        self.run_bad(2, "kind = \"grass\"\n[season\n", "scene.toml:2", "not valid TOML")

    def test_missing_dem(self):
        self.run_bad(3, HILL, "hill.asc")

    def test_unreadable_geotiff(self):
        (self.folder / "hill.tif").write_bytes(b"II*\0" + bytes(range(200)))
        self.run_bad(3, HILL.replace("hill.asc", "hill.tif"), "hill.tif")

    def test_void_cells(self):
        rows = hill_rows()
        rows[2][3] = -9999
        self.hill(rows)
        self.run_bad(2, HILL, "hill.asc", "1")

    def test_nan_cells(self):
        rows = [[float(v) for v in row] for row in hill_rows()]
        rows[3][4] = "nan"
        (self.folder / "hill.asc").write_text(ascii_grid(rows))
        self.run_bad(2, HILL, "hill.asc")

    def test_tiles_that_do_not_fit_the_true_size(self):
        self.hill()
        self.run_bad(2, HILL + "width_m = 0\n", "texel.size_m = 0.2 m")

    def test_camera_under_ground(self):
        self.hill()
        self.run_bad(2, HILL + STILL.replace("[0.1, -0.4, 0.3]", "[0.3, 0.3, -0.1]"), "still \"a\"", "under ground")

    def test_folder_that_cannot_be_made(self):
        self.bad(3, "run", self.scene(TINY), "-o", "/proc/none/x", says=["/proc/none/x"])
        self.bad(3, "run", self.scene(TINY), "-o", "scene.toml", says=["scene.toml"])

    def test_folder_of_somebody_else_is_left_alone(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "letter.txt").write_text("dear")
        for flag in ((), ("--force",), ("--resume",)):
            self.bad(2, "run", self.scene(TINY), "-o", "mine", *flag, says=["'mine'", "not a run"])
        self.assertEqual(list(self.files("mine")), ["letter.txt"])

    def test_disk_full_at_the_first_frame_leaves_nothing(self):
        def no_large_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))
        self.run_bad(3, TINY, "out/scene/", before=no_large_files)

    def test_render_and_info_of_what_is_not_a_run(self):
        (self.folder / "empty").mkdir()
        self.bad(3, "render", "empty", says=["'empty'", "run.json"])
        self.bad(3, "info", "empty", says=["'empty'"])
        self.bad(3, "info", "nothing.vti", says=["nothing.vti"])
        self.bad(3, "volume", "nothing.vti", "-o", "a.png", says=["nothing.vti"])
        (self.folder / "broken.vti").write_text("<VTKFile>")
        self.bad(3, "info", "broken.vti", says=["broken.vti"])

    def test_povray_missing(self):
        self.good("run", self.scene(TINY + STILL))
        before = self.files("out/scene")
        env = dict(os.environ, PATH=str(self.folder))
        self.bad(3, "render", "out/scene", env=env, says=["povray"])
        self.assertEqual(self.files("out/scene"), before)
        self.assertFalse((self.folder / "out/scene/images").exists())

    def test_render_of_unknown_still_or_look(self):
        self.good("run", self.scene(TINY + STILL.replace('"texel", "blades"', '"texel"')))
        self.bad(2, "render", "out/scene", "--scene", "b", says=["--scene b", "there are: a"])
        self.bad(2, "render", "out/scene", "--look", "blades", says=["--look blades"])

    def test_render_without_stills(self):
        self.good("run", self.scene(TINY))
        self.bad(2, "render", "out/scene", says=["[[still]]"])


if __name__ == "__main__":
    unittest.main()
