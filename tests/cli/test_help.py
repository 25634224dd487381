"""Help that teaches, version, defaults, exit codes of the command line itself."""
import unittest

from program import ProgramTest


class Help(ProgramTest):
    def test_help_names_every_command_and_shows_examples(self):
        text = self.good("--help").stdout
        for command in ("run", "render", "film", "volume", "info", "check", "edit"):
            self.assertIn(command, text)
        self.assertIn("witherfield run --print-defaults grass", text)
        self.assertIn("Exit codes", text)

    def test_each_command_has_examples(self):
        for command in ("run", "render", "film", "volume", "info", "check", "edit"):
            text = self.good(command, "--help").stdout
            self.assertIn("Examples:", text, command)
            self.assertIn(f"witherfield {command} ", text, command)

    def test_version(self):
        self.assertRegex(self.good("--version").stdout, r"^witherfield \d+\.\d+\.\d+\n$")

    def test_wrong_command_lines_are_bad_input(self):
        for arguments in ((), ("dance",), ("run", "--wrong"), ("run",), ("volume", "x.vti"), ("render",),
                          ("run", "a.toml", "--resume", "--force"), ("run", "a.toml", "--threads", "-1"),
                          ("render", "x", "--quality", "best"), ("run", "--print-defaults", "leek")):
            done = self.program(*arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertTrue(done.stderr, arguments)

    def test_unknown_command_names_the_known_ones(self):
        self.bad(2, "-q", "dance", says=["'dance'", "run, render, film, volume, info, check, edit"])

    def test_wrong_sizes_and_ranges(self):
        (self.folder / "x.vti").write_text("")
        self.bad(2, "volume", "x.vti", "-o", "a.png", "--size", "12", says=["--size 12", "pixels"])
        self.bad(2, "volume", "x.vti", "-o", "a.png", "--range", "3,1", says=["--range 3,1", "LO < HI"])
        self.bad(2, "volume", "x.vti", "-o", "a.png", "--field", "watr", says=["unknown field 'watr'", "'water'"])

    def test_printed_defaults_are_a_scene(self):
        defaults = self.good("run", "--print-defaults", "grass").stdout
        self.assertIn("length_days = 60", defaults)
        self.scene(defaults + "\n", "defaults.toml")
        small = self.good("run", "defaults.toml", "--preview", "-o", "d")
        self.assertIn("key frames", small.stdout)
        self.assertTrue((self.folder / "d" / "run.json").exists())


if __name__ == "__main__":
    unittest.main()
