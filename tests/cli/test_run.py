"""What a run writes, and that it is the same for any number of threads."""
import json
import unittest

from program import HILL, STILL, TINY, ProgramTest


class Run(ProgramTest):
    def test_writes_the_contracted_files(self):
        self.hill()
        done = self.good("run", self.scene(HILL + STILL, "meadow.toml"), "-q")
        self.assertEqual(done.stderr, "")
        files = self.files("out/meadow")
        for i in range(3):
            for name in (f"texel/texel_{i:04}.vti", f"optics/optics_{i:04}.vti", f"points/points_{i:04}.vtp"):
                self.assertIn(name, files)
        for name in ("grass.pvd", "grass_optics.pvd", "grass_points.pvd", "terrain.vtp", "view_in_paraview.py",
                     "scene.resolved.json", "run.json", "pov/a_texel.pov", "pov/a_blades.pov"):
            self.assertIn(name, files)
        self.assertNotIn("run.partial.json", files)
        self.assert_nothing_half_written()

    def test_run_json_tells_everything(self):
        self.hill()
        self.good("run", self.scene(HILL + STILL, "meadow.toml"))
        run = json.loads((self.folder / "out/meadow/run.json").read_text())
        self.assertEqual(run["program"], "witherfield")
        self.assertRegex(run["version"], r"\d+\.\d+\.\d+")
        self.assertEqual(run["seed"], 1)
        self.assertEqual(run["scene"]["name"], "meadow")
        self.assertEqual(run["scene"]["season"]["tip_advance"], 0.08)  # a default, spelled out
        self.assertAlmostEqual(run["scene"]["terrain"]["width_m"], 0.6)  # 3 texels of 0.2 m
        self.assertEqual([f["wd"] for f in run["frames"]], [0.0, 0.3, 0.9])
        self.assertEqual([f["time_days"] for f in run["frames"]], [0.0, 6.0, 18.0])
        for stage in run["stages"]:
            self.assertGreaterEqual(stage["seconds"], 0)
            self.assertGreater(stage["peak_memory_MiB"], 1)
        for name, check in run["checks"].items():
            self.assertTrue(check["passed"], (name, check))
        self.assertIn("density_error_relative", run["checks"])
        self.assertIn("terrain_self_intersections", run["checks"])
        lo, hi = run["value_ranges"]["water"]
        self.assertTrue(0 <= lo < hi <= 1, (lo, hi))
        self.assertEqual(run["units"]["stress_vein_MPa"], "MPa")
        listed = {f["path"]: f["bytes"] for f in run["files"]}
        on_disk = {p: (self.folder / "out/meadow" / p).stat().st_size for p in self.files("out/meadow")}
        del on_disk["run.json"]
        self.assertEqual(listed, on_disk)
        self.assertEqual(run["stills"][0]["scenes"], {"texel": "pov/a_texel.pov", "blades": "pov/a_blades.pov"})

    def test_ranges_are_those_of_all_frames(self):
        self.good("run", self.scene(TINY))
        run = json.loads((self.folder / "out/scene/run.json").read_text())
        for name, whole in run["value_ranges"].items():
            self.assertEqual(whole[0], min(f["ranges"][name][0] for f in run["frames"]), name)
            self.assertEqual(whole[1], max(f["ranges"][name][1] for f in run["frames"]), name)

    def test_variants_have_series_of_their_own(self):
        text = TINY.replace("resolution = 32", "resolution = 32\nvariants = 2\nvariant_spread = 1")
        text = text.replace("[texel]", "wd_frames_other_variants = [0.3]\n[texel]")
        self.good("run", self.scene(text))
        files = self.files("out/scene")
        self.assertIn("texel/texel_v1_0000.vti", files)
        self.assertNotIn("texel/texel_v1_0001.vti", files)
        series = (self.folder / "out/scene/grass_variant1.pvd").read_text()
        self.assertIn("texel/texel_v1_0000.vti", series)
        self.assertIn('timestep="6"', series)

    def test_other_variants_write_what_is_asked_for(self):
        text = TINY.replace("resolution = 32", "resolution = 32\nvariants = 2")
        for what, series in (("all", {"texel", "optics", "points"}), ("fields", {"texel"}), ("none", set())):
            self.good("run", self.scene(text + f'[output]\nother_variants = "{what}"\n'), "-o", what)
            files = self.files(what)
            self.assertEqual({f.split("/")[0] for f in files if "_v1_" in f}, series, what)
            self.assertIn("optics/optics_0000.vti", files)  # the first variant's

    def test_blades_are_written_as_meshes_that_pass_the_check(self):
        self.good("run", self.scene(TINY + "[output]\nblades = true\n"))
        run = json.loads((self.folder / "out/scene/run.json").read_text())
        self.assertEqual(run["blade_meshes"]["meshes"], 3)
        self.assertEqual(run["blade_meshes"]["blades"], 90)
        self.assertTrue(run["checks"]["blades_not_manifold"]["passed"])
        self.assertTrue(run["checks"]["blades_degenerate_faces"]["passed"])
        self.assertIn("blades/blades_0002.vtp", (self.folder / "out/scene/grass_blades.pvd").read_text())
        found = json.loads(self.good("check", "out/scene/blades/blades_0002.vtp", "--json").stdout)["meshes"][0]
        self.assertEqual(found["length_unit"], "mm")
        self.assertEqual(found["shells"], 30)
        self.assertEqual(found["shell"][7]["part"], "blade 7")

    def test_output_switches(self):
        text = TINY + '[output]\noptics = false\npoints = false\ncompression = "zlib"\n'
        self.good("run", self.scene(text))
        files = self.files("out/scene")
        self.assertIn("texel/texel_0000.vti", files)
        self.assertFalse([f for f in files if f.startswith(("optics", "points", "pov"))])
        self.assertIn(b"vtkZLibDataCompressor", (self.folder / "out/scene/texel/texel_0000.vti").read_bytes())

    def test_same_bytes_for_one_and_two_threads(self):
        self.hill()
        scene = self.scene(HILL + STILL)
        self.good("run", scene, "-o", "one", "--threads", 1)
        self.good("run", scene, "-o", "two", "--threads", 2)
        one, two = self.files("one"), self.files("two")
        one.pop("run.json")  # timings
        two.pop("run.json")
        self.assertEqual(one, two)
        self.assertGreater(len(one), 12)

    def test_another_seed_gives_other_fields(self):
        self.good("run", self.scene(TINY), "-o", "one")
        self.good("run", self.scene("seed = 2\n" + TINY), "-o", "two")
        self.assertNotEqual(self.files("one")["texel/texel_0000.vti"], self.files("two")["texel/texel_0000.vti"])

    def test_info_of_a_run_and_of_files(self):
        self.good("run", self.scene(TINY))
        run = self.good("info", "out/scene").stdout
        self.assertIn('run "scene"', run)
        self.assertIn("water", run)
        self.assertIn("root_shift", run)
        file = self.good("info", "out/scene/texel/texel_0001.vti").stdout
        self.assertIn("stress_vein_MPa", file)
        self.assertIn("wd 0.3", file)
        series = self.good("info", "out/scene/grass.pvd").stdout
        self.assertIn("texel/texel_0002.vti", series)


if __name__ == "__main__":
    unittest.main()
