#!/usr/bin/env python3
"""Lets things go wrong during runs, and looks at what they leave: one that does not end, that ends by a signal
which nobody sent, that leaves a process, a namespace or a file behind, or a result that cannot be read.

    BARAKA_BIN=... faults.py [--faults 1000] [--seed 1] [--jobs 2] [--only N]

Which runs and which faults follows from the seed, when exactly they strike does not. Exit status 1: something was
found; what, and the number of its run for --only, is printed. Runs with programs need user namespaces."""
import argparse
import collections
import concurrent.futures
import contextlib
import os
import pathlib
import random
import resource
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time

import private_network
from baraka import BIN, CASE_STUDY, ROOT
from remains import Mark

FAULTY = ROOT / "tests/e2e/faulty.yaml"
ENDS_WITHIN = 90  # s after the last fault, on a machine that does other things, too
GONE_WITHIN = 10  # s after its end
MOST_MEMORY = 600  # MB of a run
AIR = """version: 1
routing: none
radio: {include: radios/ieee80211g.yaml}
agents:
  a:
    name: a
    station: {}
    poses: [{x: 0 m, y: 0 m}]
    network: {}
    programs: [{name: ping, command: [ping, -i, "0.05", b], start: 100 ms, on_exit: ignore}]
  b:
    name: b
    station: {}
    poses: [{x: 5 m, y: 0 m}]
    network: {}
    programs: [{name: wait, command: [sh, -c, "while :; do sleep 0.05; done"], start: 100 ms, on_exit: ignore}]
end: [{at: 3 s, result: timeout}]
"""
DEADLY = ("null_at", "abort_at", "overflow_at", "raise_at", "thread_throw_at", "thread_null_at", "throw_at",
          "exit_at", "leave_at", "quick_exit_at", "thread_exit_at", "nan_at", "beyond_at", "shout_at")


def sent(run, what, to=None):
    """Sends a signal to the run, or to a process of its."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(to or run.process.pid, getattr(signal, what))
        if to is None:
            run.signals.add(getattr(signal, what))


class Run:
    """One run, the faults that it meets, and what is wrong afterwards."""

    KINDS = {"processes": [CASE_STUDY, "--until", "40", "--max-speed", "20"],
             "inside": [CASE_STUDY, "--until", "40", "--max-speed", "20", "--controllers", "in-process"],
             "realtime": [CASE_STUDY, "--until", "40", "--pace", "realtime:20"],
             "view": [CASE_STUDY, "--until", "40", "--max-speed", "20", "--view", "--no-open"]}

    def __init__(self, seed, number):
        self.number = number
        self.random = random.Random(f"{seed} {number}")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="baraka-faults-"))
        self.out = self.folder / "out"
        (self.folder / "tmp").mkdir()
        self.mark = Mark()
        self.signals = set()  # that it was sent or has caused
        self.removed = False
        self.met = []
        self.sockets = []
        kinds = [*self.KINDS, "faulty"] + ["air"] * private_network.is_possible()
        self.kind = self.random.choice(kinds)

    def arguments(self):
        if self.kind == "air":
            (self.folder / "air.yaml").write_text(AIR)
            return [self.folder / "air.yaml", "--pace", "realtime"]
        if self.kind != "faulty":
            return self.KINDS[self.kind]
        fault, mode = self.random.choice(DEADLY), self.random.choice(("spawn", "in-process"))
        self.met.append(f"{fault} {mode}")
        if mode == "in-process":
            self.signals |= {signal.SIGSEGV, signal.SIGABRT, signal.SIGUSR1}
        return [FAULTY, "--controllers", mode, "--max-speed", "20",
                "--set", f"agents.robots.controller.parameters.{fault}=2 s"]

    def play(self):
        """@return what is wrong, in words."""
        arguments = [str(one) for one in self.arguments()]
        before = {name for name, _ in self.faults()}
        chosen = self.random.choices(sorted(before), k=self.random.randint(1, 4))
        delays = [self.random.uniform(0, 1) for _ in chosen]
        with open(self.folder / "err", "wb") as err:
            self.process = subprocess.Popen(
                [BIN / "baraka", "run", *arguments, "--out", self.out], stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=err, cwd=self.folder,
                env={**os.environ, **self.mark.variables, "TMPDIR": str(self.folder / "tmp")})
        for name, delay in zip(chosen, delays):
            time.sleep(delay)
            if self.ended():
                break
            self.mark.look()
            with contextlib.suppress(OSError, sqlite3.Error):
                if dict(self.faults())[name]() is not False:
                    self.met.append(name)
        return self.judged()

    def ended(self):
        return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)

    def faults(self):
        common = {"signal": self.signal_run, "halt": self.halt_run, "few files": self.few_files,
                  "full disk": self.full_disk, "little memory": self.little_memory,
                  "locked tables": self.lock_tables, "no folder": self.remove_folder,
                  "nobody reads": self.nobody_reads, "garbage": self.garbage}
        if self.kind != "inside":
            common |= {"kill one of its": self.kill_other, "halt one of its": self.halt_other}
        if self.kind == "view":
            common |= {"http garbage": self.http_garbage, "http trickle": self.http_trickle,
                       "http reset": self.http_reset, "http crowd": self.http_crowd}
        return list(common.items())

    # What can go wrong. False: it could not be done.

    def signal_run(self):
        sent(self, self.random.choice(("SIGINT", "SIGTERM", "SIGHUP", "SIGKILL", "SIGABRT", "SIGSEGV", "SIGUSR1")))

    def halt_run(self):
        sent(self, "SIGSTOP")
        time.sleep(self.random.uniform(0.05, 0.5))
        sent(self, "SIGCONT")

    def other(self):
        others = sorted(set(self.mark.processes()) - {self.process.pid})
        return self.random.choice(others) if others else None

    def kill_other(self):
        other = self.other()
        if other is None:
            return False
        sent(self, self.random.choice(("SIGKILL", "SIGTERM", "SIGSEGV", "SIGABRT")), other)
        return True

    def halt_other(self):
        other = self.other()
        if other is None:
            return False
        sent(self, "SIGSTOP", other)
        time.sleep(self.random.uniform(0.05, 0.5))
        sent(self, "SIGCONT", other)
        return True

    def limit(self, what, value):
        resource.prlimit(self.process.pid, what, (value, resource.prlimit(self.process.pid, what)[1]))

    def few_files(self):
        self.limit(resource.RLIMIT_NOFILE, len(os.listdir(f"/proc/{self.process.pid}/fd")) + self.random.randint(0, 3))

    def full_disk(self):
        """As near to it as one process can have it: no file of its grows any more."""
        self.signals.add(signal.SIGXFSZ)
        self.limit(resource.RLIMIT_FSIZE, self.random.choice((0, 4096, 65536)))

    def little_memory(self):
        pages = int(pathlib.Path(f"/proc/{self.process.pid}/statm").read_text().split()[0])
        self.signals.add(signal.SIGABRT)  # an exception that a library lets nobody catch
        self.limit(resource.RLIMIT_AS, pages * os.sysconf("SC_PAGE_SIZE") + self.random.choice((0, 1 << 20, 1 << 23)))

    def lock_tables(self):
        file = self.out / "run.sqlite"
        if not file.exists():
            return False
        with contextlib.closing(sqlite3.connect(file, timeout=0.1)) as database:
            database.execute("BEGIN EXCLUSIVE")
            time.sleep(self.random.uniform(0.1, 1))
        return True

    def remove_folder(self):
        if not self.out.exists():
            return False
        self.removed = True
        shutil.rmtree(self.out, ignore_errors=True)
        return True

    def nobody_reads(self):
        self.signals.add(signal.SIGPIPE)
        self.process.stdout.close()

    def garbage(self):
        mine = {os.readlink(file)[8:-1] for file in pathlib.Path(f"/proc/{self.process.pid}/fd").iterdir()
                if os.readlink(file).startswith("socket:")}
        lines = [line.split() for line in pathlib.Path("/proc/net/udp").read_text().splitlines()[1:]]
        ports = [int(line[1].split(":")[1], 16) for line in lines if line[9] in mine]
        if not ports:
            return False
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            for _ in range(300):
                head = b"RTPS\x02\x03" if self.random.random() < 0.5 else b""
                stranger.sendto(head + self.random.randbytes(self.random.randint(0, 1400)),
                                ("127.0.0.1", self.random.choice(ports)))
        return True

    def connection(self):
        for line in (self.folder / "err").read_text(errors="replace").splitlines():
            if line.startswith("view: http://"):
                host, _, port = line.removeprefix("view: http://").partition("/")[0].partition(":")
                self.sockets.append(socket.create_connection((host, int(port)), timeout=5))
                return self.sockets[-1]
        return None

    def http(self, data):
        one = self.connection()
        if one is None:
            return False
        one.sendall(data)
        return True

    def http_garbage(self):
        return self.http(self.random.randbytes(self.random.randint(1, 20000)))

    def http_trickle(self):
        return self.http(b"GET /api/clock HT")  # and stays

    def http_crowd(self):
        return all(self.http(b"GET / HTTP/1.1\r\nX: ") for _ in range(80))

    def http_reset(self):
        if not self.http(b"GET / HTTP/1.1\r\n\r\n"):
            return False
        self.sockets[-1].setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\0\0\0\0\0\0\0")
        self.sockets.pop().close()
        return True

    # What is wrong then.

    def judged(self):
        wrong = []
        end = time.monotonic() + ENDS_WITHIN
        while not self.ended() and time.monotonic() < end:
            self.mark.look()
            time.sleep(0.05)
        if not self.ended():
            wrong.append(f"has not ended {ENDS_WITHIN} s after its last fault")
            sent(self, "SIGKILL")
        _, status, usage = os.wait4(self.process.pid, 0)
        if usage.ru_maxrss > MOST_MEMORY * 1024:
            wrong.append(f"took {usage.ru_maxrss // 1024} MB")
        self.process.returncode = os.waitstatus_to_exitcode(status)
        for one in [*self.sockets, self.process.stdout]:
            one.close()
        if self.process.returncode < 0 and -self.process.returncode not in {*self.signals, signal.SIGKILL}:
            wrong.append(f"ended by signal {-self.process.returncode}")
        wrong += [f"left {one}" for one in self.mark.remains_after(GONE_WITHIN)]
        killed = self.process.returncode < 0
        wrong += [f"left {one}" for one in (self.folder / "tmp").iterdir() if not killed]
        wrong += [] if self.removed else self.unreadable()
        if not wrong:
            shutil.rmtree(self.folder)
        return wrong

    def unreadable(self):
        file = self.out / "run.sqlite"
        if not file.exists():
            return []
        try:
            with contextlib.closing(sqlite3.connect(file)) as database:
                found = database.execute("PRAGMA integrity_check").fetchone()[0]
                ended = database.execute("SELECT 1 FROM sqlite_master WHERE name = 'run'").fetchone() and \
                    database.execute("SELECT value FROM run WHERE key = 'result'").fetchone()
        except sqlite3.Error as error:
            return [f"its tables: {error}"]
        wrong = [] if found == "ok" else [f"its tables: {found}"]
        done = subprocess.run([BIN / "baraka", "report", self.out], capture_output=True, text=True, timeout=120,
                              check=False)
        if done.returncode < 0 or (ended and done.returncode != 0) or (done.returncode and not done.stderr):
            wrong.append(f"report: status {done.returncode}: {done.stderr.strip()}")
        return wrong


def played(seed, number):
    run = Run(seed, number)
    try:
        wrong = run.play()
    except Exception as error:  # pylint: disable=broad-except
        wrong = [f"the script: {error!r}"]
        run.process.kill()
    return run, wrong


def soak(faults, seed, jobs, only=None):
    """@return how many were met of each kind, and what was found."""
    met, found, number, pending = collections.Counter(), [], 0, set()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        while met.total() < faults or pending:
            while len(pending) < jobs and met.total() < faults and (only is None or number == 0):
                pending.add(pool.submit(played, seed, number if only is None else only))
                number += 1
            done, pending = concurrent.futures.wait(pending, return_when=concurrent.futures.FIRST_COMPLETED)
            for run, wrong in (one.result() for one in done):
                met.update(f"{run.kind}: {name}" for name in run.met)
                for one in wrong:
                    found.append(f"run {run.number} ({run.kind}; {', '.join(run.met)}): {one}; see {run.folder}")
                    print(found[-1], flush=True)
            if only is not None:
                break
    return met, number, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--faults", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", type=int, help="the run of this number")
    options = parser.parse_args()
    shared = set(os.listdir("/dev/shm"))
    met, runs, found = soak(options.faults, options.seed, options.jobs, options.only)
    for name, count in sorted(met.items()):
        print(f"{count:5} {name}")
    left = sorted(set(os.listdir("/dev/shm")) - shared)
    print(f"{met.total()} faults in {runs} runs, {len(found)} found; new in /dev/shm: {', '.join(left) or 'nothing'}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
