#!/usr/bin/env python3
"""Many runs of one scenario in one command: each equals the single run of its seed, and what ends
them early costs only what was under way."""
import sqlite3
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program, send, wait_for
from remains import Mark, started

IN_PROCESS = ["--controllers", "in-process"]
FAULTY = ROOT / "tests/e2e/faulty.yaml"
MARK = "kept.log"  # a run that starts again has a new folder


class Replications(Case):
    def replicate(self, *arguments, scenario=CASE_STUDY, status=0, out=None):
        finished = self.start(scenario, *IN_PROCESS, *arguments, out=out).finish()
        self.assertEqual(finished.status, status, str(finished))
        return finished

    def folders(self):
        return sorted(path for path in self.out.iterdir() if path.is_dir())

    def value(self, key, folder):
        """Of a run's table; None if it is not there."""
        try:
            rows = self.query(f"SELECT value FROM run WHERE key = '{key}'", folder)
        except sqlite3.OperationalError:
            return None  # not even the tables are there
        return rows[0][0] if rows else None

    def values(self, key):
        return {folder.name: self.value(key, folder) for folder in self.folders()}

    def ended(self):
        return [f for f in self.folders() if self.value("exit_status", f) is not None]


class KilledAndResumed(Replications):
    until = ["--until", "40"]
    command = [*until, "--replications", "10", "--max-speed", "100"]  # 0.4 s each

    def kill_after(self, count, signal, *arguments):
        """Starts the command, ends it once `count` runs have, and marks those."""
        mark = Mark()
        program = self.start(CASE_STUDY, *IN_PROCESS, *self.command, *arguments,
                             out=self.folder / "ten", env=mark.variables)
        wait_for(lambda: self.out.exists() and len(self.ended()) >= count)
        send(program.process.pid, signal)
        finished = program.finish()
        wait_for(lambda: not any(map(started, mark.processes())))  # those under way are dead, too
        marked = self.ended()
        for folder in marked:
            (folder / MARK).touch()
        self.assertLess(len(marked), 10, "it was to be killed before its end")
        return finished

    def test_two_kills_lose_and_repeat_nothing(self):
        self.kill_after(2, "SIGKILL")
        self.kill_after(5, "SIGKILL", "--jobs", "2")
        marked = {folder.name for folder in self.folders() if (folder / MARK).exists()}
        finished = self.replicate(*self.command, out=self.out)

        self.assertGreaterEqual(len(marked), 5)
        self.assertEqual(int(finished["kept"]), len(marked))
        for folder in self.folders():
            self.assertEqual((folder / MARK).exists(), folder.name in marked, folder.name)
        self.assertEqual([finished[key] for key in ("replications", "finished", "failed")],
                         ["10", "10", "0"])
        self.assertEqual(finished["result until"], "10")
        self.assertEqual(self.values("seed"),
                         {f"replication-{k:02}": k for k in range(1, 11)})
        self.assert_equal_to_single_runs()

    def assert_equal_to_single_runs(self):
        fingerprints = list(self.values("fingerprint").values())
        self.assertEqual(len(set(fingerprints)), 10, "seeds must make a difference")
        for seed, fingerprint in enumerate(fingerprints, 1):
            single = self.start(CASE_STUDY, *IN_PROCESS, *self.until, "--seed", seed,
                                out=self.folder / "single").finish()
            self.assertEqual(single["fingerprint"], fingerprint, f"seed {seed}")

    def test_ctrl_c_ends_it_at_once_and_says_how_to_go_on(self):
        finished = self.kill_after(1, "SIGINT")
        self.assertEqual(finished.status, 130, str(finished))
        self.assertIn("repeat the command to continue", finished.err)
        self.assertEqual(int(finished["finished"]), len(self.ended_well()))

    def ended_well(self):
        return [f for f in self.folders() if self.value("exit_status", f) == 0]


class Outcomes(Replications):
    def test_side_by_side_they_are_what_they_are_one_by_one(self):
        options = ["--until", "20", "--replications", "4"]
        self.replicate(*options)
        expected = self.values("fingerprint")
        self.replicate(*options, "--jobs", "2")
        self.assertEqual(self.values("fingerprint"), expected)

    def test_over_dds_each_takes_a_domain_of_its_own(self):
        options = ["--until", "20", "--replications", "2"]
        self.replicate(*options)
        expected = self.values("fingerprint")
        finished = self.start(CASE_STUDY, *options, "--jobs", "2").finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertEqual(self.values("fingerprint"), expected)

    def test_the_first_seed_is_the_one_given_and_more_can_be_added(self):
        self.replicate("--until", "2", "--seed", "7", "--replications", "2")
        more = self.replicate("--until", "2", "--seed", "7", "--replications", "3", out=self.out)
        self.assertEqual(more["kept"], "2")
        self.assertEqual(list(self.values("seed").values()), [7, 8, 9])
        self.assertRegex(more.err, r"replication-03 \(seed 9\): until, [\d.]+ s; 1 of 1, about 0 s")

    def test_another_scenario_in_the_same_folder_is_refused(self):
        self.replicate("--until", "2", "--replications", "1")
        for change in (["--until", "3"], ["--until", "2", "--seed", "2"],
                       ["--until", "2", "--set", "control_period=200 ms"]):
            with self.subTest(change=change):
                refused = self.replicate(*change, "--replications", "1", out=self.out, status=2)
                self.assertIn("another scenario", refused.err)
        self.assertIn("control_period", refused.err)
        single = self.replicate("--until", "2", out=self.out, status=2)
        self.assertIn("replications.yaml", single.err)

    def test_failed_ones_are_listed_with_their_errors_and_run_again(self):
        fault = ["--set", "agents.robots.controller.parameters.throw_at=2 s"]
        for _ in range(2):
            finished = self.replicate(*fault, "--replications", "2", scenario=FAULTY, status=1,
                                      out=self.folder / "faulty")
            self.assertEqual([finished[key] for key in ("finished", "failed", "kept")],
                             ["0", "2", "0"])
            for line in (r"failed: replication-01 \(seed \d+\): .*the wheels have come off",
                         r"failed: replication-02 \(seed \d+\): .*the wheels have come off"):
                self.assertRegex(finished.err, line)

    def test_an_expectation_that_is_not_met_has_its_own_exit_status(self):
        finished = self.replicate("--set", "end=[{at: 2 s, result: gave up}]",
                                  "--replications", "2", status=3)
        self.assertEqual((finished["finished"], finished["result gave up"]), ("2", "2"))

    def test_a_report_pools_them(self):
        self.replicate("--replications", "2", "--until", "2")
        report = Program("baraka", "report", self.out).finish()
        self.assertEqual(report.status, 0, str(report))
        for folder in self.folders():
            self.assertIn(folder.name, report.out)

    def test_wrong_options_are_usage_errors(self):
        for options in (["--replications", "0"], ["--jobs", "2"],
                        ["--replications", "2", "--jobs", "2", "--domain", "9-9"]):
            with self.subTest(options=options):
                self.replicate(*options, status=2)


if __name__ == "__main__":
    unittest.main()
