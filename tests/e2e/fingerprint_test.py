#!/usr/bin/env python3
"""A run is the same however it is computed: its fingerprint does not depend on where controllers
run, how agents share processes, how fast it goes, or what else the machine does."""
import unittest

from baraka import CASE_STUDY, Case

UNTIL = ["--until", "20"]  # after a second a mote calls, and the robot drives to it; e2e.case_study has all of the run
SPLIT_IN_FIVE = ["--set", "agents.motes.controller.processes=5"]
ONE_EACH = ["--set", "agents.motes.controller.processes=25"]
NO_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}


class Fingerprints(Case):
    settings = []  # of the scenario

    def fingerprint(self, *arguments, env=None):
        finished = self.run_baraka(CASE_STUDY, *UNTIL, *self.settings, *arguments, env=env)
        self.assertEqual(finished["result"], "until")
        return finished["fingerprint"]

    def in_process(self, seed, env=None):
        return self.fingerprint("--seed", seed, "--controllers", "in-process", env=env)

    def test_in_process_and_over_dds_are_equal_for_three_seeds(self):
        seen = set()
        for seed in (1, 2, 3):
            with self.subTest(seed=seed):
                expected = self.in_process(seed)
                self.assertEqual(self.fingerprint("--seed", seed), expected)
                self.assertEqual(self.in_process(seed, env=NO_FMA), expected)
                seen.add(expected)
        self.assertEqual(len(seen), 3, "seeds must make a difference")

    def test_more_processes_change_nothing(self):
        self.assertEqual(self.fingerprint(*SPLIT_IN_FIVE), self.in_process(1))

    def test_two_runs_side_by_side_and_a_throttled_one_are_equal(self):
        programs = [self.start(CASE_STUDY, *UNTIL, *self.settings) for _ in range(2)]
        programs.append(self.start(CASE_STUDY, *UNTIL, *self.settings, "--max-speed", "50"))
        finished = [program.finish() for program in programs]
        expected = self.in_process(1)
        for one in finished:
            self.assertEqual(one["fingerprint"], expected, str(one))
        # 20 simulated seconds at 50 times real time last 0.4 s
        self.assertLessEqual(float(finished[2]["real_time_factor"]), 50.5)


class FingerprintsWithLatency(Fingerprints):
    settings = ["--set", "controller_latency=10 ms", "--set", "control_phase=uniform"]

    def test_a_process_for_each_agent_changes_nothing(self):
        self.assertEqual(self.fingerprint(*ONE_EACH), self.in_process(1))

    def test_latency_and_phase_belong_to_the_runs_identity(self):
        with_latency = self.in_process(1)
        plain = self.run_baraka(CASE_STUDY, *UNTIL, "--controllers", "in-process")
        self.assertNotEqual(with_latency, plain["fingerprint"])


if __name__ == "__main__":
    unittest.main()
