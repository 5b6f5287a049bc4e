#!/usr/bin/env python3
"""Robots on fixed and on mecanum wheels, driven over DDS and in process, as the record and a reader
that knows only ROS 2 see them."""
import math
import unittest

from baraka import ROOT, Case, some_domain
from ros import Peer, needs_peer

EIGHT = ROOT / "tests/e2e/eight.yaml"
ROBOTS = {"b0": 0, "b1": 10, "y0": 20, "y1": 30}  # x of the start, m
YAW = math.radians(30)
RADIUS = 1.0  # m
PATH = 4 * math.pi * RADIUS  # m


def turned(theta, x, y):
    return math.cos(theta) * x - math.sin(theta) * y, math.sin(theta) * x + math.cos(theta) * y


def off_the_eight(x, y):
    """Distance of a point, in the frame of the start, to the two circles."""
    return min(abs(math.hypot(x, y - side * RADIUS) - RADIUS) for side in (-1, 1))


class Drives(Case):
    def poses(self, robot):
        """x, y, heading in the frame of the start, by time."""
        rows = self.query(f"SELECT at_ns, p.x_m, p.y_m, p.theta_rad FROM poses AS p "
                          f"JOIN agents USING (agent) WHERE name = '{robot}' ORDER BY at_ns")
        return {at: (*turned(-YAW, x - ROBOTS[robot], y), theta - YAW) for at, x, y, theta in rows}

    def test_they_follow_a_figure_of_eight_over_dds_as_in_process(self):
        inside = self.run_baraka(EIGHT, "--controllers", "in-process")
        over_dds = self.run_baraka(EIGHT)
        self.assertEqual(inside["result"], "done")
        self.assertEqual(inside["fingerprint"], over_dds["fingerprint"])
        for robot in ROBOTS:
            poses = self.poses(robot)
            self.assertGreater(len(poses), 80)
            for x, y, _ in poses.values():
                self.assertLess(off_the_eight(x, y), 0.02 * PATH, robot)
            for side in (-1, 1):  # it was at the far end of both circles
                self.assertLess(min(math.hypot(x, y - side * 2 * RADIUS)
                                    for x, y, _ in poses.values()), 0.2, robot)

    def test_what_the_wheels_cannot_do_is_left_out_and_said(self):
        sideways = [f"agents.{group}.controller.parameters.sideways=0.05 m/s"
                    for group in ("burgers_jointed", "burgers_contact", "youbots_jointed",
                                  "youbots_contact")]
        self.run_baraka(EIGHT, "--until", 10, *[word for one in sideways for word in ("--set", one)])
        said = {robot: {state for state, in self.query(
            f"SELECT state FROM states JOIN agents USING (agent) WHERE name = '{robot}'")}
            for robot in ROBOTS}
        self.assertIn("restricted", said["b0"])
        self.assertIn("restricted", said["b1"])
        self.assertEqual(said["y0"], {"driving"})
        self.assertEqual(said["y1"], {"driving"})

    @needs_peer
    def test_a_reader_of_ros_2_sees_their_odometry_within_a_percent_of_the_way(self):
        domain = some_domain(self)
        topics = [word for robot in ROBOTS for word in ("Odometry", f"rt/{robot}/odom")]
        peer = Peer(self, "read", domain, *topics)
        self.run_baraka(EIGHT, "--max-speed", 20, "--domain", domain)
        peer.end()
        for robot in ROBOTS:
            poses = self.poses(robot)
            compared = 0
            for sample in peer.samples(f"rt/{robot}/odom"):
                if sample["t"] not in poses:
                    continue
                compared += 1
                x, y, _ = poses[sample["t"]]
                seen_x, seen_y, _ = sample["position"]
                self.assertLess(math.hypot(seen_x - x, seen_y - y), 0.01 * PATH, robot)
                if robot.startswith("b"):  # two fixed wheels tell nothing of the side but rounding
                    self.assertAlmostEqual(sample["linear"][1], 0, delta=1e-12)  # m/s
            self.assertGreater(compared, 40, robot)


if __name__ == "__main__":
    unittest.main()
