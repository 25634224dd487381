"""Runs that were broken off, resumed, repeated and replaced."""
import json
import resource
import signal
import subprocess
import time
import unittest

from program import PROGRAM, STILL, TINY, ProgramTest


class Interrupted(ProgramTest):
    def test_a_folder_with_a_run_is_not_overwritten(self):
        scene = self.scene(TINY)
        self.good("run", scene)
        before = self.files("out/scene")
        self.bad(2, "run", scene, says=["--resume", "--force"])
        self.assertEqual(self.files("out/scene"), before)

    def test_resuming_a_complete_run_does_nothing(self):
        scene = self.scene(TINY)
        self.good("run", scene)
        before = self.files("out/scene")
        self.assertIn("complete", self.good("run", scene, "--resume").stdout)
        self.assertEqual(self.files("out/scene"), before)

    def test_another_scene_cannot_be_resumed(self):
        self.good("run", self.scene(TINY))
        self.bad(2, "run", self.scene(TINY.replace("count = 30", "count = 31")), "--resume", says=["another scene"])

    def test_force_replaces_the_run_and_nothing_else(self):
        self.good("run", self.scene(TINY + STILL))
        mine = self.folder / "out/scene/texel/notes.txt"
        mine.write_text("mine")
        (self.folder / "out/scene/images").mkdir()
        (self.folder / "out/scene/images/a_texel.png").write_text("old picture")
        (self.folder / "out/scene/images/holiday.png").write_text("mine")
        self.good("run", self.scene(TINY.replace("0.3, 0.9", "0.9")), "--force")
        files = self.files("out/scene")
        self.assertIn("texel/notes.txt", files)
        self.assertIn("images/holiday.png", files)
        self.assertNotIn("images/a_texel.png", files)
        self.assertIn("texel/texel_0001.vti", files)
        self.assertNotIn("texel/texel_0002.vti", files)
        self.assertFalse([f for f in files if f.startswith("pov/")])
        listed = [f["path"] for f in json.loads((self.folder / "out/scene/run.json").read_text())["files"]]
        self.assertNotIn("texel/notes.txt", listed)

    def test_disk_full_later_keeps_whole_frames_and_resumes_to_the_same_bytes(self):
        scene = self.scene(TINY + STILL)
        self.good("run", scene, "-o", "whole")
        size = {p: (self.folder / "whole" / p).stat().st_size for p in self.files("whole")}
        first = max(size[p] for p in size if p.endswith(("0000.vti", "0000.vtp", ".json")) and p != "run.json")
        later = max(size[p] for p in size if p.endswith(("1.vti", "1.vtp", "2.vti", "2.vtp")))
        self.assertGreater(later, first + 1, "the scene must make a later frame larger than the first")

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (later - 1, later - 1))
        done = self.bad(3, "run", scene, "-o", "cut", says=["cut/"], before=limit)
        self.assertIn("--resume", done.stderr)
        self.assert_nothing_half_written()
        cut = self.files("cut")
        self.assertNotIn("run.json", cut)
        self.assertIn("texel/texel_0000.vti", cut)
        self.bad(3, "render", "cut", says=["broken off", "--resume"])
        kept = (self.folder / "cut/texel/texel_0000.vti").stat().st_mtime_ns
        self.good("run", scene, "-o", "cut", "--resume")
        self.assertEqual((self.folder / "cut/texel/texel_0000.vti").stat().st_mtime_ns, kept, "a whole frame is not rewritten")
        whole, cut = self.files("whole"), self.files("cut")
        runs = [json.loads((self.folder / d / "run.json").read_text()) for d in ("whole", "cut")]
        for key in ("scene", "value_ranges", "frames", "stills", "checks"):
            self.assertEqual(runs[0][key], runs[1][key], key)
        whole.pop("run.json")
        cut.pop("run.json")
        self.assertEqual(whole, cut)

    def test_ctrl_c_leaves_whole_files_only(self):
        frames = ", ".join(str(i / 200) for i in range(200))
        scene = self.scene(TINY.replace("0.0, 0.3, 0.9", frames))
        process = subprocess.Popen([PROGRAM, "run", scene, "-o", "stopped"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while not (self.folder / "stopped/texel/texel_0000.vti").exists() and time.monotonic() < deadline:
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, messages)
        self.assertIn("interrupted", messages)
        self.assert_nothing_half_written()
        self.assertNotIn("run.json", self.files("stopped"))
        self.good("run", scene, "-o", "stopped", "--resume")

    def test_remains_of_a_killed_run_are_cleared(self):
        scene = self.scene(TINY)
        self.good("run", scene)
        (self.folder / "out/scene/run.json").unlink()
        (self.folder / "out/scene/texel/texel_0002.vti").rename(self.folder / "out/scene/texel/texel_0002.vti.part")
        self.good("run", scene, "--resume")
        self.assert_nothing_half_written()
        self.assertIn("texel/texel_0002.vti", self.files("out/scene"))


if __name__ == "__main__":
    unittest.main()
