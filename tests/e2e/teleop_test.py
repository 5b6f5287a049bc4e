#!/usr/bin/env python3
"""A robot whose brain is `teleop` does what comes on rt/<agent>/cmd_vel, and stops when nothing
comes any more."""
import math
import pathlib
import signal
import sqlite3
import time

from baraka import ROOT, Case, Program, some_domain, unittest, wait_for
from ros import Peer, needs_peer

TELEOP = pathlib.Path(__file__).parent / "teleop.yaml"
RECORDED = ["--set", "record.pose_period=100 ms"]
SPEED, BRAKING = 0.5, 1.5  # m/s as commanded; m/s^2 of the robot's file


class Teleop(Case):
    def poses(self):
        """(s, x, y) of the robot so far."""
        try:
            return [(at / 1e9, x, y) for at, x, y in
                    self.query("SELECT at_ns, x_m, y_m FROM poses ORDER BY at_ns")]
        except sqlite3.Error:
            return []  # not there yet

    def drive(self, domain, rate, *arguments):
        """Commands 0.5 m/s, so many times a second, until the robot has moved; then lets go and ends
        the run after a while. Returns the finished run, and (m/s, s, m): speeds, when and where."""
        run = self.start(TELEOP, *RECORDED, *arguments)
        peer = Peer(self, "write", domain, "Twist", "rt/r0/cmd_vel", rate, SPEED, 0, 0)
        wait_for(lambda: any(x > 0.8 for _, x, _ in self.poses()))
        peer.end()
        time.sleep(3)
        run.process.send_signal(signal.SIGINT)
        finished = run.finish()
        self.assertEqual(finished.status, 130, str(finished))
        poses = self.poses()
        self.assertAlmostEqual(poses[-1][2], 0, delta=0.01)  # y
        return finished, [((x - x0) / (t - t0), t, x)
                          for (t0, x0, _), (t, x, _) in zip(poses, poses[1:])]

    def check_repetition(self, driven):
        """Nobody drives now, and no domain is needed: the velocities come from the record."""
        record = self.out
        ((arrivals,),) = self.query("SELECT count(*) FROM arrivals WHERE door = 'cmd_vel of r0'")
        self.assertGreater(arrivals, 0)
        for how in ([], ["--controllers", "in-process", "--no-inspect"]):
            repeated = self.run_baraka(TELEOP, *RECORDED, "--repeat", record, *how)
            for key in ("fingerprint", "simulated_s"):
                self.assertEqual(repeated[key], driven[key], key)
            self.assertEqual(self.query("SELECT count(*) FROM arrivals"), [(arrivals,)])
        undriven = self.run_baraka(TELEOP, *RECORDED, "--until", driven["simulated_s"])
        self.assertNotEqual(undriven["fingerprint"], driven["fingerprint"])

    @needs_peer
    def test_the_robot_drives_as_it_is_told_and_stops_when_nothing_comes(self):
        domain = some_domain(self)
        finished, track = self.drive(domain, 20, "--pace", "realtime", "--domain", domain)
        self.assertAlmostEqual(max(track)[0], SPEED, delta=0.05)
        _, at, x = [one for one in track if one[0] > 0.96 * SPEED][-1]
        # Poses are recorded while it moves, every 100 ms; it settles within a second.
        self.assertLess(track[-1][1], float(finished["simulated_s"]) - 0.5, "it never stopped")
        self.assertLess(track[-1][1] - at, 0.1 + SPEED / BRAKING + 1)
        self.assertLess(track[-1][2] - x, SPEED * 0.1 + SPEED ** 2 / (2 * BRAKING) + 0.02)
        self.check_repetition(finished)

    @needs_peer
    def test_a_command_holds_for_the_command_timeout_only(self):
        """0.5 s of every second: it speeds up for as long, and stands before the next comes. Here
        without inspection and in a domain that is not the run's."""
        domain = some_domain(self)
        finished, track = self.drive(domain, 1, "--controllers", "in-process", "--no-inspect",
                                     "--inspect-domain", domain, "--max-speed", "1")
        self.assertIn(f"inspect domain: {domain}", finished.err)
        fast = [k for k, one in enumerate(track) if one[0] > 0.3]
        self.assertTrue(any(one[0] < 0.02 for one in track[fast[0]:fast[-1]]), track)
        self.check_repetition(finished)

    def test_in_process_without_a_domain_is_an_error_that_says_what_to_do(self):
        finished = self.run_baraka(TELEOP, "--controllers", "in-process", status=2)
        self.assertRegex(finished.err, r"teleop\.yaml:\d+:\d+: program: 'teleop' needs .*--inspect-domain N")
        for how, status in (([], 0), (["--controllers", "in-process"], 2)):
            checked = Program("baraka", "check", TELEOP, *how).finish()
            self.assertEqual(checked.status, status, str(checked))
            self.assertEqual(checked.err, finished.err if status else "")

    def test_without_commands_the_robot_stands(self):
        self.run_baraka(TELEOP, "--until", "20")
        for _, x, y in self.poses():
            self.assertLess(math.hypot(x, y), 0.001)

    def test_parameters_and_motes_are_refused_with_their_place(self):
        parameter = "agents.robots.controller.parameters={speed: 1 m/s}"
        finished = self.run_baraka(TELEOP, "--set", parameter, status=2)
        self.assertRegex(finished.err, r"--set .*speed: is not a known parameter; teleop has none")
        scenario = self.folder / "mote.yaml"
        scenario.write_text(TELEOP.read_text().replace(
            "robot: {include: ../../config/robots/robertino.yaml}",
            f"mote: {{include: {ROOT}/config/robots/mote.yaml}}"))
        finished = self.run_baraka(scenario, status=2)
        self.assertRegex(finished.err,
                         r"mote.yaml:\d+:\d+: program: 'teleop' does not drive agents like r0")


if __name__ == "__main__":
    unittest.main()
