#!/usr/bin/env python3
"""A robot whose brain is `teleop` does what comes on rt/<agent>/cmd_vel, and stops when nothing
comes any more."""
import math
import pathlib
import signal
import sqlite3
import time

from baraka import ROOT, Case, unittest, wait_for
from ros import Peer, needs_peer, some_domain

TELEOP = pathlib.Path(__file__).parent / "teleop.yaml"
COMMAND_TIMEOUT = 0.5  # s, the scenario's default
SLOWING_DOWN = 0.4  # s, from 0.5 m/s at 1.5 m/s^2


class Teleop(Case):
    def poses(self):
        """(s, x, y) of the robot so far."""
        try:
            return [(at / 1e9, x, y) for at, x, y in
                    self.query("SELECT at_ns, x, y FROM poses ORDER BY at_ns")]
        except sqlite3.Error:
            return []  # not there yet

    def drive(self, domain, *arguments):
        """Drives forward at 0.5 m/s until the robot has moved, lets go, and ends the run after a
        while. Returns the finished run."""
        run = self.start(TELEOP, "--max-speed", "1", "--set", "record.pose_period=100 ms",
                         *arguments)
        peer = Peer(self, "write", domain, "Twist", "rt/r0/cmd_vel", 20, 0.5, 0, 0)
        wait_for(lambda: any(x > 0.2 for _, x, _ in self.poses()))
        peer.end()
        time.sleep(3)
        run.process.send_signal(signal.SIGINT)
        return run.finish()

    def check(self, finished):
        self.assertEqual(finished.status, 130, str(finished))
        poses = self.poses()
        speeds = [((b[1] - a[1]) / (b[0] - a[0]), b[0]) for a, b in zip(poses, poses[1:])]
        self.assertAlmostEqual(max(speeds)[0], 0.5, delta=0.05)  # m/s
        last, x, y = poses[-1]  # poses are recorded while the robot moves
        self.assertLess(last, float(finished["simulated_s"]) - 0.5, "it never stopped")
        self.assertAlmostEqual(y, 0, delta=0.01)
        # From the last command on: the timeout, the way to a stop, and half a control period each.
        cruising = [at for speed, at in speeds if speed > 0.48]
        slow = [at for speed, at in speeds if at > cruising[-1] and speed < 0.01]
        self.assertLess((slow + [last])[0] - cruising[-1], SLOWING_DOWN + 0.3)

    @needs_peer
    def test_the_robot_drives_as_it_is_told_and_stops_when_nothing_comes(self):
        domain = some_domain()
        self.check(self.drive(domain, "--domain", domain))

    @needs_peer
    def test_it_works_without_inspection_and_in_a_domain_of_its_own(self):
        domain = some_domain()
        finished = self.drive(domain, "--controllers", "in-process", "--no-inspect",
                              "--inspect-domain", domain)
        self.check(finished)
        self.assertIn(f"inspect domain: {domain}", finished.err)

    def test_in_process_without_a_domain_is_an_error_that_says_what_to_do(self):
        finished = self.run_baraka(TELEOP, "--controllers", "in-process", status=1)
        self.assertIn("--inspect-domain N", finished.err)

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
