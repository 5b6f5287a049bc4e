#!/usr/bin/env python3
"""Small random programs in lock-step (lockstep/random_program.c): each step of each of their threads, signal handlers among
them, ends when a model says (lockstep_model.py), to the nanosecond, in the order that it says, and again in a second run.

BARAKA_RANDOM_PROGRAMS   how many (default 200)
BARAKA_RANDOM_SEED       the first of their seeds (default 1)"""
import os
import unittest

import lockstep_plans
from baraka import BIN
from lockstep_test import REFUSED, Held, scenario

PROGRAM = BIN.parent / "tests/lockstep_random"
PROGRAMS = int(os.environ.get("BARAKA_RANDOM_PROGRAMS", "200"))
FIRST_SEED = int(os.environ.get("BARAKA_RANDOM_SEED", "1"))
AGENTS = 5
MOST_IN_RUN = 250
LEAST_REQUEST = 200  # bytes, of all but those that only find the other station


def first_difference(lines, expected):
    """In words; empty: there is none."""
    for i in range(max(len(lines), len(expected))):
        one, other = (some[i] if i < len(some) else "nothing" for some in (lines, expected))
        if one != other:
            plan = next((line for line in reversed(expected[:i]) if line.startswith("plan")), "")
            before = "\n".join(expected[max(0, i - 5):i])
            return f"{plan}, line {i + 1}: '{one}' instead of '{other}' after\n{before}"
    return ""


@unittest.skipIf(REFUSED, REFUSED)
class RandomPrograms(Held):
    def start_scenario(self, all_seeds):
        """@param all_seeds  those of each agent's plans"""
        self.plans, agents = [], {"z": [("answer", [PROGRAM, "answer"], "")]}
        for i, seeds in enumerate(all_seeds):
            self.plans.append([lockstep_plans.make_plan(seed) for seed in seeds])
            file = self.folder / f"{i}.plans"
            file.write_text("".join(map(lockstep_plans.text_of, seeds, self.plans[-1])), encoding="utf-8")
            agents[f"r{i}"] = [("plans", [PROGRAM, file, "10.77.0.1", 0.1 * (i + 1)], "")]
        return scenario(self.folder, agents, seed=all_seeds[0][0])

    def answers(self, agent):
        """When answers to the programs of an agent came in, ns, by the run's own tables."""
        return [at for at, in self.query(
            "SELECT e.at_ns FROM frame_ends e JOIN frames f USING (frame) WHERE f.transmitter = 1 AND f.class = 'unicast' "
            f"AND f.bits > {8 * LEAST_REQUEST} AND f.receiver = e.agent AND e.verdict = 'delivered' AND e.agent = {agent} "
            "ORDER BY e.at_ns")]

    def check_logs(self, all_seeds):
        for i, (seeds, plans) in enumerate(zip(all_seeds, self.plans)):
            expected = lockstep_plans.foreseen(seeds, plans, self.answers(i + 2))
            self.assertEqual(first_difference(self.log(f"r{i}", "plans").splitlines(), expected), "", f"agent r{i}")

    def play(self, file):
        finished = self.run_held(file, timeout=600)
        return finished["fingerprint"], [self.log(f"r{i}", "plans") for i in range(AGENTS)]

    def test_each_step_is_where_the_model_says(self):
        for begin in range(0, PROGRAMS, MOST_IN_RUN):
            count = min(MOST_IN_RUN, PROGRAMS - begin)
            seeds = [list(range(FIRST_SEED + begin + i, FIRST_SEED + begin + count, AGENTS)) for i in range(AGENTS)]
            with self.subTest(first=seeds[0][0], count=count):
                file = self.start_scenario(seeds)
                fingerprint, logs = self.play(file)
                self.check_logs(seeds)
                again = self.play(file)
                for i, (log, other) in enumerate(zip(again[1], logs)):
                    self.assertEqual(first_difference(log.splitlines(), other.splitlines()), "", f"agent r{i}, again")
                self.assertEqual(again[0], fingerprint, f"see {self.out}")


if __name__ == "__main__":
    unittest.main()
