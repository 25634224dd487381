"""film, end to end: a small worn floor of some seconds, decoded again; the stills of a texel; what can go wrong."""
import json
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest

from program import PROGRAM, TINY, ProgramTest

FLOOR = """kind = "floor"
name = "room"
seed = 3
[room]
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[room.door]]
a_m = [1.4, 0]
b_m = [2.6, 0]
[[room.window]]
a_m = [4, 0.8]
b_m = [4, 2.2]
[crowd]
visits = 300
visits_each = 3000
days = 7300
[footprints]
pixels_per_m = 50
[material]
preset = "varnished_oak"
[wear]
frames = [0.0, 0.05, 0.3, 1.0]
[[still]]
name = "worn"
size_px = [160, 90]
camera_m = [0.4, 0.3, 1.7]
look_at_m = [2.4, 1.8, 0]
fov_deg = 75
sun_azimuth_deg = 10
sun_elevation_deg = 30
"""

STILLS = """
[view]
size_px = [64, 36]
camera_m = [0.1, -0.4, 0.3]
look_at_m = [0.1, 0.1, 0.05]
[[still]]
name = "fresh"
wd = 0.0
[[still]]
name = "dry"
wd = 0.9
[[still]]
name = "elsewhere"
wd = 0.3
camera_m = [0.1, -0.6, 0.3]
"""

WIDTH, HEIGHT = 160, 90
BOUND = 1 + 4 * 255 / 49  # 50 frames


def needs(*programs):
    missing = [p for p in programs if not shutil.which(p)]
    return unittest.skipIf(missing, f"{' and '.join(missing)} not installed")


def probe(path):
    """codec, pixel format, width, height, rate, number of frames of the film's only stream."""
    out = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                          "stream=codec_name,pix_fmt,width,height,r_frame_rate,nb_read_frames", "-of", "json", path],
                         capture_output=True, text=True, check=True).stdout
    (stream,) = json.loads(out)["streams"]
    return stream


def decoded(path, width, height):
    """Frames as bytes, 3 a pixel."""
    raw = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         capture_output=True, check=True).stdout
    size = 3 * width * height
    assert len(raw) % size == 0
    return [raw[i:i + size] for i in range(0, len(raw), size)]


def mean_difference(a, b):
    return sum(abs(x - y) for x, y in zip(a, b)) / len(a)


class Film(ProgramTest):
    def film_of_the_floor(self, *more):
        self.good("run", self.scene(FLOOR))
        return self.good("film", "out/room", "--seconds", "2", "--quality", "draft", "--blend-bound", "2", *more)

    @needs("povray", "ffmpeg", "ffprobe")
    def test_a_floor_from_new_to_worn(self):
        done = self.film_of_the_floor("--verify", "1", "--strip", "strip.png")
        film = self.folder / "out/room/film/worn.mp4"
        stream = probe(film)
        self.assertEqual((stream["codec_name"], stream["pix_fmt"]), ("h264", "yuv420p"))
        self.assertEqual((stream["width"], stream["height"], stream["r_frame_rate"]), (WIDTH, HEIGHT, "25/1"))
        self.assertEqual(int(stream["nb_read_frames"]), 50)
        self.assertLess(film.read_bytes().index(b"moov"), film.read_bytes().index(b"mdat"))  # plays while it loads

        frames = decoded(film, WIDTH, HEIGHT)
        self.assertEqual(len(frames), 50)
        # 999 of 1000 values; the encoder may add a few levels of its own.
        for a, b in zip(frames, frames[1:]):
            changes = sorted(abs(x - y) for x, y in zip(a, b))
            self.assertLessEqual(changes[len(changes) * 999 // 1000], BOUND + 6)
        steps = [mean_difference(a, b) for a, b in zip(frames, frames[1:])]
        growth = [mean_difference(frames[0], f) for f in frames]
        self.assertGreater(growth[-1], 2)  # the wear is seen
        self.assertLess(max(steps), growth[-1] / 10)
        for earlier, later in zip(growth[::7], growth[7::7]):
            self.assertGreater(later, earlier)

        told = json.loads((film.parent / "worn.json").read_text())
        self.assertEqual((told["frames"], told["size_px"]), (50, [WIDTH, HEIGHT]))
        self.assertTrue(all(c["passed"] for c in told["checks"].values()), told["checks"])
        self.assertLessEqual(told["checks"]["neighbour_difference_p999"]["value"], BOUND)
        self.assertEqual(len(told["verified"]), 1)
        self.assertLessEqual(told["verified"][0]["rms"], 2)
        moments = [k["visits_share"] for k in told["keys"]]
        self.assertEqual((moments[0], moments[-1]), (0, 1))
        self.assertEqual(moments, sorted(moments))
        self.assertIn("film/worn.mp4", done.stdout)
        head = (self.folder / "strip.png").read_bytes()[:24]
        self.assertEqual(struct.unpack(">II", head[16:24]), (3 * 80 + 12, 2 * 45 + 6))
        self.assert_nothing_half_written()
        self.assertEqual(sorted(p.name for p in film.parent.iterdir()), ["worn.json", "worn.mp4"])

    @needs("povray", "ffmpeg")
    @needs("povray", "ffmpeg", "ffprobe")
    def test_only_the_first_frame_is_coded_anew(self):
        self.good("run", self.scene(FLOOR))
        self.good("film", "out/room", "--seconds", "12", "--size", "48x28", "--quality", "draft", "--blend-bound", "20")
        out = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "frame=pict_type", "-of", "csv=p=0",
                              self.folder / "out/room/film/worn.mp4"], capture_output=True, text=True, check=True).stdout
        types = [line.strip(",") for line in out.split()]
        self.assertEqual((len(types), types[0], types.count("I")), (300, "I", 1))

    def test_a_bound_that_is_broken_is_an_error_and_the_frames_stay(self):
        self.good("run", self.scene(FLOOR))
        tiny = ["film", "out/room", "--seconds", "0.4", "--size", "48x28", "--quality", "draft", "--blend-bound", "20"]
        self.bad(1, *tiny, "--bound", "0.5", "--keep-frames", says=["neighbour_difference_p999"])
        frames = sorted((self.folder / "out/room/film/worn_frames").iterdir())
        self.assertEqual([f.name for f in frames], [f"frame_{i:04}.png" for i in range(10)])
        keys = list((self.folder / "out/room/film/worn_keys").glob("*.hdr"))
        self.assertGreaterEqual(len(keys), 3)
        # The kept key pictures are used again; other settings cannot use them.
        before = {k: k.stat().st_mtime_ns for k in keys}
        self.good(*tiny, "--bound", "200", "--resume", "--keep-frames")
        self.assertEqual({k: k.stat().st_mtime_ns for k in keys}, before)
        self.assertEqual(json.loads((self.folder / "out/room/film/worn.json").read_text())["pictures_rendered"], 0)
        self.bad(2, "film", "out/room", "--size", "64x36", "--resume", says=["another size"])

    @needs("povray", "ffmpeg")
    def test_ctrl_c_leaves_keys_for_resume_and_nothing_half_written(self):
        self.good("run", self.scene(FLOOR))
        arguments = ["film", "out/room", "--seconds", "1", "--size", "160x90", "--blend-bound", "0.05", "--keys", "60"]
        work = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        keys = self.folder / "out/room/film/worn_keys"
        while not list(keys.glob("key_*.hdr")) and work.poll() is None:  # the test's own time limit ends it
            time.sleep(0.05)
        work.send_signal(signal.SIGINT)
        work.communicate(timeout=120)
        self.assertEqual(work.returncode, 128 + signal.SIGINT)
        self.assertGreaterEqual(len(list(keys.glob("key_*.hdr"))), 1)
        self.assertEqual([p.name for p in keys.parent.iterdir()], ["worn_keys"])
        self.assertFalse((keys / "scene").exists())
        self.assert_nothing_half_written()

    @needs("povray", "ffmpeg", "ffprobe")
    def test_stills_of_grass_are_held_and_none_is_invented(self):
        self.good("run", self.scene(TINY + STILLS))
        self.good("film", "out/scene", "--scene", "fresh", "--quality", "draft")
        film = self.folder / "out/scene/film/dry_texel.mp4"
        self.assertEqual(int(probe(film)["nb_read_frames"]), 25)  # two pictures, half a second each
        told = json.loads(film.with_suffix(".json").read_text())
        self.assertEqual([p["still"] for p in told["pictures"]], ["fresh", "dry"])
        frames = decoded(film, 64, 36)
        self.assertLess(mean_difference(frames[0], frames[11]), 1)
        self.assertLess(mean_difference(frames[14], frames[24]), 1)
        self.assertGreater(mean_difference(frames[11], frames[14]), 4 * mean_difference(frames[0], frames[11]) + 1)
        self.bad(2, "film", "out/scene", "--scene", "elsewhere", says=["elsewhere", "only one"])

    def test_bad_input(self):
        self.bad(3, "film", "nowhere", says=["nowhere", "run.json"])
        self.good("run", self.scene(FLOOR.replace("frames = [0.0, 0.05, 0.3, 1.0]", "frames = [1.0]"), "one.toml"),
                  "-o", "one")
        if shutil.which("ffmpeg"):
            self.bad(2, "film", "one", says=["1 key frame", "wear.frames"])
            self.bad(2, "film", "one", "--size", "161x90", says=["--size 161x90", "even"])
            self.bad(2, "film", "one", "--scene", "wurn", says=["wurn", "there are: worn"])

    def test_without_ffmpeg_the_package_is_named(self):
        self.good("run", self.scene(FLOOR))
        empty = self.folder / "empty"
        empty.mkdir()
        self.bad(3, "film", "out/room", env={**os.environ, "PATH": str(empty)}, says=["ffmpeg", "Debian package"])


if __name__ == "__main__":
    unittest.main()
