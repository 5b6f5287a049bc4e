"""Starts emulated devices, and the drivers by hand (driver_probe). The probe's path comes from the
environment."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
EMULATORS = ROOT / "tests/e2e/emulators"
HARDWARE = ROOT / "config/hardware"


class Process:
    """A program under way, by its pipes."""

    def __init__(self, *arguments, env=None):
        self.process = subprocess.Popen([str(a) for a in arguments], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True, bufsize=1,
                                        env={**os.environ, **(env or {})})

    def line(self):
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(f"{self.process.args} ended: {self.process.wait(5)}")
        return line.rstrip("\n")

    def kill(self):
        """As kill -9. @return when, on time.monotonic()."""
        self.process.kill()
        at = time.monotonic()
        self.process.wait()
        return at

    def clean_up(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


class Emulator(Process):
    def __init__(self, name, *arguments):
        super().__init__(sys.executable, EMULATORS / name, *arguments)
        self.announced = self.line().split(": ", 1)[1]


class Robotino(Emulator):
    def __init__(self, *arguments, port=0):
        super().__init__("robotino.py", "--port", port, *arguments)
        self.port = int(self.announced.rsplit(":", 1)[1])

    def state(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/emulator/state") as answer:
            return json.load(answer)

    def fault(self, path, kind):
        body = json.dumps({"path": path, "kind": kind}).encode()
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}/emulator/fault", body)
        urllib.request.urlopen(request).close()


class Probe(Process):
    """The drivers of a robot's file."""

    def __init__(self, file, *overrides, env=None):
        super().__init__(os.environ["DRIVER_PROBE"], file, *overrides, env=env)

    def ask(self, command):
        self.process.stdin.write(command + "\n")
        return self.line()

    def numbers(self, command):
        """The answer's numbers, group by group; nothing if it is an error."""
        answer = self.ask(command)
        if answer.startswith("error"):
            return None
        return [[float(n) for n in group.split()] for group in answer.split("|")]

    def condition(self, command="wheels"):
        words = self.ask(command).split(maxsplit=10)
        counts = {words[i]: int(words[i + 1]) for i in range(1, 9, 2)}
        return words[0], counts


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="baraka-drivers-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def started(self, process):
        self.addCleanup(process.clean_up)
        return process

    def wait_for(self, condition, what, timeout=20):
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            value = condition()
            if value:
                return value
            time.sleep(0.02)
        raise AssertionError(f"waited in vain: {what}")

    def near(self, got, wanted, tolerance, what=""):
        self.assertEqual(len(got), len(wanted), what)
        for a, b in zip(got, wanted):
            self.assertTrue(math.isclose(a, b, abs_tol=tolerance), f"{what}: {got} for {wanted}")
