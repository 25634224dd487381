"""Leaves, end to end: run, files read back with VTK, resume, edits, measured points, bad input."""
import json
import unittest
from pathlib import Path

from program import ProgramTest

LEAF = """kind = "leaf"
species = "cucumber"
main_vein_m = 0.12
[mesh]
outline_spacing_m = 0.003
edge_m = 0.009
vein_edge_m = 0.006
"""

WILT = """
[wilt]
length_hours = 4
frames = 3
"""

HANDLES = """
[edit]
mode = "{mode}"
[[edit.handle]]
uv = [{base}, 0.5]
[[edit.handle]]
uv = [{tip}, 0.5]
[[edit.key]]
name = "tip up"
move_m = [0, 0, 0, -0.01, 0, 0.04]
"""

STILL = """
[[still]]
name = "above"
size_px = [64, 48]
"""


def vtk_arrays(path):
    """(points, polygons, lines, {array: (min, max)}) of a .vtp, by VTK's own reader."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    arrays = {}
    for i in range(data.GetPointData().GetNumberOfArrays()):
        array = data.GetPointData().GetArray(i)
        ranges = [array.GetRange(c) for c in range(array.GetNumberOfComponents())]
        arrays[array.GetName()] = (min(r[0] for r in ranges), max(r[1] for r in ranges))
    return data.GetNumberOfPoints(), data.GetNumberOfPolys(), data.GetNumberOfLines(), arrays


def run_json(test, name="scene"):
    return json.loads((test.folder / "out" / name / "run.json").read_text())


class Leaf(ProgramTest):
    def test_a_leaf_wilts(self):
        self.good("run", self.scene(LEAF + WILT + STILL, "wilting.toml"), "-q")
        run = run_json(self, "wilting")
        for name, check in run["checks"].items():
            self.assertTrue(check["passed"], (name, check))
        self.assertLess(run["checks"]["water_balance_relative"]["value"], 1e-9)
        self.assertLess(run["checks"]["midrib_length_change"]["value"], 0.02)
        self.assertEqual(run["checks"]["blade_self_intersections"]["value"], 0)
        frames = [f["numbers"] for f in run["frames"]]
        self.assertEqual(len(frames), 3)
        water = [f["mean_water"] for f in frames]
        self.assertAlmostEqual(water[0], 1, 6)
        self.assertTrue(water[0] > water[1] > water[2], water)
        self.assertLess(frames[2]["area_change"], -0.01)
        self.assertGreater(frames[2]["tip_drop_deg"], 10)
        folder = self.folder / "out/wilting"
        points = set()
        for i, frame in enumerate(frames):
            n, polygons, _, arrays = vtk_arrays(folder / f"leaf/leaf_{i:04}.vtp")
            points.add((n, polygons))
            for name in ("water", "chlorophyll_ug_cm2", "stress_von_mises_MPa", "strain_area", "vein", "normal", "uv",
                         "diffuse", "displacement_m", "organ_id"):
                self.assertIn(name, arrays)
            lo, hi = arrays["water"]
            self.assertTrue(0 <= lo <= hi <= 1, (lo, hi))
            self.assertTrue(0 <= arrays["diffuse"][0] and arrays["diffuse"][1] <= 1, arrays["diffuse"])
            self.assertEqual(arrays["organ_id"], (0, 1))
            self.assertEqual(arrays["vein"], (0, 1) if arrays["vein"][0] == 0 else arrays["vein"])
            if i == 0:
                self.assertLess(max(abs(v) for v in arrays["displacement_m"]), 1e-5)
        self.assertEqual(len(points), 1)  # the same mesh in every frame
        self.assertGreater(max(abs(v) for v in arrays["displacement_m"]), 0.01)
        self.assertIn("leaf/leaf_0002.vtp", (folder / "leaf.pvd").read_text())
        self.assertIn("pov/above_object.pov", self.files("out/wilting"))
        self.assert_nothing_half_written()

    def test_the_stages_of_the_construction_are_files(self):
        self.good("run", self.scene(LEAF))
        folder = self.folder / "out/scene/leaf"
        n, polygons, lines, _ = vtk_arrays(folder / "stage_1_points.vtp")
        self.assertEqual((polygons, lines), (0, 3))
        more, polygons, lines, _ = vtk_arrays(folder / "stage_2_splines.vtp")
        self.assertEqual((polygons, lines), (0, 3))
        self.assertGreater(more, 2 * n)
        faces = [vtk_arrays(folder / f"stage_{i}_{name}.vtp")[1]
                 for i, name in ((3, "mesh"), (4, "subdivided"), (5, "repaired"))]
        self.assertGreater(faces[0], 50)
        self.assertGreater(faces[1], 2 * faces[0])
        self.assertGreaterEqual(faces[2], faces[1])

    def test_edits_are_reported(self):
        for mode in ("linear", "rotation_aware"):
            name = f"{mode}.toml"
            self.good("run", self.scene(LEAF + HANDLES.format(mode=mode, base=0.05, tip=0.95), name))
            run = run_json(self, mode)
            self.assertEqual(len(run["frames"]), 2)  # as built, and the key
            report = run["edit"][0]
            self.assertEqual(report["key"], "tip up")
            self.assertGreater(report["largest_strain"], 0)
            self.assertEqual(report["intersecting_pairs"], 0)
            self.assertLess(abs(report["area_drift"]), 0.05 if mode == "rotation_aware" else 0.5)
            arrays = vtk_arrays(self.folder / f"out/{mode}/leaf/leaf_0001.vtp")[3]
            self.assertGreater(arrays["displacement_m"][1], 0.03)

    def test_measured_points_as_csv_and_as_json_give_the_same_leaf(self):
        left = [[x, 20 + 0.1 * x * (100 - x) / 100, 0] for x in range(10, 100, 10)]
        groups = {"left": left, "right": [[x, -y, z] for x, y, z in left], "midrib": [[x, 0, 0] for x in range(0, 101, 25)]}
        rows = [f"{g},{x},{y},{z}" for g, points in groups.items() for x, y, z in points]
        (self.folder / "leaf.csv").write_text("group,x,y,z\n" + "\n".join(rows) + "\n")
        (self.folder / "leaf.json").write_text(json.dumps({"unit": "mm", **groups}))
        areas = []
        for file, unit in (("leaf.csv", "mm"), ("leaf.json", "m")):
            text = f'kind = "leaf"\nsource = "points"\npoints = "{file}"\npoints_unit = "{unit}"\n'
            text += "reference_area_m2 = 0.0042\n" + LEAF[LEAF.index("[mesh]"):]
            self.good("run", self.scene(text, file.replace(".", "_") + ".toml"))
            leaf = run_json(self, file.replace(".", "_"))["leaf"]
            areas.append(leaf["area_m2"])
            self.assertAlmostEqual(leaf["area_error"], leaf["area_m2"] / 0.0042 - 1, 9)
        self.assertEqual(areas[0], areas[1])
        self.assertTrue(0.0035 < areas[0] < 0.0052, areas)

    def test_resume_goes_on_and_gives_the_same_bytes(self):
        scene = self.scene(LEAF + WILT)
        self.good("run", scene, "-o", "whole", "--threads", 1)
        self.good("run", scene, "-o", "again", "--threads", 2)
        (self.folder / "again/run.json").unlink()
        (self.folder / "again/leaf/leaf_0002.vtp").unlink()
        self.good("run", scene, "-o", "again", "--resume")
        whole, again = self.files("whole"), self.files("again")
        whole.pop("run.json")  # timings
        again.pop("run.json")
        self.assertEqual(whole, again)

    def test_printed_defaults_run_as_they_are(self):
        text = self.good("run", "--print-defaults", "leaf").stdout
        self.assertIn("curl_1_m", text)
        self.good("run", self.scene(text, "defaults.toml"), "--preview")
        run = run_json(self, "my_leaf") if (self.folder / "out/my_leaf").exists() else run_json(self, "defaults")
        for name, check in run["checks"].items():
            self.assertTrue(check["passed"], (name, check))


class BadLeaf(ProgramTest):
    def run_bad(self, text, *says, code=2):
        self.bad(code, "run", self.scene(text), says=says)
        self.assertFalse((self.folder / "out").exists())

    def mesh(self, text, *says, code=2):
        (self.folder / "leaf.obj").write_text(text)
        self.run_bad('kind = "leaf"\nsource = "mesh"\nmesh_file = "leaf.obj"\n' + HANDLES.format(mode="linear", base=0.0, tip=1.0),
                     *says, code=code)

    def test_unknown_species(self):
        self.run_bad('kind = "leaf"\nspecies = "melon"\n', "species", "cucumber")

    def test_main_vein_in_centimetres(self):
        self.run_bad('kind = "leaf"\nmain_vein_m = 15\n', "main_vein_m = 15", "0.01..1 m")

    def test_key_without_its_handles(self):
        self.run_bad(LEAF + HANDLES.format(mode="linear", base=0, tip=1).replace("-0.01, 0, 0.04", "1"), "move_m",
                     "3 numbers for each")
        self.run_bad(LEAF + '[edit]\n[[edit.key]]\nname = "x"\nmove_m = []\n', "no handle")

    def test_two_handles_at_one_place(self):
        self.run_bad(LEAF + HANDLES.format(mode="linear", base=0.5, tip=0.5), "handle", "already")

    def test_a_mesh_in_two_pieces(self):
        self.mesh("v 0 0 0\nv 50 0 0\nv 0 50 0\nv 90 0 0\nv 140 0 0\nv 90 50 0\nf 1 2 3\nf 4 5 6\n", "2 pieces")

    def test_a_mesh_with_a_face_without_area(self):
        self.mesh("v 0 0 0\nv 50 0 0\nv 50 50 0\nv 0 50 0\nv 25 0 0\nf 1 2 3\nf 1 3 4\nf 1 5 2\n", "no area")

    def test_a_mesh_without_triangles(self):
        self.mesh("v 0 0 0\nv 50 0 0\nv 50 50 0\n", "leaf.obj")

    def test_a_mesh_that_is_not_there(self):
        self.run_bad('kind = "leaf"\nsource = "mesh"\nmesh_file = "none.obj"\n', "none.obj", code=3)

    def test_points_out_of_order(self):
        (self.folder / "p.csv").write_text("left,0,1\nleft,x,2\n")
        self.run_bad('kind = "leaf"\nsource = "points"\npoints = "p.csv"\n', "p.csv:2", "'x'")
        (self.folder / "p.json").write_text('{"left": [[0, 1], [1, 1]],\n "right": [[0, -1], [1]]}')
        self.run_bad('kind = "leaf"\nsource = "points"\npoints = "p.json"\n', "p.json", "right[1]")
        (self.folder / "p.json").write_text('{"left": [[0, 1],\n}')
        self.run_bad('kind = "leaf"\nsource = "points"\npoints = "p.json"\n', "p.json:2", "JSON")

    def test_supply_that_goes_back_in_time(self):
        self.run_bad(LEAF + WILT + "supply_curve = [[0, 1], [2, 0], [1, 0]]\n", "supply_curve")


if __name__ == "__main__":
    unittest.main()
