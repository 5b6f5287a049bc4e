#!/usr/bin/env python3
"""Programs in lock-step, the holders of their namespaces, and the run itself end by signals at random instants: nothing hangs,
nothing is left, and the next run is as ever.

BARAKA_KILLS   how many (default 20)"""
import os
import random
import signal
import time
import unittest

import lockstep_plans
from baraka import BIN, Program, send, wait_for
from lockstep_test import REFUSED, Held, scenario
from remains import Mark

PROGRAM = BIN.parent / "tests/lockstep_random"
KILLS = int(os.environ.get("BARAKA_KILLS", "20"))
ENDS_WITHIN = 120  # s, of a run on a machine that does other things, too
GONE_WITHIN = 20  # s after its end
# An agent's own process may end without harm, once others hold its namespaces.
TARGETS = {"program": ("SIGKILL", "SIGKILL", "SIGTERM", "SIGSEGV"), "holder": ("SIGKILL",), "agent": ("SIGKILL",),
           "run": ("SIGKILL", "SIGTERM", "SIGINT")}
WEIGHTS = (3, 1, 1, 2)
STATUSES = {"program": (130,), "holder": (1,), "agent": (1, 130)}
# A shell in which nobody types lets what it starts with `&` ignore it, and so would a run that has not begun yet.
signal.signal(signal.SIGINT, signal.default_int_handler)


def name_of(pid):
    try:
        with open(f"/proc/{pid}/comm", encoding="utf-8") as comm:
            return comm.read().strip()
    except OSError:
        return ""


class Trial:
    """A run, and what is killed of it when."""

    def __init__(self, seed):
        self.random = random.Random(f"kill {seed}")
        self.mark = Mark()
        self.target = self.random.choices(list(TARGETS), WEIGHTS)[0]
        self.signal = self.random.choice(TARGETS[self.target])

    def is_wanted(self, name):
        """A process that is about to become a program has the name of who started it still."""
        return bool(name) and {"holder": name == "baraka-holder", "agent": name == "baraka-agent"}.get(
            self.target, not name.startswith("baraka"))

    def pick(self, run):
        """A process; nothing: there is none yet, or none any more."""
        if self.target == "run":
            return run.process.pid
        found = {pid: name_of(pid) for pid in self.mark.processes()}
        wanted = sorted(pid for pid, name in found.items() if pid != run.process.pid and self.is_wanted(name))
        return self.random.choice(wanted) if wanted else None

    def strike(self, run):
        """@return whether something was hit."""
        time.sleep(self.random.uniform(0, 0.6))
        for _ in range(200):
            pid = self.pick(run)
            try:
                if pid is not None:
                    self.mark.look()
                    send(pid, self.signal)
                    return True
            except ProcessLookupError:
                pass
            time.sleep(0.01)
        return False

    def __str__(self):
        return f"{self.signal} to a {self.target}"


@unittest.skipIf(REFUSED, REFUSED)
class Kills(Held):
    def prepare(self):
        """A run that would last for long, and a short one."""
        seeds = list(range(1, 101))
        plans = self.folder / "all.plans"
        plans.write_text("".join(lockstep_plans.text_of(seed, lockstep_plans.make_plan(seed)) for seed in seeds), encoding="utf-8")
        again = f"while :; do {PROGRAM} {plans} 10.77.0.1 0.1 || sleep 0.1; done"  # or no time would pass
        forks = "while :; do sleep 0.01 & sleep 0.003; wait; done"
        clock = ("clock", ["sh", "-c", "while sleep 1; do echo; done"], "")
        agents = {"z": [("answer", [PROGRAM, "answer"], ""), clock], "y": [clock],
                  "a": [("plans", ["sh", "-c", again], ""), ("forks", ["sh", "-c", forks], "")],
                  "b": [("plans", ["sh", "-c", again], ""), ("ping", ["ping", "-q", "-i", "0.01", "a"], "")]}
        self.long = scenario(self.folder, agents).rename(self.folder / "long.yaml")
        self.short = scenario(self.folder, {"a": [("ping", ["ping", "-c", 3, "-i", 0.1, "b"], ", on_exit: end")], "b": [
            ("forks", ["sh", "-c", forks], "")]})

    def fingerprint(self):
        return self.run_held(self.short)["fingerprint"]

    def trial(self, seed):
        trial = Trial(seed)
        run = Program("baraka", "run", self.long, "--pace", "lockstep", "--no-inspect", "--set", "end.0.at=10 h", "--out",
                      self.folder / f"killed{seed}", env=trial.mark.variables)
        self.addCleanup(run.clean_up)
        self.assertTrue(trial.strike(run), f"{trial}: there was none")
        if trial.target in ("program", "agent") and self.goes_on(run, self.folder / f"killed{seed}"):
            send(run.process.pid, "SIGINT")
        finished = run.finish(ENDS_WITHIN)
        self.assertEqual(trial.mark.remains_after(GONE_WITHIN), [], f"{trial}: {finished}")
        return trial, finished

    def goes_on(self, run, out):
        """Virtual time passes: one of two clocks has not been killed. @return false: the run has ended."""
        def length():
            return sum(log.stat().st_size for log in out.glob("?.clock.log"))
        before = length()
        wait_for(lambda: length() > before or run.process.poll() is not None, ENDS_WITHIN)
        return run.process.poll() is None

    def test_nothing_hangs_and_nothing_is_left(self):
        self.prepare()
        expected = self.fingerprint()
        met = {target: 0 for target in TARGETS}
        for seed in range(KILLS):
            with self.subTest(seed=seed):
                trial, finished = self.trial(seed)
                met[trial.target] += 1
                number = getattr(signal, trial.signal)  # ends the run by itself before the run takes it
                of_run = (-number,) if trial.signal == "SIGKILL" else (130, 143, -number)
                self.assertIn(finished.status, STATUSES.get(trial.target, of_run), f"{trial}: {finished}")
                self.assertEqual(self.fingerprint(), expected, f"after {trial}")
        self.assertGreater(min(met.values()), 0, met)

    def test_ends_that_take_too_long_are_cut_off_and_said(self):
        busy = "trap 'echo told; while :; do :; done' TERM; while sleep 0.1; do :; done"
        agents = {"a": [("busy", ["bash", "-c", busy], "")], "b": [("late", ["sleep", 100], "")]}
        begun = time.monotonic()
        finished = self.run_held(scenario(self.folder, agents), "--set", "end.0.at=1 s")
        self.assertLess(time.monotonic() - begun, ENDS_WITHIN)
        self.assertIn("told", self.log("a", "busy"))
        self.assertIn("warning: programs took too much wall time to end", finished.err)


if __name__ == "__main__":
    unittest.main()
