#!/usr/bin/env python3
"""Controllers in Python inside `baraka`, and as processes: every call, wrong uses, threads, and early ends."""
import os
import pathlib
import signal
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "e2e"))
from baraka import BIN, ROOT, Case, some_domain, wait_for  # noqa: E402

PROGRAMS = ROOT / "tests/e2e/python"
IN_PROCESS, SPAWN = ("--controllers", "in-process"), ("--controllers", "spawn")


def catches(pid, number):
    """Whether a process has a handler of its own for a signal, proc(5)."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    caught = next(line.split()[1] for line in status.splitlines() if line.startswith("SigCgt:"))
    return int(caught, 16) >> (number - 1) & 1


class Programs(Case):
    def play(self, *arguments):
        """A run, of which neither `baraka` nor a controller's process has anything that a sanitizer says."""
        done = self.run_baraka(*arguments, env={"BARAKA_CONTROLLER_PATH": f"{HERE}:{PROGRAMS}"}, timeout=300)
        said = done.err + "".join(log.read_text() for log in self.out.rglob("*.log"))
        self.assertNotIn("Sanitizer", said)
        self.assertNotIn("runtime error", said)

    def lines(self, words):
        return [line for line in (self.out / "run.log").read_text().splitlines() if words in line]

    def test_every_call(self):
        logs = []
        for mode in (IN_PROCESS, SPAWN):
            self.play(PROGRAMS / "every_call.yaml", *mode, "--set", "agents.robots.controller.program=every_call.py", "--set",
                      "agents.motes.controller.program=every_call.py")
            logs.append(self.lines("/controller:"))
        self.assertGreater(len(logs[0]), 2500)
        self.assertEqual(*logs)

    def test_wrong_uses(self):
        for mode in (IN_PROCESS, SPAWN):
            self.play(PROGRAMS / "wrong_uses.yaml", *mode)
            self.assertEqual(self.lines("WRONG"), [])
            self.assertEqual(len(self.lines("info r0/controller: right")), 80 + 3, mode)

    def test_a_thread_of_a_controller_counts_while_its_process_waits_for_the_run(self):
        for mode in (IN_PROCESS, SPAWN):
            self.play(PROGRAMS / "wrong_uses.yaml", *mode, "--set", "agents.robots.controller.program=counts.py")
            counted = [int(line.split()[-1]) for line in self.lines("counted")]
            self.assertEqual(len(counted), 2)
            self.assertGreater(min(counted), 0, mode)

    def test_a_process_is_ended_while_it_waits_for_its_run(self):
        """Its own thread goes on meanwhile, and says so; then the signal ends it, as it ends controllers in C++."""
        domain = some_domain(self)
        for number in (signal.SIGTERM, signal.SIGINT):
            process = subprocess.Popen(
                [sys.executable, BIN / "python/baraka/__main__.py", HERE / "counts.py", "--agents", "r0", "--wait", "none", "--domain",
                 str(domain)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, "COUNTS_SAYS": "1"},
                # Who starts these tests in the background of a shell has it ignored.
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            self.addCleanup(process.kill)
            wait_for(lambda pid=process.pid: catches(pid, signal.SIGTERM))  # its thread goes on already while it begins
            for _ in range(3):
                self.assertEqual(process.stdout.readline(), "goes on\n")
            process.send_signal(number)
            out, err = process.communicate(timeout=100)
            self.assertEqual((process.returncode, err), (130, ""), out)


if __name__ == "__main__":
    if not (BIN / "libbaraka_python.so").exists():
        print("skipped: needs a build with Python's headers and pybind11")
        sys.exit(77)
    unittest.main()
