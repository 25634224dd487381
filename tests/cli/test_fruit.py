"""Fruit, end to end: the examples, their files as other programs read them, meshes of the user's own, resuming, bad input."""
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from program import ProgramTest
from test_pictures import png_size

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "examples"
READER = Path(__file__).resolve().parent / "read_fruit_back.py"
VTK_PYTHON = "/usr/bin/python3"  # where Debian's python3-vtk9 lives

SMALL = """kind = "fruit"
crop = "wheat"
steps = 1
[ripening]
wd_frames = [0.0, 0.5, 1.0]
[wheat]
spikelets = 3
ear_length_mm = 20
"""

STILL = """
[[still]]
name = "ear"
wd = [0.0, 1.0]
size_px = [64, 48]
"""

MAIZE = """kind = "fruit"
crop = "maize"
steps = 1
[ripening]
wd_frames = [1.0]
[maize]
rows = 8
kernels_per_row = 5
ear_length_mm = 50
cob_diameter_mm = 14
"""

# A roof on a square: apex 4 (valence 4) over the ring 0-1-2-3, and the floor's middle 5.
ROOF = [(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0), (0, 0, 2), (0, 0, -0.5)]
ROOF_FACES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)]
ROOF_OBJ = ("".join("v %g %g %g\n" % p for p in ROOF) + "".join("vt %g %g\n" % (p[0], p[1]) for p in ROOF) +
            "".join("f %d/%d %d/%d %d/%d\n" % tuple(n for v in f for n in (v + 1, v + 1)) for f in ROOF_FACES))
RING = "mesh_creases = [[0, 1], [1, 2], [2, 3], [3, 0]]\n"


def vertices(path):
    """Positions of an OBJ file, in its millimetres."""
    return [tuple(map(float, line.split()[1:4])) for line in path.read_text().splitlines() if line.startswith("v ")]


class Fruit(ProgramTest):
    def run_of(self, folder):
        return json.loads((self.folder / folder / "run.json").read_text())

    def assert_files_of_a_run(self, folder, frames):
        files = self.files(folder)
        for i in range(frames):
            self.assertIn(f"fruit/fruit_{i:04}.vtp", files)
        for name in (f"fruit/fruit_{frames - 1:04}.obj", f"fruit/fruit_{frames - 1:04}.ply", "fruit.pvd",
                     "scene.resolved.json", "run.json"):
            self.assertIn(name, files)
        self.assertNotIn("run.partial.json", files)
        self.assert_nothing_half_written()
        run = self.run_of(folder)
        listed = {f["path"]: f["bytes"] for f in run["files"]}
        on_disk = {p: (self.folder / folder / p).stat().st_size for p in files if p != "run.json"}
        self.assertEqual(listed, on_disk)
        series = (self.folder / folder / "fruit.pvd").read_text()
        days = [float(d) for d in re.findall(r'timestep="([^"]+)"', series)]
        self.assertEqual(days, [f["time_days"] for f in run["frames"]])
        return run

    def test_every_example_runs_as_a_preview_and_is_sound(self):
        for name, frames in (("wheat_ear", 5), ("maize_ear", 4), ("raspberry", 4)):
            with self.subTest(name):
                # Without the light of the pictures, which takes most of the time; test_pictures has that.
                text = (EXAMPLES / f"{name}.toml").read_text() + "[output]\npov = false\n"
                self.good("run", self.scene(text), "--preview", "-o", name)
                run = self.assert_files_of_a_run(name, frames)
                for check in ("open", "inside_out", "degenerate", "self_intersecting"):
                    self.assertEqual(run["checks"][f"shells_{check}"], {"value": 0.0, "limit": 0.0, "passed": True,
                                                                        "unit": "shells"})
                self.assertGreater(run["shells_checked"], 100)
                self.assertLess(run["kernel_overlap"], 0.2)
                last = f"{name}/fruit/fruit_{frames - 1:04}."
                meshes = [last + kind for kind in ("obj", "ply", "vtp")]
                text = self.good("check", *meshes, "--closed").stdout
                self.assertEqual(text.count(": passed"), 3, text)
                report = json.loads(self.good("check", *meshes, "--closed", "--json").stdout)["meshes"]
                for mesh in report:
                    self.assertEqual(mesh["length_unit"], "mm")
                    self.assertEqual(2 * mesh["shells"], run["shells_checked"])  # of the first and the last frame
                    self.assertAlmostEqual(mesh["volume"] / report[0]["volume"], 1, 5)
                self.assertIn("kernel_id", self.good("info", last + "vtp").stdout)

    def test_another_library_reads_the_same(self):
        if subprocess.run([VTK_PYTHON, "-c", "import vtkmodules.vtkIOXML, numpy"], capture_output=True).returncode:
            self.skipTest("VTK's Python module is not installed")
        for name, text in (("wheat", SMALL), ("maize", MAIZE)):
            self.good("run", self.scene(text + "[output]\nevery_frame = true\n", name + ".toml"))
            done = subprocess.run([VTK_PYTHON, READER, self.folder / "out" / name], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_ripening_is_in_the_record(self):
        self.good("run", self.scene(SMALL))
        run = self.run_of("out/scene")
        moisture = [m["moisture_wb"] for m in run["kernel_means"]]
        volume = [m["kernel_volume_mm3"] for m in run["kernel_means"]]
        self.assertEqual(moisture, sorted(moisture, reverse=True))
        self.assertEqual(volume, sorted(volume, reverse=True))
        self.assertAlmostEqual(moisture[0], 0.64, 2)
        self.assertAlmostEqual(moisture[2], 0.12, 2)
        self.assertEqual((run["spikelets"], run["kernels"]), (3, 15))
        self.assertEqual([f["time_days"] for f in run["frames"]], [0, 18, 36])
        self.assertEqual(run["scene"]["wheat"]["awn_length_mm"], 60)  # a default, spelled out
        self.assertEqual(run["units"]["moisture_wb"], "1")

    def own_mesh(self, more, mesh=ROOF_OBJ):
        (self.folder / "roof.obj").write_text(mesh)
        return self.scene('kind = "fruit"\ncrop = "mesh"\nmesh = "roof.obj"\nsteps = 1\n' + more +
                          "[ripening]\nwd_frames = [1.0]\n")

    def assert_vertex(self, found, wanted):
        for a, b in zip(found, wanted):
            self.assertAlmostEqual(a, b, 9)

    def test_own_control_mesh_with_tags(self):
        """The masks of both schemes, read off the file that the run writes: vertex k stays number k, edges follow."""
        ring_weight = {"liu2007": 1 / 16, "hoppe1994": 1 / 8}
        for scheme, w in ring_weight.items():
            tags = f'scheme = "{scheme}"\n' + RING + "mesh_sharp = [4]\n"
            self.good("run", self.own_mesh(tags), "-o", scheme)
            found = vertices(self.folder / scheme / "fruit/fruit_0000.obj")
            self.assertEqual(len(found), 6 + 12)
            centre = 1 - 2 * w
            self.assert_vertex(found[0], (centre * 1 + w * (-1 + 1), centre * 1 + w * (1 - 1), 0))
            # valence 4: centre 1/2 and 1/8 each of the ring at height 0; a corner of hoppe1994 stays.
            self.assert_vertex(found[4], (0, 0, 1 if scheme == "liu2007" else 2))
            self.assertIn((0.0, 1.0, 0.0), [tuple(round(c, 9) + 0.0 for c in p) for p in found[6:]])  # edge 0-1, halved
            self.good("check", f"{scheme}/fruit/fruit_0000.obj", "--closed")
        self.good("run", self.own_mesh(""), "-o", "smooth")
        smooth = vertices(self.folder / "smooth/fruit/fruit_0000.obj")
        # Loop, valence 4: alpha = (5/8 - (3/8)^2) / 4
        alpha = (5 / 8 - 9 / 64) / 4
        self.assert_vertex(smooth[4], (0, 0, (1 - 4 * alpha) * 2))
        self.good("run", self.own_mesh('scheme = "hoppe1994"\nmesh_crease_angle_deg = 60\n'), "-o", "angle")
        # The ring folds by 90 degrees, the roof's edges by 78, the floor's by 37: four creases meet in the apex, a corner.
        self.assert_vertex(vertices(self.folder / "angle/fruit/fruit_0000.obj")[4], (0, 0, 2))

    def test_own_texture_coordinates_and_unit(self):
        self.good("run", self.own_mesh(RING + "mesh_unit_mm = 10\n"))
        text = (self.folder / "out/scene/fruit/fruit_0000.obj").read_text()
        found = vertices(self.folder / "out/scene/fruit/fruit_0000.obj")
        uv = [tuple(map(float, line.split()[1:3])) for line in text.splitlines() if line.startswith("vt ")]
        self.assertEqual(len(uv), len(found))
        for p, c in zip(found, uv):  # uv = x, y of the control mesh, subdivided by the same masks
            self.assertAlmostEqual(c[0], p[0] / 10, 6)
            self.assertAlmostEqual(c[1], p[1] / 10, 6)

    def test_grains_planted_on_an_own_mesh(self):
        scene = self.own_mesh('').replace(".toml", "_planted.toml")
        (self.folder / scene).write_text(
            'kind = "fruit"\ncrop = "planted"\nmesh = "roof.obj"\nmesh_unit_mm = 8\nsteps = 1\n'
            '[ripening]\nwd_frames = [1.0]\n[planted]\narrangement = "cells"\n')
        self.good("run", scene, "-o", "planted")
        self.assertEqual(self.run_of("planted")["kernels"], len(ROOF_FACES))

    def test_hidden_organs_are_not_in_the_picture(self):
        text = MAIZE + '[[still]]\nname = "a"\nsize_px = [32, 32]\n[[still]]\nname = "b"\nsize_px = [32, 32]\nhide = [%s]\n'
        for crop, organs, ids in (("maize", '"cob_bump", "shank"', (7, 8)), ("maize", '"kernel"', (2,))):
            self.good("run", self.scene(text % organs), "--force")
            files = self.files("out/scene")
            for organ in ids:
                self.assertIn(f"pov/a_object_0_{organ}.inc", files, crop)
                self.assertNotIn(f"pov/b_object_0_{organ}.inc", files, crop)

    def test_same_bytes_for_any_threads_and_after_resuming(self):
        scene = self.scene(SMALL + STILL)
        self.good("run", scene, "-o", "one", "--threads", 1)
        self.good("run", scene, "-o", "two", "--threads", 2)
        cut = self.folder / "two"
        frames = self.run_of("two")["frames"]
        (cut / "run.json").unlink()
        (cut / "run.partial.json").write_text(json.dumps({"frames": frames[:1]}))
        (cut / "fruit/fruit_0002.vtp").unlink()
        kept = (cut / "fruit/fruit_0000.vtp").stat().st_mtime_ns
        self.bad(3, "render", "two", says=["--resume"])
        self.good("run", scene, "-o", "two", "--resume")
        self.assertEqual((cut / "fruit/fruit_0000.vtp").stat().st_mtime_ns, kept, "a whole frame is not rewritten")
        one, two = self.files("one"), self.files("two")
        for files in (one, two):
            files.pop("run.json")  # timings
        self.assertEqual(one, two)
        self.bad(2, "run", scene, "-o", "two", says=["--resume", "--force"])
        self.assertIn("complete", self.good("run", scene, "-o", "two", "--resume").stdout)

    def test_bad_input_is_named(self):
        for text, *says in (
                (SMALL.replace("wheat", "weat", 1), "scene.toml:2: crop", 'did you mean "wheat"'),
                (SMALL + "awn_lenght_mm = 3\n", "scene.toml:9: wheat.awn_lenght_mm", "did you mean 'awn_length_mm'"),
                (SMALL + "awn_root_radius_mm = 7\n", "scene.toml:9: wheat.awn_root_radius_mm = 7", "0.02..2 mm"),
                (MAIZE.replace("rows = 8", "rows = 9"), "scene.toml:7: maize.rows", "even"),
                (SMALL.replace("steps = 1", "steps = 9"), "steps = 9", "0..4"),
                (SMALL.replace("0.5, 1.0", "0.5, 0.5"), "ripening.wd_frames", "greater than"),
                (SMALL + '[[still]]\nname = "a"\nwd = [0.3]\n', "wd", "one or more of the frames [0, 0.5, 1]"),
                (SMALL + '[[still]]\nname = "a"\nhide = ["awns"]\n', "hide", 'did you mean "awn"'),
                ('kind = "fruit"\ncrop = "mesh"\n', "mesh", "needs the name of a mesh file")):
            self.bad(2, "run", self.scene(text), says=says)
            self.assertFalse((self.folder / "out").exists())
        for tags, *says in (
                ("mesh_creases = [[0, 9]]\n", "mesh_creases names vertex 9", "roof.obj", "6 vertices"),
                ("mesh_creases = [[0, 2]]\n", "crease edge 0-2 is no edge"),
                ("mesh_creases = [[0, 1.5]]\n", "mesh_creases", "whole numbers"),
                ("mesh_sharp = [6]\n", "mesh_sharp names vertex 6", "6 vertices")):
            self.bad(2, "run", self.own_mesh(tags), says=says)
            self.assertFalse((self.folder / "out").exists(), tags)
        self.bad(2, "run", self.own_mesh("", ROOF_OBJ + "f 1 2 99\n"), says=["roof.obj", "line"])
        self.bad(2, "run", self.own_mesh("", ROOF_OBJ.replace("v 1 1 0", "v nan 1 0")), says=["roof.obj", "line 1"])
        scene = self.own_mesh("")
        (self.folder / "roof.obj").unlink()
        self.bad(3, "run", scene, says=["roof.obj"])
        self.assertFalse((self.folder / "out").exists())

    def test_printed_defaults_are_a_scene_with_the_same_values(self):
        defaults = self.good("run", "--print-defaults", "fruit").stdout
        self.good("run", self.scene(defaults, "defaults.toml"), "--preview", "-o", "printed")
        text = 'kind = "fruit"\nname = "my_fruit"\n'  # the printed still is a comment
        self.good("run", self.scene(text, "bare.toml"), "--preview", "-o", "bare")
        self.assertEqual(self.run_of("printed")["scene"], self.run_of("bare")["scene"])

    @unittest.skipUnless(shutil.which("povray"), "povray is not installed")
    def test_pictures(self):
        subdivision = '[[still]]\nname = "steps"\nsubject = "subdivision"\nsize_px = [48, 24]\n'
        self.good("run", self.scene(SMALL + STILL + subdivision))
        self.good("render", "out/scene", "--quality", "draft")
        self.assertEqual(png_size(self.folder / "out/scene/images/ear_object.png"), (64, 48))
        self.assertEqual(png_size(self.folder / "out/scene/images/steps_object.png"), (48, 24))


if __name__ == "__main__":
    sys.exit(unittest.main())
