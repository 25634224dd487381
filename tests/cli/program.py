"""Runs the program under test; small scenes and terrains for it."""
import hashlib
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ.get("WITHERFIELD", "witherfield")

TINY = """kind = "grass"
[season]
length_days = 20
steps_per_day = 2
wd_frames = [0.0, 0.3, 0.9]
[texel]
resolution = 32
[blades]
count = 30
segments = 6
"""

HILL = TINY + """
[terrain]
dem = "hill.asc"
texels = [3, 3]
"""

STILL = """
[[still]]
name = "a"
wd = 0.3
looks = ["texel", "blades"]
size_px = [64, 36]
camera_m = [0.1, -0.4, 0.3]
look_at_m = [0.1, 0.1, 0.05]
"""


def ascii_grid(rows, nodata=-9999):
    """An ESRI ASCII grid of the given rows (north first), 10 m cells."""
    head = (f"ncols {len(rows[0])}\nnrows {len(rows)}\nxllcorner 0\nyllcorner 0\ncellsize 10\n"
            f"NODATA_value {nodata}\n")
    return head + "\n".join(" ".join(str(v) for v in row) for row in rows) + "\n"


def hill_rows(n=8):
    return [[100 + 3 * ((i * 5 + j * 3) % 7) + i + j for i in range(n)] for j in range(n)]


class ProgramTest(unittest.TestCase):
    """Each test has a folder of its own, self.folder, which is also the working folder of the program."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="witherfield_cli_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def scene(self, text, name="scene.toml"):
        path = self.folder / name
        path.write_text(text)
        return name

    def hill(self, rows=None):
        (self.folder / "hill.asc").write_text(ascii_grid(rows or hill_rows()))

    def program(self, *arguments, env=None, before=None):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              env=env, preexec_fn=before, timeout=240)

    def good(self, *arguments, **options):
        done = self.program(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return done

    def bad(self, code, *arguments, says=(), **options):
        """The program must fail with this exit code and one error line that holds each of `says`."""
        done = self.program(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        errors = [line for line in done.stderr.splitlines() if "error" in line]
        self.assertEqual(len(errors), 1, done.stderr)
        for text in says:
            self.assertIn(text, errors[0])
        return done

    def files(self, folder):
        """Relative path -> digest of all files below a folder."""
        root = self.folder / folder
        return {str(p.relative_to(root)): hashlib.sha256(p.read_bytes()).hexdigest()
                for p in sorted(root.rglob("*")) if p.is_file()}

    def assert_nothing_half_written(self):
        parts = [str(p) for p in self.folder.rglob("*.part")]
        self.assertEqual(parts, [])
