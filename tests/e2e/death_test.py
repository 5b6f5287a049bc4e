#!/usr/bin/env python3
"""Controllers that die, fall silent, throw or ask for what cannot be; and a user who interrupts."""
import re
import sqlite3
import time
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program, children, send, wait_for

FAULTY = ROOT / "tests/e2e/faulty.yaml"
SLOW = ["--max-speed", "20"]  # leaves time to interfere


class Deaths(Case):
    def started(self, *arguments):
        """A case study under way, and the pids of its two controller processes."""
        program = self.start(CASE_STUDY, *SLOW, *arguments)
        wait_for(lambda: self.has_begun())
        pid = program.process.pid
        (mote,), (robot,) = children(pid, "help_mote"), children(pid, "help_robot")
        return program, mote, robot

    def has_begun(self):
        """Poses are on disk. Before, there may be no file, or one whose tables are not committed."""
        try:
            return self.query("SELECT count(*) FROM poses")[0][0] > 0
        except sqlite3.OperationalError:
            return False

    def fails_naming(self, program, *what):
        finished = program.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertEqual(finished["result"], "failed")
        error = next(line for line in finished.err.splitlines() if line.startswith("error: "))
        for one in what:
            self.assertRegex(error, one)
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'result'"), [("failed",)])
        return finished

    def test_a_killed_controller_ends_the_run(self):
        program, _, robot = self.started()
        send(robot, "SIGKILL")
        self.fails_naming(program, "robots", "killed by signal 9", r"\br0\b", r"at \d+\.\d+ s")

    def test_one_that_never_answers_ends_the_run_after_the_reply_timeout(self):
        program, mote, _ = self.started("--set", "reply_timeout=1 s")
        send(mote, "SIGSTOP")
        self.fails_naming(program, "motes", r"\bm24\b", r"at \d+\.\d+ s", r"did not answer within 1 s")

    def test_one_that_is_stopped_and_continued_changes_nothing(self):
        until = ["--until", "40"]
        expected = self.run_baraka(CASE_STUDY, *until)["fingerprint"]
        program, mote, robot = self.started(*until)
        for pid in (mote, robot):
            send(pid, "SIGSTOP")
            time.sleep(0.5)
            send(pid, "SIGCONT")
        self.assertEqual(program.finish()["fingerprint"], expected)

    def test_with_on_death_silence_the_run_goes_on_without_it(self):
        program, _, robot = self.started("--set", "on_death=silence", "--until", "60")
        send(robot, "SIGKILL")
        finished = program.finish()
        self.assertEqual(finished.status, 0, str(finished))
        self.assertEqual(finished["result"], "until")
        last = self.query("SELECT max(at_ns) / 1e9 FROM poses JOIN agents USING (agent)"
                          " WHERE name = 'r0'")[0][0]
        self.assertLess(last, 59, "its wheels have stopped")

    def test_ctrl_c_keeps_the_results(self):
        program, *_ = self.started()
        send(program.process.pid, "SIGINT")
        finished = program.finish()
        self.assertEqual(finished.status, 130, str(finished))
        self.assertEqual(finished["result"], "interrupted")
        self.assertEqual(self.query("SELECT value FROM run WHERE key = 'fingerprint'"),
                         [(finished["fingerprint"],)])

    def test_when_the_simulator_is_killed_its_controllers_end(self):
        program, mote, robot = self.started()
        program.process.kill()
        program.finish()
        wait_for(lambda: not any(alive(pid) for pid in (mote, robot)))


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as stat:
            return stat.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Faults(Case):
    modes = (["--controllers", "in-process"], [])

    def test_the_message_of_a_controller_that_throws_is_in_the_error(self):
        for mode in self.modes:
            with self.subTest(mode=mode):
                finished = self.run_baraka(
                    FAULTY, *mode, "--set", "agents.robots.controller.parameters.throw_at=2 s",
                    status=1)
                self.assertRegex(finished.err, r"error: the controller of r0 \(process robots\) "
                                               r"failed at 2\.0+ s: .*the wheels have come off")

    def test_one_that_hangs_is_a_timeout(self):
        finished = self.run_baraka(
            FAULTY, "--set", "agents.robots.controller.parameters.hang_at=2 s", "--set",
            "reply_timeout=500 ms", status=1)
        self.assertRegex(finished.err, r"error: .*robots.*\br0\b.* at 2\.0+ s")

    def test_a_wrong_action_is_returned_logged_and_the_run_goes_on(self):
        for mode in self.modes:
            with self.subTest(mode=mode):
                finished = self.run_baraka(
                    FAULTY, *mode, "--set", "agents.robots.controller.parameters.nan_at=1 s",
                    "--set", "agents.robots.controller.parameters.beyond_at=2 s")
                self.assertEqual(finished["result"], "done")
                states = [state for state, in self.query("SELECT state FROM states")]
                self.assertEqual(len(states), 2)
                self.assertNotIn("ACCEPTED", states)
                log = (self.out / "run.log").read_text()
                self.assertRegex(log, r"warning r0.*vx.*nan")
                self.assertRegex(log, r"warning r0.*1000")


class Sessions(Case):
    """Controllers started by hand, as in separate terminals."""

    def served(self, *arguments):
        program = self.start(CASE_STUDY, "--controllers", "external", "--until", "30", *arguments)
        line = program.process.stderr.readline()
        return program, re.match(r"domain: (\d+)", line).group(1)

    def controller(self, name, domain, *arguments):
        program = Program(name, "--domain", domain, *arguments)
        self.addCleanup(program.clean_up)
        return program

    def test_controllers_in_separate_terminals_serve_one_run_after_the_other(self):
        expected = self.run_baraka(CASE_STUDY, "--until", "30")["fingerprint"]
        domain = self.free_domain()
        motes = self.controller("help_mote", domain, "--agents", "m*", "--stay")
        robots = self.controller("help_robot", domain, "--agents", "r0", "--stay")
        for _ in range(2):
            program, _ = self.served("--domain", domain)
            self.assertEqual(program.finish()["fingerprint"], expected)
        for program in (motes, robots):
            send(program.process.pid, "SIGTERM")
            self.assertEqual(program.finish().status, 130)

    def free_domain(self):
        """One that runs which take the first free domain hardly reach; its ports are below those
        that the kernel gives away."""
        return str(81 + time.monotonic_ns() % 20)

    def test_who_asks_for_what_is_not_there_or_taken_is_refused_on_both_sides(self):
        program, domain = self.served("--domain", self.free_domain(), "--set", "wait=3 s")
        self.controller("help_mote", domain, "--agents", "m*", "--name", "first")
        time.sleep(0.5)
        taken = self.controller("help_mote", domain, "--agents", "m3", "--name", "second").finish()
        unknown = self.controller("help_mote", domain, "--agents", "x9", "--name", "third").finish()
        self.assertEqual((taken.status, unknown.status), (2, 2))
        self.assertRegex(taken.err, r"m3.*first")
        self.assertRegex(unknown.err, r"x9")
        finished = program.finish()
        self.assertEqual(finished.status, 1, str(finished))
        for line in (r"second.*m3", r"third.*x9", r"r0 \(help_robot\)"):
            self.assertRegex(finished.err, line)

    def test_a_busy_domain_names_who_holds_it(self):
        program, domain = self.served("--domain", self.free_domain())
        other = self.run_baraka(CASE_STUDY, "--domain", domain, status=1)
        self.assertRegex(other.err, rf"domain {domain}.*{program.process.pid}")


if __name__ == "__main__":
    unittest.main()
