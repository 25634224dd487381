"""witherfield check: verdicts, exit codes, table, JSON, broken files."""
import json
import struct
import unittest

from program import ProgramTest

CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
CUBE_FACES = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4),
              (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)]


def moved(points, by, scale=1):
    return [tuple(scale * p + b for p, b in zip(point, by)) for point in points]


def together(*meshes):
    """One mesh of several (points, faces)."""
    points, faces = [], []
    for more_points, more_faces in meshes:
        faces += [tuple(v + len(points) for v in face) for face in more_faces]
        points += more_points
    return points, faces


def obj(points, faces):
    return "".join("v %r %r %r\n" % p for p in points) + "".join("f %d %d %d\n" % tuple(v + 1 for v in f) for f in faces)


def ply(points, faces, kernel_ids=None):
    head = ("ply\nformat binary_big_endian 1.0\ncomment length_unit mm\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nelement face %d\nproperty list uchar int vertex_indices\n" % (len(points), len(faces)))
    if kernel_ids:
        head += "property float kernel_id\n"
    body = b"".join(struct.pack(">3f", *p) for p in points)
    for k, f in enumerate(faces):
        body += struct.pack(">B3i", 3, *f) + (struct.pack(">f", kernel_ids[k]) if kernel_ids else b"")
    return head.encode() + b"end_header\n" + body


class Check(ProgramTest):
    def write(self, name, content):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def found(self, mesh):
        """Name -> (found, ids) of the checks of one mesh in the JSON."""
        return {c["name"]: (c["found"], c["ids"]) for c in mesh["checks"]}

    def json(self, code, *arguments):
        done = self.program("check", *arguments, "--json")
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return json.loads(done.stdout)

    def test_sound_cube(self):
        text = self.good("check", self.write("cube.obj", obj(CUBE, CUBE_FACES)), "--closed").stdout
        self.assertIn("cube.obj: passed", text)
        self.assertIn("8 vertices, 18 edges, 12 faces", text)
        self.assertRegex(text, r"self-intersections +0  ok")
        self.assertNotIn("FAILED", text)
        report = self.json(0, "cube.obj")
        mesh = report["meshes"][0]
        self.assertTrue(report["passed"] and mesh["passed"] and mesh["closed"] and mesh["oriented_outward"])
        self.assertIsNone(mesh["length_unit"])
        self.assertAlmostEqual(mesh["volume"], 1)
        self.assertAlmostEqual(mesh["area"], 6)
        self.assertEqual([s["faces"] for s in mesh["shell"]], [12])

    def test_open_sheet_is_allowed_unless_closed_is_demanded(self):
        self.write("sheet.obj", obj(CUBE[:4], [(0, 1, 2), (0, 2, 3)]))
        self.assertRegex(self.good("check", "sheet.obj").stdout, r"open shells +1  allowed: shell 0")
        done = self.bad(1, "check", "sheet.obj", "--closed", says=["1 of 1 meshes failed", "sheet.obj", "open shells (1)"])
        self.assertIn("sheet.obj: FAILED", done.stdout)

    def test_inside_out(self):
        self.write("cube.obj", obj(CUBE, [tuple(reversed(f)) for f in CUBE_FACES]))
        self.good("check", "cube.obj")
        self.bad(1, "check", "cube.obj", "--closed", says=["inside-out shells"])

    def test_every_fault_fails_and_is_named(self):
        spike = CUBE[:6] + [(0.5, 0.5, -0.5)] + CUBE[7:]  # a corner of the top, pushed through the bottom
        cases = {
            "self-intersections": ((spike, CUBE_FACES), None),
            "non-manifold edges": ((CUBE + [(0.5, 0, -1)], CUBE_FACES + [(0, 1, 8)]), [[0, 1]]),
            "non-manifold vertices": ((CUBE + [(-1, 0, -1), (-1, -1, -1)], CUBE_FACES + [(0, 8, 9)]), [0]),
            "edges between faces of opposite orientation": ((CUBE, CUBE_FACES[:-1] + [(3, 7, 4)]), [[3, 4], [3, 7], [4, 7]]),
            "isolated vertices": ((CUBE + [(9, 9, 9)], CUBE_FACES), [8]),
            "duplicate faces": ((CUBE, CUBE_FACES + [(2, 1, 0)]), [12]),
            "degenerate faces": ((CUBE + [(2, 2, 2), (3, 3, 3), (4, 4, 4)], CUBE_FACES + [(8, 9, 10)]), [12]),
        }
        for name, ((points, faces), ids) in cases.items():
            self.write("bad.obj", obj(points, faces))
            self.bad(1, "check", "bad.obj", says=["bad.obj", name])
            found, named = self.found(self.json(1, "bad.obj")["meshes"][0])[name]
            self.assertGreater(found, 0, name)
            if ids:
                self.assertEqual(named, ids, name)

    def test_shells_may_cut_each_other(self):
        self.write("cut.obj", obj(*together((CUBE, CUBE_FACES), (moved(CUBE, (0.5, 0.25, 0.3)), CUBE_FACES))))
        self.assertRegex(self.good("check", "cut.obj", "--closed").stdout,
                         r"intersections between shells +\d+  allowed: pairs of faces \d+-\d+")

    def test_without_self_intersections(self):
        self.write("cut.obj", obj(CUBE[:6] + [(0.5, 0.5, -0.5)] + CUBE[7:], CUBE_FACES))
        self.assertIn("not checked", self.good("check", "cut.obj", "--no-self-intersections").stdout)

    def test_overlap(self):
        mesh = together((CUBE, CUBE_FACES), (moved(CUBE, (0.5, 0, 0)), CUBE_FACES), (moved(CUBE, (7, 7, 7)), CUBE_FACES))
        self.write("ear.ply", ply(*mesh, [4] * 12 + [9] * 12 + [-1] * 12))
        text = self.good("check", "ear.ply", "--overlap").stdout
        self.assertRegex(text, r"0 \(kernel 4\) +1 \(kernel 9\) +0\.50000 \+- 0\.00000")
        self.assertIn(" mm3", text)
        self.good("check", "ear.ply", "--max-overlap", "0.51")
        self.bad(1, "check", "ear.ply", "--max-overlap", "0.49", says=["overlaps beyond the limit (1)"])
        overlaps = self.json(0, "ear.ply", "--overlap")["meshes"][0]["overlaps"]
        self.assertEqual([o["shells"] for o in overlaps], [[0, 1]])
        self.assertAlmostEqual(overlaps[0]["volume"], 0.5)  # in mm3

    def test_many_shells_are_summed_up(self):
        cubes = [(moved(CUBE, (3 * k, 0, 0), 1 + 0.01 * k), CUBE_FACES) for k in range(40)]
        cubes[7] = (cubes[7][0], CUBE_FACES[1:])
        self.write("many.obj", obj(*together(*cubes)))
        text = self.good("check", "many.obj").stdout
        self.assertRegex(text, r"shells +40")
        self.assertRegex(text, r"\n    7 .*open, 3 border edges")
        self.assertRegex(text, r"\n    39 ")
        self.assertIn("37 others", text)
        self.assertEqual(len(self.json(0, "many.obj")["meshes"][0]["shell"]), 40)

    def test_broken_files(self):
        cube = obj(CUBE, CUBE_FACES)
        big = ply(CUBE, CUBE_FACES)
        for name, content, says in (
                ("empty.obj", "", "empty"),
                ("range.obj", cube + "f 1 2 9\n", "line 21"),
                ("nan.obj", cube.replace("v 1 0 0", "v nan 0 0", 1), "line 2"),
                ("cut.ply", big[:-5], "truncated"),
                ("magic.off", cube, "not an OFF file"),
                ("noise.stl", bytes(range(256)), "not an STL file"),
                ("broken.vtp", "<VTKFile type=\"PolyData\">", "broken.vtp"),
                ("scene.toml", "kind = 1", ".obj, .ply, .off, .stl or .vtp")):
            self.write(name, content)
            done = self.bad(2, "check", name, says=[f"'{name}'", says])
            self.assertIn("UNREADABLE", done.stdout)
            self.assertIn(says, self.json(2, name)["meshes"][0]["error"])
        self.bad(3, "check", "absent.obj", says=["absent.obj"])

    def test_the_rest_is_checked_beside_a_broken_file(self):
        self.write("good.obj", obj(CUBE, CUBE_FACES))
        self.write("bad.obj", "v 1\n")
        done = self.bad(2, "check", "bad.obj", "good.obj", says=["bad.obj"])
        self.assertIn("good.obj: passed", done.stdout)
        report = self.json(2, "good.obj", "bad.obj")
        self.assertEqual([m["passed"] for m in report["meshes"]], [True, False])
        self.assertFalse(report["passed"])

    def test_wrong_options(self):
        self.write("cube.obj", obj(CUBE, CUBE_FACES))
        for arguments in (("check",), ("check", "cube.obj", "--max-overlap", "2"), ("check", "cube.obj", "--wrong")):
            self.assertEqual(self.program(*arguments).returncode, 2)


if __name__ == "__main__":
    unittest.main()
