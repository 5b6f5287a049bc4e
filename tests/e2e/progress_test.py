#!/usr/bin/env python3
"""How ./setup says how far a long command is, without a terminal."""
import pathlib
import subprocess
import tempfile
import unittest

PROGRESS = pathlib.Path(__file__).resolve().parents[2] / ".ci/progress.sh"


class Progress(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.go_on = pathlib.Path(folder.name) / "go_on"

    def start(self, body, period=0.05):
        """`body` is the command, a shell function; it may wait for the file `go_on`."""
        script = (f"set -euo pipefail; source '{PROGRESS}'; PROGRESS_PERIOD={period}\n"
                  f"go_on() {{ until [ -e '{self.go_on}' ]; do sleep 0.01; done; }}\n"
                  f"command() {{ {body}\n}}\n"
                  "with_progress building command\n"
                  "echo done\n")
        return subprocess.Popen(["bash", "-c", script], stdin=subprocess.DEVNULL, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_says_where_the_command_is_while_it_runs(self):
        with self.start("echo '[7/12] Building x.o'; go_on; echo 'never shown'") as setup:
            line = setup.stdout.readline()
            while "Building" not in line:  # the first may come before the command has begun
                line = setup.stdout.readline()
            self.go_on.touch()  # only now may the command end
            rest = setup.stdout.read()
        self.assertRegex(line, r"^building, \d+ s: \[7/12\] Building x.o$")
        self.assertTrue(rest.endswith("done\n"), rest)
        self.assertEqual(setup.returncode, 0)

    def test_says_nothing_of_a_command_that_ends_at_once(self):
        with self.start("echo '[1/1] Linking'", period=3600) as setup:
            self.assertEqual(setup.stdout.read(), "done\n")
        self.assertEqual(setup.returncode, 0)

    def test_shows_a_failure_whole_at_the_end_and_keeps_its_status(self):
        failing = ("echo '[1/2] Building a.o'; echo 'FAILED: b.o'; echo 'b.cpp:1:1: error: no'; "
                   "echo '[2/2] Building c.o'; echo 'ninja: build stopped'; return 3")
        with self.start(failing) as setup:
            shown = setup.stdout.read()
        self.assertTrue(
            shown.endswith("FAILED: b.o\nb.cpp:1:1: error: no\nninja: build stopped\n"), shown)
        self.assertEqual(setup.returncode, 3)


if __name__ == "__main__":
    unittest.main()
