"""Files that are wrong in every way a hand or a disk can make them: `baraka check` accepts them or names
the place of each mistake, and what it accepts runs. Seeded: the same files every time.

Usage: mutated_files_test.py [-v]; BARAKA_MUTATED=3000 sets the number of files.
"""
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import unittest

import wire
from baraka import BIN, ROOT, some_domain

COUNT = int(os.environ.get("BARAKA_MUTATED", "300"))
SHARES = {"scenarios": 5, "robots": 3, "hardware": 3, "radios": 1}  # of the files
BATCH = 50
WALL_LIMIT = 60  # s for 2 s of simulated time: then a run is only slow, and is ended

VALUES = ["0", "-1", "1", "2", "0.5", "1e9", "1e300", "-1e300", "nan", "inf", "never", "none", "true", "~", "''",
          "0 m", "-1 m", "1e-9 m", "1e9 m", "10 m", "1 mm", "0 s", "1 ns", "-5 s", "1e9 s", "1e10 s", "1 h",
          "0 kg", "1e-3 kg", "1e4 kg", "100 kg", "0 dBm", "50 dBm", "-300 dBm", "1 W", "0 deg", "180 deg", "1e6 deg",
          "1000 m/s^2", "0 m/s^2", "1 b/s", "1e12 b/s", "99999999999999999999", "65535", "65536", "[]", "{}",
          "[1 m]", "[1 m, 2 m]", "[1 m, 2 m, 3 m]", "[0 m, 0 m, 0 m]", "{x: 1}", "a b c", "*a", "&a b", "!!int 3",
          "'\\x1b[2J'", '"\\e[31m"', "ä" * 40, "x" * 3000, "robots", "m0", "m*", "r0", "{include: nowhere.yaml}",
          "{include: ../robots/mote.yaml}", "{include: ../scenarios}", "[[[[[[1]]]]]]", "0x10", "012", "1_000"]
SCALAR = re.compile(r"(?<=[:\[,] )(?!\{|\[)[^,:#\[\]{}\n]+(?=[,\]}\n]| #)")
NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?")
# In a message about what stands in an included file.
INCLUDER = re.compile(r"(?:included|that) by (.*?\.yaml):\d+:\d+")
REFUSED = wire.why_not()  # networks, on this machine; "": nothing
FAILED = re.compile(r"^error: (the controller of \S+ .*failed at [\d.]+ s: to: "
                    r"|program \S+ of \S+ exited with status [1-9]\d*; see )", re.M)
KEY = re.compile(r"\b([a-z_]+[0-9]*)(?=:)")


def replaced(text, found, new):
    return text[:found.start()] + new + text[found.end():]


def mutate_value(text, rng):
    found = list(SCALAR.finditer(text))
    return replaced(text, rng.choice(found), rng.choice(VALUES)) if found else text


def scale_value(text, rng):
    found = [one for one in SCALAR.finditer(text) if NUMBER.match(one[0])]
    if not found:
        return text
    one = rng.choice(found)
    number = NUMBER.match(one[0])[0]
    factor = rng.choice([-1, 0, 0.1, 0.5, 0.9, 1.1, 2, 10, 1000, 1e6])
    return replaced(text, one, f"{float(number) * factor:.12g}{one[0][len(number):]}")


def swap_values(text, rng):
    found = list(SCALAR.finditer(text))
    return replaced(text, rng.choice(found), rng.choice(found)[0]) if found else text


def mutate_key(text, rng):
    found = list(KEY.finditer(text))
    new = rng.choice([one[0] for one in found] + ["include", "x", "version", "mass", "''", "?", "<<"])
    return replaced(text, rng.choice(found), new) if found else text


def change_lines(text, rng):
    lines = text.splitlines(keepends=True)
    at = rng.randrange(len(lines))
    other = rng.randrange(len(lines))
    what = rng.randrange(5)
    if what == 0:
        del lines[at]
    elif what == 1:
        lines.insert(other, lines[at])
    elif what == 2:
        lines[at], lines[other] = lines[other], lines[at]
    elif what == 3:
        lines[at] = " " * rng.randrange(1, 5) + lines[at]
    else:
        lines[at] = lines[at].lstrip()
    return "".join(lines)


def change_bytes(text, rng):
    letters = list(text)
    for _ in range(rng.randrange(1, 4)):
        at = rng.randrange(len(letters))
        letter = rng.choice("{}[]:,-#&*!|>'\"%@`\t\n \x01\x1b\x7f?~09aä")
        what = rng.randrange(3)
        if what == 0:
            letters[at] = letter
        elif what == 1:
            del letters[at]
        else:
            letters.insert(at, letter)
    return "".join(letters)


# What a person gets wrong comes more often than what a disk does: more of it is accepted.
MUTATIONS = [mutate_value] * 3 + [scale_value] * 4 + [swap_values, mutate_key, change_lines, change_bytes]


def mutated(text, rng):
    for _ in range(rng.choice([1, 1, 1, 2, 4])):
        text = rng.choice(MUTATIONS)(text, rng)
    return text


def run_arguments(kind, path):
    scenarios = path.parents[1] / "scenarios"
    if kind == "scenarios":
        return [path]
    if kind == "radios":
        return [scenarios / "two_motes.yaml", "--set", f"radio.include={path}"]
    if path.read_text().find("link:") < 0:  # a mote
        return [scenarios / "two_motes.yaml", "--set", f"agents.motes.mote.include={path}"]
    return [scenarios / "wanderer.yaml", "--set", f"agents.robots.robot.include={path}"]


class MutatedFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        rng = random.Random(1)
        cls.files = {}  # path -> kind
        for kind, share in SHARES.items():
            shutil.copytree(ROOT / "config" / kind, cls.folder / kind)
            originals = sorted((cls.folder / kind).glob("*.yaml"))
            for number in range(COUNT * share // sum(SHARES.values())):
                path = cls.folder / kind / f"mutated{number:04}.yaml"
                path.write_text(mutated(rng.choice(originals).read_text(), rng))
                cls.files[path] = kind
        cls.accepted = None

    def check(self, paths, kind):
        """Which of the files are accepted; fails if one of the others is not refused with a place."""
        arguments = ["--kind", {"scenarios": "scenario", "hardware": "hardware"}[kind]] \
            if kind in ("scenarios", "hardware") else []
        finished = subprocess.run([BIN / "baraka", "check", *arguments, *paths], capture_output=True,
                                  timeout=300, text=True, errors="replace")
        self.assertIn(finished.returncode, (0, 2), f"{paths[0]} ...: {finished.stderr[-2000:]}")
        accepted = [path for path in paths if f"{path}: ok" in finished.stdout.splitlines()]
        placed = set()
        for line in finished.stderr.splitlines():
            self.assertRegex(line, r"^[^\x00-\x1f\x7f]*$", "terminals must not see this")
            if line.startswith(("parameters of", "controller")):  # what was not checked
                continue
            found = re.match(r"(.*?\.yaml)(:\d+:\d+)?: .+", line)
            self.assertTrue(found, f"a message without a place: {line!r}")
            placed.update([found[1], *INCLUDER.findall(line)])
        for path in set(paths) - set(accepted):
            self.assertIn(str(path), placed, f"{path} is refused without a place:\n{path.read_text()}")
        self.assertEqual(finished.returncode, 0 if len(accepted) == len(paths) else 2)
        return accepted

    def accepted_files(self):
        if self.accepted is None:
            type(self).accepted = []
            for kind in SHARES:
                paths = [path for path, own in self.files.items() if own == kind]
                for at in range(0, len(paths), BATCH):
                    self.accepted.extend(self.check(paths[at:at + BATCH], kind))
        return self.accepted

    def test_each_is_accepted_or_refused_with_a_place(self):
        accepted = self.accepted_files()
        print(f"\n{len(self.files)} files, {len(accepted)} accepted")
        self.assertGreater(len(accepted), len(self.files) // 20)
        self.assertLess(len(accepted), len(self.files) * 3 // 4)
        for kind in SHARES:
            self.assertIn(kind, [self.files[path] for path in accepted], f"no file of {kind} is accepted")

    def run_for_two_seconds(self, path):
        """How the run ended: status, and what it said."""
        try:
            finished = subprocess.run(
                [BIN / "baraka", "run", *run_arguments(self.files[path], path), "--until", "2",
                 "--controllers", "in-process", "--no-inspect", "--out", path.with_suffix(".out")],
                capture_output=True, timeout=WALL_LIMIT, text=True, errors="replace")
        except subprocess.TimeoutExpired:
            return None, "slow"
        shutil.rmtree(path.with_suffix(".out"), ignore_errors=True)
        return finished.returncode, finished.stderr

    def test_those_accepted_run(self):
        simulated = [path for path in self.accepted_files() if self.files[path] != "hardware"]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            ends = dict(zip(simulated, pool.map(self.run_for_two_seconds, simulated)))
        slow = [path for path, (status, _) in ends.items() if status is None]
        print(f"\n{len(ends)} runs, {len(slow)} of them slow")
        for path, (status, said) in ends.items():
            # 3: it ended before what the scenario expects came true; 2: not fit for this scenario; 1: a
            # controller found that it cannot do with its parameters, such as the name of nobody, or
            # a program of somebody else with its arguments.
            if status == 1 and (FAILED.search(said) or REFUSED and "agents with a network need" in said):
                continue
            self.assertIn(status, (0, 2, 3, None), f"{path}:\n{path.read_text()}\n{said}")
        self.assertLess(len(slow), 1 + len(ends) // 20, slow)

    def serve_for_two_seconds(self, path, domain):
        """How a daemon without devices and with the radio on loopback ended, and what it said."""
        devices = ["--set", "wheels={driver: none}", "--set", "infrared={driver: none}"]
        is_robot = re.search(r"kind: *robot", path.read_text())
        daemon = subprocess.Popen(
            [BIN / "baraka-agentd", path, "--domain", str(domain), "--no-inspect", "--set",
             "radio.interface=lo", "--set", "radio.address=127.0.0.1", "--set",
             "localisation={driver: none}", *(devices if is_robot else [])],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
        try:
            _, said = daemon.communicate(timeout=2)
        except subprocess.TimeoutExpired:
            daemon.terminate()
            _, said = daemon.communicate(timeout=WALL_LIMIT)
        return daemon.returncode, said

    def test_daemons_serve_those_accepted(self):
        files = [path for path in self.accepted_files() if self.files[path] == "hardware"][:COUNT // 50]
        self.assertGreater(len(files), 3)
        domain = some_domain(self)
        served = 0
        for path in files:
            status, said = self.serve_for_two_seconds(path, domain)
            # 1 and 2: they say what does not suit this computer or this test.
            self.assertIn(status, (0, 1, 2), f"{path}:\n{path.read_text()}\n{said}")
            self.assertTrue(status == 0 or said.strip(), path)
            served += status == 0
        self.assertGreater(served, len(files) // 2)


if __name__ == "__main__":
    unittest.main()
