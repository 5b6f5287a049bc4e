#!/usr/bin/env python3
"""A run with agents' networks is killed at random instants, or one of what belongs to it is: nothing of
it is left 5 s later, no namespace, process, interface or file. Two runs at a time; the other one goes on."""
import contextlib
import json
import os
import pathlib
import random
import re
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

import wire
from baraka import BIN, wait_for
from remains import Mark
from wire import PYTHON

TRIALS = int(os.environ.get("BARAKA_KILLS", "12"))
REFUSED = wire.why_not()
LONGEST = 20  # s, until all is gone, also where two slow processors have eight suites
EARLY = 0.4  # s: while all is being made
KINDS = ["baraka", "holder", "init", "program"]

# What programs do that is hard to get rid of: daemons, ignored signals, files in shared memory, many
# processes, sockets that send.
PROGRAMS = [
    ["sh", "-c", "trap '' TERM HUP INT; touch /dev/shm/{mark}; while true; do sleep 0.01; done"],
    ["sh", "-c", "setsid sh -c 'setsid sleep 1000 & exit' & exit"],
    ["env", "-i", "/bin/sh", "-c", "/usr/bin/setsid /bin/sleep 1000 & exit"],
    ["ping", "-i", "0.01", "r1"],
    [PYTHON, "-c", "import socket\ns = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n"
                   "while True: s.sendto(b'x' * 1000, ('r1', 9))"],
]


def numbers_of(pid):
    """Its process numbers, from our namespace of process numbers to its own."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return re.search(r"^NSpid:(.*)$", status, re.MULTILINE).group(1).split()


def is_first_of_its_namespace(pid):
    """Not so for a program that init has forked and that bears init's name until it is executed."""
    return numbers_of(pid)[-1] == "1"


def is_inside_an_agent(pid):
    """Not so for what only helps the run to begin, as newuidmap does: without that it fails."""
    return len(numbers_of(pid)) > 1


class Victims:
    """Of one run: what can be killed."""

    def __init__(self, mark, first):
        self.mark, self.first = mark, first

    def by_name(self):
        found = {"baraka": self.first}
        for pid in self.mark.processes():
            try:
                comm = pathlib.Path(f"/proc/{pid}/comm").read_text().strip()
                is_init = comm == "baraka-init" and is_first_of_its_namespace(pid)
                # Others of init's name make the namespaces, or are about to become a program.
                is_program = is_inside_an_agent(pid) and comm != "baraka-init"
            except OSError:
                continue
            if comm == "baraka-holder":
                found["holder"] = pid
            elif is_init:
                found["init"] = pid
            elif is_program:
                found["program"] = pid
        return found

    def kill(self, chosen):
        """@return what was killed: another one if that is not there yet."""
        while True:
            found = self.by_name()
            name = chosen if chosen in found else "baraka"
            try:
                os.kill(found[name], signal.SIGKILL)
                return name
            except ProcessLookupError:
                continue  # a program that has ended by itself


class Run:
    """A run of two stations with programs under way."""

    def __init__(self, case, programs):
        self.case, self.mark, self.programs = case, Mark(), programs
        folder = tempfile.TemporaryDirectory(prefix="baraka-kill-")
        case.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.process = None

    def start(self):
        programs = [{"name": f"p{i}", "command": [word.replace("{mark}", self.mark.text) for word in program]}
                    for i, program in enumerate(self.programs)]
        scenario = {
            "version": 1, "routing": "none", "radio": {"include": "radios/ieee80211g.yaml", "queue_limit": 20},
            "agents": {
                "r0": {"name": "r0", "station": {}, "poses": [{"x": "0 m", "y": "0 m"}], "network": {},
                       "programs": programs},
                "r1": {"name": "r1", "station": {}, "poses": [{"x": "5 m", "y": "0 m"}], "network": {}}},
            "end": [{"at": "60 s", "result": "timeout"}]}
        file = self.folder / "scenario.yaml"
        file.write_text(json.dumps(scenario))
        self.process = subprocess.Popen(
            [BIN / "baraka", "run", file, "--out", self.folder / "run", "--no-inspect",
             "--max-speed", "1"],  # lockstep_kills does without
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            env={**os.environ, **self.mark.variables, "PATH": wire.PATH})

    def has_programs(self):
        return "program" in Victims(self.mark, self.process.pid).by_name()

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        return self.finish()

    def finish(self):
        _, said = self.process.communicate(timeout=60)
        return said

    def broken_results(self, has_begun):
        """What of the results cannot be read; there may be none before it has begun. As baraka's own tools it may
        write: a transaction that was cut short has to be taken back first."""
        files = list(self.folder.glob("run*/run.sqlite"))
        broken = [] if files or not has_begun else [f"none in {sorted(self.folder.rglob('*'))}"]
        for file in files:
            with contextlib.closing(sqlite3.connect(f"file:{file}?mode=rw", uri=True)) as database:
                said = database.execute("PRAGMA integrity_check").fetchall()
            if said != [("ok",)]:
                broken.append(f"{file}: {said}")
        return broken


@unittest.skipIf(REFUSED, REFUSED)
class Kills(unittest.TestCase):
    def test_nothing_is_left_whoever_dies_and_whenever(self):
        random.seed(11)
        self.killed = set()
        interfaces = wire.interfaces()
        for trial in range(TRIALS):
            chosen = KINDS[trial % 4]
            # From the first fork on; or with programs under way.
            instant = random.uniform(0, EARLY) if trial % 3 == 0 else random.uniform(EARLY, 1)
            with self.subTest(trial=trial, victim=chosen, instant=round(instant, 3)):
                self.kill_one_of_two(chosen, instant)
        self.assertEqual(wire.interfaces() - interfaces, set())
        self.assertEqual(self.killed, set(KINDS))

    def kill_one_of_two(self, chosen, instant):
        # When the other one is told to end, a program that ignores signals would take 10 s.
        doomed, other = Run(self, PROGRAMS), Run(self, PROGRAMS[1:])
        other.start()
        doomed.start()
        if instant > EARLY:
            wait_for(doomed.has_programs)
        end = time.monotonic() + instant
        while time.monotonic() < end:
            doomed.mark.look()
            time.sleep(0.02)  # the runs need the processor
        doomed.mark.look()
        killed = Victims(doomed.mark, doomed.process.pid).kill(chosen)
        self.killed.add(killed)
        if killed == "program":
            self.assertIsNone(doomed.process.poll(), "the run goes on without it")
            said = doomed.interrupt()
            self.assertEqual(doomed.process.returncode, 130, said)
        elif killed == "baraka":
            doomed.finish()
        else:
            self.assertIn("the namespaces of the run are gone", doomed.finish())
            self.assertEqual(doomed.process.returncode, 1)
        self.assertEqual(doomed.mark.remains_after(LONGEST), [])
        self.assertEqual(doomed.broken_results(has_begun=instant > EARLY), [])
        wait_for(other.has_programs)
        other.mark.look()
        self.assertTrue(other.mark.remains_after(0), "what counts what is left counts what is there")
        other.interrupt()
        self.assertEqual(other.process.returncode, 130, "the other run goes on")
        self.assertEqual(other.mark.remains_after(LONGEST), [])


if __name__ == "__main__":
    unittest.main()
