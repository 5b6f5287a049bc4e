#!/usr/bin/env python3
"""Runs in real time: nobody waits for controllers, nothing is lost, and they can be repeated."""
import re
import sqlite3
import time
import unittest

from baraka import CASE_STUDY, ROOT, Case, Program, children, send, wait_for

TALLY = ROOT / "tests/e2e/tally.yaml"


class Repetition(Case):
    def wait_until(self, seconds):
        """Of simulated time, however slow the machine is."""
        def is_there():
            try:
                return self.query(f"SELECT count(*) FROM poses WHERE at_ns >= {seconds}e9") != [(0,)]
            except sqlite3.OperationalError:
                return False  # not even the tables are there
        wait_for(is_there)

    def test_a_disturbed_run_is_repeated_to_the_same_fingerprint(self):
        arguments = ["--until", "60"]
        program = self.start(CASE_STUDY, "--pace", "realtime:20", *arguments)
        record = self.out
        (robot,) = wait_for(lambda: children(program.process.pid, "help_robot"))
        self.wait_until(5)
        send(robot, "SIGSTOP")
        time.sleep(0.3)  # 6 s of simulated time: its wheels stop after command_timeout
        send(robot, "SIGCONT")
        disturbed = program.finish()
        self.assertEqual(disturbed.status, 0, str(disturbed))
        self.assertGreaterEqual(int(disturbed["command_timeouts"]), 1)
        self.assertGreaterEqual(int(disturbed["missed_cycles"]), 10)
        for how in ([], ["--controllers", "in-process"]):
            repeated = self.run_baraka(CASE_STUDY, "--repeat", record, *how)
            for key in ("fingerprint", "missed_cycles", "command_timeouts", "simulated_s"):
                self.assertEqual(repeated[key], disturbed[key], key)
        begun = self.run_baraka(CASE_STUDY, "--repeat", record, "--until", "20")
        self.assertEqual(float(begun["simulated_s"]), 20)
        overwriting = Program("baraka", "run", CASE_STUDY, "--repeat", record, "--out", record).finish()
        self.assertEqual(overwriting.status, 2, str(overwriting))
        self.assertIn("would be overwritten", overwriting.err)
        undisturbed = self.run_baraka(CASE_STUDY, *arguments)
        self.assertNotEqual(undisturbed["fingerprint"], disturbed["fingerprint"])

    def test_a_death_is_repeated_too(self):
        silence = ["--set", "on_death=silence"]
        program = self.start(CASE_STUDY, "--pace", "realtime:20", "--until", "60", *silence)
        record = self.out
        (robot,) = wait_for(lambda: children(program.process.pid, "help_robot"))
        self.wait_until(5)
        send(robot, "SIGKILL")
        orphaned = program.finish()
        self.assertEqual(orphaned.status, 0, str(orphaned))
        repeated = self.run_baraka(CASE_STUDY, "--repeat", record, "--controllers", "in-process", *silence)
        self.assertEqual(repeated["fingerprint"], orphaned["fingerprint"])
        undisturbed = self.run_baraka(CASE_STUDY, "--until", "60", *silence)
        self.assertNotEqual(undisturbed["fingerprint"], orphaned["fingerprint"])

    def test_only_a_run_in_real_time_of_this_scenario_is_repeated(self):
        self.run_baraka(CASE_STUDY, "--until", "1")
        lock_step = self.out
        refused = self.run_baraka(CASE_STUDY, "--repeat", lock_step, status=1)
        self.assertRegex(refused.err, "not a run in real time")
        refused = self.run_baraka(CASE_STUDY, "--repeat", lock_step, "--seed", "5", status=2)
        self.assertRegex(refused.err, "not of this scenario with these settings")
        nowhere = self.folder / "nowhere"
        self.assertIn(str(nowhere), self.run_baraka(CASE_STUDY, "--repeat", nowhere, status=2).err)

    def test_a_pace_that_is_none_is_refused(self):
        for pace in ("fast", "realtime:", "realtime:0", "realtime:-1", "realtime:1x",
                     "realtime:nan", "realtime2"):
            refused = self.run_baraka(CASE_STUDY, "--pace", pace, status=2)
            self.assertRegex(refused.err, f"--pace: '{pace}' is not one of lockstep, realtime")


class SlowControllers(Case):
    """100 messages a second to a controller that cannot keep up."""

    def check_sums(self, finished):
        self.assertEqual(finished.status, 0, str(finished))
        states = dict(self.query("SELECT name, state FROM states JOIN agents USING (agent)"))
        received, disordered = map(int, re.search(r"received (\d+) disordered (\d+)",
                                                  states["c0"]).groups())
        ((delivered,),) = self.query("SELECT count(*) FROM deliveries JOIN agents"
                                     " ON agent = receiver WHERE name = 'c0'")
        self.assertEqual(int(finished["lost_events"]), 0)
        self.assertEqual(received, delivered)
        self.assertEqual(disordered, 0)
        ((sent,),) = self.query("SELECT count(*) FROM messages")  # 600 in 6 s, fewer where the sender is late, too
        self.assertGreater(sent, 0)
        self.assertGreaterEqual(received, sent - 2)  # those of the last instant

    def test_one_that_sleeps_half_a_second_in_each_cycle_gets_every_message_in_order(self):
        slow = "agents.receiver.controller.parameters.sleep=500 ms"
        finished = self.run_baraka(TALLY, "--pace", "realtime", "--set", slow)
        self.check_sums(finished)
        self.assertGreater(int(finished["missed_cycles"]), 400)  # of 600, at two a second

    def test_one_that_is_stopped_for_two_seconds_gets_every_message_in_order(self):
        program = self.start(TALLY, "--pace", "realtime")
        _, receiver = wait_for(lambda: self.two(program.process.pid))
        wait_for(self.out.exists)  # it has begun
        time.sleep(1)
        send(receiver, "SIGSTOP")
        time.sleep(2)
        send(receiver, "SIGCONT")
        finished = program.finish()
        self.check_sums(finished)
        self.assertGreaterEqual(int(finished["missed_cycles"]), 150)  # of 200

    def two(self, pid):
        """The processes of sender and receiver, in the order of their agents."""
        found = children(pid, "tally")
        return found if len(found) == 2 else None

    def test_one_that_dies_ends_the_run(self):
        program = self.start(TALLY, "--pace", "realtime")
        _, receiver = wait_for(lambda: self.two(program.process.pid))
        wait_for(self.out.exists)  # it has begun
        send(receiver, "SIGKILL")
        finished = program.finish()
        self.assertEqual(finished.status, 1, str(finished))
        self.assertRegex(finished.err, r"error: .*killed by signal 9 \(agents c0\)")


if __name__ == "__main__":
    unittest.main()
