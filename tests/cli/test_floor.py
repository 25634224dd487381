"""Worn floors from the scene file to the files: walks kept, shared, re-tuned and measured; bad input."""
import json
import struct
import subprocess
import unittest
import zlib
from pathlib import Path

from program import ProgramTest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
ROOM = """kind = "floor"
[room]
outline_m = [[0, 0], [6, 0], [6, 4], [0, 4]]
[[room.door]]
name = "main"
a_m = [2.5, 0]
b_m = [3.5, 0]
[[room.obstacle]]
name = "table"
outline_m = [[2.4, 1.8], [3.6, 1.8], [3.6, 2.4], [2.4, 2.4]]
[[room.place]]
name = "chair"
at_m = [3.0, 3.0]
[crowd]
visits = 300
days = 100
patrol_share = 0.5
round_trip_share = 0.5
[footprints]
pixels_per_m = 50
[wear]
frames = [0.0, 0.5, 1.0]
[output]
footprints = true
"""
ARRAYS = ["diffuse", "dirt", "dose_N_s_m2", "footfalls", "gloss", "height_m", "slide_m", "wear_depth_um"]
COLUMNS = "x_m,y_m,z_m,person,behaviour,phase,foot,kind,heading_rad,weight_N,time_s"
READ = """
import json, sys
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader
from vtkmodules.util.numpy_support import vtk_to_numpy
out = {}
for name in sys.argv[1:]:
    r = vtkXMLImageDataReader() if name.endswith(".vti") else vtkXMLPolyDataReader()
    r.SetFileName(name)
    r.Update()
    assert r.GetErrorCode() == 0, name
    d = r.GetOutput()
    of = d.GetCellData() if name.endswith(".vti") else d.GetPointData()
    out[name] = {"points": d.GetNumberOfPoints(), "cells": d.GetNumberOfCells(), "arrays": {
        of.GetArrayName(i): [float(vtk_to_numpy(of.GetArray(i)).min()), float(vtk_to_numpy(of.GetArray(i)).max()),
                             of.GetArray(i).GetNumberOfComponents()] for i in range(of.GetNumberOfArrays())}}
print(json.dumps(out))
"""


def png(width, height, grey):
    """A grey 8-bit PNG; grey(x, y) in 0..255."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(grey(x, y) for x in range(width)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Floor(ProgramTest):
    def read(self, *names):
        """What VTK's own readers see, by the system's Python, which has them."""
        done = subprocess.run(["/usr/bin/python3", "-c", READ, *names], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def run_json(self, folder):
        return json.loads((self.folder / folder / "run.json").read_text())

    def same_fields(self, a, b):
        for i in range(3):
            name = f"floor/floor_{i:04}.vti"
            self.assertEqual((self.folder / a / name).read_bytes(), (self.folder / b / name).read_bytes(), name)

    def test_examples_preview(self):
        for name, frames in (("patrol_gallery", 10), ("office_round_trips", 3), ("stone_stairs", 3)):
            self.good("run", EXAMPLES / f"{name}.toml", "--preview", "-o", name)
            run = self.run_json(name)
            self.assertEqual(len(run["frames"]), frames)
            self.assertLess(run["seconds"], 30)
            for check, result in run["checks"].items():
                self.assertTrue(result["passed"], check)
            for still in run["stills"]:
                self.assertTrue((self.folder / name / still["scenes"]["room"]).exists())

    def test_vtk_reads_what_is_written(self):
        self.good("run", self.scene(ROOM))
        seen = self.read("out/scene/floor/floor_0002.vti", "out/scene/footprints.vtp", "out/scene/walks.vtp")
        floor = seen["out/scene/floor/floor_0002.vti"]
        self.assertEqual(floor["cells"], 300 * 200)
        self.assertEqual(sorted(floor["arrays"]), ARRAYS)
        self.assertEqual(floor["arrays"]["diffuse"][2], 3)
        self.assertGreater(floor["arrays"]["footfalls"][1], 5)
        self.assertGreater(floor["arrays"]["wear_depth_um"][1], 0)
        lines = (self.folder / "out/scene/footprints.csv").read_text().splitlines()
        self.assertEqual(lines[0], COLUMNS)
        for name in ("footprints", "walks"):
            table = seen[f"out/scene/{name}.vtp"]
            self.assertEqual(table["points"], len(lines) - 1)
            self.assertEqual(sorted(table["arrays"]), sorted(COLUMNS.split(",")[3:]))
            self.assertEqual(table["arrays"]["person"][1], 99)
            self.assertEqual(table["arrays"]["foot"][:2], [0, 1])
        self.assertEqual(seen["out/scene/walks.vtp"]["cells"], 100)
        self.assertIn("floor/floor_0001.vti", (self.folder / "out/scene/floor.pvd").read_text())

    def test_run_json_tells_what_walked(self):
        self.good("run", self.scene(ROOM.replace("footprints = true", "")))
        run = self.run_json("out/scene")
        self.assertEqual(run["walk"]["visits"], 300)
        self.assertEqual(run["walk"]["stuck"], 0)
        self.assertGreater(run["walk"]["footprints"], 3000)
        self.assertEqual(sorted(run["simulation_stages"]), ["footprint_masks", "look", "orientation_field", "stamp", "walk"])
        self.assertEqual([f["numbers"]["visits"] for f in run["frames"]], [0, 150, 300])
        self.assertFalse((self.folder / "out/scene/footprints.bin").exists())

    def test_kept_footprints_give_the_same_floor(self):
        self.good("run", self.scene(ROOM), "-o", "a")
        self.good("run", self.scene(ROOM.replace("footprints = true", "")), "-o", "b")
        self.same_fields("a", "b")
        self.good("run", "scene.toml", "--footprints", "a/footprints.bin", "-o", "c")
        self.same_fields("a", "c")
        self.assertEqual(self.run_json("c")["footprints"]["visits_walked"], 0)

    def test_several_machines_share_the_visits(self):
        scene = self.scene(ROOM)
        self.good("run", scene, "-o", "whole")
        self.good("run", scene, "-o", "one", "--visits", "0:120")
        self.good("run", scene, "-o", "two", "--visits", "120:300")
        self.good("run", scene, "-o", "sum", "--footprints", "two/footprints.bin", "--footprints", "one/footprints.bin")
        self.same_fields("whole", "sum")
        self.assertEqual(self.run_json("sum")["footprints"]["visits_taken"], 300)
        part = self.read("one/floor/floor_0002.vti", "whole/floor/floor_0002.vti")
        self.assertLess(part["one/floor/floor_0002.vti"]["arrays"]["footfalls"][1],
                        part["whole/floor/floor_0002.vti"]["arrays"]["footfalls"][1])

    def test_retuning_walks_only_those_it_concerns(self):
        self.good("run", self.scene(ROOM), "-o", "a")
        changed = ROOM.replace("days = 100", "days = 100\nabsent = [[10, 30]]").replace(
            '[[room.place]]', '[[room.obstacle]]\nname = "box"\nfrom_day = 50\nuntil_day = 60\n'
            'outline_m = [[4.5, 1.5], [5.2, 1.5], [5.2, 2.5], [4.5, 2.5]]\n[[room.place]]')
        self.good("run", self.scene(changed, "new.toml"), "--footprints", "a/footprints.bin", "-o", "b")
        self.good("run", "new.toml", "-o", "c")
        self.same_fields("b", "c")
        told = self.run_json("b")["footprints"]
        self.assertEqual(told["visits_dropped"], 20)
        self.assertTrue(25 <= told["visits_walked"] <= 35, told)

    def test_a_wider_look_needs_no_new_walks(self):
        self.good("run", self.scene(ROOM), "-o", "a")
        large = ROOM.replace("pixels_per_m = 50", "pixels_per_m = 100").replace("[wear]", '[material]\npreset = "marble"\n[wear]')
        self.good("run", self.scene(large, "large.toml"), "--footprints", "a/footprints.bin", "-o", "b")
        self.assertEqual(self.run_json("b")["footprints"]["visits_walked"], 0)

    def test_measured_tracks(self):
        track = "\n".join(f"{p},{0.1 * i:.1f},{3 + 0.1 * p:.2f},{0.14 * i:.2f}" for p in (1, 2) for i in range(26))
        (self.folder / "people.csv").write_text("person,time_s,x_m,y_m\n" + track + "\n")
        (self.folder / "people.txt").write_text("# framerate: 10\n# id frame x y\n" + "\n".join(
            f"{p} {i} {3 + 0.1 * p:.2f} {0.14 * i:.2f}" for p in (1, 2) for i in range(26)) + "\n")
        for n, file in enumerate(("people.csv", "people.txt")):
            self.good("run", self.scene(ROOM + f'[walk]\ntracks = ["{file}"]\n'), "-o", f"t{n}")
        self.same_fields("t0", "t1")
        rows = [line.split(",") for line in (self.folder / "t0/footprints.csv").read_text().splitlines()[1:]]
        self.assertTrue(all(2.9 < float(r[0]) < 3.4 for r in rows))
        self.assertEqual(self.run_json("t0")["walk"]["visits"], 300)
        (self.folder / "far.csv").write_text("1,0,90,90\n1,1,91,90\n")
        self.bad(2, "run", self.scene(ROOM + '[walk]\ntracks = ["far.csv"]\n'), "-o", "t3",
                 says=["scene.toml", "walk.tracks", "far.csv"])
        (self.folder / "bad.csv").write_text("1,0,1,1\n1,x,1,2\n")
        self.bad(2, "run", self.scene(ROOM + '[walk]\ntracks = ["bad.csv"]\n'), "-o", "t4", says=["bad.csv:2"])

    def test_own_sole(self):
        (self.folder / "sole.png").write_bytes(png(21, 21, lambda x, y: 255 if (x - 10) ** 2 + 4 * (y - 10) ** 2 < 90 else 0))
        self.good("run", self.scene(ROOM.replace("pixels_per_m = 50", 'pixels_per_m = 50\nmasks = ["sole.png"]\nmask_pixels_per_m = 75')))
        (self.folder / "even.png").write_bytes(png(20, 20, lambda x, y: 255))
        self.bad(2, "run", self.scene(ROOM.replace("pixels_per_m = 50", 'pixels_per_m = 50\nmasks = ["even.png"]')), "-o", "x",
                 says=["scene.toml:21: footprints.masks", "even.png", "odd"])

    def test_resume(self):
        scene = self.scene(ROOM)
        self.good("run", scene)
        before = self.files("out/scene")
        self.assertIn("complete", self.good("run", scene, "--resume").stdout)
        (self.folder / "out/scene/run.json").unlink()
        (self.folder / "out/scene/floor/floor_0002.vti").unlink()
        self.good("run", scene, "--resume")
        after = self.files("out/scene")
        before.pop("run.json"), after.pop("run.json")
        self.assertEqual(before, after)

    def test_bad_rooms_are_named_with_their_line(self):
        for old, new, *says in (
                ("a_m = [2.5, 0]", "a_m = [2.5, 1]", "scene.toml:4: room.door[0]", "'main'", "outline"),
                ("[[2.4, 1.8], [3.6, 1.8], [3.6, 2.4], [2.4, 2.4]]", "[[2.2, 0.1], [3.8, 0.1], [3.8, 0.6], [2.2, 0.6]]",
                 "scene.toml:4: room.door[0]", "blocks"),
                ("[[0, 0], [6, 0], [6, 4], [0, 4]]", "[[0, 0], [6, 4], [6, 0], [0, 4]]",
                 "scene.toml:3: room.outline_m", "crosses itself"),
                ("at_m = [3.0, 3.0]", "at_m = [3.0, 2.0]", "scene.toml:11: room.place[0]", "inside the obstacle"),
                ("pixels_per_m = 50", "pixels_per_m = 50\nmask_size = 98", "scene.toml:21: footprints.mask_size", "odd"),
                ("days = 100", "days = -1", "scene.toml:16: crowd.days", "days")):
            self.bad(2, "run", self.scene(ROOM.replace(old, new)), says=says)
            self.assertFalse((self.folder / "out").exists(), new)
            self.assert_nothing_half_written()

    def test_bad_footprints_and_stretches(self):
        scene = self.scene(ROOM)
        self.bad(3, "run", scene, "--footprints", "none.bin", says=["none.bin"])
        (self.folder / "junk.bin").write_bytes(b"x" * 100)
        self.bad(3, "run", scene, "--footprints", "junk.bin", says=["junk.bin", "not a file of footprints"])
        self.bad(2, "run", scene, "--visits", "20", says=["--visits 20", "FROM:UNTIL"])
        self.bad(2, "run", scene, "--visits", "500:600", says=["walk.from_visit"])
        self.bad(2, "run", self.scene('kind = "grass"\n', "g.toml"), "--visits", "0:5", says=["--visits"])

    def test_printed_defaults_run(self):
        text = self.good("run", "--print-defaults", "floor").stdout
        self.assertIn("[[room.door]]", text)
        self.good("run", self.scene(text), "--preview", "-o", "d")
        self.assertEqual(self.run_json("d")["scene"]["crowd"]["visits"], 400)


if __name__ == "__main__":
    unittest.main()
