#!/usr/bin/env python3
"""Records that somebody forged: whatever reads them ends by itself, in little memory and without a signal,
and if it refuses them it names the file and the table, and the row if a cell is wrong. Seeded.

Usage: forged_records_test.py [-v]; BARAKA_FORGED=200 sets the number of records; BARAKA_FORGED_TABLE=FILE
writes a line of each command that did not do well; BARAKA_FORGED_MB=200 the memory that each may take, 0: any
(under a sanitizer).
"""
import concurrent.futures
import http.client
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.error
import urllib.request

import forged_records
from baraka import BIN, CASE_STUDY, ROOT

COUNT = int(os.environ.get("BARAKA_FORGED", "20"))
MOST_MB = int(os.environ.get("BARAKA_FORGED_MB", "200"))
TABLE = os.environ.get("BARAKA_FORGED_TABLE")
LONGEST = int(os.environ.get("BARAKA_FORGED_SECONDS", "60"))  # of a command: of a real record each takes far below one
OBSERVABLES = ('[{name: "agents.*.x", every: 1 s}, {name: "agents.*.speed", every: 100 ms, as: histogram, bins: 10},'
               ' {name: "agents.*.y", every: 100 ms, as: quantiles}]')
KINDS = ["poses", "frames", "messages", "states", "events", "readings", "queues", "log"]
PLACE = re.compile(r"(run|campaign)\.sqlite(: | has tables)|scenario\.resolved\.yaml|: holds no result"
                   r"|none of these runs has such a quantity", re.M)
CELL = re.compile(r"table \w+, row ")
CONTROL = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]")


class Ended:
    """How a command ended: status (negative: by a signal; None: it was ended after LONGEST), output, memory."""

    def __init__(self, status, output, megabytes, seconds):
        self.status, self.output, self.megabytes, self.seconds = status, output, megabytes, seconds


def run(command):
    begin = time.monotonic()
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT)
        hangs = threading.Event()
        timer = threading.Timer(LONGEST, lambda: (hangs.set(), os.kill(process.pid, signal.SIGKILL)))
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        return Ended(None if hangs.is_set() else process.returncode, output.read(10_000_000),
                     usage.ru_maxrss / 1024, time.monotonic() - begin)


def addresses(world):
    """What the page would ask of a run: the tiles of its whole length and some below, and each agent."""
    end = max(0, min(int(world.get("end") or 0), 2**61))
    level = 4
    while level < 17 and 8**level <= end:
        level += 1
    kinds = KINDS + [f"series:{one['index']}" for one in world.get("series", [])[:4]]
    for kind in kinds:
        for below in (0, 1, 3):
            at = max(4, level - below)
            yield from {f"{kind}/{at}/0", f"{kind}/{at}/{(end // 2) // 8**at}", f"{kind}/{at}/{end // 8**at}"}
    for agent in [one["agent"] for one in world.get("agents", [])][:4]:
        yield f"routes/{agent}"
        yield f"totals/{agent}"


def look(folder):
    """All that a page asks of `baraka view`. What it answers with 500 is part of the output."""
    begin = time.monotonic()
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen([BIN / "baraka", "view", folder, "--no-open"], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=errors)
        said, hangs = [], False
        address = process.stdout.readline().decode(errors="replace").removeprefix("view: ").strip().rstrip("/")
        try:
            get(address, "view", said)
            world = json.loads(get(address, "runs/0/world", said) or "{}")
            for path in addresses(world):
                get(address, f"runs/0/{path}", said)
        except (OSError, ValueError, http.client.HTTPException) as error:
            hangs = isinstance(error, TimeoutError) or isinstance(getattr(error, "reason", None), TimeoutError)
        os.kill(process.pid, signal.SIGKILL if hangs else signal.SIGINT)  # it may have ended: nobody has waited
        process.stdout.close()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        output = errors.read() + "".join(f"error: {text}\n" for text in said).encode()
    return Ended(None if hangs else process.returncode, output, usage.ru_maxrss / 1024, time.monotonic() - begin)


def get(address, path, said):
    if not address:
        return ""
    try:
        with urllib.request.urlopen(f"{address}/api/{path}", timeout=LONGEST) as answer:
            return answer.read()
    except urllib.error.HTTPError as error:
        with error:
            if error.code == 500:
                said.append(error.read().decode(errors="replace").strip())
        return ""


def commands(folder, out, plan):
    """Name and what to run of all that reads a result, or a campaign."""
    yield "report", lambda: run([BIN / "baraka", "report", folder])
    if (BIN / "report_page.html").exists():
        yield "report -o", lambda: run([BIN / "baraka", "report", folder, "-o", out / "page.html"])
    yield "export csv", lambda: run([BIN / "baraka", "export", folder, "--format", "csv", "-o", out / "csv"])
    if (folder / "campaign.sqlite").exists():
        yield "status", lambda: run([BIN / "baraka", "campaign", plan, "--status", "--out", folder])
        yield "figure", lambda: run([BIN / "baraka", "report", folder, "--figure", "run.simulated"])
        return
    yield "diff", lambda: run([BIN / "baraka", "diff", folder, folder])
    yield "figure", lambda: run([BIN / "baraka", "report", folder, "--figure", "agents.x", "-o", out / "x.svg"])
    yield "export mcap", lambda: run([BIN / "baraka", "export", folder, "--format", "mcap", "-o", out / "run.mcap"])
    if (BIN / "view_page.html").exists():
        yield "view --export", lambda: run([BIN / "baraka", "view", folder, "--export", out / "view.html"])
    yield "view", lambda: look(folder)
    if (folder / "motes.log").exists():
        yield "--repeat", lambda: run([BIN / "baraka", "run", folder / "scenario.resolved.yaml", "--repeat", folder,
                                       "--controllers", "in-process", "--no-inspect", "--out", out / "again"])


def faults_of(ended, name):
    """What is wrong with how a command ended; empty: nothing."""
    faults = []
    if ended.status is None:
        faults.append("hang")
    elif ended.status < 0 or ended.status > 3:
        faults.append(f"status {ended.status}")
    if MOST_MB and ended.megabytes > MOST_MB:
        faults.append("memory")
    if b"AddressSanitizer" in ended.output or b"runtime error:" in ended.output:
        faults.append("sanitizer")
    if CONTROL.search(ended.output):
        faults.append("control characters")
    text = ended.output.decode(errors="replace")
    failed = [line for line in text.splitlines() if line.startswith("error: ")]
    if any(not PLACE.search(line) for line in failed) or (ended.status and not failed and name != "--repeat"
                                                           and not PLACE.search(text)):
        faults.append("no place")
    return faults


class ForgedRecords(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="baraka-forged-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        given = os.environ.get("BARAKA_FORGED_ORIGINALS")  # made before, to attack another version with the same
        originals = pathlib.Path(given) if given else cls.folder / "originals"
        cls.plan = originals / "speeds.yaml"
        if not given:
            cls.make_originals(originals)
        cls.originals = sorted(path for path in originals.iterdir() if path.is_dir())

    @classmethod
    def make_originals(cls, folder):
        folder.mkdir()
        inside = ["--controllers", "in-process", "--no-inspect"]
        everything = [argument for key in ("frames", "messages", "routes", "readings")
                      for argument in ("--set", f"record.{key}=all")]
        for command in (
                ["run", CASE_STUDY, *inside, "--until", "40", *everything, "--set", f"record.observables={OBSERVABLES}"],
                ["run", ROOT / "config/scenarios/many_robots.yaml", *inside, "--until", "3"],
                ["run", ROOT / "config/scenarios/two_motes.yaml", "--pace", "realtime", "--until", "2", "--no-inspect"]):
            subprocess.run([BIN / "baraka", *command, "--out", folder / pathlib.Path(command[1]).stem], check=True,
                           capture_output=True, timeout=300)
        cls.plan.write_text(json.dumps({
            "version": 1, "scenario": str(CASE_STUDY), "until": "5 s", "replications": 2,
            "vary": {"agents.robots.controller.parameters.speed": ["0.3 m/s", "0.9 m/s"]}}))
        subprocess.run([BIN / "baraka", "campaign", cls.plan, "--out", folder / "campaign"], check=True, capture_output=True,
                       timeout=300)

    def attack(self, number):
        """@return  what was done, and how each command ended: name, ended, faults."""
        # Most are of the richest one.
        original = self.originals[number % 10 if number % 10 < len(self.originals) else 0]
        if number % 10 >= len(self.originals):
            original = max(self.originals, key=lambda one: sum(f.stat().st_size for f in one.glob("*.sqlite")))
        forged, out = self.folder / f"forged{number}", self.folder / f"out{number}"
        done = forged_records.forge(original, forged, number)
        out.mkdir()
        ends = []
        for name, act in commands(forged, out, self.plan):
            ended = act()
            ends.append((name, ended, faults_of(ended, name)))
        subprocess.run(["rm", "-rf", forged, out], check=False)
        return f"{number} {original.name}: {done}", ends

    def test_originals_are_read(self):
        for original in self.originals:
            out = self.folder / f"out-{original.name}"
            out.mkdir()
            for name, act in commands(original, out, self.plan):
                ended = act()
                faults = faults_of(ended, name)
                if name == "figure" and original.name != "case_study":
                    continue  # nothing was asked for
                self.assertEqual((ended.status, faults), (0, []), f"{original.name}: {name}: {ended.output[-2000:]}")

    def test_forged_ones_are_read_or_refused(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            attacks = list(pool.map(self.attack, range(COUNT)))
        sums, faulty, refused, lines = {}, 0, 0, []
        for what, ends in attacks:
            faulty += any(faults for _, _, faults in ends)
            refused += any(ended.status for _, ended, _ in ends)
            for name, ended, faults in ends:
                for fault in faults:
                    sums[fault] = sums.get(fault, 0) + 1
                if faults:
                    tail = ended.output.decode(errors="replace").strip()[-300:]
                    lines.append(f"{what}: {name}: {', '.join(faults)}; {ended.megabytes:.0f} MB, {ended.seconds:.1f} s;"
                                 f" {tail!r}")
        most = max(ended.megabytes for _, ends in attacks for _, ended, _ in ends)
        longest = max(ended.seconds for _, ends in attacks for _, ended, _ in ends)
        cells = sum(bool(CELL.search(ended.output.decode(errors="replace"))) for _, ends in attacks for _, ended, _ in ends)
        print(f"\n{COUNT} records, {refused} refused by some command, {cells} messages name table and row; faulty:"
              f" {faulty} records {sums}; most memory {most:.0f} MB, longest {longest:.1f} s")
        if TABLE:
            pathlib.Path(TABLE).write_text("".join(line + "\n" for line in lines))
        self.assertGreater(refused, COUNT // 4)
        self.assertGreater(cells, COUNT // 4)
        self.assertEqual(lines, [])


if __name__ == "__main__":
    unittest.main()
