"""Runs the programs as a user would. The folder of the programs comes from the environment."""
import contextlib
import fcntl
import os
import pathlib
import random
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["BARAKA_BIN"])
CASE_STUDY = ROOT / "config/scenarios/case_study.yaml"


def some_domain(case):
    """A DDS domain for the rest of a test, which no other end-to-end test has meanwhile. Unit tests take
    71 to 100; `baraka run` takes 1, 2, 3, ... by itself."""
    for domain in random.sample(range(41, 71), 30):
        lock = open(pathlib.Path(tempfile.gettempdir()) / f"baraka-test-domain-{domain}.lock", "w")
        case.addCleanup(lock.close)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            continue
        return domain
    raise AssertionError("all domains of tests are taken")


def loopback(host=1):
    """An address of the loopback interface that no other test process uses meanwhile; host: 1 to 254."""
    number = os.getpid() % (150 * 254)
    return f"127.{100 + number // 254}.{1 + number % 254}.{host}"


class Finished:
    """How a program ended, and what it printed."""

    def __init__(self, status, out, err):
        self.status, self.out, self.err = status, out, err

    def __getitem__(self, key):
        for line in self.out.splitlines():
            if line.startswith(key + ": "):
                return line.split(": ", 1)[1]
        raise AssertionError(f"no '{key}:' in\n{self.out}\n{self.err}")

    def __str__(self):
        return f"status {self.status}\n--- stdout\n{self.out}\n--- stderr\n{self.err}"


def threads_of(pid):
    """Name, state, processor time in ticks and what each thread of a process waits for: of one that does not end."""
    lines = []
    for task in sorted(pathlib.Path(f"/proc/{pid}/task").glob("*")):
        try:
            name, _, rest = (task / "stat").read_text().partition("(")[2].rpartition(")")
            state = rest.split()
            lines.append(f"{task.name} {name}: {state[0]}, user {state[11]}, system {state[12]}, {(task / 'wchan').read_text()}")
        except OSError:
            continue  # it ended
    return "\n".join(lines)


class Program:
    """A program under way. It has no terminal."""

    def __init__(self, name, *arguments, env=None):
        self.process = subprocess.Popen(
            [BIN / name, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True, env={**os.environ, **(env or {})})

    def finish(self, timeout=120):
        try:
            out, err = self.process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            threads = threads_of(self.process.pid)
            self.process.kill()
            out, err = self.process.communicate()
            raise AssertionError(f"did not end within {timeout} s\n{out}\n{err}\n{threads}") from None
        return Finished(self.process.returncode, out, err)

    def clean_up(self):
        if self.process.returncode is None:
            self.process.kill()
            self.process.communicate()


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="baraka-e2e-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.runs = 0

    def start(self, scenario, *arguments, env=None, out=None):
        """Starts `baraka run`; the results go to a new folder, kept in self.out."""
        self.runs += 1
        self.out = out or self.folder / f"run{self.runs}"
        program = Program("baraka", "run", scenario, "--out", self.out, *arguments, env=env)
        self.addCleanup(program.clean_up)
        return program

    def run_baraka(self, scenario, *arguments, env=None, status=0, timeout=120):
        finished = self.start(scenario, *arguments, env=env).finish(timeout)
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def query(self, sql, out=None):
        """Rows of a run's results, which may still be growing; never makes the file."""
        file = (out or self.out) / "run.sqlite"
        with contextlib.closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as database:
            return database.execute(sql).fetchall()

    def check_countable(self):
        """What the run counted is among what it says that it could count."""
        for family, counted in (
                ("frames", "SELECT class FROM frames_sent"),
                ("receptions", "SELECT verdict FROM verdict_sums WHERE addressed"),
                ("requests", "SELECT verdict FROM requests"),
                ("messages.ends", "SELECT verdict FROM message_ends WHERE destination < 65534"),
                ("routing.events", "SELECT event FROM routing_events"),
                ("air", "SELECT purpose FROM air_accounts"), ("dds.lost", "SELECT verdict FROM sample_losses"),
                ("states", "SELECT state FROM states JOIN agents USING (agent) WHERE program IN "
                           "(SELECT program FROM countable WHERE family = 'states')")):
            found = self.query(f"{counted} EXCEPT SELECT word FROM countable WHERE family = '{family}'")
            self.assertEqual(found, [], f"{family}: counted, and not in the table countable")


def children(pid, name):
    """Processes of a program started by another one, by pid."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue  # it has ended meanwhile
        parent = int(text.rpartition(")")[2].split()[1])
        if parent == pid and text.split("(", 1)[1].startswith(name):
            found.append(int(stat.parent.name))
    return sorted(found)


def wait_for(condition, timeout=60):
    """Waits until condition() is true and returns what it gave."""
    end = time.monotonic() + timeout
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError("waited in vain")


def send(pid, what):
    os.kill(pid, getattr(signal, what))
