#!/usr/bin/env python3
"""Programs in lock-step, the holders of their namespaces, and the run itself end by signals at random instants: nothing hangs,
nothing is left, and the next run is as ever.

BARAKA_KILLS   how many (default 20)"""
import os
import random
import time
import unittest

import lockstep_plans
from baraka import BIN, Program, send
from lockstep_test import REFUSED, Held, scenario
from remains import Mark

PROGRAM = BIN.parent / "tests/lockstep_random"
KILLS = int(os.environ.get("BARAKA_KILLS", "20"))
ENDS_WITHIN = 120  # s, of a run on a machine that does other things, too
GONE_WITHIN = 20  # s after its end
TARGETS = {"program": ("SIGKILL", "SIGKILL", "SIGTERM", "SIGSEGV"), "holder": ("SIGKILL",),
           "run": ("SIGKILL", "SIGTERM", "SIGINT")}


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
        self.target = self.random.choice(list(TARGETS))
        self.signal = self.random.choice(TARGETS[self.target])

    def pick(self, run):
        """A process; nothing: there is none yet, or none any more."""
        if self.target == "run":
            return run.process.pid
        found = {pid: name_of(pid) for pid in self.mark.processes()}
        wanted = sorted(pid for pid, name in found.items() if name and pid != run.process.pid and
                        (name == "baraka-holder") == (self.target == "holder"))
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
        seeds = list(range(1, 301))
        plans = self.folder / "all.plans"
        plans.write_text("".join(lockstep_plans.text_of(seed, lockstep_plans.make_plan(seed)) for seed in seeds), encoding="utf-8")
        again = f"while :; do {PROGRAM} {plans} 10.77.0.1 0.1; done"
        forks = "while :; do sleep 0.01 & sleep 0.003; wait; done"
        agents = {"z": [("answer", [PROGRAM, "answer"], "")],
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
        if trial.target == "program":
            time.sleep(trial.random.uniform(0, 0.3))
            self.assertIsNone(run.process.poll(), f"{trial}: the run goes on")
            send(run.process.pid, "SIGINT")
        finished = run.finish(ENDS_WITHIN)
        self.assertEqual(trial.mark.remains_after(GONE_WITHIN), [], f"{trial}: {finished}")
        return trial, finished

    def test_nothing_hangs_and_nothing_is_left(self):
        self.prepare()
        expected = self.fingerprint()
        met = {target: 0 for target in TARGETS}
        for seed in range(KILLS):
            with self.subTest(seed=seed):
                trial, finished = self.trial(seed)
                met[trial.target] += 1
                statuses = {"holder": (1,), "program": (130,)}.get(
                    trial.target, (-9,) if trial.signal == "SIGKILL" else (130, 143))
                self.assertIn(finished.status, statuses, f"{trial}: {finished}")
                self.assertEqual(self.fingerprint(), expected, f"after {trial}")
        self.assertGreater(min(met.values()), 0, met)


if __name__ == "__main__":
    unittest.main()
